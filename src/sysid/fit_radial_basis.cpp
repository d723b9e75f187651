// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include <strut/core/error.h>
#include <strut/sysid/fit_radial_basis.h>

namespace strut::sysid {
namespace {

constexpr int kRounds = 6;  // of Lloyd's algorithm: later ones move the centres by little

/// Squared distances but for |z|^2, which is the same for every centre: (centres x examples).
Eigen::MatrixXd relative_distances(const Eigen::MatrixXd& centres, const Eigen::Ref<const Eigen::MatrixXd>& features) {
  Eigen::MatrixXd distances = -2.0 * centres.transpose() * features;
  distances.colwise() += centres.colwise().squaredNorm().transpose();
  return distances;
}

Eigen::MatrixXd spread_evenly(const Eigen::Ref<const Eigen::MatrixXd>& features, Eigen::Index count) {
  Eigen::MatrixXd centres(features.rows(), count);
  for (Eigen::Index m = 0; m < count; ++m) centres.col(m) = features.col(m * features.cols() / count);
  return centres;
}

/// Moves every centre to the mean of the examples nearest to it; one that has none stays.
void move_to_means(const Eigen::Ref<const Eigen::MatrixXd>& features, Eigen::MatrixXd& centres) {
  const Eigen::MatrixXd distances = relative_distances(centres, features);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(centres.rows(), centres.cols());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(centres.cols());
  for (Eigen::Index t = 0; t < features.cols(); ++t) {
    Eigen::Index nearest = 0;
    distances.col(t).minCoeff(&nearest);
    sums.col(nearest) += features.col(t);
    counts[nearest] += 1.0;
  }
  for (Eigen::Index m = 0; m < centres.cols(); ++m) {
    if (counts[m] > 0.0) centres.col(m) = sums.col(m) / counts[m];
  }
}

double distance_to_nearest(const Eigen::MatrixXd& centres, const Eigen::Ref<const Eigen::MatrixXd>& features) {
  const Eigen::RowVectorXd squares =
      relative_distances(centres, features).colwise().minCoeff() + features.colwise().squaredNorm();
  return std::sqrt(std::max(0.0, squares.mean()));
}

}  // namespace

RadialBasis fit_radial_basis(const Eigen::Ref<const Eigen::MatrixXd>& features, int num_centres, double width_factor) {
  if (features.size() == 0) throw InvalidArgument("features", "at least one example", "none");
  if (!features.allFinite()) throw InvalidArgument("features", "finite numbers", "NaN or infinity");
  if (num_centres < 1) throw InvalidArgument("num_centres", "1 or more", std::to_string(num_centres));
  if (!(width_factor > 0.0)) throw InvalidArgument("width_factor", "more than 0", std::to_string(width_factor));
  Eigen::MatrixXd centres = spread_evenly(features, std::min<Eigen::Index>(num_centres, features.cols()));
  for (int round = 0; round < kRounds; ++round) move_to_means(features, centres);
  // A centre per example leaves no distance to measure: any small width then tells them apart.
  const double least = 1e-6 * std::max(1.0, std::sqrt(features.colwise().squaredNorm().mean()));
  return {centres, std::max(least, width_factor * distance_to_nearest(centres, features))};
}

Eigen::MatrixXd activations(const RadialBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& features) {
  Eigen::MatrixXd result = relative_distances(basis.centres(), features);
  const Eigen::RowVectorXd nearest = result.colwise().minCoeff();
  const Eigen::RowVectorXd distances = (nearest + features.colwise().squaredNorm()).cwiseMax(0.0);
  for (Eigen::Index t = 0; t < result.cols(); ++t) {
    result.col(t) = ((nearest[t] - result.col(t).array()) / (2.0 * basis.squared_width(distances[t]))).exp();
  }
  const Eigen::RowVectorXd sums = result.colwise().sum();
  return result * sums.cwiseInverse().asDiagonal();
}

void RadialSums::add(const Eigen::Ref<const Eigen::MatrixXd>& activations,
                     const Eigen::Ref<const Eigen::MatrixXd>& targets, double count) {
  gram.selfadjointView<Eigen::Lower>().rankUpdate(activations, count);
  cross.noalias() += count * activations * targets.transpose();
}

Eigen::MatrixXd fit_weights(const RadialSums& sums, double ridge) {
  if (!(ridge > 0.0)) throw InvalidArgument("ridge", "more than 0", std::to_string(ridge));
  Eigen::MatrixXd gram = sums.gram;
  // Never singular, even where no example is.
  gram.diagonal().array() += std::max(1e-12, ridge * gram.diagonal().mean());
  return gram.selfadjointView<Eigen::Lower>().llt().solve(sums.cross).transpose();
}

}  // namespace strut::sysid
