// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/representation/pose_encoder.h>
#include <strut/representation/representation.h>

namespace strut::representation {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::vector<int> chain_to_pelvis(const Skeleton& skeleton) {
  std::vector<int> chain{0};
  while (chain.back() != skeleton.pelvis()) chain.push_back(skeleton.children(chain.back()).front());
  return chain;
}

/// The joint of the chain whose translation varies most; the root where none moves.
int find_travel_joint(const std::vector<Motion>& motions) {
  int best = 0;
  double most = 0.0;
  for (const int joint : chain_to_pelvis(motions.front().skeleton())) {
    double range = 0.0;
    for (const Motion& motion : motions) {
      if (motion.num_frames() == 0) continue;
      Eigen::AlignedBox3d box;
      for (const Pose& pose : motion.frames()) box.extend(pose.translations[at(joint)]);
      range = std::max(range, box.diagonal().norm());
    }
    if (range > most) {
      most = range;
      best = joint;
    }
  }
  return best;
}

Eigen::Quaterniond mean_of_joint(const std::vector<Motion>& motions, int joint) {
  std::vector<Eigen::Quaterniond> all;
  for (const Motion& motion : motions) {
    for (const Pose& pose : motion.frames()) all.push_back(pose.rotations[at(joint)]);
  }
  return math::mean_rotation(all);
}

/// Rotations that are of unit length already stay as they are to the bit, so that a file comes back as it was.
Eigen::Quaterniond unit(const Eigen::Quaterniond& rotation) {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  return std::abs(rotation.squaredNorm() - 1.0) <= kRounding ? rotation : rotation.normalized();
}

}  // namespace

Representation::Representation(std::shared_ptr<const Skeleton> skeleton, std::vector<Eigen::Quaterniond> mean_rotations,
                               Eigen::Quaterniond upright, int travel_joint)
    : skeleton_(std::move(skeleton)),
      mean_rotations_(std::move(mean_rotations)),
      upright_(unit(upright)),
      travel_joint_(travel_joint) {
  if (!skeleton_) throw InvalidArgument("skeleton", "a skeleton", "null");
  if (mean_rotations_.size() != at(skeleton_->num_joints())) {
    throw InvalidArgument("mean_rotations", std::to_string(skeleton_->num_joints()),
                          std::to_string(mean_rotations_.size()));
  }
  const auto chain = chain_to_pelvis(*skeleton_);
  if (std::find(chain.begin(), chain.end(), travel_joint_) == chain.end()) {
    throw InvalidArgument("travel_joint", "a joint between root and pelvis", std::to_string(travel_joint_));
  }
  for (int j = skeleton_->pelvis() + 1; j < skeleton_->num_joints(); ++j) joints_.push_back(j);
}

std::string Representation::dof_name(int dof) const {
  static constexpr std::array<const char*, kNumRootDofs> kRootNames = {"root sideways velocity",
                                                                       "root forward velocity",
                                                                       "root turning rate",
                                                                       "root height",
                                                                       "root tilt x",
                                                                       "root tilt z"};
  if (dof < kNumRootDofs) return kRootNames.at(at(dof));
  const int joint = joints_.at(at((dof - kNumRootDofs) / 3));
  return skeleton_->joint(joint).name + " " + "xyz"[(dof - kNumRootDofs) % 3];
}

Pose mean_pose(const Representation& representation) {
  const Skeleton& skeleton = representation.skeleton();
  Pose pose = rest_pose(skeleton);
  pose.rotations[at(skeleton.pelvis())] = representation.upright();
  for (const int joint : representation.joints())
    pose.rotations[at(joint)] = representation.mean_rotations()[at(joint)];
  return pose;
}

void check_skeleton(const Representation& representation, const Skeleton& skeleton) {
  const std::string mismatch = describe_mismatch(representation.skeleton(), skeleton);
  if (!mismatch.empty()) throw SkeletonMismatch("the skeleton does not fit: " + mismatch);
}

Representation fit_representation(const std::vector<Motion>& motions, const Eigen::Quaterniond& upright) {
  const bool has_frames =
      std::any_of(motions.begin(), motions.end(), [](const Motion& motion) { return motion.num_frames() > 0; });
  if (!has_frames) throw InvalidArgument("motions", "at least one frame", "none");
  const Skeleton& skeleton = motions.front().skeleton();
  for (const Motion& motion : motions) {
    const std::string mismatch = describe_mismatch(skeleton, motion.skeleton());
    if (!mismatch.empty()) throw SkeletonMismatch("the example clips have different skeletons: " + mismatch);
  }
  std::vector<Eigen::Quaterniond> means;
  for (int j = 0; j < skeleton.num_joints(); ++j) means.push_back(mean_of_joint(motions, j));
  return {motions.front().shared_skeleton(), std::move(means), upright, find_travel_joint(motions)};
}

FrameMatrix encode(const Representation& representation, const Motion& motion) {
  check_skeleton(representation, motion.skeleton());
  PoseEncoder<double> encoder(representation, motion.frame_rate());
  math::AlignedVector<double> slots(at(encoder.layout().num_slots()));
  FrameMatrix rows(motion.num_frames(), representation.num_dofs());
  for (int t = 0; t < motion.num_frames(); ++t) {
    encoder.encode(view(motion.frame(t)), slots.data());
    encoder.layout().unpack(slots.data(), rows.row(t));
  }
  if (motion.num_frames() > 1) rows.row(0).head<kHeight>() = rows.row(1).head<kHeight>();
  return rows;
}

Motion decode(const Representation& representation, const Eigen::Ref<const FrameMatrix>& rows, double frame_rate,
              const RootPlacement& start, const std::shared_ptr<const Skeleton>& skeleton, const Pose& bones) {
  if (rows.cols() != representation.num_dofs()) {
    throw InvalidArgument("rows", std::to_string(representation.num_dofs()) + " columns", std::to_string(rows.cols()));
  }
  PoseDecoder<double> decoder(representation, frame_rate, start);
  const RowLayout layout(representation.num_dofs());
  math::AlignedVector<double> slots(at(layout.num_slots()));
  std::vector<Pose> frames(at(static_cast<int>(rows.rows())), bones);
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    layout.pack(rows.row(t), slots.data());
    decoder.decode(slots.data(), view(bones), view(frames[static_cast<std::size_t>(t)]));
  }
  return {skeleton, frame_rate, std::move(frames)};
}

}  // namespace strut::representation
