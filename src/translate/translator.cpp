// SPDX-License-Identifier: MIT
#include "translate/check_pose.h"
#include "translate/feet.h"
#include "translate/glide.h"
#include "translate/style_mix.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/model/model_step.h>
#include <strut/representation/extrapolation.h>
#include <strut/representation/pose_encoder.h>
#include <strut/representation/retime.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

using representation::kHeight;
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

/// What one model makes of the frames.
template <typename Scalar>
struct Branch {
  Branch(const std::shared_ptr<const StyleModel>& model, double fade)
      : step(model),
        encoder(model->input(), model->frame_rate()),
        mix(*model),
        input(at(step.layout().num_slots())),
        output(input.size()),
        share({0.0}, fade * model->frame_rate()) {}

  /// The model step, and how familiar it was.
  void run(const postprocess::GeneralizationOptions& options) {
    step.step(input.data(), output.data());
    share.go_to(std::array{postprocess::input_share(static_cast<double>(step.largest_deviation()), options)});
  }
  /// This frame's velocities are not to be known from it. Standing still would be a jolt to a model of walking, so the
  /// body moves as it did, or, if that is not known either, as the examples do on average.
  void guess_velocities() {
    const auto& mean = step.model().input_scaling().mean();
    for (int dof = 0; dof < kHeight; ++dof) {
      input[at(dof)] = has_velocities ? velocities[at(dof)] : static_cast<Scalar>(mean[dof]);
    }
  }
  void keep_velocities(const Scalar* row) {
    std::copy_n(row, kHeight, velocities.begin());
    has_velocities = true;
  }

  template <typename Visit>
  void visit_state(Visit&& visit) {
    step.visit_state(visit);
    encoder.visit_state(visit);
    share.visit_state(visit);
    visit(&has_velocities, 1);
    visit(velocities.data(), velocities.size());
  }

  ModelStep<Scalar> step;
  representation::PoseEncoder<Scalar> encoder;
  translate::StyleMix<Scalar> mix;
  math::AlignedVector<Scalar> input, output;
  translate::Glide share;
  bool has_velocities = false;
  std::array<Scalar, kHeight> velocities{};  // of the latest frame
};

}  // namespace

template <typename Scalar>
struct BasicTranslator<Scalar>::Stream {
  Stream(std::vector<std::shared_ptr<const StyleModel>> given, const TranslatorOptions& wanted);

  bool push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);
  void translate(const PoseView<const Scalar>& input, const PoseView<Scalar>& output);
  void tell_feet();
  void encode(const PoseView<const Scalar>& input);
  void begin();
  void glide();
  void weigh_joints();
  void blend();
  /// Memory for a pose in Scalar.
  [[nodiscard]] PoseView<Scalar> converted() {
    return {pose_rotations.data(), pose_translations.data(), models.front()->skeleton().num_joints()};
  }
  static void convert(const PoseView<const double>& from, const PoseView<Scalar>& to) {
    const auto convert = [](double number) { return static_cast<Scalar>(number); };
    std::transform(from.rotations, from.rotations + 4 * from.num_joints, to.rotations, convert);
    std::transform(from.translations, from.translations + 3 * from.num_joints, to.translations, convert);
  }
  static void convert(const PoseView<const Scalar>& from, Pose& to) {
    std::copy_n(from.rotations, 4 * from.num_joints, view(to).rotations);
    std::copy_n(from.translations, 3 * from.num_joints, view(to).translations);
    for (Eigen::Quaterniond& rotation : to.rotations) rotation.normalize();  // to the length that double asks for
  }
  [[nodiscard]] double weight(std::size_t branch) const { return weights.value()[branch]; }
  template <typename Visit>
  void visit_state(Visit&& visit) {
    for (Branch<Scalar>& branch : branches) branch.visit_state(visit);
    strengths.visit_state(visit);
    weights.visit_state(visit);
    decoder.visit_state(visit);
    visit(&started, 1);
  }

  std::vector<std::shared_ptr<const StyleModel>> models;
  TranslatorOptions options;
  std::vector<int> parts;  // per joint below the pelvis
  std::vector<Branch<Scalar>> branches;
  translate::Glide strengths;
  std::vector<double> shares;  // of the models: where they go, and
  translate::Glide weights;    // where they are
  translate::MixWeights<Scalar> mix_weights;
  representation::PoseDecoder<Scalar> decoder;
  std::optional<translate::Feet> feet;
  bool started = false;
  std::array<Scalar, RowLayout::kRotations> root{};
  math::AlignedVector<Scalar> rotations;                          // blended, planes
  math::AlignedVector<Scalar> pose_rotations, pose_translations;  // a pose, converted
};

