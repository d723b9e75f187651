// SPDX-License-Identifier: MIT
// Degrees of freedom scaled to zero mean and unit variance over the examples of one style (Hsu et al. 2005, 4.1). Those
// that barely move are dropped before scaling: scaled up they would be pure noise. They are translated by their mean.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::representation {

/// Per degree of freedom: value = mean + scale * normalized.
class Normalization {
 public:
  /// `mean`, `scale` (dofs): scale 0 marks a dropped degree of freedom.
  /// Throws InvalidArgument if sizes differ, a number is not finite, or a scale is negative.
  Normalization(Eigen::VectorXd mean, Eigen::VectorXd scale);

  [[nodiscard]] int num_dofs() const noexcept { return static_cast<int>(mean_.size()); }
  [[nodiscard]] const Eigen::VectorXd& mean() const noexcept { return mean_; }
  [[nodiscard]] const Eigen::VectorXd& scale() const noexcept { return scale_; }
  [[nodiscard]] bool is_kept(int dof) const { return scale_[dof] > 0.0; }

  /// Row(s) in units of the standard deviation; dropped degrees of freedom become 0.
  [[nodiscard]] FrameMatrix normalize(const Eigen::Ref<const FrameMatrix>& rows) const;
  /// The inverse; dropped degrees of freedom become their mean.
  [[nodiscard]] FrameMatrix denormalize(const Eigen::Ref<const FrameMatrix>& rows) const;

 private:
  Eigen::VectorXd mean_, scale_;
};

/// A deviation of degree of freedom `dof` that is no more than noise: half a degree or a centimetre (for velocities:
/// what a swing of that size at one hertz has) [units of the dof].
double least_deviation(Eigen::Index dof);

/// How far another performer of the same movement may be from the examples' mean in degree of freedom `dof` by body and
/// posture alone: 12 degrees, 8 centimetres, a tenth of a metre per second, 0.2 radians per second [units of the dof].
/// Recordings of one content differ by about that in their mean posture (docs/generalization.md).
double performer_deviation(Eigen::Index dof);

/// Mean and standard deviation over all rows of `signals` (each frames x dofs of representation.h). A degree of freedom
/// whose deviation is below least_deviation is dropped. Throws InvalidArgument if there is no row or a number is not
/// finite. Cost O(frames x dofs).
Normalization fit_normalization(const std::vector<FrameMatrix>& signals);

}  // namespace strut::representation
