// SPDX-License-Identifier: MIT
#include "correspondence_walks.h"

#include "walker_styles.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <tbb/parallel_for.h>

namespace strut::study {
namespace {

using generate::WalkContent;
using generate::WalkStyle;

constexpr double kVariation = 2.5;  // of steps: about 5 % of length and time, in each motion by itself

/// Straight at two speeds, a turn, and a change of pace with the path bending after it.
std::vector<WalkContent> contents() {
  using generate::Schedule;
  WalkContent steady, slow, turn, pace;
  for (WalkContent* content : {&steady, &slow, &turn, &pace}) content->duration = 4.0;
  slow.speed = 0.8;
  turn.turn_rate = 0.6;
  pace.speed = Schedule({{0.0, 0.8}, {1.5, 0.8}, {2.5, 1.6}});
  pace.turn_rate = Schedule({{2.0, 0.0}, {3.0, -0.5}});
  return {steady, slow, turn, pace};
}

Motion with_noise(const Motion& motion, double deviation, unsigned seed) {
  if (deviation == 0.0) return motion;
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    for (Eigen::Quaterniond& rotation : pose.rotations) {
      const Eigen::Vector3d turn(normal(generator), normal(generator), normal(generator));
      rotation = (rotation * Eigen::AngleAxisd(turn.norm(), turn.normalized())).normalized();
    }
  }
  return {motion.shared_skeleton(), motion.frame_rate(), std::move(frames)};
}

Signals signals_of(const Method& method, const WalkPair& pair) {
  auto features = representation::timing_features(pair.input, pair.output, method.features);
  return {std::move(features.input), std::move(features.output), std::move(features.weights), pair.input.frame_rate()};
}

void add(Figures& figures, const Method& method, const Signals& signals, const std::vector<double>& truth) {
  const align::Correspondence found = solve(method, signals);
  const Eigen::VectorXd time = found.output_time();
  for (Eigen::Index t = 0; t < time.size(); ++t) {
    figures.add_error((time[t] - truth[static_cast<std::size_t>(t)]) * 30.0 / signals.frame_rate);
  }
  figures.add_warp(found.differential_warp, signals.frame_rate, slope_limit_of(method));
}

/// One degree of freedom of `all`, with its rate of change where there is one.
Signals single(const Signals& all, Eigen::Index dof, Eigen::Index num_posture, const Method& method) {
  const bool moves = method.features.movement > 0.0;
  Signals one{
      FrameMatrix(all.input.rows(), moves ? 2 : 1), FrameMatrix(all.output.rows(), moves ? 2 : 1), {}, all.frame_rate};
  one.input.col(0) = all.input.col(dof);
  one.output.col(0) = all.output.col(dof);
  if (!moves) return one;
  one.input.col(1) = all.input.col(num_posture + dof);
  one.output.col(1) = all.output.col(num_posture + dof);
  one.weights = Eigen::Vector2d(method.features.posture, method.features.movement);
  return one;
}

}  // namespace

std::vector<std::string> walk_styles() {
  std::vector<std::string> names;
  for (const auto& [name, style] : walker_styles()) names.push_back(name);
  return names;
}

std::vector<WalkPair> walk_pairs(int seeds, double frame_rate, double noise) {
  std::vector<WalkPair> all;
  unsigned seed = 1;
  for (const auto& [name, style] : walker_styles()) {
    for (const WalkContent& content : contents()) {
      for (int k = 0; k < seeds; ++k) {
        WalkStyle plain, styled = style;
        plain.seed = seed++;
        styled.seed = seed++;
        plain.variation = styled.variation = kVariation;
        const generate::Walk a = generate::generate_walk(content, plain, frame_rate);
        const generate::Walk b = generate::generate_walk(content, styled, frame_rate);
        all.push_back({name, with_noise(a.motion, noise, seed), with_noise(b.motion, noise, seed + 1000000),
                       generate::true_correspondence(a, b)});
      }
    }
  }
  return all;
}

std::vector<std::vector<generate::Walk>> walk_groups(int seeds, double frame_rate) {
  auto members = walker_styles();
  members.insert(members.begin(), {"plain", WalkStyle()});
  std::vector<std::vector<generate::Walk>> groups;
  unsigned seed = 1;
  for (int k = 0; k < seeds; ++k) {
    for (const WalkContent& content : contents()) {
      groups.emplace_back();
      for (auto& [name, style] : members) {
        style.seed = seed++;
        style.variation = kVariation;
        groups.back().push_back(generate::generate_walk(content, style, frame_rate));
      }
    }
  }
  return groups;
}

std::vector<Figures> judge(const Method& method, const std::vector<WalkPair>& pairs) {
  std::vector<Figures> of_pair(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(),
                    [&](std::size_t i) { add(of_pair[i], method, signals_of(method, pairs[i]), pairs[i].truth); });
  const std::vector<std::string> names = walk_styles();
  std::vector<Figures> figures(names.size() + 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto style = std::find(names.begin(), names.end(), pairs[i].style) - names.begin();
    figures[static_cast<std::size_t>(style)].add(of_pair[i]);
    figures.back().add(of_pair[i]);
  }
  return figures;
}

Figures judge_single_dofs(const Method& method, const std::vector<WalkPair>& pairs) {
  std::vector<Figures> of_pair(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    Method without_feet = method;
    without_feet.features.feet = 0.0;
    const Signals all = signals_of(without_feet, pairs[i]);
    const Eigen::Index num_posture = method.features.movement > 0.0 ? all.input.cols() / 2 : all.input.cols();
    for (Eigen::Index dof = 0; dof < num_posture; ++dof) {
      if (all.weights[dof] == 0.0) continue;
      add(of_pair[i], method, single(all, dof, num_posture, method), pairs[i].truth);
    }
  });
  Figures figures;
  for (const Figures& one : of_pair) figures.add(one);
  return figures;
}

Figures true_figures(const std::vector<WalkPair>& pairs) {
  Figures figures;
  for (const WalkPair& pair : pairs) {
    const auto n = static_cast<Eigen::Index>(pair.truth.size());
    const Eigen::Map<const Eigen::VectorXd> time(pair.truth.data(), n);
    figures.add_warp(time.tail(n - 1) - time.head(n - 1), pair.input.frame_rate(), 2.0);
  }
  return figures;
}

}  // namespace strut::study
