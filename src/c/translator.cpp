// SPDX-License-Identifier: MIT
// Translators and snapshots of them through the C interface. What is called per frame allocates nothing, and takes no
// way round where the caller's frames are strut's already.
#include "c/handles.h"
#include "c/joint_transforms.h"
#include "c/versioned_struct.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace strut::c {
namespace {

strut_controls default_controls() {
  strut_controls controls{};
  controls.struct_size = sizeof controls;
  controls.strength = controls.pose = controls.movement = 1.0;
  for (double& part : controls.parts) part = 1.0;
  return controls;
}

strut_translator_options default_options() {
  const TranslatorOptions options;
  return {sizeof(strut_translator_options),
          options.generalization.enabled ? 1 : 0,
          options.generalization.confidence,
          options.generalization.preference,
          options.generalization.fade,
          options.glide,
          nullptr,
          nullptr,
          nullptr};
}

strut_feet default_feet() {
  const postprocess::FootskateOptions options;
  return {sizeof(strut_feet),  options.look_ahead, options.shortest_plant, options.shortest_gap,
          options.max_stretch, options.reach,      options.body_follows,   options.max_drag};
}

postprocess::FootskateOptions footskate_of(const strut_feet& feet) {
  return {feet.look_ahead, feet.shortest_plant, feet.shortest_gap, feet.max_stretch,
          feet.reach,      feet.body_follows,   feet.max_drag};
}

/// Writes what `given` says to `controls`, whose weights have a number per model and keep their size.
void set_from(const strut_controls& given, TranslatorControls& controls) {
  static_assert(motion::kNumBodyParts == STRUT_NUM_PARTS);
  const auto num_models = static_cast<int>(controls.weights.size());
  if (given.num_weights != 0 && given.num_weights != num_models) {
    throw InvalidArgument("controls.num_weights", "0 or " + std::to_string(num_models) + " (a model each)",
                          std::to_string(given.num_weights));
  }
  controls.strength = given.strength;
  controls.pose = given.pose;
  controls.movement = given.movement;
  std::copy(std::begin(given.parts), std::end(given.parts), controls.parts.begin());
  if (given.num_weights == 0) {
    std::fill(controls.weights.begin(), controls.weights.end(), 1.0);
  } else {
    std::copy_n(std::begin(given.weights), num_models, controls.weights.begin());
  }
}

strut_controls controls_of(const TranslatorControls& controls) {
  strut_controls result = default_controls();
  result.num_weights = static_cast<std::int32_t>(controls.weights.size());
  result.strength = controls.strength;
  result.pose = controls.pose;
  result.movement = controls.movement;
  std::copy(controls.parts.begin(), controls.parts.end(), std::begin(result.parts));
  std::copy(controls.weights.begin(), controls.weights.end(), std::begin(result.weights));
  return result;
}

std::vector<std::shared_ptr<const StyleModel>> models_of(const strut_model* const* models, int num_models) {
  required("models", models);
  if (num_models < 1 || num_models > STRUT_MOST_MODELS) {
    throw InvalidArgument("num_models", "1 to " + std::to_string(STRUT_MOST_MODELS), std::to_string(num_models));
  }
  std::vector<std::shared_ptr<const StyleModel>> found;
  for (int m = 0; m < num_models; ++m) found.push_back(required("models", models[m]).model);
  return found;
}

TranslatorOptions options_of(const strut_translator_options& given, std::size_t num_models) {
  if (given.generalize != 0 && given.generalize != 1) {
    throw InvalidArgument("options.generalize", "0 or 1", std::to_string(given.generalize));
  }
  TranslatorOptions options;
  options.generalization = {given.generalize == 1, given.confidence, given.preference, given.fade};
  options.glide = given.glide;
  options.clean_feet = given.feet != nullptr;
  if (options.clean_feet) options.footskate = footskate_of(taken("feet", given.feet, default_feet()));
  options.controls.weights.resize(num_models);
  const strut_controls defaults = default_controls();
  set_from(given.controls == nullptr ? defaults : taken("controls", given.controls, defaults), options.controls);
  return options;
}

strut_translator* create(const strut_model* const* models, int num_models, const strut_translator_options* given) {
  const auto styles = models_of(models, num_models);
  const strut_translator_options options =
      given == nullptr ? default_options() : taken("options", given, default_options());
  return new strut_translator(styles, options_of(options, styles.size()),
                              AxisMap(axes_or_default("axes", options.axes)));
}

void read(const JointTransforms<const float>& from, const AxisMap& axes, const PoseView<float>& to) {
  for (int j = 0; j < from.num_joints; ++j) {
    axes.rotation_to_strut(from.rotation(j), to.rotations + 4 * j);
    axes.translation_to_strut(from.translation(j), to.translations + 3 * j);
  }
}

void write(const PoseView<const float>& from, const AxisMap& axes, const JointTransforms<float>& to) {
  for (int j = 0; j < to.num_joints; ++j) {
    axes.rotation_from_strut(from.rotations + 4 * j, to.rotation(j));
    axes.translation_from_strut(from.translations + 3 * j, to.translation(j));
  }
}

/// Whether a caller's frames can be worked on where they are.
bool is_direct(const strut_translator& translator, const JointTransforms<float>& output) {
  return translator.axes.is_identity() && output.is_tight();
}

strut_status status_of(bool is_written) {
  return is_written ? STRUT_OK : STRUT_NO_OUTPUT;
}

strut_status push(strut_translator& translator, const JointTransforms<const float>& input,
                  const JointTransforms<float>& output) {
  if (is_direct(translator, output) && input.is_tight()) {
    return status_of(
        translator.translator.push(PoseView<const float>{input.rotations, input.translations, input.num_joints},
                                   {output.rotations, output.translations, output.num_joints}));
  }
  check_num_joints("input", translator.num_joints(), input.num_joints);
  check_num_joints("output", translator.num_joints(), output.num_joints);
  const PoseView<float> frame = translator.converted();
  read(input, translator.axes, frame);
  if (!translator.translator.push(frame, frame)) return STRUT_NO_OUTPUT;
  write(frame, translator.axes, output);
  return STRUT_OK;
}

strut_status flush(strut_translator& translator, const JointTransforms<float>& output) {
  if (is_direct(translator, output)) {
    return status_of(translator.translator.flush({output.rotations, output.translations, output.num_joints}));
  }
  check_num_joints("output", translator.num_joints(), output.num_joints);
  const PoseView<float> frame = translator.converted();
  if (!translator.translator.flush(frame)) return STRUT_NO_OUTPUT;
  write(frame, translator.axes, output);
  return STRUT_OK;
}

/// Takes over a state of a translator made alike: another latency would mean other buffers.
void restore(FloatTranslator& to, const FloatTranslator& from) {
  if (to.latency() != from.latency()) {
    throw InvalidArgument("snapshot", "one of a latency of " + std::to_string(to.latency()) + " frames",
                          std::to_string(from.latency()));
  }
  to.restore(from);
}

}  // namespace
}  // namespace strut::c

