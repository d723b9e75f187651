// SPDX-License-Identifier: MIT
// represent -> align -> warp the output onto the input and add the time-warp column -> normalize -> identify per joint.
// Symbols of the paper: u input signal, y output signal, w differential time warp.
#include "learn/coverage.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

#include <tbb/parallel_for.h>

#include <strut/align/correspondence.h>
#include <strut/core/error.h>
#include <strut/learn/alignment_features.h>
#include <strut/learn/learn_style.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/representation/extrapolation.h>

namespace strut {
namespace {

using learn::ClipPair;
using representation::kHeight;
using representation::kNumRootDofs;
using representation::Normalization;
using representation::Representation;

// A pair that runs along its slope limit for more than half of its length has not been aligned.
constexpr double kLargestShareAtLimit = 0.5;

/// One pair with its output warped onto its input.
struct AlignedPair {
  int group = 0;       // the input clip: pairs of one clip are left out together
  FrameMatrix input;   // lead-in, then the pair (frames x dofs)
  FrameMatrix output;  // the pair alone (frames x dofs + 1): the last column is log w
};

/// All clips of one style as signals.
struct Style {
  Representation representation;
  std::vector<FrameMatrix> clips;  // each frames x dofs
};

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::vector<Motion> resampled(const std::vector<Motion>& clips, double frame_rate) {
  std::vector<Motion> result;
  for (const Motion& clip : clips) result.push_back(motion::resample(clip, frame_rate));
  return result;
}

/// A range of frames at another rate.
motion::FrameRange rescaled(const motion::FrameRange& range, double ratio, const Motion& clip) {
  const int begin = static_cast<int>(std::lround(range.begin * ratio));
  const int end = static_cast<int>(std::lround(range.end * ratio));
  return {std::min(begin, clip.num_frames()), std::min(end, clip.num_frames())};
}

Style represent(const std::vector<Motion>& clips, const Eigen::Quaterniond& upright) {
  Style style{representation::fit_representation(clips, upright), {}};
  for (const Motion& clip : clips) style.clips.push_back(representation::encode(style.representation, clip));
  return style;
}

FrameMatrix rows_of(const FrameMatrix& clip, const motion::FrameRange& range) {
  return clip.middleRows(range.begin, range.end - range.begin);
}

/// The `count` rows before frame `begin`, continued backward where the clip does not reach.
FrameMatrix lead_in_rows(const FrameMatrix& clip, int begin, int count) {
  FrameMatrix before(count, clip.cols());
  const int real = std::min(begin, count);
  before.bottomRows(real) = clip.middleRows(begin - real, real);
  before.topRows(count - real) = representation::extrapolate_back(clip, count - real);
  return before;
}

class StyleLearner {
 public:
  StyleLearner(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs,
               const std::vector<ClipPair>& pairs, const LearnOptions& options, Diagnostics* diagnostics,
               const Progress& progress)
      : options_(options),
        diagnostics_(diagnostics),
        progress_(progress),
        frame_rate_(options.frame_rate > 0.0 ? options.frame_rate : inputs.front().frame_rate()),
        input_clips_(resampled(inputs, frame_rate_)),
        output_clips_(resampled(outputs, frame_rate_)),
        pairs_(pairs),
        upright_(motion::upright_reference(input_clips_)),
        input_(represent(input_clips_, upright_)),
        output_(represent(output_clips_, upright_)) {
    for (ClipPair& pair : pairs_) {
      pair.input_frames = rescaled(pair.input_frames, frame_rate_ / inputs[at(pair.input_clip)].frame_rate(),
                                   input_clips_[at(pair.input_clip)]);
      pair.output_frames = rescaled(pair.output_frames, frame_rate_ / outputs[at(pair.output_clip)].frame_rate(),
                                    output_clips_[at(pair.output_clip)]);
    }
  }

  LearntStyle learn(const DescribeProvenance& provenance) {
    const std::vector<AlignedPair> aligned = align_all();
    const Normalization input_scaling = fit_over_pairs(aligned, &AlignedPair::input);
    const Normalization output_scaling = fit_over_pairs(aligned, &AlignedPair::output);
    std::vector<StyleBlock> blocks = plan_blocks(input_scaling, output_scaling);
    identify_all(aligned, input_scaling, output_scaling, blocks);
    StyleModelParts parts{
        frame_rate_, input_.representation, output_.representation, input_scaling, output_scaling, std::move(blocks),
        {}};
    calibrate_timing(aligned, parts);
    learn::report_coverage(input_.clips, pairs_, report_, diagnostics_);
    parts.provenance = provenance ? provenance(report_) : "{}";
    return {std::make_shared<const StyleModel>(std::move(parts)), report_};
  }

