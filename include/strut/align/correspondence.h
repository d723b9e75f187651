// SPDX-License-Identifier: MIT
// Which moment of one signal belongs to which moment of another. Every alignment method of this folder ends in a
// Correspondence: for each frame of the input, how many frames of the output pass meanwhile (Hsu et al. 2005, 3.4).
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::align {

/// Every input frame's place in the output's time. Output frame j covers the time [j, j + 1) and is centred on j + 1/2.
/// Where the ends of the output are open, the input begins inside it and ends inside it.
struct Correspondence {
  Eigen::VectorXd differential_warp;  ///< output frames per input frame, > 0 (input frames)
  double output_begin = 0.0;          ///< where the first input frame begins [output frames], >= 0
  double output_rest = 0.0;           ///< what is left of the output after the last [output frames], >= 0

  /// Where the last input frame ends [output frames].
  [[nodiscard]] double output_end() const { return output_begin + differential_warp.sum(); }

  /// The position [output frames, within 0 ... output frames - 1] that belongs to each input frame: the middle of the
  /// stretch of output it covers. Rises strictly but for the ends, where it may be clamped. (input frames)
  [[nodiscard]] Eigen::VectorXd output_time() const;
};

/// The correspondence of repetition counts against an output divided into `resolution` slots per frame:
/// counts / resolution. Throws InvalidArgument if the resolution is below 1.
Correspondence from_repetitions(const std::vector<int>& repetitions, int resolution);

/// The smoothest curve near a differential warp: minimizes |v - w|^2 + smoothness |Dv|^2 with D the first difference.
/// Each value becomes a weighted mean of its neighbours with weights falling as exp(-distance / sqrt(smoothness)), so
/// the result stays between the smallest and largest value of `w` (positive, within the slope limits) and keeps its
/// sum. `smoothness` [frames^2] >= 0; 0 changes nothing. Throws InvalidArgument if it is negative or anything is not
/// finite. Cost O(frames).
Eigen::VectorXd smooth_differential_warp(const Eigen::Ref<const Eigen::VectorXd>& w, double smoothness);

/// The share (0 ... 1) of frames that run at the slope limit, in either direction, give or take 5 %: w <= 1.05 / limit
/// or w >= 0.95 * limit. Integer repetitions visit the limit often; take it of the smoothed warp, which comes near its
/// limit only where it stays there, to judge whether a pair runs along it.
double share_at_slope_limit(const Eigen::Ref<const Eigen::VectorXd>& w, double slope_limit);

/// The output at the moments that belong to the input's frames, linearly interpolated. `output` (output frames x dofs).
/// Returns (input frames x dofs). Throws InvalidArgument if the correspondence is of another number of output frames:
/// what is before, under and after the input must add up to it.
FrameMatrix warp_to_input(const Eigen::Ref<const FrameMatrix>& output, const Correspondence& correspondence);

}  // namespace strut::align
