// SPDX-License-Identifier: MIT
// Whitening of inputs and scaling of outputs.
#include "sysid/balance.h"

#include <Eigen/Eigenvalues>

namespace strut::sysid::detail {
namespace {

constexpr double kMoves = 1e-6;  // of the largest direction, as an amplitude: below, rounding of the files

/// Root mean square of every column of one signal over all clips, 1 where it is zero.
Eigen::VectorXd column_sizes(const std::vector<Experiment>& experiments, FrameMatrix Experiment::*signal) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero((experiments.front().*signal).cols());
  for (const Experiment& e : experiments) {
    largest = largest.cwiseMax((e.*signal).cwiseAbs().colwise().maxCoeff().transpose());
  }
  largest =
      (largest.array() > 0.0).select(largest, 1.0);  // squares of numbers near the limits of double must not be taken
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(largest.size());
  double frames = 0.0;
  for (const Experiment& e : experiments) {
    squares += ((e.*signal) * largest.cwiseInverse().asDiagonal()).colwise().squaredNorm().transpose();
    frames += e.num_frames();
  }
  squares = (squares.array() > 0.0).select(squares, frames);
  return largest.cwiseProduct((squares / frames).cwiseSqrt());
}

}  // namespace

Balance::Balance(const std::vector<Experiment>& experiments)
    : output_scale_(column_sizes(experiments, &Experiment::output)) {
  const Eigen::VectorXd unit = column_sizes(experiments, &Experiment::input).cwiseInverse();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(unit.size(), unit.size());
  double frames = 0.0;
  for (const Experiment& e : experiments) {
    const Eigen::MatrixXd scaled = e.input * unit.asDiagonal();
    covariance.noalias() += scaled.transpose() * scaled;
    frames += e.num_frames();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance / frames);
  const Eigen::VectorXd& variances = eigen.eigenvalues();  // rising
  const auto kept = (variances.array() > kMoves * kMoves * std::max(variances.tail(1)[0], 0.5)).count();
  const Eigen::MatrixXd directions = eigen.eigenvectors().rightCols(kept);
  input_map_ =
      variances.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal() * directions.transpose() * unit.asDiagonal();
  input_unmap_ = unit.cwiseInverse().asDiagonal() * directions * variances.tail(kept).cwiseSqrt().asDiagonal();
}

std::vector<Experiment> Balance::apply(const std::vector<Experiment>& experiments) const {
  std::vector<Experiment> balanced;
  balanced.reserve(experiments.size());
  for (const Experiment& e : experiments) {
    balanced.push_back(
        {e.input * input_map_.transpose(), e.output * output_scale_.cwiseInverse().asDiagonal(), e.lead_in});
  }
  return balanced;
}

LtiSystem Balance::apply(const LtiSystem& system) const {
  const auto shrink = output_scale_.cwiseInverse().asDiagonal();
  return {system.a(), system.b() * input_unmap_, shrink * system.c(), shrink * system.d() * input_unmap_};
}

LtiSystem Balance::undo(const LtiSystem& system) const {
  return {system.a(), system.b() * input_map_, output_scale_.asDiagonal() * system.c(),
          output_scale_.asDiagonal() * system.d() * input_map_};
}

}  // namespace strut::sysid::detail
