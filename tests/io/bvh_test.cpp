// SPDX-License-Identifier: MIT
// What is read and what is guessed; bvh_write_test.cpp has what is written, bvh_malformed_test.cpp what is refused.
#include "support/data.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>

namespace strut {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kRounding = 1e-12;  // a dozen products of numbers near one
constexpr double kRadians = std::numbers::pi / 180.0;
const BvhReadOptions kCentimetresYUp = {LengthUnit::kCentimetre, UpAxis::kY};

std::string file_text(const std::string& name) {
  return read_file(test::test_file("data/" + name));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string person() {
  return file_text("person.bvh");
}

Eigen::Quaterniond turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kRadians, axis));
}
const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(), kZ = Eigen::Vector3d::UnitZ();

std::vector<std::string> messages_of(const Diagnostics& diagnostics) {
  std::vector<std::string> messages;
  for (const auto& entry : diagnostics.entries()) messages.push_back(entry.where + ": " + entry.message);
  return messages;
}

std::vector<std::string> reports(const std::string& text, const BvhReadOptions& options = kCentimetresYUp) {
  Diagnostics diagnostics;
  parse_bvh(text, "a.bvh", options, &diagnostics);
  return messages_of(diagnostics);
}

/// Motions are equal to the bit: the spelling of a file must not matter.
void expect_same(const Motion& a, const Motion& b) {
  ASSERT_EQ(a.num_frames(), b.num_frames());
  EXPECT_EQ(a.frame_rate(), b.frame_rate());
  for (int i = 0; i < a.num_frames(); ++i) EXPECT_TRUE(a.frame(i) == b.frame(i)) << "frame " << i;
}

// --- channels -------------------------------------------------------------------------------------------------------

TEST(BvhChannels, RotateIntrinsicallyInTheOrderListedPerJoint) {
  const Motion motion = parse_bvh(file_text("channel_orders.bvh"), "a", kCentimetresYUp).motion;
  const Pose& pose = motion.frame(0);
  EXPECT_LT(pose.rotations[0].angularDistance(turn(10, kZ) * turn(20, kY) * turn(30, kX)), 1e-7);
  EXPECT_LT(pose.rotations[1].angularDistance(turn(40, kZ) * turn(50, kX) * turn(60, kY)), 1e-7);
}

TEST(BvhChannels, MayPutPositionsAfterRotations) {
  const Motion motion = parse_bvh(file_text("channel_orders.bvh"), "a", kCentimetresYUp).motion;
  EXPECT_LT((motion.frame(0).translations[0] - Eigen::Vector3d(0.01, 0.90, 0.02)).norm(), kRounding);
}

TEST(BvhChannels, MayBeAnySubset) {
  const BvhClip clip = parse_bvh(file_text("channel_orders.bvh"), "a", kCentimetresYUp);
  const Pose& pose = clip.motion.frame(0);
  EXPECT_EQ(clip.layout.num_channels(), 13);
  EXPECT_LT(pose.rotations[2].angularDistance(turn(70, kY)), 1e-7);
  EXPECT_EQ(pose.rotations[3].coeffs(), Eigen::Quaterniond::Identity().coeffs());
  EXPECT_LT(pose.rotations[4].angularDistance(turn(80, kZ) * turn(-15, kX)), 1e-7);
  // A single position channel: the other axes keep their OFFSET.
  EXPECT_LT((pose.translations[4] - Eigen::Vector3d(0.05, 0.07, 0.0)).norm(), kRounding);
}

TEST(BvhChannels, OnInnerJointsReplaceTheOffset) {
  const Motion motion = parse_bvh(file_text("inner_positions.bvh"), "a", kCentimetresYUp).motion;
  EXPECT_LT((motion.frame(1).translations[1] - Eigen::Vector3d(-0.004, 0.945, 0.08)).norm(), kRounding);
  EXPECT_LT((motion.skeleton().joint(1).offset - Eigen::Vector3d(-0.005, 0.935, -0.02)).norm(), kRounding);
}

