// SPDX-License-Identifier: MIT
#include "translate/check_pose.h"
#include "translate/stream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include <strut/core/error.h>
#include <strut/representation/retime.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

/// Writes a pose of less than double precision.
template <typename Scalar>
void copy_to(const PoseView<Scalar>& from, Pose& to) {
  copy_pose(from, view(to));
  for (Eigen::Quaterniond& rotation : to.rotations) rotation.normalize();  // to the length that double asks for
}

}  // namespace

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(std::shared_ptr<const StyleModel> model, const TranslatorOptions& options)
    : BasicTranslator(std::vector{std::move(model)}, options) {}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(std::vector<std::shared_ptr<const StyleModel>> models,
                                         const TranslatorOptions& options)
    : stream_(std::make_unique<translate::Stream<Scalar>>(std::move(models), options)) {}

template <typename Scalar>
BasicTranslator<Scalar>::BasicTranslator(const BasicTranslator& other)
    : stream_(std::make_unique<translate::Stream<Scalar>>(*other.stream_)) {}

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
    copy_pose(view(input), converted);
    if (!push(converted, converted)) return false;
    copy_to(converted, output);
    return true;
  }
}

template <typename Scalar>
int BasicTranslator<Scalar>::latency() const noexcept {
  return stream_->feet() ? stream_->feet()->latency() : 0;
}

template <typename Scalar>
bool BasicTranslator<Scalar>::flush(const PoseView<Scalar>& output) {
  translate::check_num_joints("output", output.num_joints, model().skeleton().num_joints());
  return stream_->feet() && stream_->feet()->flush(output);
}

template <typename Scalar>
bool BasicTranslator<Scalar>::flush(Pose& output) {
  output.rotations.resize(static_cast<std::size_t>(model().skeleton().num_joints()));
  output.translations.resize(output.rotations.size());
  if constexpr (std::is_same_v<Scalar, double>) {
    return flush(view(output));
  } else {
    const PoseView<Scalar> converted = stream_->converted();
    if (!flush(converted)) return false;
    copy_to(converted, output);
    return true;
  }
}

template <typename Scalar>
void BasicTranslator<Scalar>::warm_up(const std::vector<Pose>& opening, int frames) {
  if (stream_->has_started()) throw InvalidArgument("opening", "no frame pushed before", "a stream that runs");
  if (opening.size() < 2) throw InvalidArgument("opening", "two frames or more", std::to_string(opening.size()));
  for (const Pose& pose : opening) translate::check_pose(view(pose), model().skeleton().num_joints());
  stream_->warm_up({model().output().shared_skeleton(), model().frame_rate(), opening}, frames);
}

template <typename Scalar>
void BasicTranslator<Scalar>::set_controls(const TranslatorControls& controls) {
  check_controls(controls, num_models());
  stream_->set_controls(controls);
}

template <typename Scalar>
const TranslatorControls& BasicTranslator<Scalar>::controls() const noexcept {
  return stream_->options().controls;
}

template <typename Scalar>
void BasicTranslator<Scalar>::reset() {
  stream_->reset();
}

template <typename Scalar>
void BasicTranslator<Scalar>::restore(const BasicTranslator& snapshot) {
  if (snapshot.stream_->models() != stream_->models()) {
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
  if (stream_->feet()) throw InvalidArgument("clean_feet", "false where states are kept as bytes", "true");
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
  constexpr double kLargest = representation::kLargestLogTimeWarp;
  return std::exp(std::clamp(stream_->log_time_warp(), -kLargest, kLargest));
}

template <typename Scalar>
double BasicTranslator<Scalar>::input_share() const {
  return stream_->input_share();
}

template <typename Scalar>
const StyleModel& BasicTranslator<Scalar>::model(int index) const {
  return *stream_->models().at(static_cast<std::size_t>(index));
}

template <typename Scalar>
int BasicTranslator<Scalar>::num_models() const noexcept {
  return static_cast<int>(stream_->models().size());
}

template class BasicTranslator<float>;
template class BasicTranslator<double>;

}  // namespace strut
