// SPDX-License-Identifier: MIT
#include "align/signals.h"

#include <string>

#include <strut/core/error.h>

namespace strut::align::detail {
namespace {

/// A number times zero is zero unless it is not finite. Unlike Eigen's allFinite, this needs no branch per number:
/// signals are checked in every round of their alignment.
bool is_finite(const Eigen::Ref<const FrameMatrix>& signals) {
  return (0.0 * signals.array()).sum() == 0.0;
}

}  // namespace

void check_signals(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output) {
  if (input.rows() == 0) throw InvalidArgument("input", "at least one frame", "none");
  if (output.rows() == 0) throw InvalidArgument("output", "at least one frame", "none");
  if (input.cols() != output.cols() || input.cols() == 0) {
    throw InvalidArgument("output", std::to_string(input.cols()) + " degrees of freedom, as the input has",
                          std::to_string(output.cols()));
  }
  if (!is_finite(input)) throw InvalidArgument("input", "finite numbers", "NaN or infinity");
  if (!is_finite(output)) throw InvalidArgument("output", "finite numbers", "NaN or infinity");
}

FrameDistances::FrameDistances(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                               const Eigen::VectorXd& weights) {
  check_signals(input, output);
  if (weights.size() != 0 && weights.size() != input.cols()) {
    throw InvalidArgument("weights", std::to_string(input.cols()) + " numbers or none", std::to_string(weights.size()));
  }
  if (!weights.allFinite() || (weights.array() < 0.0).any()) {
    throw InvalidArgument("weights", "finite numbers that are not negative", "another");
  }
  const Eigen::RowVectorXd mean = output.colwise().mean();
  input_ = input.rowwise() - mean;
  output_ = output.rowwise() - mean;
  if (weights.size() != 0) {
    const Eigen::VectorXd root = weights.cwiseSqrt();
    input_ *= root.asDiagonal();
    output_ *= root.asDiagonal();
  }
  input_norms_ = input_.rowwise().squaredNorm();
  output_norms_ = output_.rowwise().squaredNorm();
}

void FrameDistances::compute(int row, int rows, int col, int cols, FrameMatrix& block) const {
  // |p - q|^2 = |p|^2 + |q|^2 - 2 p.q; rounding may take equal frames a little below zero.
  auto result = block.topLeftCorner(rows, cols);
  result.noalias() = -2.0 * input_.middleRows(row, rows) * output_.middleRows(col, cols).transpose();
  const auto norms = output_norms_.segment(col, cols).transpose().array();
  for (int i = 0; i < rows; ++i) {
    result.row(i) = (result.row(i).array() + (norms + input_norms_[row + i])).cwiseMax(0.0);
  }
}

}  // namespace strut::align::detail
