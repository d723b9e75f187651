// SPDX-License-Identifier: MIT
#include <numbers>
#include <string>

#include <strut/core/error.h>
#include <strut/representation/normalization.h>
#include <strut/representation/relative_root.h>

namespace strut::representation {
namespace {

constexpr double kLeastAngle = 0.5 * std::numbers::pi / 180.0;  // [rad]
constexpr double kLeastLength = 0.01;                           // [m]
constexpr double kOneHertz = 2.0 * std::numbers::pi;            // [rad/s]

constexpr double kPerformerAngle = 12.0 * std::numbers::pi / 180.0;  // [rad]
constexpr double kPerformerHeight = 0.08;                            // [m]
constexpr double kPerformerSpeed = 0.1;                              // [m/s]
constexpr double kPerformerTurning = 0.2;                            // [rad/s]

}  // namespace

double least_deviation(Eigen::Index dof) {
  switch (dof) {
    case kSidewaysVelocity:
    case kForwardVelocity:
      return kOneHertz * kLeastLength;
    case kTurningRate:
      return kOneHertz * kLeastAngle;
    case kHeight:
      return kLeastLength;
    default:
      return kLeastAngle;
  }
}

double performer_deviation(Eigen::Index dof) {
  switch (dof) {
    case kSidewaysVelocity:
    case kForwardVelocity:
      return kPerformerSpeed;
    case kTurningRate:
      return kPerformerTurning;
    case kHeight:
      return kPerformerHeight;
    default:
      return kPerformerAngle;
  }
}

Normalization::Normalization(Eigen::VectorXd mean, Eigen::VectorXd scale)
    : mean_(std::move(mean)), scale_(std::move(scale)) {
  if (mean_.size() != scale_.size()) {
    throw InvalidArgument("scale", std::to_string(mean_.size()) + " elements", std::to_string(scale_.size()));
  }
  if (!mean_.allFinite() || !scale_.allFinite())
    throw InvalidArgument("normalization", "finite numbers", "NaN or infinity");
  if ((scale_.array() < 0.0).any()) throw InvalidArgument("scale", "numbers of at least 0", "a negative one");
}

FrameMatrix Normalization::normalize(const Eigen::Ref<const FrameMatrix>& rows) const {
  const Eigen::RowVectorXd inverse =
      (scale_.array() > 0.0).select(scale_.array().max(1e-300).inverse(), 0.0).matrix().transpose();
  return (rows.rowwise() - mean_.transpose()).array().rowwise() * inverse.array();
}

FrameMatrix Normalization::denormalize(const Eigen::Ref<const FrameMatrix>& rows) const {
  return (rows.array().rowwise() * scale_.transpose().array()).matrix().rowwise() + mean_.transpose();
}

Normalization fit_normalization(const std::vector<FrameMatrix>& signals) {
  Eigen::Index count = 0;
  for (const auto& rows : signals) count += rows.rows();
  if (count == 0) throw InvalidArgument("signals", "at least one frame", "none");
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(signals.front().cols());
  for (const auto& rows : signals) mean += rows.colwise().sum().transpose();
  mean /= static_cast<double>(count);
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(mean.size());
  for (const auto& rows : signals) {
    variance += (rows.rowwise() - mean.transpose()).array().square().colwise().sum().matrix().transpose();
  }
  Eigen::VectorXd scale = (variance / static_cast<double>(count)).cwiseSqrt();
  for (Eigen::Index dof = 0; dof < scale.size(); ++dof) {
    if (scale[dof] < least_deviation(dof)) scale[dof] = 0.0;
  }
  return {std::move(mean), std::move(scale)};
}

}  // namespace strut::representation
