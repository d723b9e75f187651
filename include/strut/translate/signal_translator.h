// SPDX-License-Identifier: MIT
// The model step (Hsu et al. 2005, 4.4): rows of the input representation in, rows of the output representation out.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/model/style_model.h>

namespace strut::translate {

/// Runs a style model's linear systems frame by frame. Holds the states, which start at zero.
class SignalTranslator {
 public:
  /// Throws InvalidArgument if `model` is null.
  explicit SignalTranslator(std::shared_ptr<const StyleModel> model);

  /// One frame. `input` (num_dofs) in the input representation's units; `output` (num_dofs + 1) in the output
  /// representation's, the last element being the logarithm of the differential time warp. No allocation.
  void step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output);

  /// Back to the zero state.
  void reset();

  [[nodiscard]] const StyleModel& model() const noexcept { return *model_; }

 private:
  struct BlockState {
    Eigen::VectorXd state, scratch, input, output;
  };
  std::shared_ptr<const StyleModel> model_;
  std::vector<BlockState> blocks_;
};

}  // namespace strut::translate
