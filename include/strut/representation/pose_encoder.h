// SPDX-License-Identifier: MIT
// Poses to rows and back, a frame at a time (Hsu et al. 2005, 4.1): all joints at once, in float or double. The root is
// composed and integrated in double either way: a body walks far from the origin.
#pragma once

#include <vector>

#include <strut/math/aligned.h>
#include <strut/motion/pose_view.h>
#include <strut/representation/representation.h>
#include <strut/representation/row_layout.h>

namespace strut::representation {

/// Frame by frame from poses to rows (in slots of RowLayout). Holds what the previous frame leaves behind: place,
/// heading, and each rotation vector (to stay on the same branch). Copies have the same state.
template <typename Scalar>
class PoseEncoder {
 public:
  PoseEncoder(const Representation& representation, double frame_rate);

  /// Writes one row (layout().num_slots()). On the first frame the velocities are zero. `pose` must be of the
  /// representation's hierarchy, finite, its rotations of unit length within 1e-3. No allocation. Cost O(joints).
  void encode(const PoseView<const Scalar>& pose, Scalar* row);

  /// Where the latest frame stood.
  [[nodiscard]] const RootPlacement& placement() const noexcept { return placement_; }
  [[nodiscard]] const RowLayout& layout() const noexcept { return layout_; }
  /// Forgets every frame.
  void reset();
  /// Calls `visit(first, count)` for every array of plain numbers that frames leave behind, always in the same order.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    visit(&started_, 1);
    visit(&placement_, 1);
    visit(previous_.data(), previous_.size());
  }

 private:
  RowLayout layout_;
  int pelvis_;
  Eigen::Quaterniond upright_;
  double frame_time_;
  bool started_ = false;
  RootPlacement placement_;
  math::AlignedVector<Scalar> means_;     // planes x, y, z, w
  math::AlignedVector<Scalar> given_;     // the same, of a pose
  math::AlignedVector<Scalar> relative_;  // the same, of the rotations from the means
  math::AlignedVector<Scalar> previous_;  // planes x, y, z
};

/// Frame by frame from rows to poses: the inverse of PoseEncoder. Copies have the same state.
template <typename Scalar>
class PoseDecoder {
 public:
  /// The first frame stands at `start`; its velocities are ignored.
  PoseDecoder(const Representation& representation, double frame_rate, const RootPlacement& start = {});

  /// Writes one pose from a row, with the bones (translations) of `bones`. No allocation. Cost O(joints).
  void decode(const Scalar* row, const PoseView<const Scalar>& bones, const PoseView<Scalar>& pose);

  /// The same from the row's first slots `root` and rotations that are joined already: planes x, y, z, w of the joints
  /// below the pelvis in their parents' frames, of any length but zero. `upright` as in relative_root.h.
  void decode(const Scalar* root, const Scalar* rotations, const Eigen::Quaterniond& upright,
              const PoseView<const Scalar>& bones, const PoseView<Scalar>& pose);

  /// Stands at `start` again.
  void restart(const RootPlacement& start);
  /// Is carried along with something that was put from `from` to `to`.
  void carry(const RootPlacement& from, const RootPlacement& to);
  /// As PoseEncoder::visit_state.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    visit(&started_, 1);
    visit(&placement_, 1);
  }

 private:
  void place_chain(const RootTransform& root, const PoseView<Scalar>& pose) const;

  RowLayout layout_;
  int pelvis_, travel_joint_;
  Eigen::Quaterniond upright_;
  double frame_time_;
  bool started_ = false;
  RootPlacement placement_;
  std::vector<Eigen::Vector3d> chain_offsets_;                // of the joints down to the pelvis [m]
  Eigen::Vector3d standing_offset_;                           // of all of them but the one that travels [m]
  math::AlignedVector<Scalar> means_, movement_, rotations_;  // planes x, y, z, w
};

}  // namespace strut::representation