namespace {

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
BasicTranslator<Scalar>::Stream::Stream(std::vector<std::shared_ptr<const StyleModel>> given,
                                        const TranslatorOptions& wanted)
    : models((check_models(given), std::move(given))),
      options((check_options(wanted), check_controls(wanted.controls, static_cast<int>(models.size())), wanted)),
      parts(parts_of_joints(*models.front())),
      strengths(list_of(strengths_of(wanted.controls)), wanted.glide * models.front()->frame_rate()),
      shares(shares_of(wanted.controls, models.size())),
      weights(shares, wanted.glide * models.front()->frame_rate()),
      decoder(models.front()->output(), models.front()->frame_rate()) {
  for (const auto& model : models) branches.emplace_back(model, options.generalization.fade);
  if (options.clean_feet) feet.emplace(models, options.footskate);
  const int plane = branches.front().step.layout().plane();
  mix_weights.pose.resize(at(plane));
  mix_weights.movement.resize(at(plane));
  rotations.resize(at(4 * plane));
  pose_rotations.resize(at(4 * models.front()->skeleton().num_joints()));
  pose_translations.resize(at(3 * models.front()->skeleton().num_joints()));
  weigh_joints();
}

template <typename Scalar>
bool BasicTranslator<Scalar>::Stream::push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  if (!feet) {
    translate(input, output);
    return true;
  }
  translate(input, converted());  // until the feet are held it is nobody's to see
  tell_feet();
  return feet->push<Scalar>(converted(), output);
}

/// Which feet are planted, by the models' states; where input passes through, nobody can tell.
template <typename Scalar>
void BasicTranslator<Scalar>::Stream::tell_feet() {
  feet->begin();
  for (std::size_t b = 0; b < branches.size(); ++b) {
    branches[b].step.state(feet->state(b));
    feet->vote(b, weight(b) * (1.0 - branches[b].share.value().front()));
  }
}

template <typename Scalar>
void BasicTranslator<Scalar>::Stream::translate(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  encode(input);
  glide();
  for (Branch<Scalar>& branch : branches) {
    branch.run(options.generalization);
    if (!started) branch.share.arrive();
    branch.share.advance();
    const auto style_share = static_cast<Scalar>(1.0 - branch.share.value().front());
    branch.mix.mix(branch.input.data(), branch.output.data(), mix_weights, style_share);
  }
  started = true;
  if (branches.size() == 1) {
    const auto& mix = branches.front().mix;
    decoder.decode(mix.root(), mix.rotations(), models.front()->output().upright(), input, output);
    return;
  }
  blend();
  Eigen::Vector4d upright = Eigen::Vector4d::Zero();
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const Eigen::Vector4d own = models[b]->output().upright().coeffs();
    upright += (upright.dot(own) < 0.0 ? -weight(b) : weight(b)) * own;
  }
  decoder.decode(root.data(), rotations.data(), Eigen::Quaterniond(upright).normalized(), input, output);
}

template <typename Scalar>
void BasicTranslator<Scalar>::Stream::encode(const PoseView<const Scalar>& input) {
  const representation::RootPlacement before = branches.front().encoder.placement();
  for (Branch<Scalar>& branch : branches) branch.encoder.encode(input, branch.input.data());
  if (!started) {
    begin();
  } else if (is_jump(branches.front().input.data())) {
    // The body was put elsewhere: what is translated goes with it, and moves on as it moved.
    decoder.carry(before, branches.front().encoder.placement());
    for (Branch<Scalar>& branch : branches) branch.guess_velocities();
  }
  for (Branch<Scalar>& branch : branches) branch.keep_velocities(branch.input.data());
}

template <typename Scalar>
void BasicTranslator<Scalar>::Stream::begin() {
  representation::RootPlacement start = branches.front().encoder.placement();
  const double heading = start.heading;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    branches[b].guess_velocities();
    start.heading += weight(b) * math::wrap_angle(branches[b].encoder.placement().heading - heading);
  }
  decoder.restart(start);
}

template <typename Scalar>
void BasicTranslator<Scalar>::Stream::glide() {
  if (!started) {
    strengths.arrive();
    weights.arrive();
    weigh_joints();
  }
  weights.advance();
  if (strengths.advance()) weigh_joints();
}

