// SPDX-License-Identifier: MIT
// Tells two classes of vectors apart by one number: multiple discriminant analysis of two classes (Hsu et al.
// 2005, 4.5; Duda, Hart, Stork 2000, 3.8.2 and 3.8.3), a Gaussian per class of the projected examples, and the point
// between their means where both are equally likely. From examples to a projection and a boundary.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::postprocess {

/// A normal distribution of numbers.
struct Gaussian {
  double mean = 0.0;
  double deviation = 0.0;  ///< 0: all examples are alike
};

struct DiscriminantOptions {
  /// Added to the within-class scatter, in shares of each feature's total scatter, 0 or more: what decides between
  /// features that move together. 0 leaves it to rounding where they are exactly collinear.
  double ridge = 1e-3;
  /// How likely a member is before anything is known of it, inside (0, 1); empty: the share of members in the examples.
  std::optional<double> prior{};
};

/// Which side of a point examples are on, once projected.
struct Discriminant {
  Eigen::VectorXd projection;  ///< (features) scaled so that the class means lie 1 apart, members above; zero where
                               ///< the means are the same
  Gaussian members, others;    ///< of the projected examples
  double boundary = 0.0;       ///< more than this is taken for a member

  [[nodiscard]] bool is_member(const Eigen::Ref<const Eigen::VectorXd>& features) const {
    return projection.dot(features) > boundary;
  }
};

/// Where two Gaussians, each times its prior, are equal: the root between their means, of the quadratic of unequal
/// deviations or the line of equal ones. Where one class is likelier all the way, the mean of the other; so the
/// boundary never leaves the means' interval. A deviation of 0 counts as a millionth of the means' distance; both 0
/// give the middle. `members` has the larger mean or the same; of equal means every number belongs to the likelier
/// class, so the boundary is 1 below or above them. `prior`: of the members, inside (0, 1). Cost: constant.
double decision_boundary(const Gaussian& members, const Gaussian& others, double prior);

/// The projection that separates the classes most against their scatter within (Fisher 1936), (Sw + ridge)^-1 (m1 -
/// m0), and the boundary on it. `examples` (frames x features), `is_member` (frames). Throws InvalidArgument if the
/// sizes differ, a number is not finite, a class has no example, or an option is out of range. Cost frames x features^2
/// + features^3.
Discriminant discriminant_analysis(const Eigen::Ref<const FrameMatrix>& examples, const std::vector<bool>& is_member,
                                   const DiscriminantOptions& options = {});

}  // namespace strut::postprocess
