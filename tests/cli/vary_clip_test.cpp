// SPDX-License-Identifier: MIT
// The program that makes inputs no take shows, for ./dev quality, and says what a translation made of them.
#include "support/program.h"
#include "support/walks.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/io/bvh.h>
#include <strut/motion/annotation.h>
#include <strut/motion/kinematics.h>

namespace strut::test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kMillimetre = 1e-3;  // BVH files hold a few decimals of a centimetre and of a degree
constexpr double kPrinted = 1e-3;     // of shares and correlations, for the same reason

class VaryClip : public testing::Test {
 protected:
  VaryClip() { write_clip(here_.file("walk.bvh"), walk_); }

  ProgramResult run(const std::vector<std::string>& arguments) { return here_.run(STRUT_VARY_CLIP, arguments); }

  /// The walk varied; `frames` says where.
  Motion varied(std::vector<std::string> variation, motion::FrameRange* frames = nullptr) {
    std::filesystem::remove(here_.file("varied.bvh"));
    variation.insert(variation.begin(), {"@walk.bvh", "@varied.bvh"});
    const ProgramResult result = run(variation);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json json = Json::parse(result.out);
    if (frames != nullptr) *frames = {json.at("begin"), json.at("end")};
    return read_bvh(here_.file("varied.bvh")).motion;
  }

  Vector3d position(const Motion& motion, int frame, const std::string& joint) {
    const auto world = motion::forward_kinematics(motion.skeleton(), motion.frame(frame));
    return world.positions.at(static_cast<std::size_t>(motion.skeleton().find(joint)));
  }

  Workplace here_;
  Motion walk_ = short_walk(0.0);
};

TEST_F(VaryClip, DucksOnFeetThatStayWhereTheyWere) {
  motion::FrameRange frames;
  const Motion ducked = varied({"duck", "0.25"}, &frames);
  ASSERT_EQ(ducked.num_frames(), walk_.num_frames());
  EXPECT_GE(frames.num_frames(), walk_.num_frames() / 4);
  const double leg = 0.435 + 0.425;  // of the walker [m]
  for (int t = frames.begin; t < frames.end; ++t) {
    EXPECT_NEAR(position(walk_, t, "Hips").y() - position(ducked, t, "Hips").y(), 0.25 * leg, kMillimetre);
    for (const char* joint : {"LeftFoot", "RightFoot", "LeftToe", "RightToe"}) {
      EXPECT_LT((position(ducked, t, joint) - position(walk_, t, joint)).norm(), 2 * kMillimetre) << joint;
    }
  }
  EXPECT_LT((position(ducked, 0, "Hips") - position(walk_, 0, "Hips")).norm(), kMillimetre);
}

TEST_F(VaryClip, LiftsAnArmAndNothingElse) {
  motion::FrameRange frames;
  const Motion raised = varied({"raise", "RightArm", "140"}, &frames);
  const int middle = (frames.begin + frames.end) / 2;
  EXPECT_GT(position(raised, middle, "RightHand").y(), position(raised, middle, "RightArm").y() + 0.2);
  EXPECT_LT(position(walk_, middle, "RightHand").y(), position(walk_, middle, "RightArm").y());
  EXPECT_LT((position(raised, middle, "LeftHand") - position(walk_, middle, "LeftHand")).norm(), kMillimetre);
}

TEST_F(VaryClip, StandsStillForAWhile) {
  motion::FrameRange frames;
  const Motion halted = varied({"halt", "1.5"}, &frames);
  EXPECT_NEAR(frames.num_frames() / walk_.frame_rate(), 1.5, 0.1);
  for (const char* joint : {"Hips", "LeftFoot", "RightHand"}) {
    EXPECT_LT((position(halted, frames.begin, joint) - position(halted, frames.end - 1, joint)).norm(), kMillimetre);
  }
  EXPECT_GT(halted.duration(), walk_.duration() + 1.5);
}

TEST_F(VaryClip, ChangesTempoAndSize) {
  EXPECT_NEAR(varied({"stretch", "1.25"}).duration(), 1.25 * walk_.duration(), 0.1);
  const Motion smaller = varied({"resize", "0.8"});
  EXPECT_LT((position(smaller, 20, "RightHand") - 0.8 * position(walk_, 20, "RightHand")).norm(), kMillimetre);
}

TEST_F(VaryClip, MeasuresHowAJointAnswers) {
  varied({"bend", "Chest", "least", "15", "0.8"});
  const auto response = [&](const std::string& joint, const std::string& out, const std::string& varied_out) {
    return Json::parse(run({"--response", joint, "@walk.bvh", "@varied.bvh", out, varied_out}).out);
  };
  const Json same = response("Chest", "@walk.bvh", "@varied.bvh");
  EXPECT_NEAR(same.at("share"), 1.0, kPrinted);
  EXPECT_NEAR(same.at("correlation"), 1.0, kPrinted);
  EXPECT_NEAR(same.at("gain"), 1.0, kPrinted);
  EXPECT_NEAR(response("Chest", "@varied.bvh", "@walk.bvh").at("correlation"), -1.0, kPrinted);
  EXPECT_NEAR(response("Head", "@walk.bvh", "@varied.bvh").at("share"), 0.0, kPrinted);
  EXPECT_EQ(response("Chest", "@walk.bvh", "@walk.bvh").at("share"), 0.0);
}

TEST_F(VaryClip, MeasuresHowFarClipsAreApartFrameByFrame) {
  varied({"duck", "0.25"});
  const auto distance = [&](const std::string& begin, const std::string& end) {
    return Json::parse(run({"--distance", "@walk.bvh", "@varied.bvh", begin, end}).out).at("distance_cm").get<double>();
  };
  EXPECT_NEAR(distance("0", "5"), 0.0, 0.1);
  EXPECT_GT(distance("40", "50"), 10.0);
}

TEST_F(VaryClip, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run({"@walk.bvh", "@varied.bvh", "fly"}).exit_code, 2);
  EXPECT_EQ(run({"@walk.bvh", "@varied.bvh", "duck", "deep"}).exit_code, 2);
  const ProgramResult result = run({"@walk.bvh", "@varied.bvh", "raise", "Tail", "140"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("expected a joint of the clip, got 'Tail'"));
}

}  // namespace
}  // namespace strut::test