template <typename Scalar>
void BasicTranslator<Scalar>::Stream::weigh_joints() {
  const std::vector<double>& now = strengths.value();
  for (std::size_t joint = 0; joint < parts.size(); ++joint) {
    mix_weights.pose[joint] = static_cast<Scalar>(now[at(2 * parts[joint])]);
    mix_weights.movement[joint] = static_cast<Scalar>(now[at(2 * parts[joint] + 1)]);
  }
  constexpr int kTrunk = static_cast<int>(motion::BodyPart::kTrunk);
  mix_weights.root_pose = static_cast<Scalar>(now[at(2 * kTrunk)]);
  mix_weights.root_movement = static_cast<Scalar>(now[at(2 * kTrunk + 1)]);
}

/// The weighted mean of what the models make of a frame; of quaternions those that are near each other.
template <typename Scalar>
void BasicTranslator<Scalar>::Stream::blend() {
  const int plane = static_cast<int>(rotations.size()) / 4;
  root.fill(Scalar(0));
  std::fill(rotations.begin(), rotations.end(), Scalar(0));
  const Scalar* first = branches.front().mix.rotations();
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const auto share = static_cast<Scalar>(weight(b));
    const Scalar* own = branches[b].mix.rotations();
    for (std::size_t slot = 0; slot < root.size(); ++slot) root[slot] += share * branches[b].mix.root()[slot];
    for (int joint = 0; joint < plane; ++joint) {
      Scalar cosine = Scalar(0);
      for (int i = 0; i < 4; ++i) cosine += first[i * plane + joint] * own[i * plane + joint];
      const Scalar signed_share = cosine < Scalar(0) ? -share : share;
      for (int i = 0; i < 4; ++i) rotations[at(i * plane + joint)] += signed_share * own[i * plane + joint];
    }
  }
}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(std::shared_ptr<const StyleModel> model, const TranslatorOptions& options)
    : BasicTranslator(std::vector{std::move(model)}, options) {}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(std::vector<std::shared_ptr<const StyleModel>> models,
                                         const TranslatorOptions& options)
    : stream_(std::make_unique<Stream>(std::move(models), options)) {}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(const BasicTranslator& other)
    : stream_(std::make_unique<Stream>(*other.stream_)) {}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(BasicTranslator&&) noexcept = default;
template <typename Scalar>
BasicTranslator<Scalar>::~BasicTranslator() = default;

template <typename Scalar>
BasicTranslator<Scalar>& BasicTranslator<Scalar>::operator=(BasicTranslator other) noexcept {
  stream_.swap(other.stream_);
  return *this;
}

template <typename Scalar>
bool BasicTranslator<Scalar>::push(const PoseView<const Scalar>& input, const PoseView<Scalar>& output) {
  const int joints = model().skeleton().num_joints();
  translate::check_num_joints("output", output.num_joints, joints);
  translate::check_pose(input, joints);
  return stream_->push(input, output);
}

template <typename Scalar>
bool BasicTranslator<Scalar>::push(const Pose& input, Pose& output) {
  const auto joints = static_cast<std::size_t>(model().skeleton().num_joints());
  for (const std::size_t size : {input.rotations.size(), input.translations.size()}) {
    translate::check_num_joints("input", static_cast<int>(size), static_cast<int>(joints));
  }
  output.rotations.resize(joints);
  output.translations.resize(joints);
  if constexpr (std::is_same_v<Scalar, double>) {
    return push(view(input), view(output));
  } else {
    const PoseView<Scalar> converted = stream_->converted();
    stream_->convert(view(input), converted);
    if (!push(converted, converted)) return false;
    stream_->convert(converted, output);
    return true;
  }
}

template <typename Scalar>
int BasicTranslator<Scalar>::latency() const noexcept {
  return stream_->feet ? stream_->feet->latency() : 0;
}

template <typename Scalar>
bool BasicTranslator<Scalar>::flush(const PoseView<Scalar>& output) {
  translate::check_num_joints("output", output.num_joints, model().skeleton().num_joints());
  return stream_->feet && stream_->feet->flush(output);
}

template <typename Scalar>
bool BasicTranslator<Scalar>::flush(Pose& output) {
  output.rotations.resize(at(model().skeleton().num_joints()));
  output.translations.resize(output.rotations.size());
  if constexpr (std::is_same_v<Scalar, double>) {
    return flush(view(output));
  } else {
    const PoseView<Scalar> converted = stream_->converted();
    if (!flush(converted)) return false;
    stream_->convert(converted, output);
    return true;
  }
}

