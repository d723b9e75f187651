// SPDX-License-Identifier: MIT
// Fits a radial basis to examples and a linear map of it to targets. Everything runs over blocks of examples in
// parallel; results do not depend on the number of threads.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/sysid/radial_basis.h>

namespace strut::sysid {

/// Which of `num_examples` examples, at even distances in their order, centres may start from: as many as
/// `num_centres`, or as there are examples if those are fewer.
std::vector<Eigen::Index> evenly_spaced(Eigen::Index num_examples, int num_centres);

/// Centres by k-means (Lloyd's algorithm, a fixed number of rounds: the result depends on the arguments only), their
/// width a multiple of the root mean square distance of an example to its nearest centre. `features`
/// (features x examples), each example as often as `counts` (examples) says; `starts`: the examples that the centres
/// start from.
/// Throws InvalidArgument if there is no example or start, a number is not finite, a count is not positive, a start is
/// no example or `width_factor` is not positive. Cost examples x centres x features.
RadialBasis fit_radial_basis(const Eigen::Ref<const Eigen::MatrixXd>& features,
                             const Eigen::Ref<const Eigen::VectorXd>& counts, const std::vector<Eigen::Index>& starts,
                             double width_factor);

/// The functions at every example: (centres x examples).
Eigen::MatrixXd activations(const RadialBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& features);

/// Sums over examples from which weights follow.
struct RadialSums {
  Eigen::MatrixXd gram;   ///< (centres x centres), lower triangle
  Eigen::MatrixXd cross;  ///< (centres x targets)
};

/// The sums over `features` (features x examples) and `targets` (targets x examples), each example as often as `counts`
/// (examples) says. Cost examples x centres x (features + centres / 2 + targets).
RadialSums radial_sums(const RadialBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& features,
                       const Eigen::Ref<const Eigen::MatrixXd>& targets,
                       const Eigen::Ref<const Eigen::VectorXd>& counts);

/// Weights (targets x centres) that minimize the squared error plus `ridge` times the mean squared activation of a
/// centre times the squared weights: `ridge` 0.1 draws the weights of a centre that few examples are near to towards
/// zero. Throws InvalidArgument unless `ridge` is positive. Cost centres^3.
Eigen::MatrixXd fit_weights(const RadialSums& sums, double ridge);

/// What `weights` make of the functions at every example: (targets x examples).
Eigen::MatrixXd predict(const RadialBasis& basis, const Eigen::MatrixXd& weights,
                        const Eigen::Ref<const Eigen::MatrixXd>& features);

}  // namespace strut::sysid