strut_translator::strut_translator(const std::vector<std::shared_ptr<const strut::StyleModel>>& models,
                                   const strut::TranslatorOptions& options, const strut::c::AxisMap& map)
    : translator(models, options),
      axes(map),
      rotations(static_cast<std::size_t>(4 * num_joints())),
      translations(static_cast<std::size_t>(3 * num_joints())),
      controls(options.controls) {}

strut_status strut_controls_init(strut_controls* controls, size_t struct_size) {
  using namespace strut::c;
  return guarded([&] {
    give_sized("controls", &required("controls", controls), struct_size, default_controls());
    return STRUT_OK;
  });
}

strut_status strut_feet_init(strut_feet* feet, size_t struct_size) {
  using namespace strut::c;
  return guarded([&] {
    give_sized("feet", &required("feet", feet), struct_size, default_feet());
    return STRUT_OK;
  });
}

strut_status strut_translator_options_init(strut_translator_options* options, size_t struct_size) {
  using namespace strut::c;
  return guarded([&] {
    give_sized("options", &required("options", options), struct_size, default_options());
    return STRUT_OK;
  });
}

strut_status strut_translator_create(const strut_model* const* models, int32_t num_models,
                                     const strut_translator_options* options, strut_translator** translator) {
  using namespace strut::c;
  return guarded([&] {
    strut_translator*& handle = required("translator", translator);
    handle = nullptr;
    handle = create(models, num_models, options);
    return STRUT_OK;
  });
}

