// SPDX-License-Identifier: MIT
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/sysid/radial_basis.h>

namespace strut::sysid {

RadialBasis::RadialBasis(Eigen::MatrixXd centres, double width) : centres_(std::move(centres)), width_(width) {
  if (centres_.size() == 0) throw InvalidArgument("centres", "at least one of at least one feature", "none");
  if (!centres_.allFinite()) throw InvalidArgument("centres", "finite numbers", "NaN or infinity");
  if (!(width > 0.0 && std::isfinite(width))) {
    throw InvalidArgument("width", "a positive number", std::to_string(width));
  }
}

void RadialBasis::activate(const Eigen::Ref<const Eigen::VectorXd>& features,
                           Eigen::Ref<Eigen::VectorXd> activations) const {
  assert(features.size() == num_features() && activations.size() == num_centres());
  for (Eigen::Index m = 0; m < activations.size(); ++m) activations[m] = (centres_.col(m) - features).squaredNorm();
  // Relative to the nearest: far from all centres every exponential would be zero.
  const double nearest = activations.minCoeff();
  activations = ((nearest - activations.array()) / (2.0 * squared_width(nearest))).exp();
  activations /= activations.sum();
}

}  // namespace strut::sysid
