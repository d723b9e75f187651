// SPDX-License-Identifier: MIT
// Streams through the C interface: what the C++ interface gives, to the bit; no memory taken per frame; many threads
// over one model.
#include "c/handles.h"
#include "learn/example_walks.h"
#include "support/allocations.h"
#include "support/small_model.h"

#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/math/aligned.h>
#include <strut/translate/translator.h>

namespace strut::test {
namespace {

const Motion& clip() {
  static const Motion motion = turning_motion(30.0, 3.0);
  return motion;
}

/// Two models that remember, of one hierarchy.
std::vector<std::shared_ptr<const StyleModel>> models() {
  return {std::make_shared<const StyleModel>(radial_parts(clip())),
          std::make_shared<const StyleModel>(radial_parts(clip(), 9))};
}

void push(strut_translator* translator, const Frame& input, Frame& output) {
  const strut_const_pose in = input.in();
  const strut_pose out = output.out();
  ASSERT_EQ(strut_translator_push(translator, &in, &out), STRUT_OK) << strut_last_error();
}

/// The last frame of the clip, translated.
Frame translated(strut_translator* translator) {
  Frame output(6);
  for (const Pose& pose : clip().frames()) push(translator, Frame(pose), output);
  return output;
}

TEST(Translators, AreTheOnesOfCppToTheBit) {
  const auto styles = models();
  const ModelHandle first = handle_of(*styles[0]);
  const ModelHandle second = handle_of(*styles[1]);
  FloatTranslator expected(styles, {.controls = {.strength = 0.7, .weights = {1.0, 3.0}}});
  strut_controls controls;
  ASSERT_EQ(strut_controls_init(&controls, sizeof controls), STRUT_OK);
  controls.strength = 0.7;
  controls.num_weights = 2;
  controls.weights[0] = 1.0;
  controls.weights[1] = 3.0;
  strut_translator_options options;
  ASSERT_EQ(strut_translator_options_init(&options, sizeof options), STRUT_OK);
  options.controls = &controls;
  const TranslatorHandle translator = translator_of({first.get(), second.get()}, &options);
  Frame output(6);
  Frame output_of_cpp(6);
  for (const Pose& pose : clip().frames()) {
    const Frame input(pose);
    push(translator.get(), input, output);
    expected.push(PoseView<const float>{input.rotations.data(), input.translations.data(), 6},
                  {output_of_cpp.rotations.data(), output_of_cpp.translations.data(), 6});
    ASSERT_EQ(output, output_of_cpp);
  }
  double share = -1.0;
  EXPECT_EQ(strut_translator_get_input_share(translator.get(), &share), STRUT_OK);
  EXPECT_EQ(share, expected.input_share());
  EXPECT_EQ(strut_translator_get_time_warp(translator.get(), &share), STRUT_OK);
  EXPECT_EQ(share, expected.time_warp());
}

/// A model that tells footplants, and a walk to push through it.
struct Walking {
  std::shared_ptr<const StyleModel> model =
      learn_from(make_clips({content(1.0, 0.0), content(1.3, 0.2), content(1.2, -0.3)})).model;
  Motion walk = generate::generate_walk(content(1.2, 0.1, 4.0), {.seed = 7}, kExampleRate).motion;
};

strut_translator_options options_with(const strut_feet& feet, const strut_axes& axes) {
  strut_translator_options options;
  EXPECT_EQ(strut_translator_options_init(&options, sizeof options), STRUT_OK);
  options.feet = &feet;
  options.axes = &axes;
  return options;
}

/// Every frame that comes of a walk, the flushed ones last.
std::vector<Frame> frames_of(strut_translator* translator, const Motion& walk, int& num_late) {
  std::vector<Frame> frames;
  Frame output(walk.skeleton().num_joints());
  const strut_pose out = output.out();
  const auto keep = [&](strut_status status) {
    EXPECT_TRUE(status == STRUT_OK || status == STRUT_NO_OUTPUT) << strut_last_error();
    if (status == STRUT_OK) frames.push_back(output);
    return status == STRUT_OK;
  };
  num_late = 0;
  for (const Pose& pose : walk.frames()) {
    const Frame input(pose);
    const strut_const_pose in = input.in();
    num_late += keep(strut_translator_push(translator, &in, &out)) ? 0 : 1;
  }
  while (keep(strut_translator_flush(translator, &out))) {
  }
  return frames;
}

TEST(Translators, HoldFeetAfterALatencyAndGiveTheRestAtTheEnd) {
  const Walking walking;
  const ModelHandle model = handle_of(*walking.model);
  strut_feet feet;
  ASSERT_EQ(strut_feet_init(&feet, sizeof feet), STRUT_OK);
  feet.look_ahead = 0.4;
  for (const int convention : {STRUT_CONVENTION_STRUT, STRUT_CONVENTION_UNITY}) {
    const strut_axes axes = axes_of(convention);
    const strut_translator_options options = options_with(feet, axes);
    const TranslatorHandle translator = translator_of({model.get()}, &options);
    std::int32_t latency = 0;
    int num_late = 0;
    ASSERT_EQ(strut_translator_get_latency(translator.get(), &latency), STRUT_OK);
    EXPECT_EQ(latency, 12);
    const std::vector<Frame> frames = frames_of(translator.get(), walking.walk, num_late);
    EXPECT_EQ(num_late, latency);
    EXPECT_EQ(std::ssize(frames), walking.walk.num_frames());
    EXPECT_EQ(strut_translator_reset(translator.get()), STRUT_OK);
    EXPECT_EQ(frames_of(translator.get(), walking.walk, num_late), frames);
  }
}

TEST(Snapshots, OfAnotherLatencyAreRefused) {
  const Walking walking;
  const ModelHandle model = handle_of(*walking.model);
  strut_feet feet;
  ASSERT_EQ(strut_feet_init(&feet, sizeof feet), STRUT_OK);
  const strut_axes axes = axes_of(STRUT_CONVENTION_STRUT);
  const strut_translator_options options = options_with(feet, axes);
  const TranslatorHandle holding = translator_of({model.get()}, &options);
  const TranslatorHandle plain = translator_of({model.get()});
  strut_snapshot* snapshot = nullptr;
  ASSERT_EQ(strut_snapshot_create(holding.get(), &snapshot), STRUT_OK);
  const SnapshotHandle kept(snapshot);
  EXPECT_EQ(strut_translator_restore(plain.get(), snapshot), STRUT_INVALID_ARGUMENT);
  EXPECT_THAT(strut_last_error(), testing::HasSubstr("latency of 0 frames"));
  EXPECT_EQ(strut_snapshot_save(snapshot, plain.get()), STRUT_INVALID_ARGUMENT);
  Frame frame(walking.walk.frame(0));
  const strut_const_pose in = frame.in();
  const strut_pose out = frame.out();
  EXPECT_EQ(count_allocations([&] {
              for (int t = 0; t < 100; ++t) {
                EXPECT_EQ(strut_translator_push(holding.get(), &in, &out), t % 20 < 9 ? STRUT_NO_OUTPUT : STRUT_OK);
                if (t % 20 == 19) {
                  EXPECT_EQ(strut_translator_restore(holding.get(), snapshot), STRUT_OK);
                }
              }
            }),
            0);
}

TEST(Translators, WorkInPlace) {
  const ModelHandle model = handle_of(*models()[0]);
  for (const int convention : {STRUT_CONVENTION_STRUT, STRUT_CONVENTION_UNREAL}) {
    const strut_axes axes = axes_of(convention);
    strut_translator_options options;
    ASSERT_EQ(strut_translator_options_init(&options, sizeof options), STRUT_OK);
    options.axes = &axes;
    const TranslatorHandle apart = translator_of({model.get()}, &options);
    const TranslatorHandle in_place = translator_of({model.get()}, &options);
    Frame output(6);
    for (const Pose& pose : clip().frames()) {
      Frame both(pose);
      push(apart.get(), Frame(pose), output);
      push(in_place.get(), both, both);
      ASSERT_EQ(both, output);
    }
  }
}

/// Frame `t` of a stream in which everything is done that an engine does while it runs.
void use(strut_translator* translator, strut_snapshot* snapshot, int t, Frame& frame, strut_controls& controls) {
  push(translator, frame, frame);
  controls.strength = t % 2;
  controls.num_weights = t % 3 == 0 ? 2 : 0;
  controls.weights[t % 2] = 1.0 + t;
  EXPECT_EQ(strut_translator_set_controls(translator, &controls), STRUT_OK);
  EXPECT_EQ(strut_translator_get_controls(translator, &controls), STRUT_OK);
  if (t % 10 == 0) {
    EXPECT_EQ(strut_snapshot_save(snapshot, translator), STRUT_OK);
  }
  if (t % 10 == 5) {
    EXPECT_EQ(strut_translator_restore(translator, snapshot), STRUT_OK);
  }
  if (t % 20 == 19) {
    EXPECT_EQ(strut_translator_reset(translator), STRUT_OK);
  }
}

TEST(Allocations, OfAlignedMemoryAreCounted) {
  std::unique_ptr<math::AlignedVector<float>> kept;
  EXPECT_EQ(count_allocations([&] { kept = std::make_unique<math::AlignedVector<float>>(100); }), 2);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kept->data()) % 64, 0U);
}

