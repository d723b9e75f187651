// SPDX-License-Identifier: MIT
// Symbols of Duda, Hart and Stork: m class means, S_w within-class scatter, w projection.
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include <strut/core/error.h>
#include <strut/postprocess/discriminant_analysis.h>

namespace strut::postprocess {
namespace {

// A deviation of nothing, in the means' distance.
constexpr double kNoDeviation = 1e-6;
// Least ridge, in total scatter: what keeps collinear features from deciding by rounding.
constexpr double kLeastRidge = 1e-12;

void check(const Eigen::Ref<const FrameMatrix>& examples, const std::vector<bool>& is_member,
           const DiscriminantOptions& options) {
  if (examples.rows() != static_cast<Eigen::Index>(is_member.size())) {
    throw InvalidArgument("is_member", std::to_string(examples.rows()) + " entries", std::to_string(is_member.size()));
  }
  if (!examples.allFinite()) throw InvalidArgument("examples", "finite numbers", "NaN or infinity");
  const auto members = std::count(is_member.begin(), is_member.end(), true);
  if (members == 0 || members == examples.rows()) {
    throw InvalidArgument("is_member", "examples of both classes",
                          std::to_string(members) + " members of " + std::to_string(examples.rows()));
  }
  if (!(options.ridge >= 0.0 && std::isfinite(options.ridge))) {
    throw InvalidArgument("ridge", "0 or more", std::to_string(options.ridge));
  }
  if (options.prior && !(*options.prior > 0.0 && *options.prior < 1.0)) {
    throw InvalidArgument("prior", "a number inside 0 to 1", std::to_string(*options.prior));
  }
}

/// The rows of one class.
FrameMatrix rows_of(const Eigen::Ref<const FrameMatrix>& examples, const std::vector<bool>& is_member, bool wanted) {
  FrameMatrix rows(std::count(is_member.begin(), is_member.end(), wanted), examples.cols());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < is_member.size(); ++i) {
    if (is_member[i] == wanted) rows.row(next++) = examples.row(static_cast<Eigen::Index>(i));
  }
  return rows;
}

/// (S_w + ridge)^-1 (m1 - m0) with unit variance features, scaled to put the means 1 apart; zero for equal means.
Eigen::VectorXd project(const FrameMatrix& members, const FrameMatrix& others, double ridge) {
  const Eigen::RowVectorXd m1 = members.colwise().mean(), m0 = others.colwise().mean();
  const Eigen::RowVectorXd difference = m1 - m0;
  const FrameMatrix d1 = members.rowwise() - m1, d0 = others.rowwise() - m0;
  const double n1 = static_cast<double>(members.rows()), n0 = static_cast<double>(others.rows());
  Eigen::MatrixXd within = (d1.transpose() * d1 + d0.transpose() * d0) / (n1 + n0);
  const Eigen::VectorXd between = (n1 * n0 / ((n1 + n0) * (n1 + n0))) * difference.cwiseAbs2().transpose();
  const Eigen::VectorXd total = within.diagonal() + between;
  // A feature that never moves says nothing.
  const Eigen::VectorXd scale = total.unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
  within = scale.asDiagonal() * within * scale.asDiagonal();
  within.diagonal().array() += std::max(ridge, kLeastRidge);
  const Eigen::VectorXd scaled = scale.cwiseProduct(difference.transpose());
  Eigen::VectorXd w = scale.cwiseProduct(within.ldlt().solve(scaled));
  const double apart = difference.dot(w);
  if (!(apart > 0.0)) return Eigen::VectorXd::Zero(difference.size());
  return w / apart;
}

Gaussian gaussian_of(const Eigen::VectorXd& numbers) {
  const double mean = numbers.mean();
  return {mean, std::sqrt((numbers.array() - mean).square().mean())};
}

}  // namespace

double decision_boundary(const Gaussian& members, const Gaussian& others, double prior) {
  const double odds = std::log(prior / (1.0 - prior));
  const double distance = members.mean - others.mean;
  if (!(distance > 0.0)) return odds > 0.0 ? members.mean - 1.0 : members.mean + 1.0;
  if (members.deviation == 0.0 && others.deviation == 0.0) return others.mean + 0.5 * distance;
  const double s1 = std::max(members.deviation, kNoDeviation * distance);
  const double s0 = std::max(others.deviation, kNoDeviation * distance);
  // Log-likelihood of a member over another's, prior included: rises between the means.
  const auto evidence = [&](double x) {
    const double z1 = (x - members.mean) / s1, z0 = (x - others.mean) / s0;
    return odds - std::log(s1 / s0) - 0.5 * (z1 * z1 - z0 * z0);
  };
  if (evidence(others.mean) >= 0.0) return others.mean;
  if (evidence(members.mean) <= 0.0) return members.mean;
  // a x^2 + b x + c = 0 for x from the others' mean, in a form that holds for equal deviations too (a = 0).
  const double a = 0.5 * (1.0 / (s0 * s0) - 1.0 / (s1 * s1));
  const double b = distance / (s1 * s1);
  const double c = evidence(others.mean);
  const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
  return others.mean + std::clamp(-2.0 * c / (b + root), 0.0, distance);
}

Discriminant discriminant_analysis(const Eigen::Ref<const FrameMatrix>& examples, const std::vector<bool>& is_member,
                                   const DiscriminantOptions& options) {
  check(examples, is_member, options);
  const FrameMatrix members = rows_of(examples, is_member, true);
  const FrameMatrix others = rows_of(examples, is_member, false);
  Discriminant found;
  found.projection = project(members, others, options.ridge);
  found.members = gaussian_of(members * found.projection);
  found.others = gaussian_of(others * found.projection);
  const double share = static_cast<double>(members.rows()) / static_cast<double>(examples.rows());
  found.boundary = decision_boundary(found.members, found.others, options.prior.value_or(share));
  return found;
}

}  // namespace strut::postprocess
