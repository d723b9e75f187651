// SPDX-License-Identifier: MIT
// Symbols of the paper: u input signal, y output signal, w differential time warp.
#include "learn/pair_alignment.h"

#include "learn/time_warp_smoothing.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>

#include <tbb/parallel_for.h>

#include <strut/align/correspondence.h>
#include <strut/core/error.h>
#include <strut/representation/alignment_features.h>

namespace strut::learn {
namespace {

// What the paper aligns by.
constexpr representation::FeatureShares kPosture{1.0, 0.0, 0.0};

// A pair that runs along its slope limit for more than half of its length has not been aligned.
constexpr double kLargestShareAtLimit = 0.5;

std::string name_of(const ClipPair& pair) {
  if (!pair.name.empty()) return pair.name;
  return "pair of input clip " + std::to_string(pair.input_clip) + " and output clip " +
         std::to_string(pair.output_clip);
}

FrameMatrix rows_of(const FrameMatrix& clip, const FrameRange& range) {
  return clip.middleRows(range.begin, range.end - range.begin);
}

bool is_too_short(const FrameRange& range, double frame_rate) {
  return range.end - range.begin < kShortestStretch * frame_rate;
}

class PairAligner {
 public:
  PairAligner(const Examples& examples, const LearnOptions& options)
      : examples_(examples),
        options_(options),
        is_continuous_(options.alignment_method == AlignmentMethod::kContinuous &&
                       options.method != LearnMethod::kPaper),
        features_(representation::timing_features({examples.input.clips, examples.input.stillness},
                                                  {examples.output.clips, examples.output.stillness},
                                                  examples.frame_rate, is_continuous_ ? options.features : kPosture)) {}

  /// The pair's time warp, not yet smoothed, or nothing and a warning.
  std::optional<PairWarp> align(const ClipPair& pair, Diagnostics& diagnostics) const {
    if (is_too_short(pair.input_frames, examples_.frame_rate) ||
        is_too_short(pair.output_frames, examples_.frame_rate)) {
      diagnostics.warn(name_of(pair), "left out: it lasts less than 0.2 s");
      return std::nullopt;
    }
    try {
      return PairWarp{&pair, is_continuous_ ? continuous(pair) : iterative(pair)};
    } catch (const InvalidArgument& error) {
      diagnostics.warn(name_of(pair), std::string("left out: ") + error.what());
    }
    return std::nullopt;
  }

  /// The pair in the input's time, its warp smoothed over `reach` [s], or nothing and a warning.
  std::optional<AlignedPair> warp(const PairWarp& found, double reach, Diagnostics& diagnostics) const {
    const ClipPair& pair = *found.pair;
    const double frames = reach * examples_.frame_rate;
    const align::Correspondence correspondence{
        align::smooth_differential_warp(found.differential_warp, frames * frames)};
    const double at_limit = align::share_at_slope_limit(correspondence.differential_warp, slope_limit_of(pair));
    if (at_limit <= kLargestShareAtLimit) return warped(pair, correspondence);
    diagnostics.warn(name_of(pair), "left out: its alignment runs along the slope limit for " +
                                        std::to_string(std::lround(100.0 * at_limit)) + " % of its length");
    return std::nullopt;
  }

 private:
  /// 0 in a pair says that its durations are too far apart, which aligning will say.
  static int slope_limit_of(const ClipPair& pair) { return std::max(pair.slope_limit, 2); }

  [[nodiscard]] FrameMatrix input_features(const ClipPair& pair) const {
    return rows_of(features_.input[static_cast<std::size_t>(pair.input_clip)], pair.input_frames);
  }
  [[nodiscard]] FrameMatrix output_features(const ClipPair& pair) const {
    return rows_of(features_.output[static_cast<std::size_t>(pair.output_clip)], pair.output_frames);
  }

  [[nodiscard]] Eigen::VectorXd continuous(const ClipPair& pair) const {
    align::ContinuousWarpOptions options = options_.warp;
    options.slope_limit = slope_limit_of(pair);
    if (features_.weights.sum() > 0.0) options.weights = features_.weights;  // else nothing moves, and learning says so
    return align::continuous_warp(input_features(pair), output_features(pair), examples_.frame_rate, options)
        .correspondence.differential_warp;
  }

  [[nodiscard]] Eigen::VectorXd iterative(const ClipPair& pair) const {
    align::IterativeMotionWarpingOptions options = options_.alignment;
    options.slope_limit = slope_limit_of(pair);
    return align::iterative_motion_warping(input_features(pair), output_features(pair), options)
        .correspondence.differential_warp;
  }

  [[nodiscard]] FrameMatrix output_of(const ClipPair& pair) const {
    return rows_of(examples_.output.clips[static_cast<std::size_t>(pair.output_clip)], pair.output_frames);
  }

  [[nodiscard]] AlignedPair warped(const ClipPair& pair, const align::Correspondence& correspondence) const {
    const FrameMatrix& clip = examples_.input.clips[static_cast<std::size_t>(pair.input_clip)];
    const FrameMatrix y = output_of(pair);
    FrameMatrix output(pair.input_frames.num_frames(), y.cols() + 1);
    output << align::warp_to_input(y, correspondence), correspondence.differential_warp.array().log().matrix();
    FrameMatrix input = with_lead_in(clip, pair.input_frames, lead_in_frames(options_, examples_.frame_rate));
    AlignedPair aligned{pair.input_clip, pair.output_clip, pair.input_frames, std::move(input), std::move(output)};
    if (!examples_.planted.empty()) {
      const FrameMatrix& planted = examples_.planted[static_cast<std::size_t>(pair.output_clip)];
      aligned.planted = align::warp_to_input(rows_of(planted, pair.output_frames), correspondence);
    }
    return aligned;
  }

  const Examples& examples_;
  const LearnOptions& options_;
  bool is_continuous_;
  representation::TimingFeatures features_;
};

}  // namespace

int lead_in_frames(const LearnOptions& options, double frame_rate) {
  return static_cast<int>(std::lround(options.lead_in * frame_rate));
}

std::vector<AlignedPair> align_pairs(const Examples& examples, const LearnOptions& options, Diagnostics* diagnostics,
                                     const Progress& progress) {
  const PairAligner aligner(examples, options);
  const std::size_t count = examples.pairs.size();
  std::vector<std::optional<PairWarp>> found(count);
  std::vector<Diagnostics> reports(count);
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    found[i] = aligner.align(examples.pairs[i], reports[i]);
    const std::lock_guard<std::mutex> lock(mutex);
    if (progress) progress("aligning pairs", ++done, static_cast<int>(count));
  });
  std::vector<PairWarp> warps;
  for (const std::optional<PairWarp>& warp : found) {
    if (warp) warps.push_back(*warp);
  }
  const double reach = options.time_warp_smoothing ? *options.time_warp_smoothing
                                                   : choose_time_warp_smoothing(warps, examples.frame_rate);
  std::vector<AlignedPair> aligned;
  for (std::size_t i = 0; i < count; ++i) {
    if (found[i]) {
      if (auto pair = aligner.warp(*found[i], reach, reports[i])) aligned.push_back(std::move(*pair));
    }
    if (diagnostics != nullptr) diagnostics->append(reports[i]);
  }
  if (aligned.empty()) {
    throw InvalidArgument("pairs", "at least one pair that can be aligned", "none of " + std::to_string(count),
                          "pair clips of the same action, of at most three times each other's length");
  }
  return aligned;
}

}  // namespace strut::learn