TEST(BvhChannels, OnInnerJointsAddToTheOffsetIfAsked) {
  BvhReadOptions options = kCentimetresYUp;
  options.positions = PositionChannels::kAddToOffset;
  const Motion motion = parse_bvh(file_text("inner_positions.bvh"), "a", options).motion;
  EXPECT_LT((motion.frame(1).translations[1] - Eigen::Vector3d(-0.009, 1.88, 0.06)).norm(), kRounding);
}

TEST(BvhPose, HasTheWorldPositionsWorkedOutByHand) {
  const std::string text = replaced(file_text("two_joints.bvh"), "0 90 0 0 0 0 10 20 30", "1 90 2 90 0 0 0 0 0");
  const Motion motion = parse_bvh(text, "a", kCentimetresYUp).motion;
  const auto world = motion::forward_kinematics(motion.skeleton(), motion.frame(0));
  // A quarter turn about Z carries the chest's OFFSET (0, 50, 0) to (-50, 0, 0).
  EXPECT_LT((world.positions[1] - Eigen::Vector3d(-0.49, 0.90, 0.02)).norm(), kRounding);
}

TEST(BvhPose, TakesAnglesBeyondAHalfTurn) {
  const auto text = [](const std::string& angle) {
    return replaced(file_text("two_joints.bvh"), "0 90 0 0 0 0 10 20 30", "0 90 0 0 0 0 " + angle + " 20 30");
  };
  const Motion wound = parse_bvh(text("730"), "a", kCentimetresYUp).motion;
  const Motion plain = parse_bvh(text("10"), "a", kCentimetresYUp).motion;
  EXPECT_LT(wound.frame(0).rotations[1].angularDistance(plain.frame(0).rotations[1]), 1e-7);
}

// --- spelling -------------------------------------------------------------------------------------------------------

TEST(BvhSpelling, IgnoresCaseOfKeywords) {
  std::string text = person();
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"HIERARCHY", "hierarchy"},
                                                                                 {"ROOT", "Root"},
                                                                                 {"JOINT", "joint"},
                                                                                 {"OFFSET", "Offset"},
                                                                                 {"CHANNELS", "channels"},
                                                                                 {"Xposition", "XPosition"},
                                                                                 {"Zrotation", "ZROTATION"},
                                                                                 {"End Site", "END SITE"},
                                                                                 {"MOTION", "Motion"},
                                                                                 {"Frames", "FRAMES"},
                                                                                 {"Frame Time", "frame time"}}) {
    text = replaced(text, from, to);
  }
  expect_same(parse_bvh(text, "a").motion, parse_bvh(person(), "b").motion);
}

TEST(BvhSpelling, TakesTabsAndCarriageReturns) {
  const std::string text = replaced(replaced(person(), " ", "\t"), "\n", "\r\n");
  const BvhClip clip = parse_bvh(text, "a");
  expect_same(clip.motion, parse_bvh(person(), "b").motion);
  EXPECT_EQ(clip.motion.skeleton().joint(0).name, "Hips");
  EXPECT_EQ(clip.layout.line_end, "\r\n");
}

TEST(BvhSpelling, TakesAByteOrderMark) {
  expect_same(parse_bvh("\xEF\xBB\xBF" + person(), "a").motion, parse_bvh(person(), "b").motion);
}

TEST(BvhSpelling, TakesAMissingFinalNewline) {
  std::string text = person();
  ASSERT_EQ(text.back(), '\n');
  text.pop_back();
  EXPECT_THAT(reports(text), IsEmpty());
  expect_same(parse_bvh(text, "a").motion, parse_bvh(person(), "b").motion);
}

TEST(BvhSpelling, TakesBlankLinesAnywhere) {
  const std::string text = "\n \n" + replaced(person(), "\n", " \n\t\n\n");
  EXPECT_THAT(reports(text), IsEmpty());
  expect_same(parse_bvh(text, "a").motion, parse_bvh(person(), "b").motion);
}

TEST(BvhSpelling, TakesTheFrameCountWithOrWithoutSpace) {
  for (const char* spelling : {"Frames:3", "Frames :3", "Frames:\t3", "Frames  :  3"}) {
    EXPECT_EQ(parse_bvh(replaced(person(), "Frames: 3", spelling), "a").motion.num_frames(), 3) << spelling;
  }
  EXPECT_EQ(parse_bvh(replaced(person(), "Frame Time: ", "Frame Time:"), "a").motion.frame_rate(), 30.0);
}

