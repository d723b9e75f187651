// SPDX-License-Identifier: MIT
// Symbols: K covariance of the labels (kernel plus label variance on the diagonal), r residuals, weights K^-1 r.
#include "effort/residual_process.h"

#include <algorithm>
#include <cmath>

namespace strut::effort::detail {
namespace {

using Blends = std::vector<LabelledBlend>;

std::vector<int> indices(const Blends& blends, int LabelledBlend::*end) {
  std::vector<int> result;
  for (const LabelledBlend& blend : blends) result.push_back(blend.*end);
  return result;
}

Eigen::VectorXd alphas_of(const Blends& blends) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(blends.size()));
  for (std::size_t n = 0; n < blends.size(); ++n) result[static_cast<Eigen::Index>(n)] = blends[n].alpha;
  return result;
}

Eigen::VectorXd weights_at(const Eigen::Ref<const Eigen::VectorXd>& alphas) {
  return alphas.unaryExpr(&end_weight);
}

/// exp(-d^2 / (2 reach^2)) between two lists of places, d their distance (rows x columns).
Eigen::MatrixXd likeness(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& columns, double reach) {
  Eigen::MatrixXd squares = -2.0 * rows * columns.transpose();
  squares.colwise() += rows.rowwise().squaredNorm();
  squares.rowwise() += columns.rowwise().squaredNorm().transpose();
  return (squares.array().max(0.0) * (-0.5 / (reach * reach))).exp().matrix();
}

/// What pairs of fragments have in common, as they stand and with one pair turned round.
struct PairLikeness {
  Eigen::MatrixXd straight, swapped;  // (rows x columns)

  PairLikeness(const Eigen::MatrixXd& space, double reach, const Blends& rows, const Blends& columns) {
    const Eigen::Index width = space.cols();
    Eigen::MatrixXd row_places(static_cast<Eigen::Index>(rows.size()), 2 * width);
    row_places << space(indices(rows, &LabelledBlend::first), Eigen::all),
        space(indices(rows, &LabelledBlend::second), Eigen::all);
    Eigen::MatrixXd places(static_cast<Eigen::Index>(columns.size()), 2 * width);
    places << space(indices(columns, &LabelledBlend::first), Eigen::all),
        space(indices(columns, &LabelledBlend::second), Eigen::all);
    straight = likeness(row_places, places, reach);
    swapped.resize(places.rows(), places.cols());
    swapped << places.rightCols(width), places.leftCols(width);
    swapped = likeness(row_places, swapped, reach);
  }
};

Eigen::MatrixXd alpha_likeness(const Eigen::VectorXd& rows, const Eigen::VectorXd& columns, double reach) {
  return likeness(rows, columns, reach);
}

Eigen::VectorXd mirrored(const Eigen::VectorXd& alphas) {
  return (1.0 - alphas.array()).matrix();
}

}  // namespace

ResidualKernel::ResidualKernel(const BlendInputs& inputs, int factor, const ResidualSettings& settings)
    : inputs_(inputs), factor_(factor), settings_(settings) {}

Eigen::MatrixXd ResidualKernel::between(const Blends& rows, const Eigen::MatrixXd& row_terms, const Blends& columns,
                                        const Eigen::MatrixXd& column_terms) const {
  const ResidualSettings& s = settings_;
  Eigen::MatrixXd result = s.kinematics * s.kinematics * row_terms * column_terms.transpose();
  if (s.labels == 0.0 && s.posture == 0.0) return result;
  const Eigen::VectorXd row_alphas = alphas_of(rows), alphas = alphas_of(columns);
  const Eigen::MatrixXd straight = alpha_likeness(row_alphas, alphas, s.alpha_reach);
  const Eigen::MatrixXd swapped = alpha_likeness(row_alphas, mirrored(alphas), s.alpha_reach);
  const PairLikeness labels(inputs_.label_space(factor_), s.label_reach, rows, columns);
  const PairLikeness posture(inputs_.posture_space(), s.posture_reach, rows, columns);
  const double a = 0.5 * s.labels * s.labels, b = 0.5 * s.posture * s.posture;
  const Eigen::MatrixXd smooth = (a * labels.straight + b * posture.straight).cwiseProduct(straight) +
                                 (a * labels.swapped + b * posture.swapped).cwiseProduct(swapped);
  result += weights_at(row_alphas).asDiagonal() * smooth * weights_at(alphas).asDiagonal();
  return result;
}

Eigen::VectorXd ResidualKernel::label_variance(const Blends& blends) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(blends.size()));
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const double a = blends[n].alpha, weight = end_weight(a);
    const double noise = settings_.noise * settings_.noise * (1.0 + (1.0 - a) * (1.0 - a) + a * a);
    result[static_cast<Eigen::Index>(n)] = noise + settings_.misfit * settings_.misfit * weight * weight;
  }
  return result;
}

