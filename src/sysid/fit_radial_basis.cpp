// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Cholesky>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <strut/core/error.h>
#include <strut/sysid/fit_radial_basis.h>

namespace strut::sysid {
namespace {

using Features = Eigen::Ref<const Eigen::MatrixXd>;
using Counts = Eigen::Ref<const Eigen::VectorXd>;
using Block = tbb::blocked_range<Eigen::Index>;

constexpr int kRounds = 6;  // of Lloyd's algorithm: later ones move the centres by little
// Examples whose distances to all centres are held at once: they should stay in a core's cache.
constexpr Eigen::Index kBlock = 256;
// Of sums that are large themselves no more than this many are held.
constexpr Eigen::Index kMostSums = 16;

/// Squared distances but for |z|^2, which is the same for every centre: (centres x examples).
Eigen::MatrixXd relative_distances(const Eigen::MatrixXd& centres, const Features& features) {
  Eigen::MatrixXd distances = -2.0 * centres.transpose() * features;
  distances.colwise() += centres.colwise().squaredNorm().transpose();
  return distances;
}

/// Calls `body` with blocks of `count` examples. Where they end does not depend on the number of threads.
template <typename Body>
void for_blocks(Eigen::Index count, const Body& body) {
  tbb::parallel_for(Block(0, count, kBlock), body, tbb::simple_partitioner());
}

/// The examples nearest to every centre.
struct Clusters {
  Eigen::MatrixXd sums;    // (features x centres)
  Eigen::VectorXd counts;  // (centres)

