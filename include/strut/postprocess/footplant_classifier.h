// SPDX-License-Identifier: MIT
// Tells from the state of a style model whether a foot is planted (Hsu et al. 2005, 4.5, Annotation): a projection and
// a boundary per foot, learnt from states whose footplants are known. Needs this frame alone: no lag, no look-ahead.
// That the two feet are independent is the paper's naive assumption.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/postprocess/discriminant_analysis.h>

namespace strut::postprocess {

/// How one foot is judged.
struct FootplantBoundary {
  Eigen::VectorXd projection;    ///< (states)
  double boundary = 0.0;         ///< on the projected states
  bool is_planted_above = true;  ///< whether more than the boundary is planted, or less
};

/// Both feet. Immutable.
class FootplantClassifier {
 public:
  /// 0 left, 1 right. Throws InvalidArgument if the projections differ in size or a number is not finite.
  explicit FootplantClassifier(std::array<FootplantBoundary, 2> feet);

  [[nodiscard]] int num_states() const noexcept { return static_cast<int>(feet_[0].projection.size()); }
  [[nodiscard]] const FootplantBoundary& foot(int foot) const { return feet_[static_cast<std::size_t>(foot)]; }

  /// Whether `foot` (0 left, 1 right) is planted in `state` (num_states): a dot product and a comparison. No
  /// allocation; sizes are the caller's duty (asserted in debug builds).
  [[nodiscard]] bool is_planted(int foot, const Eigen::Ref<const Eigen::VectorXd>& state) const {
    const FootplantBoundary& at = feet_[static_cast<std::size_t>(foot)];
    return (at.projection.dot(state) > at.boundary) == at.is_planted_above;
  }

 private:
  std::array<FootplantBoundary, 2> feet_;
};

/// States whose footplants are known: of a clip, or a part of one.
struct LabelledStates {
  FrameMatrix states;                        ///< (frames x states)
  std::array<std::vector<bool>, 2> planted;  ///< per foot (frames)
};

/// Learns both feet's boundaries; priors are the shares of the examples. A foot that is planted throughout, or never,
/// is judged to be so always. Throws InvalidArgument if there is no frame, or sizes or numbers are not as said above.
/// Cost frames x states^2 + states^3.
FootplantClassifier train_footplant_classifier(const std::vector<LabelledStates>& clips,
                                               const DiscriminantOptions& options = {});

/// The share of frames of both feet that `classifier` judges as they are labelled; 1 if there are none.
double agreement(const FootplantClassifier& classifier, const std::vector<LabelledStates>& clips);

}  // namespace strut::postprocess
