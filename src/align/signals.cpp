// SPDX-License-Identifier: MIT
#include "align/signals.h"

#include "align/warp_kernels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>

namespace strut::align::detail {
namespace {

// Numbers of this size can be squared and summed over any signal.
constexpr double kLargestNumber = 1e100;

// A signal that differs from its first frame by a smaller share of its size differs by rounding.
constexpr double kRounding = 1e-12;

// Output tiles that stay in the nearest cache while a block of input frames goes over them.
constexpr int kTilesAtOnce = 4;

/// A number times zero is zero unless it is not finite. Unlike Eigen's allFinite, this needs no branch per number.
bool is_finite(const Eigen::Ref<const FrameMatrix>& signals) {
  return (0.0 * signals.array()).sum() == 0.0;
}

void check_numbers(const char* argument, const Eigen::Ref<const FrameMatrix>& signals) {
  if (!is_finite(signals)) throw InvalidArgument(argument, "finite numbers", "NaN or infinity");
  const double largest = signals.cwiseAbs().maxCoeff();
  if (largest <= kLargestNumber) return;
  throw InvalidArgument(argument, "numbers up to 1e100", std::to_string(largest), "normalize the signals");
}

void set_norms(const FrameMatrix& signals, math::AlignedVector<double>& norms) {
  for (Eigen::Index t = 0; t < signals.rows(); ++t) norms[static_cast<std::size_t>(t)] = signals.row(t).squaredNorm();
}

}  // namespace

void check_signals(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output) {
  if (input.rows() == 0) throw InvalidArgument("input", "at least one frame", "none");
  if (output.rows() == 0) throw InvalidArgument("output", "at least one frame", "none");
  if (input.cols() != output.cols() || input.cols() == 0) {
    throw InvalidArgument("output", std::to_string(input.cols()) + " degrees of freedom, as the input has",
                          std::to_string(output.cols()));
  }
  check_numbers("input", input);
  check_numbers("output", output);
}

void check_weights(const Eigen::VectorXd& weights, Eigen::Index dofs) {
  if (weights.size() == 0) return;
  if (weights.size() != dofs) {
    throw InvalidArgument("weights", std::to_string(dofs) + " numbers or none", std::to_string(weights.size()));
  }
  if (!weights.allFinite() || (weights.array() < 0.0).any()) {
    throw InvalidArgument("weights", "finite numbers that are not negative", "another");
  }
  if (weights.maxCoeff() > kLargestNumber) {
    throw InvalidArgument("weights", "numbers up to 1e100", std::to_string(weights.maxCoeff()));
  }
  if (weights.maxCoeff() == 0.0) {
    throw InvalidArgument("weights", "at least one above zero", "zeros", "leave them out to weigh all alike");
  }
}

bool is_constant(const Eigen::Ref<const FrameMatrix>& signals, const Eigen::VectorXd& weights) {
  for (Eigen::Index d = 0; d < signals.cols(); ++d) {
    if (weights.size() != 0 && weights[d] == 0.0) continue;
    const auto column = signals.col(d).array();
    const double least = column.minCoeff(), most = column.maxCoeff();
    if (most - least > kRounding * std::max(std::abs(least), std::abs(most))) return false;
  }
  return true;
}

FrameMatrix weighted(const Eigen::Ref<const FrameMatrix>& signals, const Eigen::RowVectorXd& origin,
                     const Eigen::VectorXd& weights) {
  FrameMatrix result = signals.rowwise() - origin;
  if (weights.size() != 0) result *= weights.cwiseSqrt().asDiagonal();
  return result;
}

FrameDistances::FrameDistances(const FrameMatrix& output)
    : dofs_(static_cast<int>(output.cols())), num_output_frames_(static_cast<int>(output.rows())) {
  const int frames = math::padded(num_output_frames_, kTileFrames);
  output_.assign(static_cast<std::size_t>(frames) * static_cast<std::size_t>(dofs_), 0.0);
  output_norms_.assign(static_cast<std::size_t>(frames), 0.0);
  for (int j = 0; j < num_output_frames_; ++j) {
    const auto tile = static_cast<std::size_t>(j / kTileFrames) * static_cast<std::size_t>(dofs_ * kTileFrames);
    double* to = output_.data() + tile + j % kTileFrames;
    const double* from = &output(j, 0);
    for (int d = 0; d < dofs_; ++d) to[static_cast<std::ptrdiff_t>(d) * kTileFrames] = from[d];
  }
  set_norms(output, output_norms_);
  mean_energy_ = output.squaredNorm() / num_output_frames_;
}

void FrameDistances::set_input(const FrameMatrix& input) {
  num_input_frames_ = static_cast<int>(input.rows());
  const auto frames = static_cast<std::size_t>(math::padded(num_input_frames_, kGroupFrames));
  input_.resize(frames * static_cast<std::size_t>(dofs_));
  input_norms_.resize(frames);
  std::copy(input.data(), input.data() + input.size(), input_.begin());
  std::fill(input_.begin() + input.size(), input_.end(), 0.0);
  set_norms(input, input_norms_);
}

void FrameDistances::compute(int row, const std::vector<Columns>& columns) {
  const int rows = static_cast<int>(columns.size());
  // Tiles of every group of rows, and of all.
  Columns tiles[kBlock / kGroupFrames], all{num_output_frames_, 0};
  for (int i = 0; i < rows; ++i) {
    const Columns here{columns[static_cast<std::size_t>(i)].first / kTileFrames,
                       (columns[static_cast<std::size_t>(i)].end + kTileFrames - 1) / kTileFrames};
    Columns& group = tiles[i / kGroupFrames];
    group = i % kGroupFrames == 0 ? here : Columns{std::min(group.first, here.first), std::max(group.end, here.end)};
    all = {std::min(all.first, here.first), std::max(all.end, here.end)};
  }
  first_ = static_cast<std::ptrdiff_t>(all.first) * kTileFrames;
  stride_ = static_cast<std::ptrdiff_t>(all.end - all.first) * kTileFrames;
  const auto size = static_cast<std::size_t>(stride_ * kBlock) + kSlotLanes;  // loops read whole steps
  if (block_.size() < size) block_.resize(size);
  const WarpKernels& kernels = warp_kernels();
  for (int tile = all.first; tile < all.end; tile += kTilesAtOnce) {
    for (int i = 0; i < rows; i += kGroupFrames) {
      const int begin = std::max(tile, tiles[i / kGroupFrames].first);
      const int end = std::min(tile + kTilesAtOnce, tiles[i / kGroupFrames].end);
      if (begin >= end) continue;
      const std::ptrdiff_t frame = static_cast<std::ptrdiff_t>(begin) * kTileFrames;
      kernels.squared_distances(dofs_, end - begin, input_.data() + static_cast<std::ptrdiff_t>(row + i) * dofs_,
                                input_norms_.data() + row + i, output_.data() + frame * dofs_,
                                output_norms_.data() + frame, block_.data() + i * stride_ + frame - first_, stride_);
    }
  }
}

}  // namespace strut::align::detail
