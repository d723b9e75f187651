// SPDX-License-Identifier: MIT
// What the alignment methods share: the check of a pair of signals, and squared distances between their frames, a block
// of input frames at a time by one matrix product.
#pragma once

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::align::detail {

/// Throws InvalidArgument unless both have frames, the same degrees of freedom, and finite numbers.
void check_signals(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output);

/// The two signals, every degree of freedom times the root of its weight and about the output's mean (distances do not
/// change, but lose fewer digits), with the squared lengths of their frames.
class FrameDistances {
 public:
  /// Throws InvalidArgument as check_signals, or if the weights are of another number, negative or not finite.
  FrameDistances(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                 const Eigen::VectorXd& weights);
  [[nodiscard]] int num_input_frames() const { return static_cast<int>(input_.rows()); }
  [[nodiscard]] int num_output_frames() const { return static_cast<int>(output_.rows()); }
  /// Of input frames [row, row + rows) to output frames [col, col + cols), into the top left of `block`; all >= 0.
  void compute(int row, int rows, int col, int cols, FrameMatrix& block) const;
  /// Mean squared length of the output's frames: the size of a distance that means something.
  [[nodiscard]] double mean_energy() const { return output_norms_.mean(); }

 private:
  FrameMatrix input_, output_;
  Eigen::VectorXd input_norms_, output_norms_;
};

}  // namespace strut::align::detail
