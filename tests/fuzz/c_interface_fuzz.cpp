// SPDX-License-Identifier: MIT
// Any bytes as calls of the C interface: which function, on which handle, with what numbers, structs of what size, and
// a model file. Whatever comes, calls return one of their statuses; frames that are given are finite and of unit length
// where the model is sound. Input: how many of the bytes are calls (2 bytes), the calls, a model file.
#include "support/small_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <strut/c/strut.h>
#include <strut/generate/walker.h>
#include <strut/model/style_model_io.h>

namespace {

using namespace strut;

constexpr int kJoints = 6;       // of poses that are only converted
constexpr int kMostJoints = 64;  // of buffers; models with more are not stepped
constexpr int kMostCalls = 200;
constexpr float kUnitTolerance = 1e-3F;

void require(bool holds) {
  if (!holds) std::abort();
}

bool is_status(strut_status status) {
  return std::strcmp(strut_status_name(status), "unknown status") != 0 && status != STRUT_INTERNAL_ERROR;
}

/// A model of a body with legs that tells footplants, its numbers of no meaning.
std::string planting_model() {
  StyleModelParts parts = test::radial_parts(generate::generate_walk({.duration = 2.0}, {}, 30.0).motion);
  const Eigen::Index states = parts.radial_map->basis.num_features();
  const Eigen::VectorXd projection = Eigen::VectorXd::LinSpaced(states, 0.1, 0.9);
  parts.footplants = postprocess::FootplantClassifier({postprocess::FootplantBoundary{projection, 0.25, true},
                                                       postprocess::FootplantBoundary{-projection, -0.5, false}});
  return format_style_model(StyleModel(std::move(parts)));
}

std::string copying_model() {
  return format_style_model(*test::copying_model(test::turning_motion(30.0, 1.0)));
}

/// Numbers out of the bytes; zeros when they are used up.
class Source {
 public:
  Source(const std::uint8_t* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}
  [[nodiscard]] bool is_empty() const { return at_ == end_; }
  std::uint8_t byte() { return is_empty() ? std::uint8_t{0} : *at_++; }
  int below(int count) { return byte() % count; }
  template <typename Number>
  Number raw() {
    std::array<std::uint8_t, sizeof(Number)> bits{};
    for (std::uint8_t& b : bits) b = byte();
    Number number;
    std::memcpy(&number, bits.data(), sizeof number);
    return number;
  }
  /// Often a number at the edge of something, else a plausible one, rarely any bits.
  double number() {
    using Limits = std::numeric_limits<float>;
    static constexpr std::array kEdges = {0.0,
                                          -0.0,
                                          1.0,
                                          -1.0,
                                          1.5,
                                          1.5000001,
                                          1e-6,
                                          1e6,
                                          9.999999e6,
                                          1e7,
                                          -1e7,
                                          1e30,
                                          1e300,
                                          static_cast<double>(Limits::max()),
                                          static_cast<double>(Limits::denorm_min()),
                                          std::numeric_limits<double>::denorm_min(),
                                          std::numeric_limits<double>::infinity(),
                                          std::numeric_limits<double>::quiet_NaN()};
    const int kind = below(8);
    if (kind < 3) return kEdges.at(static_cast<std::size_t>(below(static_cast<int>(kEdges.size()))));
    if (kind < 7) return byte() / 128.0;
    return raw<double>();
  }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

struct Frame {
  std::array<float, 4 * kMostJoints> rotations{};
  std::array<float, 3 * kMostJoints> translations{};
};

class Session {
 public:
  Session(Source& source, const std::uint8_t* model, std::size_t size) : source_(source), file_(model), size_(size) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    for (Stream& stream : streams_) strut_translator_free(stream.translator);
    for (strut_snapshot* snapshot : snapshots_) strut_snapshot_free(snapshot);
    for (strut_model* model : models_) strut_model_release(model);
  }

