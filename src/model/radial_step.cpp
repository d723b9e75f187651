// SPDX-License-Identifier: MIT
#include "math/vector_kernels.h"

#include <algorithm>
#include <cmath>

#include <strut/math/low_pass.h>
#include <strut/math/rotation_arrays.h>
#include <strut/model/radial_step.h>

namespace strut {
namespace {

using math::kLanes;
using representation::RowLayout;

// A detail of so many deviations of the examples' is taken for half the performer's own.
constexpr double kUnusual = 3.0;
// What lies farther out, in deviations, is as far: squares stay finite and are forgotten in time, whatever comes.
constexpr double kFarthestContext = 1e6;
constexpr double kLargestDetail = 1e3;
// How long a detail must last to stand out, and where slow detail ends and fast detail begins [s].
constexpr double kLevelTime = 0.5;
constexpr double kSlowTime = 0.1;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

template <typename Scalar>
RadialStep<Scalar>::RadialStep(const PackedModel<Scalar>& model, double frame_rate)
    : model_(&model),
      map_(&*model.radial_map),
      level_gain_(static_cast<Scalar>(math::low_pass_gain(kLevelTime * frame_rate))),
      slow_gain_(static_cast<Scalar>(math::low_pass_gain(kSlowTime * frame_rate))),
      num_contexts_(map_->now.num_cols()),
      num_frames_(map_->lags.back() + 1) {
  const int slots = model.layout.num_slots();
  const int parts = kLanes + model.layout.plane();
  history_.resize(at(num_frames_ * num_contexts_));
  features_.resize(at(num_contexts_) * map_->lags.size());
  activations_.resize(at(map_->now.num_rows()));
  styles_.resize(at(map_->styles.num_rows()));
  taken_.resize(at(model.context.num_rows()));
  turned_.resize(at(3 * model.layout.plane()));
  for (Array* array : {&smoothed_, &smoothed_twice_, &details_, &slow_details_, &standing_out_})
    array->resize(at(slots));
  for (Array* array : {&energy_, &unusual_, &sorted_}) array->resize(at(parts));
}

template <typename Scalar>
void RadialStep<Scalar>::step(const Scalar* input, const Scalar* context, Scalar* output) {
  see(context);
  look_up();
  measure_details(input);
  compare_details();
  measure_what_stands_out();
  filter();
  started_ = true;
  for (int slot = 0; slot < model_->layout.num_slots(); ++slot) {
    output[slot] = model_->output_mean[at(slot)] + model_->output_scale[at(slot)] * smoothed_twice_[at(slot)];
  }
  add_details(output);
}

/// The features of this frame: its context, without what stood out a frame ago, and the older ones. The first frame has
/// lasted forever, and nothing stood out in it.
template <typename Scalar>
void RadialStep<Scalar>::see(const Scalar* context) {
  constexpr auto kFarthest = static_cast<Scalar>(kFarthestContext);
  newest_ = (newest_ + 1) % num_frames_;
  if (!started_) std::fill(taken_.begin(), taken_.end(), Scalar(0));
  for (int i = 0; i < num_contexts_; ++i) {
    const Scalar seen = std::clamp(context[i], -kFarthest, kFarthest) - taken_[at(i)];
    features_[at(i)] = std::clamp(seen, -kFarthest, kFarthest);
  }
  const int frames_like_it = started_ ? 1 : num_frames_;
  for (int age = 0; age < frames_like_it; ++age) {
    std::copy_n(features_.begin(), num_contexts_, context_of(age));
  }
  for (std::size_t lag = 1; lag < map_->lags.size(); ++lag) {
    std::copy_n(context_of(map_->lags[lag]), num_contexts_,
                features_.begin() + static_cast<std::ptrdiff_t>(lag) * num_contexts_);
  }
}

template <typename Scalar>
void RadialStep<Scalar>::look_up() {
  const auto& kernels = math::vector_kernels<Scalar>();
  const int centres = map_->now.num_rows();
  const bool sees_older = map_->lags.size() > 1;
  if (sees_older) map_->before.squared_distances(features_.data() + num_contexts_, false, activations_.data());
  map_->now.squared_distances(features_.data(), sees_older, activations_.data());
  // Relative to the nearest: far from all centres every exponential would be zero.
  const Scalar nearest = kernels.smallest(centres, activations_.data());
  const Scalar scale = Scalar(0.5) / (map_->squared_width + map_->widening * nearest);
  const Scalar sum = kernels.exponentials(centres, nearest, scale, activations_.data());
  map_->styles.multiply(activations_.data(), styles_.data());
  for (Scalar& style : styles_) style /= sum;
}

template <typename Scalar>
void RadialStep<Scalar>::measure_details(const Scalar* input) {
  constexpr auto kLargest = static_cast<Scalar>(kLargestDetail * kLargestDetail);
  const RowLayout& layout = model_->layout;
  Scalar* squares = standing_out_.data();  // not in use before compare_details
  for (int slot = 0; slot < layout.num_slots(); ++slot) {
    const Scalar style = model_->input_mean[at(slot)] + model_->input_scale[at(slot)] * styles_[at(slot)];
    details_[at(slot)] = input[slot] - style;
    const Scalar deviations = details_[at(slot)] * map_->inverse_spread[at(slot)];
    squares[slot] = deviations * deviations;
  }
  using namespace representation;
  sorted_[0] = (squares[kSidewaysVelocity] + squares[kForwardVelocity] + squares[kTurningRate]) / Scalar(3);
  sorted_[1] = squares[kHeight];
  sorted_[2] = (squares[kTiltX] + squares[kTiltZ]) / Scalar(2);
  const Scalar* joints = squares + RowLayout::kRotations;
  for (int joint = 0; joint < layout.plane(); ++joint) {
    sorted_[at(kLanes + joint)] =
        (joints[joint] + joints[joint + layout.plane()] + joints[joint + 2 * layout.plane()]) / Scalar(3);
  }
  for (std::size_t part = 0; part < energy_.size(); ++part) {
    const Scalar energy = std::min(sorted_[part], kLargest);
    energy_[part] = started_ ? energy_[part] + level_gain_ * (energy - energy_[part]) : energy;
  }
}

/// A body that is unlike the examples as a whole, as another performer's is, has no part that stands out.
template <typename Scalar>
void RadialStep<Scalar>::compare_details() {
  const auto joints = energy_.begin() + kLanes;
  const auto last = std::copy(joints, joints + model_->layout.num_joints(),
                              std::copy_n(energy_.begin(), kRootDetailParts, sorted_.begin()));
  const auto middle = sorted_.begin() + (last - sorted_.begin()) / 2;
  std::nth_element(sorted_.begin(), middle, last);
  const Scalar half = static_cast<Scalar>(kUnusual * kUnusual) * std::max(Scalar(1), *middle);
  for (std::size_t part = 0; part < unusual_.size(); ++part) {
    // From 0, what every example has, to 1, what none has.
    const Scalar square = energy_[part] / half;
    unusual_[part] = square * square / (Scalar(1) + square * square);
  }
}

template <typename Scalar>
void RadialStep<Scalar>::measure_what_stands_out() {
  const RowLayout& layout = model_->layout;
  const auto take = [this](int slot, Scalar unusual) {
    standing_out_[at(slot)] = unusual * details_[at(slot)] * model_->input_inverse[at(slot)];
  };
  for (int slot = 0; slot < RowLayout::kRotations; ++slot) take(slot, unusual_[at(root_detail_part(slot))]);
  for (int plane = 0; plane < 3; ++plane) {
    for (int joint = 0; joint < layout.plane(); ++joint) {
      take(RowLayout::kRotations + plane * layout.plane() + joint, unusual_[at(kLanes + joint)]);
    }
  }
  model_->context.multiply(standing_out_.data(), taken_.data());
}

template <typename Scalar>
void RadialStep<Scalar>::filter() {
  const int slots = model_->layout.num_slots();
  const Scalar* style = styles_.data() + slots;
  if (!started_) {
    std::copy(style, style + slots, smoothed_.begin());
    smoothed_twice_ = smoothed_;
    slow_details_ = details_;
  }
  for (std::size_t slot = 0; slot < smoothed_.size(); ++slot) {
    smoothed_[slot] += map_->smoothing_gain * (style[slot] - smoothed_[slot]);
    smoothed_twice_[slot] += map_->smoothing_gain * (smoothed_[slot] - smoothed_twice_[slot]);
    slow_details_[slot] += slow_gain_ * (details_[slot] - slow_details_[slot]);
  }
}

template <typename Scalar>
void RadialStep<Scalar>::add_details(Scalar* output) {
  const auto kept_of = [this](int slot, int part) {
    const Scalar share = map_->share[at(part)];
    const Scalar kept = share + (Scalar(1) - share) * unusual_[at(part)];
    const Scalar fast = (Scalar(1) - kept) * map_->fast;
    return kept * details_[at(slot)] + fast * (details_[at(slot)] - slow_details_[at(slot)]);
  };
  // Velocities are no posture that a performer could have of his own: the way goes where the style takes it.
  for (int slot = 0; slot < representation::kHeight; ++slot) output[slot] += map_->share[0] * details_[at(slot)];
  for (int slot = representation::kHeight; slot < representation::kNumRootDofs; ++slot) {
    output[slot] += kept_of(slot, root_detail_part(slot));
  }
  const int plane = model_->layout.plane();
  Scalar* kept = standing_out_.data() + RowLayout::kRotations;
  for (int i = 0; i < 3; ++i) {
    for (int joint = 0; joint < plane; ++joint) {
      kept[i * plane + joint] = kept_of(RowLayout::kRotations + i * plane + joint, kLanes + joint);
    }
  }
  math::turn_vectors(plane, plane, map_->turns.data(), kept, turned_.data());
  for (int i = 0; i < 3 * plane; ++i) output[RowLayout::kRotations + i] += turned_[at(i)];
}

template class RadialStep<float>;
template class RadialStep<double>;

}  // namespace strut
