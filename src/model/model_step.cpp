// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/model/model_step.h>

namespace strut {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::shared_ptr<const StyleModel> not_null(std::shared_ptr<const StyleModel> model) {
  if (!model) throw InvalidArgument("model", "a style model", "null");
  return model;
}

}  // namespace

template <typename Scalar>
ModelStep<Scalar>::ModelStep(std::shared_ptr<const StyleModel> model)
    : model_(not_null(std::move(model))), packed_(&model_->packed<Scalar>()) {
  const int slots = layout().num_slots();
  inputs_.resize(at(slots + packed_->context.num_rows()));
  state_.resize(at(packed_->blocks.state_size()));
  scratch_.resize(at(packed_->blocks.scratch_size()));
  row_input_.resize(at(slots));
  row_output_.resize(at(slots));
  if (packed_->radial_map) radial_.emplace(*packed_, model_->frame_rate());
}

template <typename Scalar>
void ModelStep<Scalar>::step(const Scalar* input, Scalar* output) {
  const int slots = layout().num_slots();
  deviations_.fill(Scalar(0));
  for (int tile = 0; tile < slots; tile += math::kLanes) {
    for (int lane = 0; lane < math::kLanes; ++lane) {
      const auto slot = at(tile + lane);
      const Scalar centred = input[slot] - packed_->input_mean[slot];
      inputs_[slot] = centred * packed_->input_inverse[slot];
      deviations_[at(lane)] = std::max(deviations_[at(lane)], std::abs(centred) * packed_->familiar_inverse[slot]);
    }
  }
  Scalar* contexts = inputs_.data() + slots;
  packed_->context.multiply(inputs_.data(), contexts);
  if (radial_) {
    radial_->step(input, contexts, output);
    return;
  }
  std::fill_n(output, slots, Scalar(0));
  packed_->blocks.step(inputs_.data(), state_.data(), scratch_.data(), output);
  for (int slot = 0; slot < slots; ++slot) {
    output[slot] = packed_->output_mean[at(slot)] + packed_->output_scale[at(slot)] * output[slot];
  }
}

template <typename Scalar>
void ModelStep<Scalar>::step(const Eigen::Ref<const Eigen::RowVectorXd>& input, Eigen::Ref<Eigen::RowVectorXd> output) {
  layout().pack(input, row_input_.data());
  step(row_input_.data(), row_output_.data());
  layout().unpack(row_output_.data(), output);
}

template <typename Scalar>
void ModelStep<Scalar>::state(Eigen::Ref<Eigen::VectorXd> state) const {
  if (radial_) {
    for (int i = 0; i < radial_->num_features(); ++i) state[i] = static_cast<double>(radial_->features()[i]);
    return;
  }
  for (std::size_t i = 0; i < packed_->state_places.size(); ++i) {
    state[static_cast<Eigen::Index>(i)] = static_cast<double>(state_[at(packed_->state_places[i])]);
  }
}

template <typename Scalar>
void ModelStep<Scalar>::reset() {
  std::fill(state_.begin(), state_.end(), Scalar(0));
  deviations_.fill(Scalar(0));
  if (radial_) radial_->reset();
}

template <typename Scalar>
Scalar ModelStep<Scalar>::largest_deviation() const {
  return *std::max_element(deviations_.begin(), deviations_.end());
}

template class ModelStep<float>;
template class ModelStep<double>;

}  // namespace strut
