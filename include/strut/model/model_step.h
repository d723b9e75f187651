// SPDX-License-Identifier: MIT
// The model step (Hsu et al. 2005, 4.4): rows of the input representation in, rows of the output representation out.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include <strut/model/radial_step.h>
#include <strut/model/style_model.h>

namespace strut {

/// Runs a style model, its linear systems or its radial map, frame by frame, in Scalar (float or double). Holds the
/// states, which start at rest; copies have the same states and share the model.
template <typename Scalar>
class ModelStep {
 public:
  /// Throws InvalidArgument if `model` is null.
  explicit ModelStep(std::shared_ptr<const StyleModel> model);

  /// One frame. `input` and `output`: slots of layout(), in the representations' units; the output's slot
  /// RowLayout::kTimeWarp is the log of the differential time warp. What `input` has there must be zero. No allocation.
  void step(const Scalar* input, Scalar* output);

  /// The same for rows: `input` (num_dofs), `output` (num_dofs + 1). For whole clips; it copies.
  void step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output);

  /// The model's state after the latest step, of which StyleModel::footplants() tells footplants: `state`
  /// (StyleModel::state_size) is overwritten. Zero before the first. No allocation.
  void state(Eigen::Ref<Eigen::VectorXd> state) const;

  /// Back to rest.
  void reset();

  /// As RadialStep::visit_state.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    visit(state_.data(), state_.size());
    if (radial_) radial_->visit_state(visit);
  }

  /// How far the latest input lies from the examples (Hsu et al. 2005, Eq. 7): the largest distance of a degree of
  /// freedom from their mean, in their deviations or, where those are smaller, in a performer's own
  /// (representation::performer_deviation). Zero before the first step.
  [[nodiscard]] Scalar largest_deviation() const;

  [[nodiscard]] const StyleModel& model() const noexcept { return *model_; }
  [[nodiscard]] const representation::RowLayout& layout() const noexcept { return packed_->layout; }

 private:
  std::shared_ptr<const StyleModel> model_;
  const PackedModel<Scalar>* packed_;
  std::optional<RadialStep<Scalar>> radial_;
  std::array<Scalar, math::kLanes> deviations_{};       // of the latest input, the largest of every lane
  math::AlignedVector<Scalar> inputs_;                  // normalized slots, then the contexts
  math::AlignedVector<Scalar> state_, scratch_;         // of the linear systems
  math::AlignedVector<Scalar> row_input_, row_output_;  // slots of the rows given as rows
};

}  // namespace strut
