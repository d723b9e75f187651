// SPDX-License-Identifier: MIT
#include "bvh_units.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <strut/motion/kinematics.h>

namespace strut::io::detail {
namespace {

constexpr double kPersonHeight = 1.7;    // [m]
constexpr double kClearRatio = 1.25;     // a body stands along an axis if it reaches this much further than the other
constexpr double kRestPoseShare = 0.75;  // a rest pose smaller than this share of the first frame is not a stance
constexpr double kGroundShare = 0.2;     // standing on the ground: the lowest point is this near to zero

std::optional<UpAxis> clear_axis(const BodyExtent& extent) {
  if (extent.size.y() > kClearRatio * extent.size.z()) return UpAxis::kY;
  if (extent.size.z() > kClearRatio * extent.size.y()) return UpAxis::kZ;
  return std::nullopt;
}

bool stands_on_ground(const BodyExtent& extent, int axis) {
  return std::abs(extent.low[axis]) < kGroundShare * extent.size[axis];
}

}  // namespace

BodyExtent body_extent(const Skeleton& skeleton, const Pose& pose) {
  const motion::WorldPose world = motion::forward_kinematics(skeleton, pose);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  const auto include = [&](const Eigen::Vector3d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  };
  // What only carries the body about does not count; in a skeleton that never branches, everything does.
  const int begin = skeleton.children(skeleton.pelvis()).empty() ? 0 : skeleton.pelvis();
  for (int j = begin; j < skeleton.num_joints(); ++j) {
    const auto index = static_cast<std::size_t>(j);
    include(world.positions[index]);
    const Joint& joint = skeleton.joint(j);
    if (joint.has_end_site) include(world.positions[index] + world.rotations[index] * joint.end_site);
  }
  return {low, high - low};
}

LengthUnit guess_unit(double height) {
  constexpr std::array<LengthUnit, 5> kUnits = {LengthUnit::kMetre, LengthUnit::kFoot, LengthUnit::kInch,
                                                LengthUnit::kCentimetre, LengthUnit::kMillimetre};
  if (!(height > 0.0)) return LengthUnit::kCentimetre;
  LengthUnit best = LengthUnit::kCentimetre;
  double best_misfit = std::numeric_limits<double>::infinity();
  for (const LengthUnit unit : kUnits) {
    const double misfit = std::abs(std::log(height * metres_per(unit) / kPersonHeight));
    if (misfit < best_misfit) {
      best = unit;
      best_misfit = misfit;
    }
  }
  return best;
}

UpAxis guess_up(const BodyExtent& first_frame, const BodyExtent& rest) {
  const auto in_frame = clear_axis(first_frame);
  const bool rest_is_stance = rest.size.tail<2>().maxCoeff() > kRestPoseShare * first_frame.largest();
  const auto in_rest = rest_is_stance ? clear_axis(rest) : std::nullopt;
  if (in_frame && (!in_rest || *in_rest == *in_frame)) return *in_frame;
  if (in_rest && !in_frame) return *in_rest;
  // Lying down at first, or a root that turns the body: the one that stands on the ground is right.
  if (stands_on_ground(first_frame, 2) && !stands_on_ground(first_frame, 1)) return UpAxis::kZ;
  if (in_rest && stands_on_ground(first_frame, 2) == stands_on_ground(first_frame, 1)) return *in_rest;
  return UpAxis::kY;
}

}  // namespace strut::io::detail
