// SPDX-License-Identifier: MIT
#include "correspondence_clips.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/representation/representation.h>

namespace strut::study {
namespace {

std::vector<Motion> read_takes(const std::string& folder, const std::string& content, const std::string& style,
                               Takes takes) {
  std::vector<Motion> clips;
  const int first = takes == Takes::kLearnt ? 1 : 13, last = takes == Takes::kLearnt ? 12 : 17;
  for (int take = first; take <= last; ++take) {
    char number[16];
    std::snprintf(number, sizeof number, "%03d", take);
    clips.push_back(read_bvh(folder + "/dataset-2_" + content + "_" + style + "_" + number + ".bvh").motion);
  }
  return clips;
}

representation::StyleClips style_clips(const std::vector<Motion>& clips, const Eigen::Quaterniond& upright) {
  const auto representation = representation::fit_representation(clips, upright);
  representation::StyleClips style;
  for (const Motion& clip : clips) {
    style.rows.push_back(representation::encode(representation, clip));
    style.stillness.push_back(representation::foot_stillness(clip, *motion::find_legs(clip)));
  }
  return style;
}

std::vector<Piece> pieces_of(const std::vector<Motion>& clips, EventKind kind) {
  std::vector<Piece> pieces;
  for (std::size_t clip = 0; clip < clips.size(); ++clip) {
    const auto of_clip = pieces_of(clips[clip], static_cast<int>(clip), kind);
    pieces.insert(pieces.end(), of_clip.begin(), of_clip.end());
  }
  return pieces;
}

/// Where the warp puts the moment `time` [frames since the piece began].
double mapped(const Eigen::VectorXd& output_time, double time) {
  const Eigen::Index i = std::min(static_cast<Eigen::Index>(time), output_time.size() - 2);
  const double share = time - static_cast<double>(i);
  return (1.0 - share) * output_time[i] + share * output_time[i + 1];
}

void add(ClipFigures& figures, const Method& method, const Signals& signals, const Piece& input, const Piece& output) {
  const align::Correspondence found = solve(method, signals);
  const Eigen::VectorXd time = found.output_time();
  for (const Event& a : input.events) {
    for (const Event& b : output.events) {
      if (a.name != b.name) continue;
      const double error = mapped(time, a.time - input.begin) - (b.time - output.begin);
      figures.all.add_error(error);
      (a.is_landing ? figures.landings : figures.leavings).add_error(error);
    }
  }
  figures.all.add_warp(found.differential_warp, signals.frame_rate, slope_limit_of(method));
}

FrameMatrix rows_of(const std::vector<FrameMatrix>& clips, const Piece& piece) {
  return clips[static_cast<std::size_t>(piece.clip)].middleRows(piece.begin, piece.end - piece.begin);
}

}  // namespace

Cell read_cell(const std::string& folder, const std::string& content, const std::string& style, Takes takes) {
  return {content, style, read_takes(folder, content, "normal", takes), read_takes(folder, content, style, takes)};
}

std::vector<ClipFigures> judge(const Cell& cell, EventKind kind, const std::vector<Method>& methods) {
  const Eigen::Quaterniond upright = motion::upright_reference(cell.input);
  const auto input_clips = style_clips(cell.input, upright), output_clips = style_clips(cell.output, upright);
  const std::vector<Piece> inputs = pieces_of(cell.input, kind), outputs = pieces_of(cell.output, kind);
  const auto pairs = match(inputs, outputs);
  std::vector<ClipFigures> figures;
  for (const Method& method : methods) {
    const auto features =
        representation::timing_features(input_clips, output_clips, cell.input.front().frame_rate(), method.features);
    std::vector<ClipFigures> of_pair(pairs.size());
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
      const Piece& input = inputs[static_cast<std::size_t>(pairs[i].first)];
      const Piece& output = outputs[static_cast<std::size_t>(pairs[i].second)];
      const Signals signals{rows_of(features.input, input), rows_of(features.output, output), features.weights,
                            cell.input.front().frame_rate()};
      add(of_pair[i], method, signals, input, output);
    });
    ClipFigures all;
    for (const ClipFigures& one : of_pair) {
      all.landings.add(one.landings);
      all.leavings.add(one.leavings);
      all.all.add(one.all);
    }
    figures.push_back(std::move(all));
  }
  return figures;
}

double least_mean_error(const Cell& cell, EventKind kind, double slope_limit, bool landings_alone) {
  const std::vector<Piece> inputs = pieces_of(cell.input, kind), outputs = pieces_of(cell.output, kind);
  const auto pairs = match(inputs, outputs);
  std::vector<double> errors(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    errors[i] = least_mean_error(inputs[static_cast<std::size_t>(pairs[i].first)],
                                 outputs[static_cast<std::size_t>(pairs[i].second)], slope_limit, landings_alone);
  });
  double sum = 0.0;
  for (const double error : errors) sum += error;
  return sum / static_cast<double>(errors.size());
}

}  // namespace strut::study
