// SPDX-License-Identifier: MIT
// represent -> align -> warp the output onto the input and add the time-warp column -> normalize -> identify per joint.
#include "learn/coverage.h"
#include "learn/examples.h"
#include "learn/pair_alignment.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/learn/learn_style.h>

namespace strut {
namespace {

using learn::AlignedPair;
using learn::ClipPair;
using learn::Examples;
using representation::kHeight;
using representation::kNumRootDofs;
using representation::Normalization;

/// How both styles are brought to unit variance.
struct Scalings {
  Normalization input;   // (dofs)
  Normalization output;  // (dofs + 1)
};

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Scalings fit_scalings(const std::vector<AlignedPair>& aligned) {
  std::vector<FrameMatrix> inputs, outputs;
  for (const AlignedPair& pair : aligned) {
    inputs.emplace_back(pair.input.bottomRows(pair.output.rows()));
    outputs.push_back(pair.output);
  }
  return {representation::fit_normalization(inputs), representation::fit_normalization(outputs)};
}

std::vector<int> kept(const Normalization& scaling, int first, int end) {
  std::vector<int> dofs;
  for (int d = first; d < end; ++d) {
    if (scaling.is_kept(d)) dofs.push_back(d);
  }
  return dofs;
}

/// What stands in a block until its system is identified.
sysid::LtiSystem no_system(std::size_t inputs, std::size_t outputs) {
  const auto m = static_cast<Eigen::Index>(inputs);
  const auto p = static_cast<Eigen::Index>(outputs);
  return {{}, Eigen::MatrixXd(0, m), Eigen::MatrixXd(p, 0), Eigen::MatrixXd::Zero(p, m)};
}

/// A block per part of the body, its system still to be identified. Parts of which only the output moves are reported.
std::vector<StyleBlock> plan_blocks(const representation::Representation& body, const Scalings& scalings,
                                    LearnReport& report) {
  std::vector<StyleBlock> blocks;
  const auto plan = [&](const std::string& name, int first_in, int end_in, int first_out, int end_out) {
    const std::vector<int> from = kept(scalings.input, first_in, end_in);
    const std::vector<int> to = kept(scalings.output, first_out, end_out);
    if (!from.empty() && !to.empty()) blocks.push_back({name, from, to, no_system(from.size(), to.size())});
    if (from.empty() && !to.empty()) report.untranslated.push_back(name);
  };
  plan("root", 0, kNumRootDofs, 0, kNumRootDofs);
  int column = kNumRootDofs;
  for (const int joint : body.joints()) {
    plan(body.skeleton().joint(joint).name, column, column + 3, column, column + 3);
    column += 3;
  }
  // "The best results were achieved by using the differential position and orientation of the root" (4.2).
  plan("timing", 0, kHeight, column, column + 1);
  return blocks;
}

/// The columns `dofs` of normalized `rows`.
FrameMatrix columns_of(const FrameMatrix& rows, const std::vector<int>& dofs) {
  FrameMatrix result(rows.rows(), static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = rows.col(dofs[i]);
  return result;
}

/// What identification did without, by the block's name. Its notes (fewer block rows on short clips) help nobody here.
void report_warnings(const std::vector<StyleBlock>& blocks, const std::vector<Diagnostics>& reports,
                     Diagnostics& diagnostics) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const Diagnostic& entry : reports[b].entries()) {
      if (entry.severity == Severity::kWarning) diagnostics.warn("'" + blocks[b].name + "'", entry.message, entry.hint);
    }
  }
}

