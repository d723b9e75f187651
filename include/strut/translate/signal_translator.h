// SPDX-License-Identifier: MIT
// The model step (Hsu et al. 2005, 4.4): rows of the input representation in, rows of the output representation out.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/model/radial_step.h>
#include <strut/model/style_model.h>

namespace strut::translate {

/// Runs a style model, its linear systems or its radial map, frame by frame. Holds the states, which start at rest.
class SignalTranslator {
 public:
  /// Throws InvalidArgument if `model` is null.
  explicit SignalTranslator(std::shared_ptr<const StyleModel> model);

  /// One frame. `input` (num_dofs) in the input representation's units; `output` (num_dofs + 1) in the output
  /// representation's, the last element being the logarithm of the differential time warp. No allocation.
  void step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output);

  /// Back to rest.
  void reset();

  [[nodiscard]] const StyleModel& model() const noexcept { return *model_; }

 private:
  struct BlockState {
    Eigen::VectorXd state, scratch, input, output;
  };
  std::shared_ptr<const StyleModel> model_;
  void step_blocks(Eigen::Ref<Eigen::RowVectorXd> output);

  std::vector<BlockState> blocks_;
  std::optional<RadialStep> radial_;
  Eigen::VectorXd inputs_;  // normalized; the contexts last
};

}  // namespace strut::translate
