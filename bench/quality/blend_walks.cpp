// SPDX-License-Identifier: MIT
// What is synthesized, measured: whether it travels as fast as asked, how far its feet slide, how well cycles close,
// and how smooth changes are.
#include "blend_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <strut/blend/learn_gaits.h>
#include <strut/blend/locomotion.h>
#include <strut/math/rotation.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/kinematics.h>

namespace strut::study {
namespace {

constexpr double kRate = 60.0;

std::shared_ptr<const blend::GaitModel> learnt_from_walkers() {
  std::vector<blend::StyledClip> clips;
  std::uint64_t seed = 1;
  for (const auto& [name, style] : walker_styles()) {
    for (const double speed : walker_speeds()) clips.push_back(walk_of(name, style, speed, 1.0, seed++, kRate));
  }
  return blend::learn_gaits(blend::gait_examples(clips)).model;
}

Eigen::VectorXd mixture(const blend::GaitModel& model, const std::vector<std::pair<std::string, double>>& weights) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.styles().size()));
  for (const auto& [name, weight] : weights) all[model.find_style(name)] = weight;
  return all;
}

double travelled(const Motion& motion) {
  const auto ground = [&](int f) {
    Eigen::Vector3d place = motion.frame(f).translations[0];
    place.y() = 0.0;
    return place;
  };
  return (ground(motion.num_frames() - 1) - ground(0)).norm();
}

/// Of a cycle that loops: how far what a joint does from its last frame to its first, played on, is from what it does
/// at that moment of a walk that goes on, in pose [deg] and velocity [rad/s]; and what steps of this walk differ by
/// there anyway, from one frame to the next [rad/s].
struct Seam {
  double pose = 0.0, velocity = 0.0, change = 0.0;
};

Seam seam(const std::shared_ptr<const blend::GaitModel>& model, const blend::GaitControls& controls) {
  const Motion cycle = blend::synthesize_cycle(model, controls).motion;
  const int count = cycle.num_frames();
  const double rate = count / model->loop(controls.weights, controls.speed).duration();
  const Motion walk =
      blend::synthesize(model, {{0.0, controls}}, (8 * count + 0.5) / rate, {.frame_rate = rate}).motion;
  Seam seam;
  for (std::size_t j = 0; j < cycle.frame(0).rotations.size(); ++j) {
    const auto step = [j](const Pose& from, const Pose& to) -> Eigen::Vector3d {
      return math::log_map(from.rotations[j].conjugate() * to.rotations[j]) * kRate;
    };
    const Eigen::Vector3d over = step(cycle.frame(count - 1), cycle.frame(0));
    const Eigen::Vector3d there = step(walk.frame(4 * count - 1), walk.frame(4 * count));
    const Eigen::Vector3d next = step(walk.frame(4 * count), walk.frame(4 * count + 1));
    seam.pose = std::max(seam.pose, cycle.frame(0).rotations[j].angularDistance(walk.frame(4 * count).rotations[j]));
    seam.velocity = std::max(seam.velocity, (over - there).norm());
    seam.change = std::max(seam.change, (next - there).norm());
  }
  return seam;
}

/// Of the model's own cycle: how far its end is from its beginning, in pose [rad, m] and velocity [per second].
std::pair<double, double> gap(const blend::GaitLoop& loop) {
  return {(loop.at(1.0) - loop.at(0.0)).cwiseAbs().maxCoeff(),
          (loop.rate_at(1.0) * loop.pace(1.0) - loop.rate_at(0.0) * loop.pace(0.0)).cwiseAbs().maxCoeff()};
}

/// Largest acceleration of a joint relative to the pelvis [m/s^2] in frames [begin, end).
double acceleration(const Motion& motion, double begin, double end) {
  const auto positions = motion::joint_positions_world(motion);
  const int first = std::max(1, static_cast<int>(begin * motion.frame_rate()));
  const int last = std::min(motion.num_frames() - 1, static_cast<int>(end * motion.frame_rate()));
  double most = 0.0;
  for (int f = first; f < last; ++f) {
    for (std::size_t j = 0; j < positions[0].size(); ++j) {
      const auto at = [&](int k) { return positions[static_cast<std::size_t>(k)][j]; };
      most = std::max(most, (at(f + 1) - 2.0 * at(f) + at(f - 1)).norm() * motion.frame_rate() * motion.frame_rate());
    }
  }
  return most;
}