TEST(BvhSpelling, TakesBracesOnTheLineOfTheName) {
  const std::string text = replaced(replaced(person(), "\n{", " {"), "\n\t{", "{");
  const Motion motion = parse_bvh(text, "a").motion;
  expect_same(motion, parse_bvh(person(), "b").motion);
  EXPECT_EQ(motion.skeleton().joint(1).name, "Spine");
}

TEST(BvhSpelling, TakesNumbersInEveryNotation) {
  std::string text = file_text("two_joints.bvh");
  text = replaced(text, "1 91 2 3 4 5 -10 -20 -30", "+1 9.1e1 2E+0 1e-5 -0 .5 -10. -2e-400 +.30e2");
  const auto values = *parse_bvh(text, "a").layout.source_values;
  EXPECT_THAT(std::vector<double>(values.begin() + 9, values.end()),
              ElementsAre(1.0, 91.0, 2.0, 1e-5, 0.0, 0.5, -10.0, 0.0, 30.0));
}

TEST(BvhNames, MayHoldSpacesAndColonsAndRepeat) {
  const Skeleton skeleton = parse_bvh(file_text("names.bvh"), "a").motion.skeleton();
  ASSERT_EQ(skeleton.num_joints(), 4);
  EXPECT_EQ(skeleton.joint(0).name, "mixamorig:Hips");
  EXPECT_EQ(skeleton.joint(1).name, "Left Up Leg");
  EXPECT_EQ(skeleton.joint(2).name, "Twin");
  EXPECT_EQ(skeleton.joint(3).name, "Twin");
  EXPECT_EQ(skeleton.joint(3).parent, 2);
}

TEST(BvhNames, MayBeGivenToEndSites) {
  const Skeleton skeleton = parse_bvh(file_text("names.bvh"), "a", kCentimetresYUp).motion.skeleton();
  EXPECT_TRUE(skeleton.joint(1).has_end_site);
  EXPECT_LT((skeleton.joint(1).end_site - Eigen::Vector3d(0.0, -0.05, 0.0)).norm(), kRounding);
  EXPECT_FALSE(skeleton.joint(3).has_end_site);
}

TEST(BvhHierarchy, TakesEndSitesOfLengthZero) {
  const Skeleton skeleton = parse_bvh(file_text("inner_positions.bvh"), "a").motion.skeleton();
  EXPECT_TRUE(skeleton.joint(2).has_end_site);
  EXPECT_EQ(skeleton.joint(2).end_site, Eigen::Vector3d::Zero());
}

// --- frames ---------------------------------------------------------------------------------------------------------

TEST(BvhFrames, AreAllReadWhenTheHeaderCountsFewer) {
  const std::string text = replaced(person(), "Frames: 3", "Frames: 2");
  EXPECT_EQ(parse_bvh(text, "a").motion.num_frames(), 3);
  EXPECT_THAT(reports(text), ElementsAre("a.bvh:50: the header says 2 frames, the file holds 3; all of them are read"));
}

TEST(BvhFrames, AreAllReadWhenTheHeaderCountsMore) {
  const std::string text = replaced(person(), "Frames: 3", "Frames: 400");
  EXPECT_EQ(parse_bvh(text, "a").motion.num_frames(), 3);
  EXPECT_THAT(reports(text),
              ElementsAre("a.bvh:50: the header says 400 frames, the file holds 3; all of them are read"));
}

TEST(BvhFrames, LeaveOutALastRowThatIsCutOff) {
  for (const char* ending : {"-16.00 0.00 0.00 7.00 0.00\n", "7.00 0.00\n", "00 0.00\n", " 0.00\n"}) {
    const std::string text = person();
    const std::string cut = text.substr(0, text.rfind(ending));
    EXPECT_EQ(parse_bvh(cut, "a").motion.num_frames(), 2) << ending;
    EXPECT_THAT(reports(cut), testing::Contains(HasSubstr("a.bvh:54: the last row is cut off after"))) << ending;
  }
}