void strut_translator_free(strut_translator* translator) {
  delete translator;
}

strut_status strut_translator_push(strut_translator* translator, const strut_const_pose* input,
                                   const strut_pose* output) {
  using namespace strut::c;
  return guarded(
      [&] { return push(required("translator", translator), joints_of("input", input), joints_of("output", output)); });
}

strut_status strut_translator_flush(strut_translator* translator, const strut_pose* output) {
  using namespace strut::c;
  return guarded([&] { return flush(required("translator", translator), joints_of("output", output)); });
}

strut_status strut_translator_get_latency(const strut_translator* translator, int32_t* frames) {
  using namespace strut::c;
  return guarded([&] {
    required("frames", frames) = required("translator", translator).translator.latency();
    return STRUT_OK;
  });
}

strut_status strut_translator_reset(strut_translator* translator) {
  using namespace strut::c;
  return guarded([&] {
    required("translator", translator).translator.reset();
    return STRUT_OK;
  });
}

strut_status strut_translator_set_controls(strut_translator* translator, const strut_controls* controls) {
  using namespace strut::c;
  return guarded([&] {
    strut_translator& handle = required("translator", translator);
    set_from(taken("controls", &required("controls", controls), default_controls()), handle.controls);
    handle.translator.set_controls(handle.controls);
    return STRUT_OK;
  });
}

strut_status strut_translator_get_controls(const strut_translator* translator, strut_controls* controls) {
  using namespace strut::c;
  return guarded([&] {
    const strut::TranslatorControls& now = required("translator", translator).translator.controls();
    give("controls", &required("controls", controls), controls_of(now));
    return STRUT_OK;
  });
}

strut_status strut_translator_get_time_warp(const strut_translator* translator, double* frames) {
  using namespace strut::c;
  return guarded([&] {
    required("frames", frames) = required("translator", translator).translator.time_warp();
    return STRUT_OK;
  });
}

strut_status strut_translator_get_input_share(const strut_translator* translator, double* share) {
  using namespace strut::c;
  return guarded([&] {
    required("share", share) = required("translator", translator).translator.input_share();
    return STRUT_OK;
  });
}

strut_status strut_snapshot_create(const strut_translator* translator, strut_snapshot** snapshot) {
  using namespace strut::c;
  return guarded([&] {
    strut_snapshot*& handle = required("snapshot", snapshot);
    handle = nullptr;
    handle = new strut_snapshot{required("translator", translator).translator};
    return STRUT_OK;
  });
}

void strut_snapshot_free(strut_snapshot* snapshot) {
  delete snapshot;
}

strut_status strut_snapshot_save(strut_snapshot* snapshot, const strut_translator* translator) {
  using namespace strut::c;
  return guarded([&] {
    restore(required("snapshot", snapshot).translator, required("translator", translator).translator);
    return STRUT_OK;
  });
}

strut_status strut_translator_restore(strut_translator* translator, const strut_snapshot* snapshot) {
  using namespace strut::c;
  return guarded([&] {
    restore(required("translator", translator).translator, required("snapshot", snapshot).translator);
    return STRUT_OK;
  });
}
