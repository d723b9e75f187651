// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include <strut/math/rotation.h>
#include <strut/math/rotation_arrays.h>
#include <strut/representation/pose_encoder.h>

namespace strut::representation {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Eigen::Vector3d translation_of(const auto& pose, int joint) {
  const auto* t = pose.translations + 3 * joint;
  return {static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2])};
}

Eigen::Quaterniond rotation_of(const auto& pose, int joint) {
  const auto* q = pose.rotations + 4 * joint;
  return {static_cast<double>(q[3]), static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2])};
}

/// Composes the chain from the root down to the pelvis.
template <typename Scalar>
RootTransform pelvis_of(const PoseView<const Scalar>& pose, int pelvis) {
  RootTransform world{rotation_of(pose, 0), translation_of(pose, 0)};
  for (int joint = 1; joint <= pelvis; ++joint) {
    world.position += world.rotation * translation_of(pose, joint);
    world.rotation = world.rotation * rotation_of(pose, joint);
  }
  world.rotation.normalize();  // single precision has rounded it
  return world;
}

/// The mean orientations of the joints below the pelvis as planes; of their inverses if `inverse`.
template <typename Scalar>
math::AlignedVector<Scalar> means_of(const Representation& representation, const RowLayout& layout, bool inverse) {
  const int plane = layout.plane();
  math::AlignedVector<Scalar> means(at(4 * plane));
  std::fill(means.begin() + 3 * plane, means.end(), Scalar(1));
  for (int i = 0; i < layout.num_joints(); ++i) {
    const Eigen::Quaterniond& mean = representation.mean_rotations()[at(representation.joints()[at(i)])];
    const Eigen::Vector4d q = (inverse ? mean.conjugate() : mean).coeffs();
    for (int part = 0; part < 4; ++part) means[at(i + part * plane)] = static_cast<Scalar>(q[part]);
  }
  return means;
}

}  // namespace

template <typename Scalar>
PoseEncoder<Scalar>::PoseEncoder(const Representation& representation, double frame_rate)
    : layout_(representation.num_dofs()),
      pelvis_(representation.skeleton().pelvis()),
      upright_(representation.upright()),
      frame_time_(1.0 / frame_rate),
      means_(means_of<Scalar>(representation, layout_, true)),
      given_(means_.size()),
      relative_(means_.size()),
      previous_(at(3 * layout_.plane())) {}

template <typename Scalar>
void PoseEncoder<Scalar>::encode(const PoseView<const Scalar>& pose, Scalar* row) {
  const RootTransform root = pelvis_of(pose, pelvis_);
  if (!started_) placement_ = representation::placement(root, upright_);
  started_ = true;
  const auto dofs = encode_root(root, placement_, upright_, frame_time_);
  for (int dof = 0; dof < RowLayout::kRotations; ++dof) {
    row[dof] = dof < kNumRootDofs ? static_cast<Scalar>(dofs[at(dof)]) : Scalar(0);
  }
  const int plane = layout_.plane();
  math::to_planes(layout_.num_joints(), plane, pose.rotations + 4 * (pelvis_ + 1), given_.data());
  math::multiply_rotations(plane, plane, means_.data(), given_.data(), relative_.data());
  math::log_maps_near(plane, plane, relative_.data(), previous_.data());
  std::copy(previous_.begin(), previous_.end(), row + RowLayout::kRotations);
}

template <typename Scalar>
void PoseEncoder<Scalar>::reset() {
  started_ = false;
  std::fill(previous_.begin(), previous_.end(), Scalar(0));
}

template <typename Scalar>
PoseDecoder<Scalar>::PoseDecoder(const Representation& representation, double frame_rate, const RootPlacement& start)
    : layout_(representation.num_dofs()),
      pelvis_(representation.skeleton().pelvis()),
      travel_joint_(representation.travel_joint()),
      upright_(representation.upright()),
      frame_time_(1.0 / frame_rate),
      placement_(start),
      standing_offset_(Eigen::Vector3d::Zero()),
      means_(means_of<Scalar>(representation, layout_, false)),
      movement_(means_.size()),
      rotations_(means_.size()) {
  for (int joint = 0; joint <= pelvis_; ++joint) {
    chain_offsets_.push_back(representation.skeleton().joint(joint).offset);
    if (joint != travel_joint_) standing_offset_ += chain_offsets_.back();
  }
}

