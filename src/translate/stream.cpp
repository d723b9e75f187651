// SPDX-License-Identifier: MIT
#include "translate/stream.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/motion/body_parts.h>
#include <strut/representation/extrapolation.h>

namespace strut::translate {
namespace {

using representation::RowLayout;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

void check_options(const TranslatorOptions& options) {
  const auto check = [](const char* name, double value, bool may_be_zero) {
    if (std::isfinite(value) && (value > 0.0 || (may_be_zero && value == 0.0))) return;
    throw InvalidArgument(name, may_be_zero ? "a number that is not negative" : "a positive number",
                          std::to_string(value));
  };
  check("confidence", options.generalization.confidence, false);
  check("preference", options.generalization.preference, false);
  check("fade", options.generalization.fade, true);
  check("glide", options.glide, true);
}

void check_models(const std::vector<std::shared_ptr<const StyleModel>>& models) {
  if (models.empty()) throw InvalidArgument("models", "at least one style model", "none");
  for (const auto& model : models) {
    if (!model) throw InvalidArgument("model", "a style model", "null");
    representation::check_skeleton(models.front()->input(), model->skeleton());
    if (model->frame_rate() == models.front()->frame_rate()) continue;
    throw InvalidArgument("models", "one frame rate",
                          std::to_string(models.front()->frame_rate()) + " and " + std::to_string(model->frame_rate()));
  }
}

/// The body part of every joint below the pelvis.
std::vector<int> parts_of_joints(const StyleModel& model) {
  const Motion standing(model.output().shared_skeleton(), 1.0, {representation::mean_pose(model.output())});
  const std::vector<motion::BodyPart> parts = motion::body_parts(standing);
  std::vector<int> below;
  for (const int joint : model.output().joints()) below.push_back(static_cast<int>(parts[at(joint)]));
  return below;
}

/// What is applied to each part of the body: its pose, its movement, the next part's pose, ...
std::array<double, 2 * motion::kNumBodyParts> strengths_of(const TranslatorControls& controls) {
  std::array<double, 2 * motion::kNumBodyParts> strengths{};
  for (std::size_t part = 0; part < controls.parts.size(); ++part) {
    const double all = controls.strength * controls.parts[part];
    strengths[2 * part] = std::min(kMostStrength, all * controls.pose);
    strengths[2 * part + 1] = std::min(kMostStrength, all * controls.movement);
  }
  return strengths;
}

// No body runs or turns so fast; where one seems to, it was put elsewhere [m/s, rad/s].
constexpr double kFastest = 25.0;
constexpr double kFastestTurn = 60.0;

template <typename Scalar>
bool is_jump(const Scalar* row) {
  using namespace representation;
  return std::hypot(row[kSidewaysVelocity], row[kForwardVelocity]) > static_cast<Scalar>(kFastest) ||
         std::abs(row[kTurningRate]) > static_cast<Scalar>(kFastestTurn);
}

/// The models' weights, made to sum to 1; `shares` has a number per model.
void set_shares(const TranslatorControls& controls, std::vector<double>& shares) {
  std::fill(shares.begin(), shares.end(), 1.0);
  std::copy(controls.weights.begin(), controls.weights.end(), shares.begin());
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
}

std::vector<double> shares_of(const TranslatorControls& controls, std::size_t num_models) {
  std::vector<double> shares(num_models);
  set_shares(controls, shares);
  return shares;
}

std::vector<double> list_of(const std::array<double, 2 * motion::kNumBodyParts>& numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace

template <typename Scalar>
Stream<Scalar>::Stream(std::vector<std::shared_ptr<const StyleModel>> given, const TranslatorOptions& wanted)
    : models_((check_models(given), std::move(given))),
      options_((check_options(wanted), check_controls(wanted.controls, static_cast<int>(models_.size())), wanted)),
      parts_(parts_of_joints(*models_.front())),
      strengths_(list_of(strengths_of(wanted.controls)), wanted.glide * models_.front()->frame_rate()),
      shares_(shares_of(wanted.controls, models_.size())),
      weights_(shares_, wanted.glide * models_.front()->frame_rate()),
      decoder_(models_.front()->output(), models_.front()->frame_rate()) {
  for (const auto& model : models_) branches_.emplace_back(model, options_.generalization.fade);
  if (options_.clean_feet) feet_.emplace(models_, options_.footskate);
  const int plane = branches_.front().step.layout().plane();
  mix_weights_.pose.resize(at(plane));
  mix_weights_.movement.resize(at(plane));
  rotations_.resize(at(4 * plane));
  pose_rotations_.resize(at(4 * models_.front()->skeleton().num_joints()));
  pose_translations_.resize(at(3 * models_.front()->skeleton().num_joints()));
  weigh_joints();
}

template <typename Scalar>
bool Stream<Scalar>::push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  if (!feet_) {
    translate(input, output);
    return true;
  }
  translate(input, converted());  // until the feet_ are held it is nobody's to see
  tell_feet();
  return feet_->push<Scalar>(converted(), output);
}

/// Which feet_ are planted, by the models' states; where input passes through, nobody can tell.
template <typename Scalar>
void Stream<Scalar>::tell_feet() {
  feet_->begin();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    branches_[b].step.state(feet_->state(b));
    feet_->vote(b, weight(b) * (1.0 - branches_[b].share.value().front()));
  }
}

template <typename Scalar>
void Stream<Scalar>::translate(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  encode(input);
  glide();
  for (Branch<Scalar>& branch : branches_) {
    branch.run(options_.generalization);
    if (!started_) branch.share.arrive();
    branch.share.advance();
    const auto style_share = static_cast<Scalar>(1.0 - branch.share.value().front());
    branch.mix.mix(branch.input.data(), branch.output.data(), mix_weights_, style_share);
  }
  started_ = true;
  if (branches_.size() == 1) {
    const auto& mix = branches_.front().mix;
    decoder_.decode(mix.root(), mix.rotations(), models_.front()->output().upright(), input, output);
    return;
  }
  blend();
  Eigen::Vector4d upright = Eigen::Vector4d::Zero();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const Eigen::Vector4d own = models_[b]->output().upright().coeffs();
    upright += (upright.dot(own) < 0.0 ? -weight(b) : weight(b)) * own;
  }
  decoder_.decode(root_.data(), rotations_.data(), Eigen::Quaterniond(upright).normalized(), input, output);
}

