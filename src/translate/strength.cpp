// SPDX-License-Identifier: MIT
#include <strut/math/rotation.h>
#include <strut/translate/strength.h>

namespace strut::translate {

void apply_strength(const StyleModel& model, const Eigen::Ref<const Eigen::RowVectorXd>& input, double strength,
                    Eigen::Ref<Eigen::RowVectorXd> output) {
  using representation::kNumRootDofs;
  if (strength == 1.0) return;
  output.head<kNumRootDofs>() = (1.0 - strength) * input.head<kNumRootDofs>() + strength * output.head<kNumRootDofs>();
  output[model.time_warp_dof()] *= strength;
  int column = kNumRootDofs;
  for (const int joint : model.input().joints()) {
    const auto j = static_cast<std::size_t>(joint);
    const Eigen::Quaterniond& mean = model.output().mean_rotations()[j];
    const Eigen::Quaterniond from =
        model.input().mean_rotations()[j] * math::exp_map(input.segment<3>(column).transpose());
    const Eigen::Quaterniond to = mean * math::exp_map(output.segment<3>(column).transpose());
    const Eigen::Quaterniond between = from * math::exp_map(strength * math::log_map(from.conjugate() * to));
    const Eigen::Vector3d previous = output.segment<3>(column).transpose();
    output.segment<3>(column) = math::log_map_near(mean.conjugate() * between, previous).transpose();
    column += 3;
  }
}

}  // namespace strut::translate