TEST(BvhFrames, LeaveOutALastNumberWithoutItsExponent) {
  const std::string text = file_text("two_joints.bvh");
  const std::string cut = text.substr(0, text.rfind("-30")) + "3e-";
  EXPECT_EQ(parse_bvh(cut, "a").motion.num_frames(), 1);
}

TEST(BvhFrames, MayBeNone) {
  const std::string text = replaced(person().substr(0, person().find("0.00 90.00")), "Frames: 3", "Frames: 0");
  const Motion motion = parse_bvh(text, "a").motion;
  EXPECT_EQ(motion.num_frames(), 0);
  EXPECT_EQ(motion.skeleton().num_joints(), 7);
}

TEST(BvhFrameTime, SnapsToTheUsualRates) {
  const std::vector<std::pair<std::string, double>> printed = {
      {"0.0416667", 24}, {"0.04", 25},  {"0.0333333", 30},   {"0.033333", 30},
      {"0.0208333", 48}, {"0.02", 50},  {"0.016667", 60},    {"0.013889", 72},
      {"0.0111111", 90}, {"0.01", 100}, {"0.00833333", 120}, {"0.0041667", 240}};
  for (const auto& [text, rate] : printed) {
    const BvhClip clip = parse_bvh(replaced(person(), "0.033333", text), "a");
    EXPECT_EQ(clip.motion.frame_rate(), rate) << text;
    EXPECT_EQ(clip.layout.frame_time, text);
  }
}

TEST(BvhFrameTime, IsTakenAsItStandsElsewhere) {
  for (const double frame_time : {0.0336, 0.033, 0.1, 1.0, 0.0078125}) {
    const std::string text = replaced(person(), "0.033333", std::to_string(frame_time));
    EXPECT_NEAR(parse_bvh(text, "a").motion.frame_rate(), 1.0 / std::stod(std::to_string(frame_time)), 1e-12);
  }
}

// --- units and axes -------------------------------------------------------------------------------------------------

/// person.bvh with every length divided by `divisor`.
std::string person_in_units_of(double divisor) {
  const BvhClip clip = parse_bvh(person(), "a", kCentimetresYUp);
  std::vector<Joint> joints = clip.motion.skeleton().joints();
  for (Joint& joint : joints) joint.offset /= divisor, joint.end_site /= divisor;
  std::vector<Pose> frames = clip.motion.frames();
  for (Pose& pose : frames) {
    for (auto& translation : pose.translations) translation /= divisor;
  }
  const Motion motion(std::make_shared<const Skeleton>(joints), 30.0, frames);
  return format_bvh(motion, default_layout(motion.skeleton(), LengthUnit::kMetre));
}

TEST(BvhUnits, AreGuessedFromTheSkeletonsSize) {
  for (const LengthUnit unit :
       {LengthUnit::kMetre, LengthUnit::kCentimetre, LengthUnit::kMillimetre, LengthUnit::kInch, LengthUnit::kFoot}) {
    const BvhClip clip = parse_bvh(person_in_units_of(metres_per(unit)), "a");
    EXPECT_EQ(clip.layout.unit, unit) << plural_name(unit);
    EXPECT_NEAR(clip.motion.frame(0).translations[0].y(), 0.9, 1e-5);
    EXPECT_NEAR(clip.motion.skeleton().joint(1).offset.y(), 0.25, 1e-5);
  }
}

TEST(BvhUnits, HoldForChildrenAndGiants) {
  for (const double size : {0.7, 1.25}) {
    EXPECT_EQ(parse_bvh(person_in_units_of(0.01 / size), "a").layout.unit, LengthUnit::kCentimetre) << size;
  }
}

TEST(BvhUnits, AreReportedWhenGuessed) {
  EXPECT_THAT(reports(person(), {}),
              ElementsAre("a.bvh: lengths read as centimetres (the skeleton spans 166), Y as up"));
  EXPECT_THAT(reports(person(), {LengthUnit::kCentimetre, std::nullopt}), ElementsAre("a.bvh: Y as up"));
  EXPECT_THAT(reports(person(), kCentimetresYUp), IsEmpty());
}

