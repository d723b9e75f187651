// SPDX-License-Identifier: MIT
// How the runtime keeps a row of representation.h: degrees of freedom of one kind beside each other, so that all joints
// are stepped at once. A place in such a row is called a slot.
#pragma once

#include <Eigen/Core>

#include <strut/math/aligned.h>
#include <strut/representation/relative_root.h>

namespace strut::representation {

/// [the root's degrees of freedom, the log of the differential time warp | x of every joint | y | z], each part filled
/// up to whole lanes (math/aligned.h). What fills up is zero.
class RowLayout {
 public:
  static constexpr int kTimeWarp = kNumRootDofs;   ///< slot of the log of the differential time warp
  static constexpr int kRotations = math::kLanes;  ///< first slot of the rotation vectors
  static_assert(kTimeWarp < kRotations);

  /// `num_dofs` as of a Representation.
  explicit RowLayout(int num_dofs)
      : num_dofs_(num_dofs), num_joints_((num_dofs - kNumRootDofs) / 3), plane_(math::padded(num_joints_)) {}

  [[nodiscard]] int num_dofs() const noexcept { return num_dofs_; }
  /// Joints below the pelvis.
  [[nodiscard]] int num_joints() const noexcept { return num_joints_; }
  /// Slots from one coordinate of a rotation vector to the next.
  [[nodiscard]] int plane() const noexcept { return plane_; }
  [[nodiscard]] int num_slots() const noexcept { return kRotations + 3 * plane_; }
  /// Where degree of freedom `dof` stands; num_dofs() is the log of the differential time warp.
  [[nodiscard]] int slot(int dof) const noexcept {
    if (dof < kNumRootDofs) return dof;
    if (dof == num_dofs_) return kTimeWarp;
    return kRotations + (dof - kNumRootDofs) % 3 * plane_ + (dof - kNumRootDofs) / 3;
  }

  /// `row` (num_dofs, or one more with the time warp) to slots; those it does not fill are left alone.
  template <typename Scalar>
  void pack(const Eigen::Ref<const Eigen::RowVectorXd>& row, Scalar* slots) const {
    for (int dof = 0; dof < row.size(); ++dof) slots[slot(dof)] = static_cast<Scalar>(row[dof]);
  }
  /// The inverse.
  template <typename Scalar>
  void unpack(const Scalar* slots, Eigen::Ref<Eigen::RowVectorXd> row) const {
    for (int dof = 0; dof < row.size(); ++dof) row[dof] = static_cast<double>(slots[slot(dof)]);
  }
  /// `row` as slots of their own, zero where it says nothing.
  template <typename Scalar>
  [[nodiscard]] math::AlignedVector<Scalar> packed(const Eigen::Ref<const Eigen::RowVectorXd>& row) const {
    math::AlignedVector<Scalar> slots(static_cast<std::size_t>(num_slots()));
    pack(row, slots.data());
    return slots;
  }

 private:
  int num_dofs_, num_joints_, plane_;
};

}  // namespace strut::representation
