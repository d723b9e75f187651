// SPDX-License-Identifier: MIT
#include "learn/normalized_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <tbb/blocked_range.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

namespace strut::learn {
namespace {

/// Of the normalized input, mean over pairs (dofs x dofs).
Eigen::MatrixXd input_covariance(const std::vector<AlignedPair>& aligned, const Scalings& scalings) {
  constexpr std::size_t kBlock = 64;  // pairs
  const Eigen::Index dofs = scalings.input.num_dofs();
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(dofs, dofs);
  const Eigen::MatrixXd sum = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, aligned.size(), kBlock), none,
      [&](const tbb::blocked_range<std::size_t>& block, Eigen::MatrixXd covariance) {
        for (std::size_t i = block.begin(); i < block.end(); ++i) {
          const AlignedPair& pair = aligned[i];
          const FrameMatrix rows = scalings.input.normalize(pair.input.bottomRows(pair.output.rows()));
          covariance.noalias() += rows.transpose() * rows / static_cast<double>(rows.rows());
        }
        return covariance;
      },
      [](Eigen::MatrixXd a, const Eigen::MatrixXd& b) -> Eigen::MatrixXd { return a += b; });
  return sum / static_cast<double>(aligned.size());
}

}  // namespace

Scalings fit_scalings(const std::vector<AlignedPair>& aligned) {
  std::optional<representation::Normalization> of_input, of_output;
  tbb::parallel_invoke(
      [&] {
        std::vector<FrameMatrix> inputs;
        for (const AlignedPair& pair : aligned) inputs.emplace_back(pair.input.bottomRows(pair.output.rows()));
        of_input = representation::fit_normalization(inputs);
      },
      [&] {
        std::vector<FrameMatrix> outputs;
        for (const AlignedPair& pair : aligned) outputs.push_back(pair.output);
        of_output = representation::fit_normalization(outputs);
      });
  return {*of_input, *of_output};
}

Eigen::MatrixXd fit_context(const std::vector<AlignedPair>& aligned, const Scalings& scalings, int count) {
  const Eigen::Index dofs = scalings.input.num_dofs();
  const Eigen::MatrixXd covariance = input_covariance(aligned, scalings);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const double largest = eigen.eigenvalues()[dofs - 1];
  if (!(largest > 0.0)) return Eigen::MatrixXd(0, dofs);
  const Eigen::Index kept = std::min<Eigen::Index>(count, dofs);
  return eigen.eigenvectors().rightCols(kept).rowwise().reverse().transpose() / std::sqrt(largest);
}

std::vector<NormalizedPair> normalize_pairs(const std::vector<AlignedPair>& aligned, const Scalings& scalings,
                                            const Eigen::MatrixXd& context) {
  std::vector<NormalizedPair> pairs;
  pairs.reserve(aligned.size());
  for (const AlignedPair& pair : aligned) {
    const FrameMatrix rows = scalings.input.normalize(pair.input);
    FrameMatrix input(rows.rows(), rows.cols() + context.rows());
    input << rows, rows * context.transpose();
    pairs.push_back({std::move(input), scalings.output.normalize(pair.output)});
  }
  return pairs;
}

sysid::LeaveOut leave_out(const std::vector<AlignedPair>& aligned) {
  constexpr int kFolds = 4;
  std::vector<int> inputs, outputs, frames;
  for (const AlignedPair& pair : aligned) {
    inputs.push_back(pair.input_clip);
    outputs.push_back(pair.output_clip);
    frames.push_back(static_cast<int>(pair.output.rows()));
  }
  return sysid::leave_out_pairs(inputs, outputs, frames, kFolds);
}

}  // namespace strut::learn
