// SPDX-License-Identifier: MIT
// Symbols: m timeline frames, n_k frames of clip k, c_k(t) the time of clip k that belongs to timeline's t, counted
// from frames' edges. The timeline is unbiased where mean_k c_k(t) / n_k = t / m; a round's answers are re-timed until
// it is.
#include "align/signals.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <tbb/parallel_for.h>

#include <strut/align/groupwise.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/warp_curve.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kSmoothness = 10.0;  // of the differential warp [frames^2]: docs/correspondence.md

void check(const std::vector<FrameMatrix>& clips, const GroupOptions& options) {
  if (clips.size() < 2) throw InvalidArgument("clips", "at least two", std::to_string(clips.size()));
  for (std::size_t k = 0; k < clips.size(); ++k) {
    try {
      detail::check_signals(clips.front(), clips[k]);
    } catch (const InvalidArgument& error) {
      throw InvalidArgument("clip " + std::to_string(k), error);
    }
  }
  if (options.num_frames < 0) throw InvalidArgument("num_frames", "0 or more", std::to_string(options.num_frames));
  if (options.max_rounds < 1) throw InvalidArgument("max_rounds", "at least 1", std::to_string(options.max_rounds));
  if (!(options.tolerance >= 0.0)) {
    throw InvalidArgument("tolerance", "a number that is not negative", std::to_string(options.tolerance));
  }
}

int timeline_frames(const std::vector<FrameMatrix>& clips, const GroupOptions& options) {
  if (options.num_frames > 0) return options.num_frames;
  double sum = 0.0;
  for (const FrameMatrix& clip : clips) sum += std::log(static_cast<double>(clip.rows()));
  return static_cast<int>(std::lround(std::exp(sum / static_cast<double>(clips.size()))));
}

Correspondence even(int frames, Eigen::Index output_frames) {
  return {Eigen::VectorXd::Constant(frames, static_cast<double>(output_frames) / frames)};
}

/// The clips on the timeline, and their mean.
struct OnTimeline {
  std::vector<FrameMatrix> clips;
  FrameMatrix mean;

  OnTimeline(const std::vector<FrameMatrix>& given, const std::vector<Correspondence>& found) {
    for (std::size_t k = 0; k < given.size(); ++k) clips.push_back(warp_to_input(given[k], found[k]));
    mean = clips.front();
    for (std::size_t k = 1; k < clips.size(); ++k) mean += clips[k];
    mean /= static_cast<double>(clips.size());
  }
  [[nodiscard]] double spread() const {
    double sum = 0.0;
    for (const FrameMatrix& clip : clips) sum += (clip - mean).squaredNorm();
    return std::sqrt(sum / static_cast<double>(mean.size()) / static_cast<double>(clips.size()));
  }
  [[nodiscard]] const FrameMatrix& nearest_to_mean() const {
    return *std::min_element(clips.begin(), clips.end(), [this](const FrameMatrix& a, const FrameMatrix& b) {
      return (a - mean).squaredNorm() < (b - mean).squaredNorm();
    });
  }
};

/// Moves the timeline's moments to where the clips' mean time is.
void make_unbiased(std::vector<Correspondence>& found) {
  const Eigen::Index m = found.front().differential_warp.size();
  Correspondence mean{Eigen::VectorXd::Zero(m)};
  for (const Correspondence& clip : found) {
    mean.differential_warp += clip.differential_warp * (static_cast<double>(m) / clip.differential_warp.sum());
  }
  mean.differential_warp /= static_cast<double>(found.size());
  const Correspondence retiming = inverse(mean);
  for (Correspondence& clip : found) clip = compose(retiming, clip);
}

/// How far a moment lies from where it lay, at most [timeline frames].
double largest_move(const std::vector<Correspondence>& before, const std::vector<Correspondence>& after) {
  double largest = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double per_frame = before[k].differential_warp.mean();
    largest = std::max(largest, (after[k].output_time() - before[k].output_time()).cwiseAbs().maxCoeff() / per_frame);
  }
  return largest;
}

}  // namespace

Correspondence align_smoothly(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output) {
  Correspondence found = iterative_motion_warping(input, output).correspondence;
  found.differential_warp = smooth_differential_warp(found.differential_warp, kSmoothness);
  return found;
}

std::vector<Correspondence> align_to_reference(const Eigen::Ref<const FrameMatrix>& reference,
                                               const std::vector<FrameMatrix>& clips, const Aligner& aligner) {
  std::vector<Correspondence> found(clips.size());
  tbb::parallel_for(std::size_t{0}, clips.size(), [&](std::size_t k) {
    try {
      found[k] = aligner(reference, clips[k]);
    } catch (const InvalidArgument& error) {
      throw InvalidArgument("clip " + std::to_string(k), error);
    }
  });
  return found;
}

GroupAlignment align_group(const std::vector<FrameMatrix>& clips, const GroupOptions& options) {
  check(clips, options);
  const int m = timeline_frames(clips, options);
  std::vector<Correspondence> before;
  for (const FrameMatrix& clip : clips) before.push_back(even(m, clip.rows()));
  FrameMatrix reference = OnTimeline(clips, before).nearest_to_mean();
  GroupAlignment best;
  for (int round = 0; round < options.max_rounds && !best.converged; ++round) {
    std::vector<Correspondence> found = align_to_reference(reference, clips, options.aligner);
    make_unbiased(found);
    OnTimeline here(clips, found);
    best.spread.push_back(here.spread());
    best.moved = largest_move(before, found);
    best.converged = best.moved <= options.tolerance;
    reference = here.mean;
    before = found;
    if (best.spread.back() > *std::min_element(best.spread.begin(), best.spread.end())) continue;
    best.clips = std::move(found);
    best.mean = std::move(here.mean);
  }
  return best;
}

}  // namespace strut::align
