// SPDX-License-Identifier: MIT
// Symbols: i, j fragments, a alpha, q the mean square of a difference of a blended curve: with evenly resampled curves
// C_i, (1-a) C_i + a C_j has q(a) = (1-a)^2 q_ii + 2 a (1-a) q_ij + a^2 q_jj, so that three inner products per pair
// tell how fast all its blends would move.
#include "effort/blend_inputs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

namespace strut::effort::detail {
namespace {

// Labels are drawn in by this before atanh, which is infinite at 1.
constexpr double kLargestLabel = 0.95;
// A blend of opposite movements stands still: its mean square is at least this share of the lesser end's.
constexpr double kLeastShare = 1e-3;
// A fragment that stands still has no logarithm: a hundredth of a millimetre per duration is as good as none [m^2].
constexpr double kStandstill = 1e-10;
// Time cannot run backwards or stop: a blend lasts at least this share of the shorter end.
constexpr double kLeastDuration = 0.25;
// Label per deviation of a kinematic quantity, roughly: puts its terms on the scale of the others.
constexpr double kTermScale = 0.3;
// As many fragments, with the deviation that groups have on average, as a group's own deviation is mixed with.
constexpr double kPriorFragments = 4.0;
constexpr double kRidge = 0.05;        // of the regression of labels on kinematics, per fragment
constexpr int kPostureCovariates = 3;  // components of posture that the same regression sees
constexpr double kLeastScale = 1e-3;   // of a deviation of logarithms

/// Differences of order 1, 2 and 3 of a curve, all mean squares with another's (a dot product per order).
Eigen::Array3d difference_products(Eigen::MatrixXd a, Eigen::MatrixXd b) {
  Eigen::Array3d products;
  for (int order = 0; order < 3; ++order) {
    const Eigen::Index left = a.cols() - 1;
    // Unevaluated on the right, the blocks would overlap with what is assigned.
    a = (a.rightCols(left) - a.leftCols(left)).eval() * kCurvePoints;
    b = (b.rightCols(left) - b.leftCols(left)).eval() * kCurvePoints;
    products[order] = a.cwiseProduct(b).sum() / static_cast<double>(left);
  }
  return products;
}

double drawn_in(double label) {
  return std::atanh(std::clamp(label, -kLargestLabel, kLargestLabel));
}

}  // namespace

double end_weight(double alpha) {
  const double parabola = 4.0 * alpha * (1.0 - alpha);
  return parabola >= 0.0 ? parabola : parabola / (1.0 - parabola / 3.0);
}

BlendInputs::BlendInputs(const EffortRegressionParts& parts) : parts_(parts) {
  filled_ = parts.effort.unaryExpr([](double e) { return strut::effort::is_rated(e) ? e : 0.0; });
  latent_ = filled_.unaryExpr(&drawn_in);
  for (int d = 0; d < kNumPredictedFactors; ++d) label_space_[static_cast<std::size_t>(d)] = filled_.col(d);
  posture_space_.resize(parts.effort.rows(), parts.posture.cols() + 4);
  posture_space_ << parts.posture, parts.duration.array().log().matrix(), 3.0 * filled_;
  weights_.setZero();
  if (parts.curves.cols() == 0) return;
  measure_curves();
  measure_groups();
  weigh_kinematics();
}

bool BlendInputs::is_rated(int first, int second, int factor) const {
  return strut::effort::is_rated(parts_.effort(first, factor)) &&
         strut::effort::is_rated(parts_.effort(second, factor));
}

double BlendInputs::linear(int first, int second, double alpha, int factor) const {
  return mix(filled_(first, factor), filled_(second, factor), alpha);
}

Eigen::Array3d BlendInputs::products(int first, int second) const {
  const auto curve = [&](int i) {
    const Eigen::VectorXd row = parts_.curves.row(i);
    return Eigen::MatrixXd(Eigen::Map<const Eigen::MatrixXd>(row.data(), row.size() / kCurvePoints, kCurvePoints));
  };
  return difference_products(curve(first), curve(second)) + kStandstill;
}

void BlendInputs::measure_curves() {
  const Eigen::Index count = parts_.curves.rows();
  own_.resize(count, kOrders);
  quantities_.resize(count, kQuantities);
  for (Eigen::Index i = 0; i < count; ++i) {
    own_.row(i) = products(static_cast<int>(i), static_cast<int>(i)).matrix().transpose();
    const double log_duration = std::log(parts_.duration[i]);
    for (int k = 0; k < kOrders; ++k) quantities_(i, k) = 0.5 * std::log(own_(i, k)) - (k + 1) * log_duration;
    quantities_(i, kOrders) = log_duration;
  }
}

void BlendInputs::measure_groups() {
  std::map<int, std::vector<int>> members;
  for (Eigen::Index i = 0; i < parts_.group.size(); ++i) members[parts_.group[i]].push_back(static_cast<int>(i));
  means_.resize(quantities_.rows(), kQuantities);
  Eigen::RowVectorXd pooled = Eigen::RowVectorXd::Zero(kQuantities);
  std::map<int, Eigen::RowVectorXd> squares;
  for (const auto& [group, fragments] : members) {
    const Eigen::MatrixXd rows = quantities_(fragments, Eigen::all);
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    for (const int i : fragments) means_.row(i) = mean;
    squares[group] = (rows.rowwise() - mean).colwise().squaredNorm();
    pooled += squares[group] / static_cast<double>(quantities_.rows());
  }
  scales_.resize(quantities_.rows(), kQuantities);
  for (const auto& [group, fragments] : members) {
    const double own = static_cast<double>(fragments.size());
    const Eigen::RowVectorXd scale =
        ((squares[group] + kPriorFragments * pooled) / (own + kPriorFragments)).cwiseSqrt();
    for (const int i : fragments) scales_.row(i) = scale.cwiseMax(kLeastScale);
  }
}

// How labels depend on kinematics, seen on the fragments themselves: ridge regression of atanh of the label on the
// quantities as deviations within a group, with posture beside them so that what is posture's is not said of speed.
void BlendInputs::weigh_kinematics() {
  const Eigen::Index covariates = std::min<Eigen::Index>(kPostureCovariates, parts_.posture.cols());
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    std::vector<int> rated;
    for (Eigen::Index i = 0; i < parts_.effort.rows(); ++i) {
      if (strut::effort::is_rated(parts_.effort(i, d))) rated.push_back(static_cast<int>(i));
    }
    if (rated.empty()) continue;
    Eigen::MatrixXd inputs(static_cast<Eigen::Index>(rated.size()), kQuantities + covariates);
    inputs << ((quantities_ - means_).array() / scales_.array()).matrix()(rated, Eigen::all),
        parts_.posture.leftCols(covariates)(rated, Eigen::all);
    const Eigen::VectorXd labels = latent_.col(d)(rated);
    Eigen::MatrixXd gram = inputs.transpose() * inputs;
    gram.diagonal().array() += kRidge * static_cast<double>(rated.size()) + 1.0;
    const Eigen::VectorXd solution = gram.ldlt().solve(inputs.transpose() * labels);
    weights_.col(d) = solution.head(kQuantities);
  }
}

