// SPDX-License-Identifier: MIT
#include <strut/core/error.h>
#include <strut/translate/signal_translator.h>

namespace strut::translate {

SignalTranslator::SignalTranslator(std::shared_ptr<const StyleModel> model) : model_(std::move(model)) {
  if (!model_) throw InvalidArgument("model", "a style model", "null");
  inputs_ = Eigen::VectorXd::Zero(model_->num_dofs() + model_->context().rows());
  if (model_->radial_map()) radial_.emplace(*model_);
  for (const StyleBlock& block : model_->blocks()) {
    const int states = block.system.num_states();
    blocks_.push_back({Eigen::VectorXd::Zero(states), Eigen::VectorXd::Zero(states),
                       Eigen::VectorXd::Zero(block.system.num_inputs()),
                       Eigen::VectorXd::Zero(block.system.num_outputs())});
  }
}

void SignalTranslator::step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output) {
  const auto& from = model_->input_scaling();
  const Eigen::Index dofs = model_->num_dofs();
  for (Eigen::Index dof = 0; dof < dofs; ++dof) {
    inputs_[dof] = from.is_kept(static_cast<int>(dof)) ? (input[dof] - from.mean()[dof]) / from.scale()[dof] : 0.0;
  }
  auto context = inputs_.tail(inputs_.size() - dofs);
  context.noalias() = model_->context().lazyProduct(inputs_.head(dofs));
  if (radial_) {
    radial_->step(input, context, output);
  } else {
    step_blocks(output);
  }
}

void SignalTranslator::step_blocks(Eigen::Ref<Eigen::RowVectorXd> output) {
  const auto& to = model_->output_scaling();
  output = to.mean().transpose();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const StyleBlock& block = model_->blocks()[b];
    BlockState& at = blocks_[b];
    for (std::size_t i = 0; i < block.input_dofs.size(); ++i) {
      at.input[static_cast<Eigen::Index>(i)] = inputs_[block.input_dofs[i]];
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
  if (radial_) radial_->reset();
}

}  // namespace strut::translate
