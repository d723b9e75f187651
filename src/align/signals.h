// SPDX-License-Identifier: MIT
// What the alignment methods share: the check of a pair of signals, and squared distances between their frames where
// they are asked for.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/aligned.h>
#include <strut/math/frame_matrix.h>

namespace strut::align::detail {

/// Throws InvalidArgument unless both have frames, the same degrees of freedom, and finite numbers that can be squared
/// and summed.
void check_signals(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output);

/// Throws InvalidArgument unless there are none or `dofs` of them, finite, not negative and not all zero.
void check_weights(const Eigen::VectorXd& weights, Eigen::Index dofs);

/// Whether every frame is the first one, give or take rounding, in the degrees of freedom that weigh something.
bool is_constant(const Eigen::Ref<const FrameMatrix>& signals, const Eigen::VectorXd& weights);

/// The signals as distances need them: about `origin` (which changes no distance but saves digits), every degree of
/// freedom times the root of its weight. Those of no weight, or zero throughout in both, could be left out, but are
/// not.
FrameMatrix weighted(const Eigen::Ref<const FrameMatrix>& signals, const Eigen::RowVectorXd& origin,
                     const Eigen::VectorXd& weights);

/// The columns [first, end) of a matrix of distances.
struct Columns {
  int first = 0, end = 0;
};

/// Squared distances between the frames of two `weighted` signals, a few input frames at a time.
class FrameDistances {
 public:
  /// Input frames that are computed together: enough that what is read of the output is used often.
  static constexpr int kBlock = 16;

  explicit FrameDistances(const FrameMatrix& output);
  void set_input(const FrameMatrix& input);
  [[nodiscard]] int num_input_frames() const { return num_input_frames_; }
  [[nodiscard]] int num_output_frames() const { return num_output_frames_; }
  /// Computes those of input frames [row, row + columns.size()), row a multiple of kBlock, each at its columns; all are
  /// >= 0. They stay until the next call. At most kBlock rows, columns not empty.
  void compute(int row, const std::vector<Columns>& columns);
  /// The distances of the block's i-th row: [j] is that to output frame j, for j of its columns; what is beyond may be
  /// read up to a step of kSlotLanes, and is finite.
  [[nodiscard]] const double* row(int i) const { return block_.data() + i * stride_ - first_; }
  /// Mean squared length of the output's frames: the size of a distance that means something.
  [[nodiscard]] double mean_energy() const { return mean_energy_; }

 private:
  int dofs_, num_input_frames_ = 0, num_output_frames_;
  double mean_energy_;
  math::AlignedVector<double> input_, input_norms_;    // rows, filled up to whole blocks
  math::AlignedVector<double> output_, output_norms_;  // tiles (warp_kernels.h)
  math::AlignedVector<double> block_;
  std::ptrdiff_t first_ = 0, stride_ = 0;  // what column the block begins with; numbers per row
};

}  // namespace strut::align::detail
