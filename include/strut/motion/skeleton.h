// SPDX-License-Identifier: MIT
// A hierarchy of named joints. Immutable once made, and shared by the motions that move it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace strut {

/// One joint of a skeleton.
struct Joint {
  std::string name;                                  ///< as in the file; may be empty or repeated
  int parent = -1;                                   ///< index of the parent, -1 for the root; always less than its own
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< rest position in the parent's frame [m]
  bool has_end_site = false;                         ///< whether the file gives a tip for this joint
  Eigen::Vector3d end_site = Eigen::Vector3d::Zero();  ///< the tip in this joint's frame [m], if has_end_site
};

/// A tree of joints in which every parent precedes its children and joint 0 is the only root.
class Skeleton {
 public:
  /// Throws InvalidArgument if `joints` is empty, joint 0 is not the only root, a parent does not precede its child, or
  /// an offset is not finite.
  explicit Skeleton(std::vector<Joint> joints);

  [[nodiscard]] int num_joints() const noexcept { return static_cast<int>(joints_.size()); }
  [[nodiscard]] const Joint& joint(int index) const { return joints_.at(static_cast<std::size_t>(index)); }
  [[nodiscard]] const std::vector<Joint>& joints() const noexcept { return joints_; }
  /// Indices of the joints whose parent is `index`, ascending.
  [[nodiscard]] const std::vector<int>& children(int index) const {
    return children_.at(static_cast<std::size_t>(index));
  }
  /// Index of the first joint of that name, or -1.
  [[nodiscard]] int find(const std::string& name) const noexcept;
  /// The first joint, going down from the root, that branches (or ends): the pelvis of a body. The chain above it only
  /// carries it about and is folded into its motion (representation/relative_root.h).
  [[nodiscard]] int pelvis() const noexcept { return pelvis_; }

 private:
  std::vector<Joint> joints_;
  std::vector<std::vector<int>> children_;
  int pelvis_ = 0;
};

/// What keeps motions of skeleton `b` from being used where `a` is wanted: empty if names and hierarchy agree (bone
/// lengths may differ), else a sentence naming up to five joints that do not fit.
std::string describe_mismatch(const Skeleton& a, const Skeleton& b);

}  // namespace strut
