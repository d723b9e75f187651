// SPDX-License-Identifier: MIT
// What a fitted regression knows of fragments, ready to be asked about blends: their labels, how far apart they are in
// label and posture, and the kinematic terms: how a blend's speed, acceleration and jerk would differ from the mean of
// its ends'. Every term is 0 at alpha = 0 and 1 and the same for (i, j, a) and (j, i, 1 - a).
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort_regression.h>

namespace strut::effort::detail {

/// (1 - alpha) a + alpha b: exact at 0 and 1.
inline double mix(double a, double b, double alpha) {
  return (1.0 - alpha) * a + alpha * b;
}

/// 0 at alpha = 0 and 1, 1 at 1/2, below 0 outside, where it grows ever more slowly (-1.5 at 1.5, above -3).
double end_weight(double alpha);

/// Fragments, prepared. Keeps a reference to the parts.
class BlendInputs {
 public:
  explicit BlendInputs(const EffortRegressionParts& parts);

  [[nodiscard]] const EffortRegressionParts& parts() const noexcept { return parts_; }
  /// Whether both fragments are rated in this factor.
  [[nodiscard]] bool is_rated(int first, int second, int factor) const;
  [[nodiscard]] double linear(int first, int second, double alpha, int factor) const;

  [[nodiscard]] int num_terms() const noexcept;
  /// (alphas x terms) of one factor; both fragments must be rated in it.
  [[nodiscard]] Eigen::MatrixXd terms(int first, int second, const Eigen::Ref<const Eigen::VectorXd>& alphas,
                                      int factor) const;
  /// The same of many blends (blends x terms).
  [[nodiscard]] Eigen::MatrixXd terms(const std::vector<LabelledBlend>& blends, int factor) const;

  /// Coordinates of every fragment by its label in one factor (fragments x 1; 0 where not rated).
  [[nodiscard]] const Eigen::MatrixXd& label_space(int factor) const {
    return label_space_[static_cast<std::size_t>(factor)];
  }
  /// Coordinates by posture, duration and all labels (fragments x coordinates).
  [[nodiscard]] const Eigen::MatrixXd& posture_space() const noexcept { return posture_space_; }

 private:
  static constexpr int kOrders = 3;                // speed, acceleration, jerk
  static constexpr int kQuantities = kOrders + 1;  // and duration

  void measure_curves();
  void measure_groups();
  void weigh_kinematics();
  [[nodiscard]] Eigen::Array3d products(int first, int second) const;
  [[nodiscard]] Eigen::Array4d excess(int first, int second, double alpha, const Eigen::Array3d& cross) const;

  const EffortRegressionParts& parts_;
  Eigen::MatrixXd filled_;      // labels, 0 where not rated (fragments x 3)
  Eigen::MatrixXd latent_;      // atanh of labels drawn in a little (fragments x 3)
  Eigen::MatrixXd own_;         // mean squares of differences of every order (fragments x kOrders)
  Eigen::MatrixXd quantities_;  // logarithms: of speed, acceleration, jerk, duration (fragments x kQuantities)
  Eigen::MatrixXd scales_;      // their deviations within the fragment's group (fragments x kQuantities)
  Eigen::MatrixXd means_;       // their means within the fragment's group (fragments x kQuantities)
  Eigen::Matrix<double, kQuantities, kNumPredictedFactors> weights_;  // latent label per deviation of each
  std::array<Eigen::MatrixXd, kNumPredictedFactors> label_space_;
  Eigen::MatrixXd posture_space_;
};

}  // namespace strut::effort::detail