  void call() {
    switch (source_.below(16)) {
      case 0:
        load();
        break;
      case 1:
        create();
        break;
      case 2:
        look_at_model();
        break;
      case 3:
        move_controls();
        break;
      case 4:
        snapshot();
        break;
      case 5:
        restore();
        break;
      case 6:
        query();
        break;
      case 7:
        convert();
        break;
      case 8:
        retain_and_release();
        break;
      default:
        push();
        break;
    }
  }

 private:
  /// A translator, and whether its models are sound.
  struct Stream {
    strut_translator* translator = nullptr;
    bool is_sound = false;
    int num_joints = 0;
    strut_axes axes{};
  };

  Stream& stream() { return streams_.at(static_cast<std::size_t>(source_.below(3))); }
  strut_model*& model() { return models_.at(static_cast<std::size_t>(source_.below(3))); }

  static void expect(strut_status status) { require(is_status(status)); }

  void load() {
    static const std::array kSound = {planting_model(), copying_model()};
    const auto slot = static_cast<std::size_t>(source_.below(3));
    strut_model_release(models_[slot]);
    // Slots 0 and 1 have the sound models, 2 the one that comes with the calls.
    const void* bytes = slot < 2 ? kSound[slot].data() : reinterpret_cast<const char*>(file_);
    expect(strut_model_load_memory(bytes, slot < 2 ? kSound[slot].size() : size_, nullptr, &models_[slot]));
    require(slot == 2 || models_[slot] != nullptr);
  }

  strut_axes any_axes() {
    strut_axes axes{};
    expect(strut_axes_init(&axes, sizeof axes, source_.below(6)));
    if (source_.below(4) == 0) {
      axes.right = source_.below(9) - 4;
      axes.up = source_.below(9) - 4;
      axes.forward = source_.below(9) - 4;
    }
    if (source_.below(4) == 0) axes.metres_per_unit = static_cast<float>(source_.number());
    axes.quaternion_order = source_.below(8) == 0 ? source_.below(4) - 1 : source_.below(2);
    axes.struct_size = any_size(sizeof axes);
    return axes;
  }

  /// Mostly the size that it is; never one that reaches beyond the struct.
  std::uint32_t any_size(std::size_t size) {
    return static_cast<std::uint32_t>(source_.below(8) == 0 ? source_.byte() % (size + 1) : size);
  }

  strut_controls any_controls() {
    strut_controls controls;
    expect(strut_controls_init(&controls, sizeof controls));
    if (source_.below(2) == 0) controls.strength = source_.number();
    if (source_.below(4) == 0) controls.pose = source_.number();
    if (source_.below(4) == 0) controls.movement = source_.number();
    if (source_.below(4) == 0) controls.parts[source_.below(STRUT_NUM_PARTS)] = source_.number();
    controls.num_weights = source_.below(4) == 0 ? source_.below(20) - 1 : 0;
    for (int m = 0; m < controls.num_weights && m < STRUT_MOST_MODELS; ++m) controls.weights[m] = source_.number();
    controls.struct_size = any_size(sizeof controls);
    return controls;
  }

  strut_feet any_feet() {
    strut_feet feet;
    expect(strut_feet_init(&feet, sizeof feet));
    for (double* number : {&feet.look_ahead, &feet.shortest_plant, &feet.shortest_gap, &feet.max_stretch, &feet.reach,
                           &feet.body_follows, &feet.max_drag}) {
      if (source_.below(8) == 0) *number = source_.number();
    }
    feet.struct_size = any_size(sizeof feet);
    return feet;
  }

