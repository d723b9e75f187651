// SPDX-License-Identifier: MIT
// Streams: both precisions, blends, snapshots, warm-up, batches, feet, threads.
#include "learn/example_walks.h"
#include "support/allocations.h"
#include "support/small_model.h"

#include <cmath>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/translate/translate_motion.h>
#include <strut/translate/translator_batch.h>

namespace strut {
namespace {

using Models = std::vector<std::shared_ptr<const StyleModel>>;

constexpr double kRate = 30.0;
constexpr double kSinglePrecision = 1e-4;  // [m] after two seconds of walking: rounded steps add up

Motion clip_of_two_seconds() {
  return test::turning_motion(kRate, 2.0);
}

template <typename Scalar>
std::vector<Pose> run(BasicTranslator<Scalar>& translator, const std::vector<Pose>& frames) {
  std::vector<Pose> result;
  Pose output;
  for (const Pose& frame : frames) {
    if (translator.push(frame, output)) result.push_back(output);
  }
  while (translator.flush(output)) result.push_back(output);
  return result;
}

TEST(Translator, IsNearlyTheSameInSinglePrecision) {
  const Motion clip = clip_of_two_seconds();
  for (const auto& model : test::remembering_models(clip)) {
    Translator precise(model);
    FloatTranslator rounded(model);
    const Motion a(clip.shared_skeleton(), kRate, run(precise, clip.frames()));
    const Motion b(clip.shared_skeleton(), kRate, run(rounded, clip.frames()));
    EXPECT_LT(test::largest_difference(a, b), kSinglePrecision);
    EXPECT_GT(test::largest_difference(a, b), 0.0);  // they are not one and the same
    EXPECT_GT(test::largest_difference(a, clip), 0.01);
  }
}

TEST(Translator, MayWriteWhereItReads) {
  const Motion clip = clip_of_two_seconds();
  for (const auto& model : test::remembering_models(clip)) {
    Translator apart(model), in_place(model);
    const std::vector<Pose> expected = run(apart, clip.frames());
    for (int t = 0; t < clip.num_frames(); ++t) {
      Pose pose = clip.frame(t);
      in_place.push(view(pose), view(pose));
      EXPECT_EQ(pose, expected[static_cast<std::size_t>(t)]);
    }
  }
}

TEST(Translator, GoesOnFromASnapshotAsIfNothingHadHappened) {
  const Motion clip = clip_of_two_seconds();
  const std::vector<Pose> first(clip.frames().begin(), clip.frames().begin() + 20);
  const std::vector<Pose> rest(clip.frames().begin() + 20, clip.frames().end());
  for (const auto& model : test::remembering_models(clip)) {
    Translator translator(model);
    run(translator, first);
    const Translator snapshot = translator;
    std::vector<std::byte> bytes(translator.state_size());
    translator.save_state(bytes.data());
    const std::vector<Pose> expected = run(translator, rest);
    EXPECT_EQ(test::count_allocations([&] { translator.restore(snapshot); }), 0);
    EXPECT_EQ(run(translator, rest), expected);
    EXPECT_EQ(test::count_allocations([&] { translator.load_state(bytes.data()); }), 0);
    EXPECT_EQ(run(translator, rest), expected);
    EXPECT_NE(run(translator, rest), expected);  // from elsewhere it goes on differently
    EXPECT_LT(translator.state_size(), 64U * 1024U);
  }
  Translator other(test::copying_model(clip));
  Translator translator(test::remembering_models(clip).front());
  EXPECT_THROW(translator.restore(other), InvalidArgument);
}

TEST(Translator, IsAnyOfItsModelsWhereThatHasAllTheWeight) {
  const Motion clip = clip_of_two_seconds();
  const Models models = test::remembering_models(clip);
  for (std::size_t only = 0; only < models.size(); ++only) {
    TranslatorControls controls;
    controls.weights = {0.0, 0.0};
    controls.weights[only] = 3.0;
    Translator blend(models, {.controls = controls});
    Translator alone(models[only]);
    EXPECT_LT(test::largest_difference(Motion(clip.shared_skeleton(), kRate, run(blend, clip.frames())),
                                       Motion(clip.shared_skeleton(), kRate, run(alone, clip.frames()))),
              1e-12);
  }
}

TEST(Translator, RefusesModelsThatDoNotFitTogether) {
  const Motion clip = clip_of_two_seconds();
  const auto model = test::copying_model(clip);
  const auto faster = test::copying_model(test::turning_motion(60.0, 2.0));
  EXPECT_THROW(Translator(Models{}), InvalidArgument);
  EXPECT_THROW(Translator(Models{model, nullptr}), InvalidArgument);
  EXPECT_THROW(Translator(Models{model, faster}), InvalidArgument);
  EXPECT_THROW(Translator(model, {.controls = {.weights = {1.0, 1.0}}}), InvalidArgument);
  EXPECT_THROW(Translator(model, {.glide = -1.0}), InvalidArgument);
  EXPECT_THROW(Translator(model, {.clean_feet = true}), InvalidArgument);  // it tells no footplants
}

TEST(Translator, GoesAlongWhereTheBodyIsPutElsewhereAndBack) {
  const Motion clip = clip_of_two_seconds();
  const Motion away = motion::moved(clip, {3e5, 0, -1e5}, 1.0);
  for (const auto& model : test::remembering_models(clip)) {
    Translator still(model), moved(model);
    Pose expected, pose;
    for (int t = 0; t < clip.num_frames(); ++t) {
      still.push(clip.frame(t), expected);
      moved.push(t >= 20 && t < 23 ? away.frame(t) : clip.frame(t), pose);
    }
    // Each of the two jumps guesses one frame's step.
    EXPECT_LT((pose.translations[1] - expected.translations[1]).norm(), 0.2);
    EXPECT_GT((expected.translations[1] - clip.frame(0).translations[1]).norm(), 0.4);
  }
}

TEST(Translator, WarmedUpItBeginsAsIfItHadRunBefore) {
  const Motion clip = test::turning_motion(kRate, 4.0);
  constexpr int kBefore = 60;
  const std::vector<Pose> rest(clip.frames().begin() + kBefore, clip.frames().end());
  for (const auto& model : test::remembering_models(clip)) {
    const auto first_error = [&](const std::function<void(Translator&)>& prepare) {
      Translator settled(model), fresh(model);
      Pose expected, pose;
      for (int t = 0; t <= kBefore; ++t) settled.push(clip.frame(t), expected);
      prepare(fresh);
      fresh.push(clip.frame(kBefore), pose);
      double error = 0.0;
      for (std::size_t j = 2; j < pose.rotations.size(); ++j)
        error += pose.rotations[j].angularDistance(expected.rotations[j]);
      return error;
    };
    const double cold = first_error([](Translator&) {});
    const double warm = first_error([&](Translator& fresh) { fresh.warm_up(rest, 10); });
    EXPECT_LT(warm, cold);
  }
  Translator running(test::remembering_models(clip).front());
  Pose pose;
  running.push(clip.frame(0), pose);
  EXPECT_THROW(running.warm_up(rest, 10), InvalidArgument);
  running.reset();
  EXPECT_THROW(running.warm_up({rest.front()}, 10), InvalidArgument);
}

TEST(TranslatorBatch, IsAsManyTranslatorsToTheBit) {
  const Motion clip = clip_of_two_seconds();
  constexpr int kCharacters = 3;
  const auto joints = static_cast<std::size_t>(clip.skeleton().num_joints());
  for (const auto& model : test::remembering_models(clip)) {
    TranslatorBatch<double> batch(model, kCharacters);
    std::vector<Translator> alone(kCharacters, Translator(model));
    const TranslatorControls half{.strength = 0.5};
    batch.set_controls(1, half);
    alone[1].set_controls(half);
    std::vector<double> rotations(kCharacters * 4 * joints), translations(kCharacters * 3 * joints);
    const PoseView<double> all{rotations.data(), translations.data(), static_cast<int>(joints)};
    Pose expected;
    for (int t = 0; t < 40; ++t) {
      if (t == 20) {
        batch.reset(2);
        alone[2].reset();
      }
      for (std::size_t c = 0; c < kCharacters; ++c) {
        const auto from = view(clip.frame(t + 3 * static_cast<int>(c)));
        std::copy_n(from.rotations, 4 * joints, rotations.begin() + static_cast<std::ptrdiff_t>(4 * joints * c));
        std::copy_n(from.translations, 3 * joints, translations.begin() + static_cast<std::ptrdiff_t>(3 * joints * c));
      }
      EXPECT_EQ(test::count_allocations([&] { batch.push(all, all); }), 0);
      for (std::size_t c = 0; c < kCharacters; ++c) {
        alone[c].push(clip.frame(t + 3 * static_cast<int>(c)), expected);
        EXPECT_TRUE(std::equal(rotations.begin() + static_cast<std::ptrdiff_t>(4 * joints * c),
                               rotations.begin() + static_cast<std::ptrdiff_t>(4 * joints * (c + 1)),
                               view(expected).rotations));
      }
    }
  }
}

TEST(TranslatorBatch, RefusesACharacterOrAFrameThatIsNone) {
  const Motion clip = clip_of_two_seconds();
  TranslatorBatch<float> batch(test::copying_model(clip), 2);
  EXPECT_THROW(batch.reset(2), InvalidArgument);
  EXPECT_THROW(batch.reset(-1), InvalidArgument);
  EXPECT_THROW(TranslatorBatch<float>(test::copying_model(clip), 0), InvalidArgument);
  std::vector<float> rotations(2 * 4 * 6, 0.5F), translations(2 * 3 * 6, 0.0F);
  rotations[4 * 6 + 4 * 2] = 9.0F;  // of the second character's third joint
  const PoseView<float> all{rotations.data(), translations.data(), 6};
  try {
    batch.push(all, all);
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(),
                 "input: expected unit rotations and translations of less than 10,000 km, got others at joint 2 of "
                 "character 1");
  }
}

// ---- feet, with a limp learnt from generated walks
// --------------------------------------------------------------------

const std::shared_ptr<const StyleModel>& limp() {
  static const auto model = test::learn_from(test::varied_clips()).model;
  return model;
}

Motion new_walk() {
  return generate::generate_walk(test::content(1.25, 0.1, 6.0), {.seed = 77}, test::kExampleRate).motion;
}

double slide(const Motion& motion) {
  const auto plants = postprocess::detect_footplants(motion, motion::find_legs(motion).value());
  return metrics::foot_slide(metrics::body_track(motion, motion.frame_rate()), plants).speed;
}

TEST(TranslatorFeet, AreHeldInTheStreamAfterItsLatency) {
  const Motion walk = new_walk();
  Translator plain(limp()), cleaning(limp(), {.clean_feet = true});
  EXPECT_EQ(plain.latency(), 0);
  EXPECT_EQ(cleaning.latency(), 9);  // 0.3 s at 30 frames/s
  Pose output;
  for (int t = 0; t < walk.num_frames(); ++t) EXPECT_EQ(cleaning.push(walk.frame(t), output), t >= 9);
  for (int t = 0; t < 9; ++t) EXPECT_TRUE(cleaning.flush(output));
  EXPECT_FALSE(cleaning.flush(output));
  cleaning.reset();
  const Motion slid(walk.shared_skeleton(), walk.frame_rate(), run(plain, walk.frames()));
  const Motion held(walk.shared_skeleton(), walk.frame_rate(), run(cleaning, walk.frames()));
  ASSERT_EQ(held.num_frames(), walk.num_frames());
  EXPECT_GT(slide(slid), 0.02);  // [m/s]
  EXPECT_LT(slide(held), 0.25 * slide(slid));
}

TEST(TranslatorFeet, AllocateNothingAndGoOnFromASnapshot) {
  const Motion walk = new_walk();
  Translator translator(limp(), {.clean_feet = true});
  Pose output = walk.frame(0);
  const auto push = [&](int begin, int end) {
    for (int t = begin; t < end; ++t) translator.push(walk.frame(t), output);
  };
  EXPECT_EQ(test::count_allocations([&] { push(0, 60); }), 0);
  const Translator snapshot = translator;
  push(60, 100);
  const Pose expected = output;
  translator.restore(snapshot);
  push(60, 100);
  EXPECT_EQ(output, expected);
  EXPECT_THROW((void)translator.state_size(), InvalidArgument);
}

TEST(TranslateMotionFeet, AreHeldUnlessToldNotTo) {
  const Motion walk = new_walk();
  EXPECT_LT(slide(translate_motion(limp(), walk)), 0.01);  // [m/s]
  EXPECT_GT(slide(translate_motion(limp(), walk, {.clean_feet = false})), 0.02);
}

TEST(Translator, SharesItsModelWithOtherThreads) {
  const Motion walk = new_walk();
  const auto frames = [&] {
    Translator translator(limp(), {.clean_feet = true});
    return run(translator, walk.frames());
  };
  const std::vector<Pose> expected = frames();
  std::vector<std::vector<Pose>> found(4);
  std::vector<std::thread> threads;
  for (auto& result : found) threads.emplace_back([&result, &frames] { result = frames(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : found) EXPECT_EQ(result, expected);
}

}  // namespace
}  // namespace strut