void measure(const std::shared_ptr<const blend::GaitModel>& model, const char* name,
             const blend::GaitControls& controls) {
  Diagnostics told;
  try {
    const auto gait = blend::synthesize(model, {{0.0, controls}}, 20.0, {}, &told);
    const double speed = travelled(gait.motion) / ((gait.motion.num_frames() - 1) / gait.motion.frame_rate());
    const auto raw = blend::synthesize(model, {{0.0, controls}}, 20.0, {.clean_feet = false});
    const auto slide = [](const blend::SynthesizedGait& g) {
      return 100.0 * metrics::foot_slide(metrics::body_track(g.motion, kRate), g.footplants).speed;
    };
    const Seam held = seam(model, {controls.weights, controls.speed, 0.0});
    const auto [pose, velocity] = gap(model->loop(controls.weights, controls.speed));
    std::printf("| %s | %.2f | %.3f | %.2f | %.2f | %.1f | %.0e, %.0e | %.0e, %.0e of %.1f | %zu |\n", name,
                controls.speed, speed, 100.0 * std::abs(speed / controls.speed - 1.0), slide(gait), slide(raw), pose,
                velocity, held.pose, held.velocity, held.change, told.entries().size());
  } catch (const std::exception& error) {
    std::printf("| %s | %.2f | refused: %s |\n", name, controls.speed, error.what());
  }
}

}  // namespace

void judge_synthesis() {
  const auto model = learnt_from_walkers();
  const auto of = [&](const std::vector<std::pair<std::string, double>>& w) { return mixture(*model, w); };
  std::printf(
      "| asked for | speed [m/s] | made [m/s] | off [%%] | feet slide [cm/s] | before cleanup | the model's cycle: gap "
      "in pose, velocity | "
      "with feet held: gap in pose, velocity, of a step's change there | warnings |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const double speed : {0.6, 0.9, 1.2}) measure(model, "crouch", {of({{"crouch", 1.0}}), speed, 0.0});
  for (const double speed : {0.8, 1.2, 1.6}) measure(model, "swagger", {of({{"swagger", 1.0}}), speed, 0.0});
  for (const double speed : {0.5, 0.9, 1.3}) {
    measure(model, "half old, half march", {of({{"old", 0.5}, {"march", 0.5}}), speed, 0.0});
    measure(model, "half limp, half hurry", {of({{"limp", 0.5}, {"hurry", 0.5}}), speed, 0.0});
  }
  measure(model, "swagger 1.5, march -0.5", {of({{"swagger", 1.5}, {"march", -0.5}}), 1.1, 0.0});
  measure(model, "swagger, far too fast", {of({{"swagger", 1.0}}), 2.4, 0.0});
  measure(model, "old, slower than all", {of({{"old", 1.0}}), 0.15, 0.0});
  const auto crouch = of({{"crouch", 1.0}}), march = of({{"march", 1.0}});
  const auto change = [&](double from, double to) {
    return blend::synthesize(model, {{0.0, {crouch, 0.8, 0.0}}, {from, {crouch, 0.8, 0.0}}, {to, {march, 1.4, 0.3}}},
                             to + 6.0);
  };
  std::printf(
      "\n| from crouch at 0.8 m/s to march at 1.4 m/s within | peak acceleration before [m/s2] | during | after |\n"
      "| --- | ---: | ---: | ---: |\n");
  for (const double within : {0.5, 1.0, 2.0}) {
    const auto gait = change(6.0, 6.0 + within);
    std::printf("| %.1f s | %.0f | %.0f | %.0f |\n", within, acceleration(gait.motion, 1.0, 5.5),
                acceleration(gait.motion, 5.5, 6.5 + within), acceleration(gait.motion, 6.5 + within, 11.5 + within));
  }
  const auto turning = blend::synthesize(model, {{0.0, {of({{"swagger", 1.0}}), 1.1, 0.5}}}, 20.0);
  std::printf("\nturning by 0.5 rad/s: feet slide %.2f cm/s\n",
              100.0 * metrics::foot_slide(metrics::body_track(turning.motion, kRate), turning.footplants).speed);
}

}  // namespace strut::study