  void create() {
    std::array<const strut_model*, STRUT_MOST_MODELS> chosen{};
    const int count = source_.below(8) == 0 ? source_.below(20) - 1 : 1 + source_.below(2);
    Stream made{nullptr, true, 0, any_axes()};
    for (int m = 0; m < std::min(count, STRUT_MOST_MODELS); ++m) {
      const auto slot = static_cast<std::size_t>(source_.below(3));
      chosen[static_cast<std::size_t>(m)] = models_[slot];
      made.is_sound = made.is_sound && slot < 2;
    }
    strut_translator_options options;
    expect(strut_translator_options_init(&options, sizeof options));
    const strut_controls controls = any_controls();
    if (source_.below(4) == 0) options.confidence = source_.number();
    if (source_.below(4) == 0) options.preference = source_.number();
    if (source_.below(4) == 0) options.fade = source_.number();
    if (source_.below(4) == 0) options.glide = source_.number();
    options.generalize = source_.below(3);
    options.controls = source_.below(2) == 0 ? &controls : nullptr;
    options.axes = &made.axes;
    const strut_feet feet = any_feet();
    if (source_.below(3) == 0) options.feet = &feet;
    options.struct_size = any_size(sizeof options);
    const strut_status status = strut_translator_create(chosen.data(), count, &options, &made.translator);
    expect(status);
    require((status == STRUT_OK) == (made.translator != nullptr));
    if (status != STRUT_OK) return;
    strut_model_info info{};
    info.struct_size = sizeof info;
    expect(strut_model_get_info(chosen[0], &info));
    made.num_joints = info.num_joints;
    Stream& place = stream();
    strut_translator_free(place.translator);
    place = made;
  }

  void look_at_model() {
    const strut_model* chosen = model();
    strut_model_info info{};
    info.struct_size = any_size(sizeof info);
    expect(strut_model_get_info(chosen, &info));
    const strut_axes axes = any_axes();
    strut_joint joint{};
    joint.struct_size = any_size(sizeof joint);
    const strut_status status =
        strut_model_get_joint(chosen, source_.below(kJoints + 2) - 1, source_.below(2) == 0 ? &axes : nullptr, &joint);
    expect(status);
    if (status == STRUT_OK && joint.name != nullptr) require(std::strlen(joint.name) < 1U << 30U);
    std::array<const char*, 4> names = {"root", "pelvis", "left", "\xFF"};
    std::array<std::int32_t, 4> parents = {-1, 0, source_.below(8) - 2, 1};
    expect(strut_model_check_skeleton(chosen, names.data(), parents.data(), source_.below(5)));
  }

  void retain_and_release() {
    const strut_model* chosen = model();
    if (strut_model_retain(chosen) == STRUT_OK) strut_model_release(chosen);
    // Translators live on without the handle.
    strut_model*& released = model();
    if (source_.below(4) != 0) return;
    strut_model_release(released);
    released = nullptr;
  }

  void move_controls() {
    strut_translator* translator = stream().translator;
    const strut_controls controls = any_controls();
    expect(strut_translator_set_controls(translator, &controls));
    strut_controls now{};
    now.struct_size = any_size(sizeof now);
    expect(strut_translator_get_controls(translator, &now));
  }

  void snapshot() {
    const Stream& from = stream();
    const auto slot = static_cast<std::size_t>(source_.below(2));
    if (source_.below(2) == 0) {
      expect(strut_snapshot_save(snapshots_[slot], from.translator));
      return;
    }
    strut_snapshot_free(snapshots_[slot]);
    expect(strut_snapshot_create(from.translator, &snapshots_[slot]));
  }

  void restore() {
    Stream& to = stream();
    const auto slot = static_cast<std::size_t>(source_.below(2));
    expect(strut_translator_restore(to.translator, snapshots_[slot]));
  }

  void query() {
    const Stream& from = stream();
    strut_translator* translator = from.translator;
    double number = 0.0;
    std::int32_t frames = 0;
    expect(strut_translator_get_time_warp(translator, &number));
    expect(strut_translator_get_latency(translator, &frames));
    if (strut_translator_get_input_share(translator, &number) == STRUT_OK) require(!(number < 0.0));
    Frame frame;
    const int num_joints = source_.below(4) == 0 ? source_.below(kMostJoints) : from.num_joints;
    const strut_pose out{frame.rotations.data(), frame.translations.data(), 0, 0, num_joints};
    if (num_joints > kMostJoints) return;
    const strut_status status = strut_translator_flush(translator, &out);
    expect(status);
    if (status == STRUT_OK && from.is_sound) require_sound(frame, num_joints);
    if (source_.below(4) == 0) expect(strut_translator_reset(translator));
  }