template <typename Scalar>
void PoseDecoder<Scalar>::decode(const Scalar* row, const PoseView<const Scalar>& bones, const PoseView<Scalar>& pose) {
  const int plane = layout_.plane();
  math::exp_maps(plane, plane, row + RowLayout::kRotations, movement_.data());
  math::multiply_rotations(plane, plane, means_.data(), movement_.data(), rotations_.data());
  decode(row, rotations_.data(), upright_, bones, pose);
}

template <typename Scalar>
void PoseDecoder<Scalar>::decode(const Scalar* root, const Scalar* rotations, const Eigen::Quaterniond& upright,
                                 const PoseView<const Scalar>& bones, const PoseView<Scalar>& pose) {
  std::array<double, kNumRootDofs> dofs;
  for (int dof = 0; dof < kNumRootDofs; ++dof) dofs[at(dof)] = static_cast<double>(root[dof]);
  if (!started_) dofs[kSidewaysVelocity] = dofs[kForwardVelocity] = dofs[kTurningRate] = 0.0;
  started_ = true;
  const int first = pelvis_ + 1;
  const int plane = layout_.plane();
  for (int i = 0; i < layout_.num_joints(); ++i) {
    const Scalar* q = rotations + i;
    const Scalar x = q[0], y = q[plane], z = q[2 * plane], w = q[3 * plane];
    const Scalar scale = Scalar(1) / std::sqrt(x * x + y * y + z * z + w * w);
    Scalar* result = pose.rotations + 4 * (first + i);
    result[0] = x * scale;
    result[1] = y * scale;
    result[2] = z * scale;
    result[3] = w * scale;
  }
  if (pose.translations != bones.translations) {
    std::copy(bones.translations, bones.translations + 3 * bones.num_joints, pose.translations);
  }
  place_chain(decode_root(dofs, placement_, upright, frame_time_), pose);
}

/// Puts the pelvis where it belongs by way of the joint that carries the travel; the rest of the chain stands still.
template <typename Scalar>
void PoseDecoder<Scalar>::place_chain(const RootTransform& root, const PoseView<Scalar>& pose) const {
  for (int joint = 0; joint <= pelvis_; ++joint) {
    const Eigen::Vector3d position =
        joint == travel_joint_ ? Eigen::Vector3d(root.position - standing_offset_) : chain_offsets_[at(joint)];
    const Eigen::Quaterniond rotation = joint == pelvis_ ? root.rotation : Eigen::Quaterniond::Identity();
    for (int i = 0; i < 3; ++i) pose.translations[3 * joint + i] = static_cast<Scalar>(position[i]);
    for (int i = 0; i < 4; ++i) pose.rotations[4 * joint + i] = static_cast<Scalar>(rotation.coeffs()[i]);
  }
}

template <typename Scalar>
void PoseDecoder<Scalar>::restart(const RootPlacement& start) {
  placement_ = start;
  started_ = false;
}

template <typename Scalar>
void PoseDecoder<Scalar>::carry(const RootPlacement& from, const RootPlacement& to) {
  const double turn = to.heading - from.heading;
  const Eigen::Vector3d offset =
      math::rotation_about_y(turn) * Eigen::Vector3d(placement_.x - from.x, 0.0, placement_.z - from.z);
  placement_ = {to.x + offset.x(), to.z + offset.z(), math::wrap_angle(placement_.heading + turn)};
}

template class PoseEncoder<float>;
template class PoseEncoder<double>;
template class PoseDecoder<float>;
template class PoseDecoder<double>;

}  // namespace strut::representation
