// SPDX-License-Identifier: MIT
#include "effort/blend_source.h"

#include <optional>

#include <strut/math/sampling.h>
#include <strut/motion/legs.h>

namespace strut::effort {
namespace {

using Eigen::Index;

constexpr Index kPelvisRotation = 3, kJoints = 7;  // columns

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

double bone_length(const Skeleton& skeleton, int joint) {
  return skeleton.joint(joint).offset.norm();
}

/// Of the bones that make a body high.
double size_of(const Skeleton& skeleton, const std::optional<motion::Legs>& legs) {
  double sum = 0.0;
  if (legs) {
    for (const motion::Leg* leg : {&legs->left, &legs->right}) {
      sum += bone_length(skeleton, leg->knee) + bone_length(skeleton, leg->ankle);
    }
    return sum;
  }
  for (int j = skeleton.pelvis() + 1; j < skeleton.num_joints(); ++j) sum += bone_length(skeleton, j);
  return sum;
}

/// Writes `rotation` with the sign in which it is nearer to the row before.
void put_rotation(FrameMatrix& channels, Index row, Index column, const Eigen::Quaterniond& rotation) {
  Eigen::RowVector4d q = rotation.coeffs().transpose();
  if (row > 0 && q.dot(channels.row(row - 1).segment<4>(column)) < 0.0) q = -q;
  channels.row(row).segment<4>(column) = q;
}

Eigen::Quaterniond unit(const FrameMatrix& rows, Index row, Index column) {
  const Eigen::Vector4d q = rows.row(row).segment<4>(column).transpose();
  return Eigen::Quaterniond(q).normalized();
}

}  // namespace

double length_scale(const Motion& from, const Motion& to) {
  const auto legs = motion::find_legs(to);
  const double own = size_of(from.skeleton(), legs), wanted = size_of(to.skeleton(), legs);
  return own > 0.0 && wanted > 0.0 ? wanted / own : 1.0;
}

BlendSource::BlendSource(const Motion& motion, const Skeleton& skeleton, double scale)
    : num_joints_(skeleton.num_joints() - skeleton.pelvis() - 1),
      channels_(motion.num_frames(), kJoints + 7 * num_joints_) {
  const int first = skeleton.pelvis() + 1;
  for (int t = 0; t < motion.num_frames(); ++t) {
    const Pose& pose = motion.frame(t);
    const auto root = representation::pelvis_world(motion.skeleton(), pose);
    channels_.row(t).head<3>() = scale * root.position.transpose();
    put_rotation(channels_, t, kPelvisRotation, root.rotation);
    for (int i = 0; i < num_joints_; ++i) {
      put_rotation(channels_, t, kJoints + 4 * i, pose.rotations[at(first + i)]);
      const Eigen::Vector3d moved = pose.translations[at(first + i)] - motion.skeleton().joint(first + i).offset;
      channels_.row(t).segment<3>(kJoints + 4 * num_joints_ + 3 * i) =
          (skeleton.joint(first + i).offset + scale * moved).transpose();
    }
  }
}

FrameMatrix BlendSource::sample(const Eigen::VectorXd& frames) const {
  return math::sample_rows(channels_, frames);
}

representation::RootTransform BlendSource::pelvis(const FrameMatrix& rows, Index row) const {
  return {unit(rows, row, kPelvisRotation), rows.row(row).head<3>().transpose()};
}

Eigen::Quaterniond BlendSource::rotation(const FrameMatrix& rows, Index row, int joint) const {
  return unit(rows, row, kJoints + 4 * joint);
}

Eigen::Vector3d BlendSource::translation(const FrameMatrix& rows, Index row, int joint) const {
  return rows.row(row).segment<3>(kJoints + 4 * num_joints_ + 3 * joint).transpose();
}

Eigen::AlignedBox3d BlendSource::reach_of_bone(int joint) const {
  const auto columns = channels_.middleCols<3>(kJoints + 4 * num_joints_ + 3 * joint);
  return {columns.colwise().minCoeff().transpose(), columns.colwise().maxCoeff().transpose()};
}

}  // namespace strut::effort
