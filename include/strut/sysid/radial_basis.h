// SPDX-License-Identifier: MIT
// Normalized radial basis functions: a smooth map that is a weighted mean of what examples near the input did. Unlike
// a linear system it cannot amplify, and the farther from every example it is, the more of them it takes the mean of.
#pragma once

#include <Eigen/Core>

namespace strut::sysid {

/// phi_m(z) = exp(-|z - c_m|^2 / (2 w^2)), divided by their sum over m (Moody and Darken 1989, "Fast learning in
/// networks of locally-tuned processing units"), with w^2 = width^2 + kWidening |z - c|^2, c the centre nearest to z:
/// at a fixed width, small movements far from all centres would switch from one to another. Immutable.
class RadialBasis {
 public:
  static constexpr double kWidening = 0.03;

  /// `centres` (features x centres). Throws InvalidArgument if there is none, a number is not finite, or `width` is not
  /// positive.
  RadialBasis(Eigen::MatrixXd centres, double width);

  [[nodiscard]] int num_features() const noexcept { return static_cast<int>(centres_.rows()); }
  [[nodiscard]] int num_centres() const noexcept { return static_cast<int>(centres_.cols()); }
  [[nodiscard]] const Eigen::MatrixXd& centres() const noexcept { return centres_; }
  [[nodiscard]] double width() const noexcept { return width_; }

  /// w^2 above, of a squared distance to the nearest centre.
  [[nodiscard]] double squared_width(double nearest) const noexcept { return width_ * width_ + kWidening * nearest; }

  /// The functions at `features` (num_features): `activations` (num_centres) are in [0, 1] and sum to 1. No allocation;
  /// sizes are the caller's duty (asserted in debug builds). Cost centres x features.
  void activate(const Eigen::Ref<const Eigen::VectorXd>& features, Eigen::Ref<Eigen::VectorXd> activations) const;

 private:
  Eigen::MatrixXd centres_;
  double width_;
};

}  // namespace strut::sysid