template <typename Scalar>
void Stream<Scalar>::encode(const PoseView<const Scalar>& input) {
  const representation::RootPlacement before = branches_.front().encoder.placement();
  for (Branch<Scalar>& branch : branches_) branch.encoder.encode(input, branch.input.data());
  if (!started_) {
    begin();
  } else if (is_jump(branches_.front().input.data())) {
    // The body was put elsewhere: what is translated goes with it, and moves on as it moved.
    decoder_.carry(before, branches_.front().encoder.placement());
    for (Branch<Scalar>& branch : branches_) branch.guess_velocities();
  }
  for (Branch<Scalar>& branch : branches_) branch.keep_velocities();
}

template <typename Scalar>
void Stream<Scalar>::begin() {
  representation::RootPlacement start = branches_.front().encoder.placement();
  const double heading = start.heading;
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    branches_[b].guess_velocities();
    start.heading += weight(b) * math::wrap_angle(branches_[b].encoder.placement().heading - heading);
  }
  decoder_.restart(start);
}

template <typename Scalar>
void Stream<Scalar>::glide() {
  if (!started_) {
    strengths_.arrive();
    weights_.arrive();
    weigh_joints();
  }
  weights_.advance();
  if (strengths_.advance()) weigh_joints();
}

template <typename Scalar>
void Stream<Scalar>::weigh_joints() {
  const std::vector<double>& now = strengths_.value();
  for (std::size_t joint = 0; joint < parts_.size(); ++joint) {
    mix_weights_.pose[joint] = static_cast<Scalar>(now[at(2 * parts_[joint])]);
    mix_weights_.movement[joint] = static_cast<Scalar>(now[at(2 * parts_[joint] + 1)]);
  }
  constexpr int kTrunk = static_cast<int>(motion::BodyPart::kTrunk);
  mix_weights_.root_pose = static_cast<Scalar>(now[at(2 * kTrunk)]);
  mix_weights_.root_movement = static_cast<Scalar>(now[at(2 * kTrunk + 1)]);
}

/// The weighted mean of what the models_ make of a frame; of quaternions those that are near each other.
template <typename Scalar>
void Stream<Scalar>::blend() {
  const int plane = static_cast<int>(rotations_.size()) / 4;
  root_.fill(Scalar(0));
  std::fill(rotations_.begin(), rotations_.end(), Scalar(0));
  const Scalar* first = branches_.front().mix.rotations();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const auto share = static_cast<Scalar>(weight(b));
    const Scalar* own = branches_[b].mix.rotations();
    for (std::size_t slot = 0; slot < root_.size(); ++slot) root_[slot] += share * branches_[b].mix.root()[slot];
    for (int joint = 0; joint < plane; ++joint) {
      Scalar cosine = Scalar(0);
      for (int i = 0; i < 4; ++i) cosine += first[i * plane + joint] * own[i * plane + joint];
      const Scalar signed_share = cosine < Scalar(0) ? -share : share;
      for (int i = 0; i < 4; ++i) rotations_[at(i * plane + joint)] += signed_share * own[i * plane + joint];
    }
  }
}

template <typename Scalar>
void Stream<Scalar>::warm_up(const Motion& opening, int frames) {
  for (Branch<Scalar>& branch : branches_) {
    const FrameMatrix rows = representation::encode(branch.step.model().input(), opening);
    const FrameMatrix before = representation::extrapolate_back(rows, frames);
    for (Eigen::Index t = 0; t < before.rows(); ++t) {
      branch.step.layout().pack(before.row(t), branch.input.data());
      branch.run(options_.generalization);
      if (t == 0) branch.share.arrive();
      branch.share.advance();
    }
    branch.step.layout().pack(rows.row(0), branch.input.data());
    branch.keep_velocities();
  }
}

template <typename Scalar>
void Stream<Scalar>::set_controls(const TranslatorControls& controls) {
  options_.controls = controls;
  strengths_.go_to(strengths_of(controls));
  set_shares(controls, shares_);
  weights_.go_to(shares_);
}

template <typename Scalar>
void Stream<Scalar>::reset() {
  for (Branch<Scalar>& branch : branches_) {
    branch.step.reset();
    branch.encoder.reset();
    branch.has_velocities = false;
  }
  if (feet_) feet_->reset();
  started_ = false;
}

template <typename Scalar>
double Stream<Scalar>::log_time_warp() const {
  double log_time_warp = 0.0;
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    log_time_warp += weight(b) * static_cast<double>(branches_[b].mix.root()[RowLayout::kTimeWarp]);
  }
  return log_time_warp;
}

template <typename Scalar>
double Stream<Scalar>::input_share() const {
  double share = 0.0;
  for (std::size_t b = 0; b < branches_.size(); ++b) share += weight(b) * branches_[b].share.value().front();
  return share;
}

template class Stream<float>;
template class Stream<double>;

}  // namespace strut::translate
