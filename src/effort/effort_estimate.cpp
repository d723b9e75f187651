// SPDX-License-Identifier: MIT
// The starting formula, and ridge regression whose left-out errors are known in closed form.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/effort/effort_estimate.h>

namespace strut::effort {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSquash = 0.6;  // tanh(0.6 z): one deviation is about half way to a pole
constexpr Index kNumInputs = 1 + 2 * static_cast<Index>(kNumDescriptors);
// How far the starting formula is to be believed in a large group. A rule of thumb: Time's descriptor is the one that
// studies agree on, those of Flow and Weight measured Time instead on labelled data.
constexpr double kStartConfidence[] = {0.3, 0.3, 0.5};
constexpr double kLargeGroup = 10.0;  // fragments

/// 1, the standardized descriptors, and what of them is squashed.
VectorXd inputs(const VectorXd& z) {
  VectorXd all(kNumInputs);
  all << 1.0, z, (kSquash * z.array()).tanh();
  return all;
}

MatrixXd starting_weights() {
  constexpr Index kSquashed = 1 + static_cast<Index>(kNumDescriptors);
  MatrixXd weights = MatrixXd::Zero(kNumPredictedFactors, kNumInputs);
  weights(kFlow, kSquashed + kHandSmoothness) = -1.0;
  weights(kWeight, kSquashed + kHeight) = -0.5;
  weights(kWeight, kSquashed + kLogPeakDeceleration) = 0.5;
  weights(kTime, kSquashed + kLogAcceleration) = 1.0;
  return weights;
}

const DescriptorScale& scale_of(const std::vector<DescriptorScale>& groups, int group) {
  if (group >= 0 && group < static_cast<int>(groups.size())) return groups[static_cast<std::size_t>(group)];
  throw InvalidArgument("group", "one of " + std::to_string(groups.size()) + " groups", std::to_string(group));
}

/// What was labelled of one factor.
struct Labelled {
  MatrixXd inputs;  // a row per label, without the constant
  VectorXd values;
};

Labelled labelled(const std::vector<DescriptorScale>& groups, const std::vector<LabelledDescriptors>& labels,
                  int factor) {
  std::vector<const LabelledDescriptors*> rated;
  for (const LabelledDescriptors& label : labels) {
    const double value = label.effort[factor];
    if (!is_rated(value)) continue;
    if (!(std::abs(value) <= 1.0)) throw InvalidArgument("labels", "numbers from -1 to 1", std::to_string(value));
    rated.push_back(&label);
  }
  Labelled result{MatrixXd(static_cast<Index>(rated.size()), kNumInputs - 1), VectorXd(rated.size())};
  for (std::size_t i = 0; i < rated.size(); ++i) {
    const VectorXd z = standardized(scale_of(groups, rated[i]->group), rated[i]->descriptors);
    result.inputs.row(static_cast<Index>(i)) = inputs(z).tail(kNumInputs - 1).transpose();
    result.values[static_cast<Index>(i)] = rated[i]->effort[factor];
  }
  return result;
}

struct RidgeFit {
  VectorXd weights;  // offset first
  double left_out_error = 0.0;
};

/// The ridge whose left-out error is least. Leaving label i out gives it the error r_i / (1 - h_i), with r the
/// residuals and h the diagonal of the hat matrix, the mean's own 1/n included (Allen 1974).
RidgeFit fit_ridge(const Labelled& data) {
  const double n = static_cast<double>(data.values.size());
  const Eigen::RowVectorXd centre = data.inputs.colwise().mean();
  const MatrixXd x = data.inputs.rowwise() - centre;
  const double mean = data.values.mean();
  const VectorXd y = data.values.array() - mean;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(x.transpose() * x);
  const VectorXd strengths = eigen.eigenvalues().cwiseMax(0.0);
  const MatrixXd turned = x * eigen.eigenvectors();
  const VectorXd projected = turned.transpose() * y;
  RidgeFit best;
  best.left_out_error = std::numeric_limits<double>::infinity();
  for (double lambda = 0.03; lambda < 3000.0; lambda *= 2.0) {
    const VectorXd shrink = (strengths.array() + lambda).inverse();
    const VectorXd weights = shrink.cwiseProduct(projected);
    const Eigen::ArrayXd leverage = 1.0 / n + (turned.cwiseAbs2() * shrink).array();
    const Eigen::ArrayXd left_out = (y - turned * weights).array() / (1.0 - leverage).max(1e-6);
    const double error = std::sqrt(left_out.square().mean());
    if (error >= best.left_out_error) continue;
    best.left_out_error = error;
    best.weights.resize(kNumInputs);
    best.weights.tail(kNumInputs - 1) = eigen.eigenvectors() * weights;
    best.weights[0] = mean - centre.dot(best.weights.tail(kNumInputs - 1));
  }
  return best;
}

}  // namespace

KinematicEstimator::KinematicEstimator(std::vector<DescriptorScale> groups) {
  numbers_.groups = std::move(groups);
  numbers_.weights = starting_weights();
}

KinematicEstimator::KinematicEstimator(EstimatorNumbers numbers) : numbers_(std::move(numbers)) {
  const MatrixXd& weights = numbers_.weights;
  if (weights.rows() != kNumPredictedFactors || weights.cols() != kNumInputs || !weights.allFinite()) {
    throw InvalidArgument("numbers.weights", "3 x " + std::to_string(kNumInputs) + " finite numbers",
                          std::to_string(weights.rows()) + " x " + std::to_string(weights.cols()));
  }
  for (const DescriptorScale& group : numbers_.groups) {
    const bool fits = group.mean.size() == kNumDescriptors && group.deviation.size() == kNumDescriptors &&
                      group.mean.allFinite() && group.deviation.allFinite() && std::isfinite(group.braking_slope);
    if (!fits) throw InvalidArgument("numbers.groups", "a finite scale for every descriptor", "another");
  }
}

KinematicEstimator KinematicEstimator::fit(std::vector<DescriptorScale> groups,
                                           const std::vector<LabelledDescriptors>& labels) {
  KinematicEstimator result(std::move(groups));
  EstimatorNumbers& numbers = result.numbers_;
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    const Labelled data = labelled(numbers.groups, labels, factor);
    numbers.num_labels[factor] = static_cast<int>(data.values.size());
    if (data.values.size() < kFewestLabels) continue;
    const RidgeFit ridge = fit_ridge(data);
    numbers.weights.row(factor) = ridge.weights.transpose();
    numbers.left_out_error[factor] = ridge.left_out_error;
    const VectorXd centred = data.values.array() - data.values.mean();
    numbers.label_deviation[factor] = std::sqrt(centred.squaredNorm() / static_cast<double>(centred.size()));
  }
  return result;
}

EffortEstimate KinematicEstimator::estimate(int group, const Eigen::Ref<const VectorXd>& descriptors) const {
  const DescriptorScale& scale = scale_of(numbers_.groups, group);
  EffortEstimate result;
  result.effort = (numbers_.weights * inputs(standardized(scale, descriptors))).cwiseMax(-1.0).cwiseMin(1.0);
  const double company = std::clamp((scale.num_fragments - 1) / (kLargeGroup - 1.0), 0.0, 1.0);
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    const double deviation = numbers_.label_deviation[factor], error = numbers_.left_out_error[factor];
    const double fitted = deviation > 0.0 ? std::max(0.0, 1.0 - error / deviation) : 0.0;
    result.confidence[factor] = is_rated(error) ? fitted : company * kStartConfidence[factor];
  }
  return result;
}

}  // namespace strut::effort