/// Identifies every block's system, in parallel.
void identify_blocks(const std::vector<AlignedPair>& aligned, const Scalings& scalings, double frame_rate,
                     const LearnOptions& options, std::vector<StyleBlock>& blocks, LearnReport& report,
                     Diagnostics* diagnostics, const Progress& progress) {
  std::vector<FrameMatrix> inputs, outputs;
  std::vector<int> groups;
  for (const AlignedPair& pair : aligned) {
    inputs.push_back(scalings.input.normalize(pair.input));
    outputs.emplace_back(FrameMatrix::Zero(pair.input.rows(), pair.output.cols()));
    outputs.back().bottomRows(pair.output.rows()) = scalings.output.normalize(pair.output);
    groups.push_back(pair.input_clip);
  }
  sysid::IdentifyOptions identification = options.identification;
  identification.max_radius = std::exp(-1.0 / (options.longest_memory * frame_rate));
  report.blocks.resize(blocks.size());
  std::vector<Diagnostics> reports(blocks.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    std::vector<sysid::Experiment> experiments;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      experiments.push_back({columns_of(inputs[i], blocks[b].input_dofs), columns_of(outputs[i], blocks[b].output_dofs),
                             learn::lead_in_frames(options, frame_rate)});
    }
    const auto found = sysid::identify(experiments, groups, identification, &reports[b]);
    blocks[b].system = found.system;
    report.blocks[b] = {blocks[b].name, found.system.num_states(), found.fit,
                        sysid::simulated_fit(found.system, experiments)};
    const std::lock_guard<std::mutex> lock(mutex);
    if (progress) progress("identifying joints", ++done, static_cast<int>(blocks.size()));
  });
  if (diagnostics != nullptr) report_warnings(blocks, reports, *diagnostics);
}

/// E[exp(log w)] is not exp(E[log w]) (Jensen): one constant makes the durations of all examples together come out
/// right.
void calibrate_timing(const std::vector<AlignedPair>& aligned, StyleModelParts& parts, LearnReport& report) {
  const Eigen::Index dof = parts.input.num_dofs();
  const auto timing = std::find_if(parts.blocks.begin(), parts.blocks.end(),
                                   [&](const StyleBlock& block) { return block.output_dofs.front() == dof; });
  double real = 0.0, predicted = 0.0, input_frames = 0.0;
  for (const AlignedPair& pair : aligned) {
    Eigen::VectorXd log_warp = Eigen::VectorXd::Constant(pair.input.rows(), parts.output_scaling.mean()[dof]);
    if (timing != parts.blocks.end()) {
      const FrameMatrix u = columns_of(parts.input_scaling.normalize(pair.input), timing->input_dofs);
      log_warp += parts.output_scaling.scale()[dof] * sysid::simulate(timing->system, u).col(0);
    }
    real += pair.output.col(dof).array().exp().sum();
    predicted += log_warp.tail(pair.output.rows()).array().exp().sum();
    input_frames += static_cast<double>(pair.output.rows());
  }
  Eigen::VectorXd mean = parts.output_scaling.mean();
  mean[dof] += std::log(real / predicted);
  parts.output_scaling = {std::move(mean), parts.output_scaling.scale()};
  report.duration_ratio = real / input_frames;
  report.seconds = input_frames / parts.frame_rate;
}

void check_options(const LearnOptions& options) {
  const auto check = [](const char* name, double value, double least) {
    if (!(value >= least && std::isfinite(value))) {
      throw InvalidArgument(name, "a number of at least " + std::to_string(least), std::to_string(value));
    }
  };
  check("time_warp_smoothing", options.time_warp_smoothing, 0.0);
  check("lead_in", options.lead_in, 0.0);
  check("longest_memory", options.longest_memory, 0.01);
  check("frame_rate", options.frame_rate, 0.0);
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
  const Examples examples = learn::represent_examples(inputs, outputs, pairs, frame_rate);
  const std::vector<AlignedPair> aligned = learn::align_pairs(examples, options, diagnostics, progress);
  LearnReport report;
  report.num_pairs = static_cast<int>(aligned.size());
  report.num_refused = static_cast<int>(pairs.size() - aligned.size());

  const Scalings scalings = fit_scalings(aligned);
  std::vector<StyleBlock> blocks = plan_blocks(examples.input.representation, scalings, report);
  if (blocks.empty()) throw InvalidArgument("pairs", "clips in which something moves", "none");
  identify_blocks(aligned, scalings, frame_rate, options, blocks, report, diagnostics, progress);
  StyleModelParts parts{frame_rate,
                        examples.input.representation,
                        examples.output.representation,
                        scalings.input,
                        scalings.output,
                        std::move(blocks),
                        {}};
  calibrate_timing(aligned, parts, report);

  learn::report_coverage(examples.input.clips, examples.pairs, report, diagnostics);
  parts.provenance = provenance ? provenance(report) : "{}";
  return {std::make_shared<const StyleModel>(std::move(parts)), std::move(report)};
}

}  // namespace strut