template <typename Scalar>
void BasicTranslator<Scalar>::warm_up(const std::vector<Pose>& opening, int frames) {
  if (stream_->started) throw InvalidArgument("opening", "no frame pushed before", "a stream that runs");
  if (opening.size() < 2) throw InvalidArgument("opening", "two frames or more", std::to_string(opening.size()));
  for (const Pose& pose : opening) translate::check_pose(view(pose), model().skeleton().num_joints());
  const Motion clip(model().output().shared_skeleton(), model().frame_rate(), opening);
  for (Branch<Scalar>& branch : stream_->branches) {
    const FrameMatrix rows = representation::encode(branch.step.model().input(), clip);
    const FrameMatrix before = representation::extrapolate_back(rows, frames);
    for (Eigen::Index t = 0; t < before.rows(); ++t) {
      branch.step.layout().pack(before.row(t), branch.input.data());
      branch.run(stream_->options.generalization);
      if (t == 0) branch.share.arrive();
      branch.share.advance();
    }
    branch.step.layout().pack(rows.row(0), branch.input.data());
    branch.keep_velocities(branch.input.data());
  }
}

template <typename Scalar>
void BasicTranslator<Scalar>::set_controls(const TranslatorControls& controls) {
  check_controls(controls, num_models());
  stream_->options.controls = controls;
  stream_->strengths.go_to(strengths_of(controls));
  set_shares(controls, stream_->shares);
  stream_->weights.go_to(stream_->shares);
}

template <typename Scalar>
const TranslatorControls& BasicTranslator<Scalar>::controls() const noexcept {
  return stream_->options.controls;
}

template <typename Scalar>
void BasicTranslator<Scalar>::reset() {
  for (Branch<Scalar>& branch : stream_->branches) {
    branch.step.reset();
    branch.encoder.reset();
    branch.has_velocities = false;
  }
  if (stream_->feet) stream_->feet->reset();
  stream_->started = false;
}

template <typename Scalar>
void BasicTranslator<Scalar>::restore(const BasicTranslator& snapshot) {
  if (snapshot.stream_->models != stream_->models) {
    throw InvalidArgument("snapshot", "one of a translator of the same models", "one of others");
  }
  if (snapshot.latency() != latency()) {
    throw InvalidArgument("snapshot", "one of a latency of " + std::to_string(latency()) + " frames",
                          "one of " + std::to_string(snapshot.latency()));
  }
  *stream_ = *snapshot.stream_;
}

template <typename Scalar>
std::size_t BasicTranslator<Scalar>::state_size() const {
  if (stream_->feet) throw InvalidArgument("clean_feet", "false where states are kept as bytes", "true");
  std::size_t size = 0;
  stream_->visit_state([&size](auto* first, std::size_t count) { size += count * sizeof(*first); });
  return size;
}

template <typename Scalar>
void BasicTranslator<Scalar>::save_state(std::byte* bytes) const {
  stream_->visit_state([&bytes](auto* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<std::remove_pointer_t<decltype(first)>>);
    if (count > 0) std::memcpy(bytes, first, count * sizeof(*first));
    bytes += count * sizeof(*first);
  });
}

template <typename Scalar>
void BasicTranslator<Scalar>::load_state(const std::byte* bytes) {
  stream_->visit_state([&bytes](auto* first, std::size_t count) {
    if (count > 0) std::memcpy(first, bytes, count * sizeof(*first));
    bytes += count * sizeof(*first);
  });
  stream_->weigh_joints();
}

template <typename Scalar>
double BasicTranslator<Scalar>::time_warp() const {
  double log_time_warp = 0.0;
  for (std::size_t b = 0; b < stream_->branches.size(); ++b) {
    log_time_warp += stream_->weight(b) * static_cast<double>(stream_->branches[b].mix.root()[RowLayout::kTimeWarp]);
  }
  return std::exp(std::clamp(log_time_warp, -representation::kLargestLogTimeWarp, representation::kLargestLogTimeWarp));
}

template <typename Scalar>
double BasicTranslator<Scalar>::input_share() const {
  double share = 0.0;
  for (std::size_t b = 0; b < stream_->branches.size(); ++b) {
    share += stream_->weight(b) * stream_->branches[b].share.value().front();
  }
  return share;
}

template <typename Scalar>
const StyleModel& BasicTranslator<Scalar>::model(int index) const {
  return *stream_->models.at(at(index));
}

template <typename Scalar>
int BasicTranslator<Scalar>::num_models() const noexcept {
  return static_cast<int>(stream_->models.size());
}

template class BasicTranslator<float>;
template class BasicTranslator<double>;

}  // namespace strut
