// SPDX-License-Identifier: MIT
// Which blend of two fragments shows the Effort that is wanted (Torresani, Hackney, Bregler 2006, Eq. 2). Taken alone,
// the smallest predicted error is where predictions err most; so the best candidates are synthesized, scored again by
// their own kinematics, and then chosen from.
#pragma once

#include <memory>
#include <vector>

#include <strut/effort/effort.h>
#include <strut/effort/effort_model.h>
#include <strut/effort/space_time_blend.h>

namespace strut::effort {

/// How a blend is chosen.
struct ChoiceOptions {
  double least_alpha = -0.5;    ///< how far the first fragment may be exaggerated, in [-2, 0]
  double greatest_alpha = 1.5;  ///< how far the second may be, in [1, 3]
  int num_candidates = 20;      ///< that are synthesized and scored again; 1: Eq. 2 alone, 1 ... 200
  double beyond_weight = 0.05;  ///< what exaggeration counts: this times the squared distance of alpha from [0, 1] is
                                ///< added to the squared error, so that of blends that do the milder is taken, >= 0
  EffortVector weights = EffortVector::Ones();  ///< what an error in each factor counts, >= 0, not all 0
};

/// What viewers notice: Time first, Weight hardly.
inline EffortVector noticed_weights() {
  return {0.8, 0.15, 1.0};
}

/// A blend and what is known of its Effort.
struct ChosenBlend {
  int first = 0, second = 0;  ///< fragments of the model; the same: that fragment as it is
  double alpha = 0.0;         ///< of SpaceTimeBlend::at
  EffortVector predicted =
      EffortVector::Constant(kNotRated);  ///< by the regression, Eq. 1; kNotRated in a factor that was not labelled
  EffortVector deviation = EffortVector::Constant(kNotRated);  ///< of that, kNotRated where the method gives none
  EffortVector estimated = EffortVector::Constant(
      kNotRated);  ///< of the synthesized blend, by how it moves; kNotRated if it was not synthesized
  EffortVector expected = EffortVector::Constant(kNotRated);  ///< both together, weighted by their variances
  double error = 0.0;  ///< weighted distance of `expected` from what was wanted, exaggeration counted
};

/// Chooses, and keeps alignments of pairs it has blended before. Const calls are thread-safe; what is chosen does not
/// depend on what was asked before.
class BlendChooser {
 public:
  /// Throws InvalidArgument if the model is null.
  explicit BlendChooser(std::shared_ptr<const EffortModel> model);
  ~BlendChooser();
  BlendChooser(BlendChooser&&) noexcept;
  BlendChooser& operator=(BlendChooser&&) noexcept;

  [[nodiscard]] const EffortModel& model() const noexcept;

  /// The blend of a group's accepted pairs (or single fragment) nearest to `wanted`; its kNotRated factors do not
  /// count. Pairs that cannot be blended are passed over. Throws InvalidArgument if there is no such group, a number or
  /// option is out of range, nothing is wanted, or no fragment of the group is labelled in all factors that are. Cost:
  /// predictions of all pairs, and candidates alignments the first time (some ms each), on several threads.
  [[nodiscard]] ChosenBlend choose(int group, const EffortVector& wanted, const ChoiceOptions& options = {}) const;

  /// What choose looks at: the candidates that can be blended, the nearest first. Throws as choose.
  [[nodiscard]] std::vector<ChosenBlend> candidates(int group, const EffortVector& wanted,
                                                    const ChoiceOptions& options = {}) const;

  /// The single fragment whose own label is nearest: the baseline. Throws as choose.
  [[nodiscard]] ChosenBlend choose_fragment(int group, const EffortVector& wanted,
                                            const EffortVector& weights = EffortVector::Ones()) const;

  /// The motion of a chosen blend, on the model's skeleton and at its rate.
  [[nodiscard]] Blend synthesize(const ChosenBlend& chosen) const;

  /// What `motion`, of the content of `group`, shows by how it moves; the deviation is of the labels from that. Throws
  /// InvalidArgument if there is no such group, and as describe.
  [[nodiscard]] EffortPrediction estimate(const Motion& motion, int group) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace strut::effort