TEST(Translators, TakeNoMemoryPerFrame) {
  const auto styles = models();
  const ModelHandle first = handle_of(*styles[0]);
  const ModelHandle second = handle_of(*styles[1]);
  const strut_axes axes = axes_of(STRUT_CONVENTION_UNREAL);
  strut_translator_options options;
  ASSERT_EQ(strut_translator_options_init(&options, sizeof options), STRUT_OK);
  for (const strut_axes* convention : {static_cast<const strut_axes*>(nullptr), &axes}) {
    options.axes = convention;
    TranslatorHandle translator;
    EXPECT_GT(count_allocations([&] { translator = translator_of({first.get(), second.get()}, &options); }), 10);
    strut_snapshot* snapshot = nullptr;
    EXPECT_GT(count_allocations([&] { strut_snapshot_create(translator.get(), &snapshot); }), 10);
    const SnapshotHandle kept(snapshot);
    strut_controls controls;
    ASSERT_EQ(strut_controls_init(&controls, sizeof controls), STRUT_OK);
    Frame frame(clip().frame(0));
    EXPECT_EQ(count_allocations([&] {
                for (int t = 0; t < 50; ++t) use(translator.get(), snapshot, t, frame, controls);
              }),
              0);
  }
}

TEST(Models, AreSharedByManyThreads) {
  const ModelHandle model = handle_of(*models()[0]);
  const Frame expected = translated(translator_of({model.get()}).get());
  constexpr int kThreads = 16;
  std::vector<int> same(kThreads, 0);
  std::vector<std::string> errors(kThreads);
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) {
        if (strut_model_retain(model.get()) != STRUT_OK) return;
        const ModelHandle own(model.get());
        same[i] += translated(translator_of({own.get()}).get()) == expected;
        strut_model_info info;
        info.struct_size = sizeof info;
        strut_model_get_joint(own.get(), 100 + i, nullptr, nullptr);
        errors[i] = strut_model_get_info(own.get(), &info) == STRUT_OK ? strut_last_error() : "";
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(same, testing::Each(20));
  for (int i = 0; i < kThreads; ++i) {
    EXPECT_THAT(errors[i], testing::EndsWith("got " + std::to_string(100 + i))) << "an error of another thread";
  }
}

