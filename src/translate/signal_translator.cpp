// SPDX-License-Identifier: MIT
#include <strut/core/error.h>
#include <strut/translate/signal_translator.h>

namespace strut::translate {

SignalTranslator::SignalTranslator(std::shared_ptr<const StyleModel> model) : model_(std::move(model)) {
  if (!model_) throw InvalidArgument("model", "a style model", "null");
  for (const StyleBlock& block : model_->blocks()) {
    const int states = block.system.num_states();
    blocks_.push_back({Eigen::VectorXd::Zero(states), Eigen::VectorXd::Zero(states),
                       Eigen::VectorXd::Zero(block.system.num_inputs()),
                       Eigen::VectorXd::Zero(block.system.num_outputs())});
  }
}

void SignalTranslator::step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output) {
  const auto& from = model_->input_scaling();
  const auto& to = model_->output_scaling();
  output = to.mean().transpose();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const StyleBlock& block = model_->blocks()[b];
    BlockState& at = blocks_[b];
    for (std::size_t i = 0; i < block.input_dofs.size(); ++i) {
      const int dof = block.input_dofs[i];
      at.input[static_cast<Eigen::Index>(i)] =
          from.is_kept(dof) ? (input[dof] - from.mean()[dof]) / from.scale()[dof] : 0.0;
    }
    block.system.step(at.state, at.input, at.output, at.scratch);
    for (std::size_t i = 0; i < block.output_dofs.size(); ++i) {
      const int dof = block.output_dofs[i];
      output[dof] += to.scale()[dof] * at.output[static_cast<Eigen::Index>(i)];
    }
  }
}

void SignalTranslator::reset() {
  for (BlockState& block : blocks_) block.state.setZero();
}

}  // namespace strut::translate
