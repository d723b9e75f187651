// SPDX-License-Identifier: MIT
#include "learn/normalized_pairs.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace strut::learn {

Scalings fit_scalings(const std::vector<AlignedPair>& aligned) {
  std::vector<FrameMatrix> inputs, outputs;
  for (const AlignedPair& pair : aligned) {
    inputs.emplace_back(pair.input.bottomRows(pair.output.rows()));
    outputs.push_back(pair.output);
  }
  return {representation::fit_normalization(inputs), representation::fit_normalization(outputs)};
}

Eigen::MatrixXd fit_context(const std::vector<AlignedPair>& aligned, const Scalings& scalings, int count) {
  const Eigen::Index dofs = scalings.input.num_dofs();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(dofs, dofs);
  for (const AlignedPair& pair : aligned) {
    const FrameMatrix rows = scalings.input.normalize(pair.input.bottomRows(pair.output.rows()));
    covariance.noalias() += rows.transpose() * rows / static_cast<double>(rows.rows());
  }
  covariance /= static_cast<double>(aligned.size());
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
