// SPDX-License-Identifier: MIT
// From a row of the input and a row of the output style to joint rotations between them, or beyond.
#pragma once

#include <array>

#include <strut/math/aligned.h>
#include <strut/model/style_model.h>

namespace strut::translate {

/// How much of the difference between input and output is applied, per joint below the pelvis (filled up to lanes) and
/// to the root: of the styles' mean postures (pose) and of the movement about them.
template <typename Scalar>
struct MixWeights {
  math::AlignedVector<Scalar> pose, movement;
  Scalar root_pose = Scalar(1), root_movement = Scalar(1);
};

/// Mixes rows of one model. In the parent's frame a joint's rotation is exp(V) M, M the style's mean orientation and V
/// the movement about it. The mix is exp(V_in + m (V_out - V_in)) exp(a log(M_out M_in^-1)) M_in: the input at a = m =
/// 0, the output at 1, and monotone in both.
template <typename Scalar>
class StyleMix {
 public:
  explicit StyleMix(const StyleModel& model);

  /// `input`, `output`: slots of the two representations. `share` (0 to 1) of the weights is applied. Writes the root's
  /// slots (kRotations numbers, the log time warp among them) and rotations() in the parents' frames. No allocation.
  void mix(const Scalar* input, const Scalar* output, const MixWeights<Scalar>& weights, Scalar share);

  [[nodiscard]] const Scalar* root() const noexcept { return root_.data(); }
  /// Planes x, y, z, w of the joints below the pelvis; of unit length up to rounding.
  [[nodiscard]] const Scalar* rotations() const noexcept { return rotations_.data(); }

 private:
  using Array = math::AlignedVector<Scalar>;
  static constexpr int kRoot = representation::RowLayout::kRotations;

  int plane_;
  Array input_turns_, output_turns_;    // 9 planes: rotation matrices of the means
  Array mean_step_;                     // 3 planes: log(M_out M_in^-1)
  Array input_means_;                   // 4 planes
  std::array<Scalar, kRoot> static_{};  // of the root: the part of output - input that is posture
  std::array<Scalar, kRoot> root_{};
  Array from_, to_;                 // 3 planes
  Array step_, means_, rotations_;  // 4 planes
};

}  // namespace strut::translate