TEST(BvhUnits, MayBeGiven) {
  const BvhClip clip = parse_bvh(person(), "a", {LengthUnit::kInch, UpAxis::kY});
  EXPECT_NEAR(clip.motion.frame(0).translations[0].y(), 90.0 * 0.0254, kRounding);
  EXPECT_THAT(reports(person(), {LengthUnit::kInch, UpAxis::kY}),
              ElementsAre("a.bvh: the skeleton spans 4.21 m, which no person does"));
}

TEST(BvhUpAxis, IsGuessedFromTheMainAxis) {
  EXPECT_EQ(parse_bvh(person(), "a").layout.up, UpAxis::kY);
  const BvhClip clip = parse_bvh(file_text("person_z_up.bvh"), "a");
  EXPECT_EQ(clip.layout.up, UpAxis::kZ);
  EXPECT_EQ(clip.layout.unit, LengthUnit::kMetre);
}

TEST(BvhUpAxis, MayBeGiven) {
  EXPECT_EQ(parse_bvh(person(), "a", {std::nullopt, UpAxis::kZ}).layout.up, UpAxis::kZ);
}

TEST(BvhUpAxis, IsNotFooledByABodyThatLiesDownFirst) {
  // The root is turned by a quarter about X and lies on the ground; the rest pose stands along Y.
  const std::string lying = replaced(person(), "0.00 90.00 0.00 1.00 2.00 3.00", "0.00 10.00 400.00 0.00 90.00 0.00");
  EXPECT_EQ(parse_bvh(lying, "a").layout.up, UpAxis::kY);
}

TEST(BvhUpAxis, IsThatOfTheFirstFrameWhereTheRootTurnsTheBodyUpright) {
  const std::string turned = replaced(person(), "0.00 90.00 0.00 1.00 2.00 3.00", "50.00 400.00 90.00 0.00 90.00 0.00");
  EXPECT_EQ(parse_bvh(turned, "a").layout.up, UpAxis::kZ);
}

TEST(BvhUpAxis, TurnsAZUpFileAsAWhole) {
  const Motion z_as_y = parse_bvh(file_text("person_z_up.bvh"), "a", {LengthUnit::kMetre, UpAxis::kY}).motion;
  const Motion z_up = parse_bvh(file_text("person_z_up.bvh"), "a", {LengthUnit::kMetre, UpAxis::kZ}).motion;
  const auto unturned = motion::joint_positions_world(z_as_y), turned = motion::joint_positions_world(z_up);
  for (std::size_t i = 0; i < turned.size(); ++i) {
    for (std::size_t j = 0; j < turned[i].size(); ++j) {
      const Eigen::Vector3d p = unturned[i][j];
      EXPECT_LT((turned[i][j] - Eigen::Vector3d(p.x(), p.z(), -p.y())).norm(), kRounding);
    }
  }
  EXPECT_LT((z_up.skeleton().joint(1).offset - Eigen::Vector3d(0.0, 0.6, 0.0)).norm(), kRounding);
  EXPECT_LT((z_up.skeleton().joint(2).end_site - Eigen::Vector3d(0.0, -0.05, 0.15)).norm(), kRounding);
}

TEST(RealClips, AreCentimetresWithYUpAtThirtyFrames) {
  STRUT_REQUIRE_REAL_DATA();
  for (const char* clip : {"walk_normal_001", "run_active_003", "raise-up-right-hand_feminine_013", "bow_normal_001"}) {
    const std::string path = test::real_data() + "/bandai-namco/dataset-2_" + clip + ".bvh";
    if (!std::filesystem::exists(path)) continue;
    const BvhClip read = read_bvh(path);
    EXPECT_EQ(read.layout.unit, LengthUnit::kCentimetre);
    EXPECT_EQ(read.layout.up, UpAxis::kY);
    EXPECT_EQ(read.motion.frame_rate(), 30.0);
    EXPECT_EQ(read.motion.skeleton().num_joints(), 22);
    EXPECT_EQ(read.layout.num_channels(), 132);
  }
}

}  // namespace
}  // namespace strut