Blends rated_blends(const BlendInputs& inputs, int factor, const Blends& blends) {
  Blends rated;
  for (const LabelledBlend& blend : blends) {
    if (is_rated(blend.effort[factor]) && inputs.is_rated(blend.first, blend.second, factor)) rated.push_back(blend);
  }
  return rated;
}

Eigen::VectorXd residuals(const BlendInputs& inputs, int factor, const Blends& blends) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(blends.size()));
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const LabelledBlend& blend = blends[n];
    result[static_cast<Eigen::Index>(n)] =
        blend.effort[factor] - inputs.linear(blend.first, blend.second, blend.alpha, factor);
  }
  return result;
}

ResidualProcess::ResidualProcess(const BlendInputs& inputs, int factor, const ResidualSettings& settings,
                                 const Blends& blends)
    : kernel_(inputs, factor, settings),
      blends_(rated_blends(inputs, factor, blends)),
      terms_(inputs.terms(blends_, factor)) {
  Eigen::MatrixXd covariance = kernel_.between(blends_, terms_, blends_, terms_);
  covariance.diagonal() += kernel_.label_variance(blends_);
  llt_.compute(covariance);
  weights_ = llt_.solve(residuals(inputs, factor, blends_));
  term_weights_ = settings.kinematics * settings.kinematics * terms_.transpose() * weights_;
}

Eigen::VectorXd ResidualProcess::mean(const Blends& blends) const {
  if (blends_.empty()) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blends.size()));
  const Eigen::MatrixXd terms = kernel_.inputs().terms(blends, kernel_.factor());
  return kernel_.between(blends, terms, blends_, terms_) * weights_;
}

Eigen::MatrixXd ResidualProcess::covariance(const Blends& blends) const {
  const Eigen::MatrixXd terms = kernel_.inputs().terms(blends, kernel_.factor());
  Eigen::MatrixXd result = kernel_.between(blends, terms, blends, terms);
  if (blends_.empty()) return result;
  const Eigen::MatrixXd seen = llt_.matrixL().solve(kernel_.between(blends_, terms_, blends, terms));
  result -= seen.transpose() * seen;
  return result;
}

Eigen::VectorXd ResidualProcess::variance(const Blends& blends) const {
  const ResidualSettings& s = kernel_.settings();
  const Eigen::MatrixXd terms = kernel_.inputs().terms(blends, kernel_.factor());
  Eigen::VectorXd result = s.kinematics * s.kinematics * terms.rowwise().squaredNorm();
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const Blends one{blends[n]};
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(1, terms.cols());
    result[static_cast<Eigen::Index>(n)] += kernel_.between(one, none, one, none)(0, 0);
  }
  if (blends_.empty()) return result;
  const Eigen::MatrixXd seen = llt_.matrixL().solve(kernel_.between(blends_, terms_, blends, terms));
  return (result - seen.colwise().squaredNorm().transpose()).cwiseMax(0.0);
}

Eigen::MatrixXd ResidualProcess::mean(const FragmentPair* pairs, Eigen::Index count,
                                      const Eigen::Ref<const Eigen::VectorXd>& alphas) const {
  Eigen::MatrixXd result(count, alphas.size());
  if (blends_.empty()) return Eigen::MatrixXd::Zero(count, alphas.size());
  Blends rows(static_cast<std::size_t>(count));
  for (Eigen::Index p = 0; p < count; ++p) {
    rows[static_cast<std::size_t>(p)] = {pairs[p].first, pairs[p].second, 0.0, EffortVector::Zero()};
    result.row(p) =
        (kernel_.inputs().terms(pairs[p].first, pairs[p].second, alphas, kernel_.factor()) * term_weights_).transpose();
  }
  const ResidualSettings& s = kernel_.settings();
  if (s.labels == 0.0 && s.posture == 0.0) return result;
  // The kernels are products of what pairs and what alphas have in common, so sums over blends are matrix products.
  const PairLikeness labels(kernel_.inputs().label_space(kernel_.factor()), s.label_reach, rows, blends_);
  const PairLikeness posture(kernel_.inputs().posture_space(), s.posture_reach, rows, blends_);
  const Eigen::VectorXd seen = alphas_of(blends_);
  const double a = 0.5 * s.labels * s.labels, b = 0.5 * s.posture * s.posture;
  const Eigen::VectorXd weighted = weights_at(seen).cwiseProduct(weights_);
  const Eigen::MatrixXd straight = weighted.asDiagonal() * alpha_likeness(seen, alphas, s.alpha_reach);
  const Eigen::MatrixXd swapped = weighted.asDiagonal() * alpha_likeness(mirrored(seen), alphas, s.alpha_reach);
  const Eigen::MatrixXd smooth =
      (a * labels.straight + b * posture.straight) * straight + (a * labels.swapped + b * posture.swapped) * swapped;
  result += smooth * weights_at(alphas).asDiagonal();
  return result;
}

}  // namespace strut::effort::detail
