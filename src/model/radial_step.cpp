// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/model/radial_step.h>

namespace strut {
namespace {

// Activations below this add nothing that could be seen.
constexpr double kOutOfReach = 1e-6;
// A detail of so many deviations of the examples' is taken for half the performer's own.
constexpr double kUnusual = 3.0;
// What lies farther out, in deviations, is as far: squares stay finite and are forgotten in time, whatever comes.
constexpr double kFarthestContext = 1e6;
constexpr double kLargestDetail = 1e3;
// How long a detail must last to stand out, and where slow detail ends and fast detail begins [s].
constexpr double kLevelTime = 0.5;
constexpr double kSlowTime = 0.1;

/// Gain of a one-pole low-pass filter with a time constant of `frames`.
double filter_gain(double frames) {
  return frames > 0.0 ? 1.0 - std::exp(-1.0 / frames) : 1.0;
}

/// From 0, what every example has, to 1, what none has.
double unusualness(double deviations) {
  const double square = (deviations / kUnusual) * (deviations / kUnusual);
  return square * square / (1.0 + square * square);
}

}  // namespace

RadialStep::RadialStep(const StyleModel& model)
    : model_(&model),
      parts_(detail_parts(model.input(), model.output())),
      smoothing_gain_(filter_gain(model.radial_map()->smoothing)),
      level_gain_(filter_gain(kLevelTime * model.frame_rate())),
      slow_gain_(filter_gain(kSlowTime * model.frame_rate())) {
  const RadialMap& map = *model.radial_map();
  const auto parts = static_cast<Eigen::Index>(parts_.size());
  history_ = Eigen::MatrixXd::Zero(model.context().rows(), map.lags.back() + 1);
  context_ = Eigen::VectorXd::Zero(model.context().rows());
  features_ = Eigen::VectorXd::Zero(map.basis.num_features());
  activations_ = Eigen::VectorXd::Zero(map.basis.num_centres());
  input_style_ = Eigen::VectorXd::Zero(map.input.rows());
  output_style_ = smoothed_ = smoothed_twice_ = Eigen::VectorXd::Zero(map.output.rows());
  details_ = slow_details_ = Eigen::Matrix3Xd::Zero(3, parts);
  energy_ = next_energy_ = unusual_ = sorted_ = Eigen::VectorXd::Zero(parts);
}

void RadialStep::step(const Eigen::Ref<const Eigen::RowVectorXd>& input,
                      const Eigen::Ref<const Eigen::VectorXd>& context, Eigen::Ref<Eigen::RowVectorXd> output) {
  newest_ = (newest_ + 1) % history_.cols();
  context_ = context;
  look_up(context_);
  measure_details(input);
  compare_details();
  take_details_out();
  look_up(context_);
  measure_details(input);
  compare_details();
  filter();
  started_ = true;
  const auto& to = model_->output_scaling();
  output = (to.mean().array() + to.scale().array() * smoothed_twice_.array()).matrix().transpose();
  add_details(output);
}

void RadialStep::look_up(const Eigen::VectorXd& context) {
  const RadialMap& map = *model_->radial_map();
  history_.col(newest_) = context.cwiseMax(-kFarthestContext).cwiseMin(kFarthestContext);
  for (Eigen::Index t = 0; !started_ && t < history_.cols(); ++t) history_.col(t) = history_.col(newest_);
  for (std::size_t l = 0; l < map.lags.size(); ++l) {
    const Eigen::Index frame = (newest_ + history_.cols() - map.lags[l]) % history_.cols();
    features_.segment(static_cast<Eigen::Index>(l) * context.size(), context.size()) = history_.col(frame);
  }
  map.basis.activate(features_, activations_);
  input_style_.setZero();
  output_style_.setZero();
  for (Eigen::Index m = 0; m < activations_.size(); ++m) {
    if (activations_[m] < kOutOfReach) continue;
    input_style_ += activations_[m] * map.input.col(m);
    output_style_ += activations_[m] * map.output.col(m);
  }
}

void RadialStep::measure_details(const Eigen::Ref<const Eigen::RowVectorXd>& input) {
  const RadialMap& map = *model_->radial_map();
  const auto& from = model_->input_scaling();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    double squares = 0.0;
    for (Eigen::Index i = 0; i < parts_[p].size; ++i) {
      const Eigen::Index dof = parts_[p].first + i;
      details_(i, column) = input[dof] - from.mean()[dof] - from.scale()[dof] * input_style_[dof];
      squares += details_(i, column) * details_(i, column) / (map.spread[dof] * map.spread[dof]);
    }
    const double energy = std::min(squares / static_cast<double>(parts_[p].size), kLargestDetail * kLargestDetail);
    next_energy_[column] = started_ ? energy_[column] + level_gain_ * (energy - energy_[column]) : energy;
  }
}

/// A body that is unlike the examples as a whole, as another performer's is, has no part that stands out.
void RadialStep::compare_details() {
  sorted_ = next_energy_;
  const auto middle = sorted_.data() + sorted_.size() / 2;
  std::nth_element(sorted_.data(), middle, sorted_.data() + sorted_.size());
  const double ordinary = std::max(1.0, *middle);
  for (Eigen::Index p = 0; p < unusual_.size(); ++p) unusual_[p] = unusualness(std::sqrt(next_energy_[p] / ordinary));
}

void RadialStep::take_details_out() {
  const auto& scale = model_->input_scaling().scale();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    for (Eigen::Index i = 0; i < parts_[p].size; ++i) {
      const Eigen::Index dof = parts_[p].first + i;
      if (scale[dof] > 0.0)
        context_ -= (unusual_[column] * details_(i, column) / scale[dof]) * model_->context().col(dof);
    }
  }
}

void RadialStep::filter() {
  energy_ = next_energy_;
  if (!started_) {
    smoothed_ = smoothed_twice_ = output_style_;
    slow_details_ = details_;
  }
  smoothed_ += smoothing_gain_ * (output_style_ - smoothed_);
  smoothed_twice_ += smoothing_gain_ * (smoothed_ - smoothed_twice_);
  slow_details_ += slow_gain_ * (details_ - slow_details_);
}

void RadialStep::add_details(Eigen::Ref<Eigen::RowVectorXd> output) {
  const RadialMap& map = *model_->radial_map();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const DetailPart& part = parts_[p];
    const auto column = static_cast<Eigen::Index>(p);
    const double share = map.share[part.first];
    // Velocities are no posture that a performer could have of his own: the way goes where the style takes it.
    const double kept = part.is_velocity ? share : share + (1.0 - share) * unusual_[column];
    const double fast = part.is_velocity ? 0.0 : (1.0 - kept) * map.fast;
    const Eigen::Vector3d turned =
        part.turn * (kept * details_.col(column) + fast * (details_.col(column) - slow_details_.col(column)));
    for (Eigen::Index i = 0; i < part.size; ++i) output[part.first + i] += turned[i];
  }
}

}  // namespace strut
