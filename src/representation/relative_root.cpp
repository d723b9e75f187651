// SPDX-License-Identifier: MIT
#include <cmath>

#include <strut/math/rotation.h>
#include <strut/representation/relative_root.h>

namespace strut::representation {
namespace {

/// The body's rotation with the upright pelvis as identity: its heading is the way it faces.
Eigen::Quaterniond body_rotation(const RootTransform& root, const Eigen::Quaterniond& upright) {
  return root.rotation * upright.conjugate();
}

}  // namespace

RootTransform pelvis_world(const Skeleton& skeleton, const Pose& pose) {
  RootTransform world{pose.rotations[0], pose.translations[0]};
  for (int joint = 0; joint != skeleton.pelvis();) {
    joint = skeleton.children(joint).front();
    const auto j = static_cast<std::size_t>(joint);
    world.position += world.rotation * pose.translations[j];
    world.rotation = world.rotation * pose.rotations[j];
  }
  return world;
}

RootPlacement placement(const RootTransform& root, const Eigen::Quaterniond& upright) {
  return {root.position.x(), root.position.z(), math::heading(body_rotation(root, upright))};
}

std::array<double, kNumRootDofs> encode_root(const RootTransform& root, RootPlacement& previous,
                                             const Eigen::Quaterniond& upright, double frame_time) {
  const Eigen::Quaterniond body = body_rotation(root, upright);
  const RootPlacement here{root.position.x(), root.position.z(), math::heading(body)};
  const double turn = math::wrap_angle(here.heading - previous.heading);
  const Eigen::Vector3d moved(here.x - previous.x, 0.0, here.z - previous.z);
  const Eigen::Vector3d local = math::rotation_about_y(-(previous.heading + 0.5 * turn)) * moved;
  const Eigen::Vector3d tilt = math::log_map(math::rotation_about_y(-here.heading) * body);
  previous = here;
  return {local.x() / frame_time, local.z() / frame_time, turn / frame_time, root.position.y(), tilt.x(), tilt.z()};
}

RootTransform decode_root(const std::array<double, kNumRootDofs>& dofs, RootPlacement& previous,
                          const Eigen::Quaterniond& upright, double frame_time) {
  const double turn = dofs[kTurningRate] * frame_time;
  const Eigen::Vector3d local(dofs[kSidewaysVelocity] * frame_time, 0.0, dofs[kForwardVelocity] * frame_time);
  const Eigen::Vector3d moved = math::rotation_about_y(previous.heading + 0.5 * turn) * local;
  previous = {previous.x + moved.x(), previous.z + moved.z(), math::wrap_angle(previous.heading + turn)};
  const Eigen::Quaterniond tilt = math::exp_map({dofs[kTiltX], 0.0, dofs[kTiltZ]});
  return {(math::rotation_about_y(previous.heading) * tilt * upright).normalized(),
          {previous.x, dofs[kHeight], previous.z}};
}

}  // namespace strut::representation
