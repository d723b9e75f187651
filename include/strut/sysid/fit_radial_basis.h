// SPDX-License-Identifier: MIT
// Where radial basis functions stand and how wide they are, from examples; and the weights that map them to outputs.
#pragma once

#include <Eigen/Core>

#include <strut/sysid/radial_basis.h>

namespace strut::sysid {

/// Centres by k-means (Lloyd's algorithm from examples at even distances in the order given, a fixed number of rounds:
/// the result depends on nothing else), their width a multiple of the root mean square distance of an example to its
/// nearest centre. `features` (features x examples); `num_centres` (at least 1; no more than examples are made).
/// Throws InvalidArgument if there is no example, a number is not finite, or an argument out of range.
/// Cost examples x centres x features.
RadialBasis fit_radial_basis(const Eigen::Ref<const Eigen::MatrixXd>& features, int num_centres, double width_factor);

/// The functions at every example: (centres x examples).
Eigen::MatrixXd activations(const RadialBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& features);

/// Sums over examples from which weights follow.
struct RadialSums {
  Eigen::MatrixXd gram;   ///< (centres x centres), lower triangle
  Eigen::MatrixXd cross;  ///< (centres x targets)

  RadialSums(Eigen::Index centres, Eigen::Index targets)
      : gram(Eigen::MatrixXd::Zero(centres, centres)), cross(Eigen::MatrixXd::Zero(centres, targets)) {}
  /// `activations` (centres x examples), `targets` (targets x examples): the mean of `count` examples each.
  void add(const Eigen::Ref<const Eigen::MatrixXd>& activations, const Eigen::Ref<const Eigen::MatrixXd>& targets,
           double count = 1.0);
};

/// Weights (targets x centres) that minimize the squared error plus `ridge` times the mean squared activation of a
/// centre times the squared weights: `ridge` 0.1 draws the weights of a centre that few examples are near to towards
/// zero. Throws InvalidArgument unless `ridge` is positive. Cost centres^3.
Eigen::MatrixXd fit_weights(const RadialSums& sums, double ridge);

}  // namespace strut::sysid