 private:
  std::vector<AlignedPair> align_all();
  std::optional<AlignedPair> align_one(const ClipPair& pair, const Normalization& input_scaling,
                                       const Normalization& output_scaling, Diagnostics& diagnostics) const;
  static Normalization fit_over_pairs(const std::vector<AlignedPair>& aligned, FrameMatrix AlignedPair::*signal);
  std::vector<StyleBlock> plan_blocks(const Normalization& input_scaling, const Normalization& output_scaling);
  void identify_all(const std::vector<AlignedPair>& aligned, const Normalization& input_scaling,
                    const Normalization& output_scaling, std::vector<StyleBlock>& blocks);
  void calibrate_timing(const std::vector<AlignedPair>& aligned, StyleModelParts& parts);
  [[nodiscard]] int lead_in_frames() const { return static_cast<int>(std::lround(options_.lead_in * frame_rate_)); }
  void tell(const std::string& step, int done, int total) const {
    if (progress_) progress_(step, done, total);
  }

  const LearnOptions& options_;
  Diagnostics* diagnostics_;
  const Progress& progress_;
  double frame_rate_;
  std::vector<Motion> input_clips_, output_clips_;
  std::vector<ClipPair> pairs_;
  Eigen::Quaterniond upright_;
  Style input_, output_;
  LearnReport report_;
};

std::optional<AlignedPair> StyleLearner::align_one(const ClipPair& pair, const Normalization& input_scaling,
                                                   const Normalization& output_scaling,
                                                   Diagnostics& diagnostics) const {
  const FrameMatrix& input_clip = input_.clips[at(pair.input_clip)];
  const FrameMatrix u = rows_of(input_clip, pair.input_frames);
  const FrameMatrix y = rows_of(output_.clips[at(pair.output_clip)], pair.output_frames);
  align::IterativeMotionWarpingOptions options = options_.alignment;
  options.slope_limit = std::max(pair.slope_limit, 2);  // 0 where the durations are too far apart: let aligning say so
  const std::string where =
      "pair of input clip " + std::to_string(pair.input_clip) + " and output clip " + std::to_string(pair.output_clip);
  try {
    const auto found =
        align::iterative_motion_warping(learn::alignment_features(u, input_scaling, output_scaling),
                                        learn::alignment_features(y, output_scaling, input_scaling), options);
    align::Correspondence correspondence = found.correspondence;
    correspondence.differential_warp = align::smooth_differential_warp(
        correspondence.differential_warp, std::pow(options_.time_warp_smoothing * frame_rate_, 2));
    const double at_limit = align::share_at_slope_limit(correspondence.differential_warp, options.slope_limit);
    if (at_limit > kLargestShareAtLimit) {
      diagnostics.warn(where, "left out: its alignment runs along the slope limit for " +
                                  std::to_string(std::lround(100.0 * at_limit)) + " % of its length");
      return std::nullopt;
    }
    FrameMatrix output(u.rows(), y.cols() + 1);
    output << align::warp_to_input(y, correspondence), correspondence.differential_warp.array().log().matrix();
    FrameMatrix input(lead_in_frames() + u.rows(), u.cols());
    input << lead_in_rows(input_clip, pair.input_frames.begin, lead_in_frames()), u;
    return AlignedPair{pair.input_clip, std::move(input), std::move(output)};
  } catch (const InvalidArgument& error) {
    diagnostics.warn(where, std::string("left out: ") + error.what());
    return std::nullopt;
  }
}

std::vector<AlignedPair> StyleLearner::align_all() {
  const Normalization input_scaling = representation::fit_normalization(input_.clips);
  const Normalization output_scaling = representation::fit_normalization(output_.clips);
  std::vector<std::optional<AlignedPair>> found(pairs_.size());
  std::vector<Diagnostics> reports(pairs_.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, pairs_.size(), [&](std::size_t i) {
    found[i] = align_one(pairs_[i], input_scaling, output_scaling, reports[i]);
    const std::lock_guard<std::mutex> lock(mutex);
    tell("aligning pairs", ++done, static_cast<int>(pairs_.size()));
  });
  std::vector<AlignedPair> aligned;
  for (auto& pair : found) {
    if (pair) aligned.push_back(std::move(*pair));
  }
  if (diagnostics_ != nullptr) {
    for (const Diagnostics& report : reports) diagnostics_->append(report);
  }
  report_.num_pairs = static_cast<int>(aligned.size());
  report_.num_refused = static_cast<int>(pairs_.size() - aligned.size());
  if (aligned.empty()) {
    throw InvalidArgument("pairs", "at least one pair that can be aligned", "none of " + std::to_string(pairs_.size()),
                          "look at the reasons above; pair clips of the same action");
  }
  return aligned;
}

Normalization StyleLearner::fit_over_pairs(const std::vector<AlignedPair>& aligned, FrameMatrix AlignedPair::*signal) {
  std::vector<FrameMatrix> signals;
  for (const AlignedPair& pair : aligned) signals.push_back((pair.*signal).bottomRows(pair.output.rows()));
  return representation::fit_normalization(signals);
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

std::vector<StyleBlock> StyleLearner::plan_blocks(const Normalization& input_scaling,
                                                  const Normalization& output_scaling) {
  std::vector<StyleBlock> blocks;
  const auto plan = [&](const std::string& name, int first_in, int end_in, int first_out, int end_out) {
    const std::vector<int> from = kept(input_scaling, first_in, end_in);
    const std::vector<int> to = kept(output_scaling, first_out, end_out);
    if (!from.empty() && !to.empty()) blocks.push_back({name, from, to, no_system(from.size(), to.size())});
    if (from.empty() && !to.empty()) report_.untranslated.push_back(name);
  };
  plan("root", 0, kNumRootDofs, 0, kNumRootDofs);
  int column = kNumRootDofs;
  for (const int joint : input_.representation.joints()) {
    plan(input_.representation.skeleton().joint(joint).name, column, column + 3, column, column + 3);
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

void StyleLearner::identify_all(const std::vector<AlignedPair>& aligned, const Normalization& input_scaling,
                                const Normalization& output_scaling, std::vector<StyleBlock>& blocks) {
  std::vector<FrameMatrix> inputs, outputs;
  std::vector<int> groups;
  for (const AlignedPair& pair : aligned) {
    inputs.push_back(input_scaling.normalize(pair.input));
    outputs.emplace_back(FrameMatrix::Zero(pair.input.rows(), pair.output.cols()));
    outputs.back().bottomRows(pair.output.rows()) = output_scaling.normalize(pair.output);
    groups.push_back(pair.group);
  }
  sysid::IdentifyOptions identification = options_.identification;
  identification.max_radius = std::exp(-1.0 / (options_.longest_memory * frame_rate_));
  report_.blocks.resize(blocks.size());
  std::vector<Diagnostics> reports(blocks.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    std::vector<sysid::Experiment> experiments;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      experiments.push_back({columns_of(inputs[i], blocks[b].input_dofs), columns_of(outputs[i], blocks[b].output_dofs),
                             lead_in_frames()});
    }
    const auto found = sysid::identify(experiments, groups, identification, &reports[b]);
    blocks[b].system = found.system;
    report_.blocks[b] = {blocks[b].name, found.system.num_states(), found.fit,
                         sysid::simulated_fit(found.system, experiments)};
    const std::lock_guard<std::mutex> lock(mutex);
    tell("identifying joints", ++done, static_cast<int>(blocks.size()));
  });
  if (diagnostics_ == nullptr) return;
  for (const Diagnostics& report : reports) diagnostics_->append(report);
}

/// E[exp(log w)] is not exp(E[log w]) (Jensen): one constant makes the durations of all examples together come out
/// right.
void StyleLearner::calibrate_timing(const std::vector<AlignedPair>& aligned, StyleModelParts& parts) {
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
  report_.duration_ratio = real / input_frames;
  report_.seconds = input_frames / frame_rate_;
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
  return StyleLearner(inputs, outputs, pairs, options, diagnostics, progress).learn(provenance);
}

}  // namespace strut
