// SPDX-License-Identifier: MIT
// Dynamic time warping of whole frames under two of Rabiner and Juang's local constraints (Fundamentals of Speech
// Recognition, 1993, table 4.5): what the paper compares iterative motion warping with. It warps time alone.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// The steps (input frames, output frames) a path may take.
enum class LocalConstraint {
  kTypeI,    ///< (1,0), (1,1), (0,1): any slope
  kTypeIII,  ///< (2,1), (1,1), (1,2): slopes 1/2 ... 2
};

/// A matched pair of frames.
struct FramePair {
  int input = 0;
  int output = 0;
  friend bool operator==(const FramePair&, const FramePair&) = default;
};

/// How a path is searched.
struct DynamicTimeWarpingOptions {
  Eigen::VectorXd weights{};  ///< multiplies each degree of freedom's squared distance, >= 0; empty means 1 (dofs)
  /// The best of all paths is found where no more pairs of frames than this can be reached: all of them by Type I,
  /// about a third by Type III. A longer pair of signals is searched coarse to fine. >= 1.
  std::int64_t exact_cells = std::int64_t{1} << 28;
  int band_radius = 64;  ///< how far from the coarser path a finer one is looked for [output frames], >= 1
};

/// What dynamic time warping found.
struct DynamicTimeWarpingResult {
  Correspondence correspondence;  ///< the path as a differential warp: each output frame shared by its input frames
  std::vector<FramePair> path;    ///< from (0, 0) to (last, last), the ends of the steps taken
  double cost = 0;                ///< the path's summed squared distance, each step's weighted by its length
  bool is_exact = true;           ///< the best of all; false if it was searched coarse to fine
};

/// Finds the path of least summed squared distance from the first pair of frames to the last. A step counts the
/// distance at its end times the input and output frames it passes (slope weighting (d), symmetric), the first pair
/// twice, so no path gains by being short. `input` (m x dofs), `output` (n x dofs).
/// Throws InvalidArgument if a size does not fit, a number is not finite, all weights are zero or one is negative, an
/// option is out of range, or, for Type III, one signal has more than twice the steps of the other.
/// Cost O(reachable m n dofs); memory: two bits per reachable pair of frames, so 64 MB by default; beyond, coarse to
/// fine, O((m + n) dofs) and two bits for every pair in a band of twice the radius.
DynamicTimeWarpingResult dynamic_time_warping(const Eigen::Ref<const FrameMatrix>& input,
                                              const Eigen::Ref<const FrameMatrix>& output, LocalConstraint constraint,
                                              const DynamicTimeWarpingOptions& options = {});

}  // namespace strut::align