  /// A body that moves a little, with a few of its numbers put to anything.
  void disturb(Frame& frame, int num_joints, const strut_axes& axes) {
    const bool w_first = axes.quaternion_order == STRUT_QUATERNION_WXYZ;
    const float unit = axes.metres_per_unit > 0.0F ? 1.0F / axes.metres_per_unit : 1.0F;
    for (int j = 0; j < num_joints; ++j) {
      const float half = 0.01F * static_cast<float>(source_.byte());
      frame.rotations.at(static_cast<std::size_t>(4 * j + (w_first ? 1 : 0) + j % 3)) = std::sin(half);
      frame.rotations.at(static_cast<std::size_t>(4 * j + (w_first ? 0 : 3))) = std::cos(half);
      frame.translations.at(static_cast<std::size_t>(3 * j + 1)) = unit * 0.01F * static_cast<float>(source_.byte());
    }
    for (int faults = source_.below(16) - 10; faults > 0; --faults) {
      const auto joint = static_cast<std::size_t>(source_.below(std::max(num_joints, 1)));
      const auto value = static_cast<float>(source_.number());
      if (source_.below(4) == 0) {
        frame.rotations[4 * joint + static_cast<std::size_t>(source_.below(4))] = value;
      } else {
        frame.translations[3 * joint + static_cast<std::size_t>(source_.below(3))] = unit * value;
      }
    }
  }

  void push() {
    const Stream& to = stream();
    if (to.num_joints > kMostJoints) return;
    Frame frame;
    disturb(frame, to.num_joints, to.axes);
    const int num_joints = source_.below(16) == 0 ? source_.below(kMostJoints) : to.num_joints;
    const std::size_t stride = source_.below(16) == 0 ? source_.byte() % 17 : 0;
    const strut_const_pose in{frame.rotations.data(), frame.translations.data(), stride, 0, num_joints};
    Frame apart;
    Frame& result = source_.below(2) == 0 ? frame : apart;
    const strut_pose out{result.rotations.data(), result.translations.data(), 0, 0, num_joints};
    const strut_status status = strut_translator_push(to.translator, &in, &out);
    expect(status);
    if (status == STRUT_OK && to.is_sound) require_sound(result, num_joints);
  }

  static void require_sound(const Frame& frame, int num_joints) {
    for (int j = 0; j < num_joints; ++j) {
      float length = 0.0F;
      for (int i = 0; i < 4; ++i) length += std::pow(frame.rotations[static_cast<std::size_t>(4 * j + i)], 2.0F);
      require(std::abs(length - 1.0F) < kUnitTolerance);
      for (int i = 0; i < 3; ++i) require(std::isfinite(frame.translations[static_cast<std::size_t>(3 * j + i)]));
    }
  }

  void convert() {
    Frame frame;
    const strut_axes from = any_axes();
    const strut_axes to = any_axes();
    disturb(frame, kJoints, from);
    const strut_const_pose in{frame.rotations.data(), frame.translations.data(), 0, 0, kJoints};
    const strut_pose out{frame.rotations.data(), frame.translations.data(), 0, 0, kJoints};
    expect(strut_convert_pose(&in, &from, &out, source_.below(2) == 0 ? &to : nullptr));
  }

  Source& source_;
  const std::uint8_t* file_;
  std::size_t size_;
  std::array<strut_model*, 3> models_{};
  std::array<Stream, 3> streams_{};
  std::array<strut_snapshot*, 2> snapshots_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t wanted = bytes[0] + 256U * bytes[1];
  const std::size_t num_calls = std::min(wanted, size - 2);
  Source source(bytes + 2, num_calls);
  Session session(source, bytes + 2 + num_calls, size - 2 - num_calls);
  for (int call = 0; call < kMostCalls && !source.is_empty(); ++call) session.call();
  return 0;
}