  void add(const Eigen::MatrixXd& centres, const Features& features, const Counts& how_often) {
    const Eigen::MatrixXd distances = relative_distances(centres, features);
    for (Eigen::Index t = 0; t < features.cols(); ++t) {
      Eigen::Index nearest = 0;
      distances.col(t).minCoeff(&nearest);
      sums.col(nearest) += how_often[t] * features.col(t);
      counts[nearest] += how_often[t];
    }
  }
};

/// Moves every centre to the mean of the examples nearest to it; one that has none stays.
void move_to_means(const Features& features, const Counts& counts, Eigen::MatrixXd& centres) {
  const Clusters none{Eigen::MatrixXd::Zero(centres.rows(), centres.cols()), Eigen::VectorXd::Zero(centres.cols())};
  const Clusters clusters = tbb::parallel_deterministic_reduce(
      Block(0, features.cols(), kBlock), none,
      [&](const Block& block, Clusters found) {
        const auto size = static_cast<Eigen::Index>(block.size());
        found.add(centres, features.middleCols(block.begin(), size), counts.segment(block.begin(), size));
        return found;
      },
      [](Clusters a, const Clusters& b) {
        a.sums += b.sums;
        a.counts += b.counts;
        return a;
      });
  for (Eigen::Index m = 0; m < centres.cols(); ++m) {
    if (clusters.counts[m] > 0.0) centres.col(m) = clusters.sums.col(m) / clusters.counts[m];
  }
}

/// Root mean square over examples.
double distance_to_nearest(const Eigen::MatrixXd& centres, const Features& features, const Counts& counts) {
  Eigen::VectorXd squares(features.cols());
  for_blocks(features.cols(), [&](const Block& block) {
    const auto here = features.middleCols(block.begin(), static_cast<Eigen::Index>(block.size()));
    squares.segment(block.begin(), here.cols()) =
        relative_distances(centres, here).colwise().minCoeff() + here.colwise().squaredNorm();
  });
  return std::sqrt(std::max(0.0, squares.dot(counts) / counts.sum()));
}

void check(const Features& features, const Counts& counts, const std::vector<Eigen::Index>& starts,
           double width_factor) {
  if (features.size() == 0) throw InvalidArgument("features", "at least one example", "none");
  if (!features.allFinite()) throw InvalidArgument("features", "finite numbers", "NaN or infinity");
  if (counts.size() != features.cols()) {
    throw InvalidArgument("counts", std::to_string(features.cols()) + " numbers", std::to_string(counts.size()));
  }
  if (!counts.allFinite() || !(counts.minCoeff() > 0.0)) {
    throw InvalidArgument("counts", "numbers above 0", "one that is not");
  }
  if (starts.empty()) throw InvalidArgument("starts", "at least one", "none");
  for (const Eigen::Index start : starts) {
    if (start >= 0 && start < features.cols()) continue;
    throw InvalidArgument("starts", "examples from 0 to " + std::to_string(features.cols() - 1), std::to_string(start));
  }
  if (!(width_factor > 0.0)) throw InvalidArgument("width_factor", "more than 0", std::to_string(width_factor));
}

}  // namespace

std::vector<Eigen::Index> evenly_spaced(Eigen::Index num_examples, int num_centres) {
  const Eigen::Index count = std::min<Eigen::Index>(num_centres, num_examples);
  std::vector<Eigen::Index> places;
  for (Eigen::Index m = 0; m < count; ++m) places.push_back(m * num_examples / count);
  return places;
}

RadialBasis fit_radial_basis(const Features& features, const Counts& counts, const std::vector<Eigen::Index>& starts,
                             double width_factor) {
  check(features, counts, starts, width_factor);
  Eigen::MatrixXd centres = features(Eigen::all, starts);
  for (int round = 0; round < kRounds; ++round) move_to_means(features, counts, centres);
  // A centre per example leaves no distance to measure: any small width then tells them apart.
  const double mean_square = features.colwise().squaredNorm().dot(counts.transpose()) / counts.sum();
  const double least = 1e-6 * std::max(1.0, std::sqrt(mean_square));
  return {centres, std::max(least, width_factor * distance_to_nearest(centres, features, counts))};
}

Eigen::MatrixXd activations(const RadialBasis& basis, const Features& features) {
  Eigen::MatrixXd result = relative_distances(basis.centres(), features);
  for (Eigen::Index t = 0; t < result.cols(); ++t) {
    auto column = result.col(t).array();
    const double nearest = column.minCoeff();
    const double distance = std::max(0.0, nearest + features.col(t).squaredNorm());
    column = ((nearest - column) / (2.0 * basis.squared_width(distance))).exp();
    column /= column.sum();
  }
  return result;
}

RadialSums radial_sums(const RadialBasis& basis, const Features& features, const Features& targets,
                       const Counts& counts) {
  const Eigen::Index centres = basis.num_centres();
  const RadialSums none{Eigen::MatrixXd::Zero(centres, centres), Eigen::MatrixXd::Zero(centres, targets.rows())};
  const auto add = [&](const Block& block, RadialSums sums) {
    for (Eigen::Index first = block.begin(); first < block.end(); first += kBlock) {
      const Eigen::Index size = std::min(kBlock, block.end() - first);
      const auto root = counts.segment(first, size).cwiseSqrt().asDiagonal();
      const Eigen::MatrixXd phi = activations(basis, features.middleCols(first, size)) * root;
      sums.gram.selfadjointView<Eigen::Lower>().rankUpdate(phi);
      sums.cross.noalias() += phi * (targets.middleCols(first, size) * root).transpose();
    }
    return sums;
  };
  const auto join = [](RadialSums a, const RadialSums& b) {
    a.gram += b.gram;
    a.cross += b.cross;
    return a;
  };
  const Eigen::Index share = std::max(kBlock, features.cols() / kMostSums + 1);
  return tbb::parallel_deterministic_reduce(Block(0, features.cols(), share), none, add, join);
}

Eigen::MatrixXd fit_weights(const RadialSums& sums, double ridge) {
  if (!(ridge > 0.0)) throw InvalidArgument("ridge", "more than 0", std::to_string(ridge));
  Eigen::MatrixXd gram = sums.gram;
  // Never singular, even where no example is.
  gram.diagonal().array() += std::max(1e-12, ridge * gram.diagonal().mean());
  return gram.selfadjointView<Eigen::Lower>().llt().solve(sums.cross).transpose();
}

Eigen::MatrixXd predict(const RadialBasis& basis, const Eigen::MatrixXd& weights, const Features& features) {
  Eigen::MatrixXd predicted(weights.rows(), features.cols());
  for_blocks(features.cols(), [&](const Block& block) {
    const auto size = static_cast<Eigen::Index>(block.size());
    predicted.middleCols(block.begin(), size).noalias() =
        weights * activations(basis, features.middleCols(block.begin(), size));
  });
  return predicted;
}

}  // namespace strut::sysid
