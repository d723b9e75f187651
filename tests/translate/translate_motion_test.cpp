// SPDX-License-Identifier: MIT
#include "support/allocations.h"
#include "support/small_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>
#include <strut/translate/translate_motion.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

constexpr double kRoundTrip = 1e-9;  // encode, copy, decode [m]

TEST(TranslateMotion, OfACopyingModelIsTheIdentity) {
  const Motion clip = test::turning_motion(30.0, 3.0);
  EXPECT_LT(test::largest_difference(translate_motion(test::copying_model(clip), clip), clip), kRoundTrip);
}

TEST(TranslateMotion, RetimesUnlessToldNotTo) {
  const Motion clip = test::turning_motion(30.0, 3.0);
  const auto slower = test::copying_model(clip, std::log(1.5));
  EXPECT_EQ(translate_motion(slower, clip).num_frames(), 134);  // 89 intervals, each half as long again, and one
  EXPECT_EQ(translate_motion(slower, clip, {.retime = false}).num_frames(), clip.num_frames());
  EXPECT_EQ(translate_motion(slower, clip, {.controls = {.strength = 0.0}}).num_frames(), clip.num_frames());
}

TEST(TranslateMotion, ResamplesOtherFrameRatesThereAndBack) {
  const Motion clip = test::turning_motion(120.0, 3.0);
  Diagnostics diagnostics;
  const Motion result = translate_motion(test::copying_model(motion::resample(clip, 30.0)), clip, {}, &diagnostics);
  EXPECT_EQ(result.frame_rate(), 120.0);
  EXPECT_NEAR(result.duration(), clip.duration(), 0.05);
  EXPECT_EQ(diagnostics.entries().size(), 1U);
}

constexpr double kMoment = 1e-9;  // rounding [frames]

TEST(TranslateMotion, TellsTheMomentsOfTheOutputThatBelongToTheInput) {
  const Motion clip = test::turning_motion(30.0, 3.0);
  const std::vector<std::shared_ptr<const StyleModel>> slower{test::copying_model(clip, std::log(1.5))};
  const Translation result = translate_with_moments(slower, clip);
  ASSERT_EQ(result.moments.size(), clip.num_frames());
  for (int frame = 0; frame < clip.num_frames(); ++frame) {
    EXPECT_NEAR(result.moments[frame], std::min(1.5 * frame, result.motion.num_frames() - 1.0), kMoment) << frame;
  }
  const Translation untimed = translate_with_moments(slower, clip, {.retime = false});
  for (int frame = 0; frame < clip.num_frames(); ++frame) EXPECT_NEAR(untimed.moments[frame], frame, kMoment);
}

TEST(TranslateMotion, TellsMomentsInTheClipsOwnFramesWhateverTheModelsRate) {
  const Motion clip = test::turning_motion(120.0, 3.0);
  const std::vector<std::shared_ptr<const StyleModel>> faster{
      test::copying_model(motion::resample(clip, 30.0), std::log(0.5))};
  const Translation result = translate_with_moments(faster, clip);
  ASSERT_EQ(result.moments.size(), clip.num_frames());
  for (const int frame : {0, 1, 2, 100, 250}) EXPECT_NEAR(result.moments[frame], 0.5 * frame, kMoment);
  EXPECT_LE(result.moments[clip.num_frames() - 1], result.motion.num_frames() - 1.0);
}

TEST(TranslateMotion, IsTheTranslatorFrameByFrameToTheBit) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  std::vector<Pose> frames = clip.frames();
  for (const auto& model : test::remembering_models(clip)) {
    const Motion whole =
        translate_motion(model, clip, {.controls = {.strength = 0.8}, .retime = false, .warm_up = 0.0});
    Translator translator(model, {.controls = {.strength = 0.8}});
    for (std::size_t t = 0; t < frames.size(); ++t) translator.push(clip.frames()[t], frames[t]);
    EXPECT_EQ(Motion(clip.shared_skeleton(), 30.0, frames).frames(), whole.frames());
  }
}

TEST(TranslateMotion, IsBlindToWhereTheClipStands) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  const Motion moved = motion::moved(clip, {2, 0, 5}, 1.0);
  for (const auto& model : test::remembering_models(clip)) {
    EXPECT_LT(test::largest_difference(motion::moved(translate_motion(model, clip), {2, 0, 5}, 1.0),
                                       translate_motion(model, moved)),
              kRoundTrip);
  }
}

