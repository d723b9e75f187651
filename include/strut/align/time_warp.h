// SPDX-License-Identifier: MIT
// The time-warp stage of iterative motion warping (Hsu et al. 2005, 3.1): how often to repeat each frame of one signal
// so that it comes nearest to another, all degrees of freedom together, the best of all possibilities. Beyond the paper
// the slope limit is any number, apart from how finely an output frame is divided, and the ends may be open.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// The largest slope limit and the finest resolution.
inline constexpr double kLargestSlopeLimit = 16.0;
inline constexpr int kLargestResolution = 32;

/// Whether the input must begin where the output begins, and end where it ends.
enum class Ends {
  kFixed,      ///< first belongs to first and last to last
  kOpenBegin,  ///< it may begin anywhere in the output
  kOpenEnd,    ///< it may end anywhere
  kOpen,       ///< both: a short clip is looked for in a long one
};

/// How a time warp is searched. The defaults are the paper's.
struct TimeWarpOptions {
  double slope_limit = 2.0;  ///< L: an input frame covers 1/L ... L output frames, 1 ... kLargestSlopeLimit
  int resolution = 0;        ///< s: slots an output frame is divided into, at most kLargestResolution; 0: chosen, below
  Ends ends = Ends::kFixed;
  Eigen::VectorXd weights{};  ///< multiplies each degree of freedom's squared distance, >= 0; empty means 1 (dofs)
  /// The best of all warps is found where no more steps than this must be tried: slots reachable (about a third of
  /// input frames x slots if L = 2 and the ends are fixed) times counts to choose from (taken as at least four). A
  /// longer pair is searched coarse to fine. The default finds the best of 10,000 x 10,000 frames if L = s = 2. >= 1.
  std::int64_t exact_steps = std::int64_t{1} << 28;
  int band_radius = 64;  ///< how far from the coarser answer a finer one is looked for [output frames], >= 1
};

/// The resolution that is chosen where none is given: the smallest number of at least the slope limit at which counts
/// come within a fifth (of the logarithm) of both limits. For a whole limit it is the limit itself, the paper's form; a
/// limit of 1.25 makes it 5, one of 1.5 makes it 6. Throws InvalidArgument if the limit is out of range.
int default_resolution(double slope_limit);

/// A time warp as repetitions: the paper's vector r, and against what it counts.
struct TimeWarp {
  std::vector<int> repetitions;  ///< slots that each input frame covers, > 0 (input frames)
  int resolution = 1;            ///< s, slots per output frame
  int begin = 0;                 ///< slots of the output before the first input frame
  int rest = 0;                  ///< slots of the output after the last input frame
  /// Whether an input frame's distance counts once, as the mean over its slots, or at every slot. It does where an end
  /// is open: a sum would favour whatever covers little of the output.
  bool counts_frames = false;
  bool is_exact = true;  ///< the best of all; false if it was searched coarse to fine

  /// repetitions / resolution, and the ends alike.
  [[nodiscard]] Correspondence correspondence() const;
  friend bool operator==(const TimeWarp&, const TimeWarp&) = default;
};

/// Finds the time warp that minimizes the squared distance of the repeated input to the output, whose frames are
/// repeated s times: with d(i, x) the distance of input frame i to slot x and r(i) its count,
///   fixed ends:  sum over i of the sum over its slots of d(i, x);
///   open ends:   sum over i of s times the mean over its slots of d(i, x), so that every input frame counts the same,
///                whatever it covers, and as much as at slope 1 with fixed ends.
/// Counts run from s / L rounded up to s L rounded down. Dynamic programming over the reachable slots; where several
/// warps are equally good, the one nearest to uniform is taken, and of equal ends the first.
/// `input` (m x dofs), `output` (n x dofs), in one unit per degree of freedom.
/// Throws InvalidArgument if a size does not fit, a number is not finite, all weights are zero or one is negative, an
/// option is out of range, or the lengths are further apart than the limit and the resolution allow.
/// Cost O(reachable m n (dofs + s^2 L)); memory: the bits of a count (2 in the paper's form with s = 2) per reachable
/// slot, at most 27 MB by default; beyond, coarse to fine, O((m + n) dofs) and the bits of a band: m (2 radius + 1) s.
TimeWarp time_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                   const TimeWarpOptions& options = {});

}  // namespace strut::align
