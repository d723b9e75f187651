// SPDX-License-Identifier: MIT
// Arms by angles, legs by two-bone inverse kinematics.
#include "body_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <strut/math/rotation.h>

namespace strut::generate::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kElbowOut = 0.25;  // elbows turned a little outwards [rad]

}  // namespace

double ankle_height(const Skeleton& skeleton) {
  return -skeleton.joint(kToe).offset.y() - skeleton.joint(kToe).end_site.y();
}

void place_arm(int side, const ArmAngles& arm, Pose& pose) {
  const double sign = side == 0 ? 1.0 : -1.0;
  const auto joint = [&](int left) { return static_cast<std::size_t>(left + side * kSideOfArm); };
  pose.rotations[joint(kUpperArm)] =
      about_x(-arm.flexion) * about_z(sign * (arm.spread - std::numbers::pi / 2)) * about_x(kElbowOut + arm.twist);
  pose.rotations[joint(kForeArm)] = about_y(-sign * arm.elbow);
  pose.rotations[joint(kHand)] = about_y(-sign * arm.wrist);
}

void place_leg(const Skeleton& skeleton, int side, const Vector3d& position, const Quaterniond& rotation,
               const Vector3d& ahead, const FootState& foot, Pose& pose) {
  const auto joint = [&](int left) { return left + side * kSideOfLeg; };
  const auto index = [&](int left) { return static_cast<std::size_t>(joint(left)); };
  const double thigh = -skeleton.joint(joint(kShank)).offset.y(), shank = -skeleton.joint(joint(kFoot)).offset.y();
  const Vector3d hip = position + rotation * skeleton.joint(joint(kThigh)).offset;
  const Vector3d leg = foot.ankle - hip;
  const double length = std::min(leg.norm(), 0.9999 * (thigh + shank));
  const Vector3d down = leg.normalized();

  const Vector3d x = ahead.cross(down).normalized();
  const Vector3d front = down.cross(x);
  const double along = (length * length + thigh * thigh - shank * shank) / (2.0 * length);
  const Vector3d knee = down * along + front * std::sqrt(thigh * thigh - along * along);

  const auto bone = [&](const Vector3d& direction) {
    Eigen::Matrix3d axes;
    axes << x, -direction, x.cross(-direction);
    return Quaterniond(axes);
  };
  const Quaterniond thigh_world = bone(knee.normalized());
  const Quaterniond shank_world = bone((leg - knee).normalized());
  const Quaterniond foot_world = about_y(foot.yaw) * about_x(-foot.pitch);
  pose.rotations[index(kThigh)] = rotation.conjugate() * thigh_world;
  pose.rotations[index(kShank)] = thigh_world.conjugate() * shank_world;
  pose.rotations[index(kFoot)] = shank_world.conjugate() * foot_world;
  pose.rotations[index(kToe)] = about_x(-foot.toe_bend);
}

}  // namespace strut::generate::detail