TEST(TranslateMotion, RefusesOtherSkeletonsAndShortClips) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  const auto model = test::copying_model(clip);
  const auto other = std::make_shared<const Skeleton>(std::vector<Joint>{{"hips", -1}, {"a", 0}, {"b", 0}});
  EXPECT_THROW(translate_motion(model, Motion(other, 30.0, {rest_pose(*other), rest_pose(*other)})), SkeletonMismatch);
  EXPECT_THROW(translate_motion(model, clip.slice(0, 1)), InvalidArgument);
  EXPECT_THROW(translate_motion(model, clip, {.controls = {.strength = 2.0}}), InvalidArgument);
  EXPECT_THROW(translate_motion(model, clip, {.warm_up = -1.0}), InvalidArgument);
}

TEST(TranslateMotion, AcceptsOtherBoneLengths) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  auto joints = clip.skeleton().joints();
  joints[5].offset *= 1.5;
  std::vector<Pose> frames = clip.frames();
  for (Pose& pose : frames) pose.translations[5] *= 1.5;
  const Motion taller(std::make_shared<const Skeleton>(joints), 30.0, frames);
  EXPECT_LT(test::largest_difference(translate_motion(test::copying_model(clip), taller), taller), kRoundTrip);
}

TEST(Translator, GivesTheInputBackThroughACopyingModelAtAnyStrength) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  for (const double strength : {0.0, 0.5, 1.0, 1.5}) {
    Translator translator(test::copying_model(clip, 0.2),
                          {.controls = {.strength = strength}, .generalization = {.enabled = false}});
    std::vector<Pose> frames(clip.frames().size());
    for (std::size_t t = 0; t < frames.size(); ++t) translator.push(clip.frames()[t], frames[t]);
    EXPECT_LT(test::largest_difference(Motion(clip.shared_skeleton(), 30.0, frames), clip), kRoundTrip) << strength;
    EXPECT_NEAR(translator.time_warp(), std::exp(0.2 * strength), 1e-12);
  }
}

TEST(Translator, StrengthZeroIsTheInputWhateverTheModel) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  auto parts = test::copying_parts(clip);
  for (auto& block : parts.blocks) {
    block.system =
        sysid::LtiSystem({}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0), 0.5 * Eigen::MatrixXd::Ones(1, 1));
  }
  const auto model = std::make_shared<const StyleModel>(std::move(parts));
  EXPECT_LT(test::largest_difference(translate_motion(model, clip, {.controls = {.strength = 0.0}}), clip), kRoundTrip);
  EXPECT_GT(test::largest_difference(translate_motion(model, clip, {.controls = {.strength = 1.0}}), clip), 0.1);
}

TEST(Translator, ChangesNothingWhenItRefusesAFrame) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  Translator a(test::copying_model(clip));
  Translator b(test::copying_model(clip));
  Pose bad = clip.frame(5);
  bad.translations[2].x() = NAN;
  Pose from_a, from_b;
  for (int t = 0; t < clip.num_frames(); ++t) {
    if (t == 5) {
      EXPECT_THROW(a.push(bad, from_a), InvalidArgument);
    }
    a.push(clip.frame(t), from_a);
    b.push(clip.frame(t), from_b);
    EXPECT_EQ(from_a, from_b) << t;
  }
  bad = clip.frame(5);
  bad.rotations.pop_back();
  EXPECT_THROW(a.push(bad, from_a), InvalidArgument);
}

TEST(Translator, ForgetsOnReset) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  for (const auto& model : test::remembering_models(clip)) {
    Translator translator(model);
    Pose first, again;
    translator.push(clip.frame(0), first);
    translator.push(clip.frame(20), again);
    translator.reset();
    translator.push(clip.frame(0), again);
    EXPECT_EQ(first, again);
  }
}

TEST(Translator, AllocatesNothingOnceTheOutputHasItsSize) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  for (const auto& model : test::remembering_models(clip)) {
    Translator translator(model);
    Pose output;
    EXPECT_GT(test::count_allocations([&] { translator.push(clip.frame(0), output); }), 0);  // it gets its size
    EXPECT_EQ(test::count_allocations([&] {
                for (const Pose& frame : clip.frames()) translator.push(frame, output);
              }),
              0);
  }
}

}  // namespace
}  // namespace strut
