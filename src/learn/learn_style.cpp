// SPDX-License-Identifier: MIT
// represent -> align -> warp the output onto the input and add the time-warp column -> normalize -> fit the model.
#include "learn/coverage.h"
#include "learn/examples.h"
#include "learn/footplant_training.h"
#include "learn/learn_linear.h"
#include "learn/learn_radial.h"
#include "learn/normalized_pairs.h"
#include "learn/pair_alignment.h"
#include "learn/spectrum.h"

#include <cmath>

#include <strut/core/error.h>
#include <strut/learn/learn_style.h>

namespace strut {
namespace {

using learn::AlignedPair;
using learn::ClipPair;
using learn::Examples;
using learn::NormalizedPair;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The normalized log time warp that the linear systems give on each pair, run through its lead-in first.
std::vector<Eigen::VectorXd> timing_of(const std::vector<StyleBlock>& blocks,
                                       const std::vector<NormalizedPair>& pairs) {
  std::vector<Eigen::VectorXd> timing;
  for (const NormalizedPair& pair : pairs) {
    timing.emplace_back(Eigen::VectorXd::Zero(pair.output.rows()));
    for (const StyleBlock& block : blocks) {
      if (block.output_dofs.front() != pair.output.cols() - 1) continue;
      FrameMatrix u(pair.input.rows(), block.system.num_inputs());
      for (std::size_t i = 0; i < block.input_dofs.size(); ++i) {
        u.col(static_cast<Eigen::Index>(i)) = pair.input.col(block.input_dofs[i]);
      }
      timing.back() = sysid::simulate(block.system, u).col(0).tail(pair.output.rows());
    }
  }
  return timing;
}

/// E[exp(log w)] is not exp(E[log w]) (Jensen): one constant makes the durations of all examples together come out
/// right.
/// `timing`: normalized, per pair (frames).
void calibrate_timing(const std::vector<AlignedPair>& aligned, const std::vector<Eigen::VectorXd>& timing,
                      StyleModelParts& parts, LearnReport& report) {
  const Eigen::Index dof = parts.input.num_dofs();
  Eigen::VectorXd mean = parts.output_scaling.mean();
  const double scale = parts.output_scaling.scale()[dof];
  double real = 0.0, predicted = 0.0, input_frames = 0.0;
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    real += aligned[i].output.col(dof).array().exp().sum();
    predicted += (mean[dof] + scale * timing[i].array()).exp().sum();
    input_frames += static_cast<double>(aligned[i].output.rows());
  }
  mean[dof] += std::log(real / predicted);
  parts.output_scaling = {std::move(mean), parts.output_scaling.scale()};
  report.duration_ratio = real / input_frames;
}

void check_options(const LearnOptions& options) {
  const auto check = [](const char* name, double value, double least) {
    if (!(value >= least && std::isfinite(value))) {
      throw InvalidArgument(name, "a number of at least " + std::to_string(least), std::to_string(value));
    }
  };
  check("time_warp_smoothing", options.time_warp_smoothing.value_or(0.0), 0.0);
  check("lead_in", options.lead_in, 0.0);
  check("longest_memory", options.longest_memory, 0.01);
  check("frame_rate", options.frame_rate, 0.0);
  check("context", options.context, 0.0);
  check("radial.centres", options.radial.centres, 1.0);
  check("radial.width", options.radial.width, 0.01);
  check("radial.ridge", options.radial.ridge, 1e-9);
  check("radial.lags", options.radial.lags, 1.0);
  check("radial.lag", options.radial.lag, 0.0);
}

void check_pairs(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                 const std::vector<ClipPair>& pairs) {
  if (pairs.empty()) throw InvalidArgument("pairs", "at least one pair", "none");
  if (inputs.empty()) throw InvalidArgument("inputs", "at least one clip", "none");
  if (outputs.empty()) throw InvalidArgument("outputs", "at least one clip", "none");
  const auto check = [](const char* which, int clip, const motion::FrameRange& range,
                        const std::vector<Motion>& clips) {
    if (clip < 0 || clip >= static_cast<int>(clips.size())) {
      throw InvalidArgument(which, "a clip from 0 to " + std::to_string(clips.size() - 1), std::to_string(clip));
    }
    const int frames = clips[at(clip)].num_frames();
    if (range.begin < 0 || range.end <= range.begin || range.end > frames) {
      throw InvalidArgument(std::string(which) + " frames", "a range inside 0 to " + std::to_string(frames),
                            std::to_string(range.begin) + " to " + std::to_string(range.end));
    }
  };
  for (const ClipPair& pair : pairs) {
    check("input", pair.input_clip, pair.input_frames, inputs);
    check("output", pair.output_clip, pair.output_frames, outputs);
  }
}

}  // namespace

LearntStyle learn_style(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
                        const std::vector<ClipPair>& pairs, const LearnOptions& options,
                        const DescribeProvenance& provenance, Diagnostics* diagnostics, const Progress& progress) {
  check_pairs(inputs, outputs, pairs);
  check_options(options);
  const std::string mismatch = describe_mismatch(inputs.front().skeleton(), outputs.front().skeleton());
  if (!mismatch.empty()) throw SkeletonMismatch("input and output clips have different skeletons: " + mismatch);

  const double frame_rate = options.frame_rate > 0.0 ? options.frame_rate : inputs.front().frame_rate();
  Examples examples = learn::represent_examples(inputs, outputs, pairs, frame_rate);
  examples.planted = learn::footplant_marks(outputs, options.footplants, examples, diagnostics);
  const std::vector<AlignedPair> aligned = learn::align_pairs(examples, options, diagnostics, progress);
  LearnReport report;
  report.num_pairs = static_cast<int>(aligned.size());
  report.num_refused = static_cast<int>(pairs.size() - aligned.size());

  const learn::Scalings scalings = learn::fit_scalings(aligned);
  const bool sees_context = options.method != LearnMethod::kPaper && options.context > 0;
  const Eigen::MatrixXd context = learn::fit_context(aligned, scalings, sees_context ? options.context : 0);
  StyleModelParts parts{frame_rate,
                        examples.input.representation,
                        examples.output.representation,
                        scalings.input,
                        scalings.output,
                        context,
                        {},
                        {},
                        {}};
  if (options.method == LearnMethod::kRadial && context.rows() > 0) {
    learn::LearntRadialMap learnt = learn::learn_radial_map(examples, aligned, scalings, context, options.radial);
    report.num_centres = learnt.map.basis.num_centres();
    parts.radial_map = std::move(learnt.map);
    report.blocks = std::move(learnt.blocks);
    calibrate_timing(aligned, learnt.timing, parts, report);
    const learn::Spectrum spectrum = learn::choose_spectrum(examples, parts);
    parts.radial_map->smoothing = spectrum.smoothing;
    parts.radial_map->fast = spectrum.fast;
  } else {
    const std::vector<NormalizedPair> normalized = learn::normalize_pairs(aligned, scalings, context);
    parts.blocks = learn::identify_blocks(examples, aligned, normalized, scalings, static_cast<int>(context.rows()),
                                          options, report, diagnostics, progress);
    calibrate_timing(aligned, timing_of(parts.blocks, normalized), parts, report);
  }

  report.footplants = learn::learn_footplants(examples, aligned, parts);
  learn::report_coverage(examples, aligned, report, diagnostics);
  parts.provenance = provenance ? provenance(report) : "{}";
  return {std::make_shared<const StyleModel>(std::move(parts)), std::move(report)};
}

}  // namespace strut