Eigen::Array4d BlendInputs::excess(int first, int second, double alpha, const Eigen::Array3d& cross) const {
  const double shorter = std::min(parts_.duration[first], parts_.duration[second]);
  const double duration = mix(parts_.duration[first], parts_.duration[second], alpha);
  const double log_duration = std::log(std::max(duration, kLeastDuration * shorter));
  Eigen::Array4d result;
  for (int k = 0; k < kOrders; ++k) {
    const double mixed = (1.0 - alpha) * (1.0 - alpha) * own_(first, k) + 2.0 * alpha * (1.0 - alpha) * cross[k] +
                         alpha * alpha * own_(second, k);
    const double square = std::max(mixed, kLeastShare * std::min(own_(first, k), own_(second, k)));
    result[k] = 0.5 * std::log(square) - (k + 1) * log_duration;
  }
  result[kOrders] = log_duration;
  for (int k = 0; k < kQuantities; ++k) result[k] -= mix(quantities_(first, k), quantities_(second, k), alpha);
  const Eigen::Array4d scale = 0.5 * (scales_.row(first) + scales_.row(second)).transpose().array();
  return result / scale;
}

int BlendInputs::num_terms() const noexcept {
  return parts_.curves.cols() > 0 ? 3 + kQuantities : 2;
}

Eigen::MatrixXd BlendInputs::terms(int first, int second, const Eigen::Ref<const Eigen::VectorXd>& alphas,
                                   int factor) const {
  const bool has_curves = parts_.curves.cols() > 0;
  const Eigen::Array3d cross = has_curves ? products(first, second) : Eigen::Array3d::Zero();
  const double first_end = latent_(first, factor), second_end = latent_(second, factor);
  Eigen::MatrixXd result(alphas.size(), num_terms());
  for (Eigen::Index q = 0; q < alphas.size(); ++q) {
    const double alpha = alphas[q];
    const double straight = linear(first, second, alpha, factor);
    const double ends = mix(std::tanh(first_end), std::tanh(second_end), alpha);
    const double latent = mix(first_end, second_end, alpha);
    // Labels end at 1: they bend towards it, or stop there.
    result(q, 0) = std::tanh(latent) - ends;
    result(q, 1) = std::clamp(straight, -1.0, 1.0) - straight;
    if (!has_curves) continue;
    const bool is_end = alpha == 0.0 || alpha == 1.0;  // the logarithms are equal but for rounding
    const Eigen::Array4d beyond = is_end ? Eigen::Array4d(Eigen::Array4d::Zero()) : excess(first, second, alpha, cross);
    result(q, 2) = std::tanh(latent + weights_.col(factor).dot(beyond.matrix())) - ends;
    result.row(q).tail(kQuantities) = kTermScale * beyond.matrix().transpose();
  }
  return result;
}

Eigen::MatrixXd BlendInputs::terms(const std::vector<LabelledBlend>& blends, int factor) const {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(blends.size()), num_terms());
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const Eigen::VectorXd alpha = Eigen::VectorXd::Constant(1, blends[n].alpha);
    result.row(static_cast<Eigen::Index>(n)) = terms(blends[n].first, blends[n].second, alpha, factor);
  }
  return result;
}

}  // namespace strut::effort::detail