TEST(Models, LiveAsLongAsTheirLastOwner) {
  const strut_model* model = handle_of(*models()[0]).release();
  strut_model_info info;
  info.struct_size = sizeof info;
  ASSERT_EQ(strut_model_get_info(model, &info), STRUT_OK);
  constexpr int kOwners = 8;
  for (int i = 0; i < kOwners; ++i) ASSERT_EQ(strut_model_retain(model), STRUT_OK);
  std::vector<std::thread> threads;
  for (int i = 0; i < kOwners; ++i) threads.emplace_back([&] { strut_model_release(model); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_STREQ(info.provenance, R"({"made": "by hand"})");
  strut_model_release(model);
}

TEST(LastError, IsCutWhereItIsTooLong) {
  std::string name = "e";
  for (int i = 0; i < 400; ++i) name += "\xC3\xA9";  // é: two bytes, at odd places
  strut_model* model = nullptr;
  EXPECT_EQ(strut_model_load_memory("x", 1, name.c_str(), &model), STRUT_BAD_FILE);
  EXPECT_EQ(std::string(strut_last_error()), name.substr(0, 511));
  name.insert(0, "e");
  EXPECT_EQ(strut_model_load_memory("x", 1, name.c_str(), &model), STRUT_BAD_FILE);
  EXPECT_EQ(std::string(strut_last_error()), name.substr(0, 510)) << "half a character";
}

}  // namespace
}  // namespace strut::test
