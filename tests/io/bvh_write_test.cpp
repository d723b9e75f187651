// SPDX-License-Identifier: MIT
// What is written: the source's own text where the motion is unchanged, a layout every program reads alike otherwise.
#include "support/data.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>

namespace strut {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr double kKeptNumber = 1e-5;     // what a kept number may differ by [degrees or file units]
constexpr double kPrintedMetres = 1e-6;  // six decimals of a centimetre through a few joints [m]
const BvhReadOptions kCentimetresYUp = {LengthUnit::kCentimetre, UpAxis::kY};

std::string file_text(const std::string& name) {
  return read_file(test::test_file("data/" + name));
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Over all frames and the joints from `first_joint` on [m].
double largest_distance(const Motion& a, const Motion& b, std::size_t first_joint = 0) {
  const auto x = motion::joint_positions_world(a), y = motion::joint_positions_world(b);
  if (x.size() != y.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = first_joint; j < x[i].size(); ++j) largest = std::max(largest, (x[i][j] - y[i][j]).norm());
  }
  return largest;
}

const std::vector<double>& values_of(const BvhClip& clip) {
  return *clip.layout.source_values;
}

/// Two joints, three rotations each, and these rows.
std::string text_with_rows(const std::string& rows, int count) {
  std::string text = file_text("two_joints.bvh");
  text = text.substr(0, text.find("Frames: 2"));
  return text + "Frames: " + std::to_string(count) + "\nFrame Time: 0.0333333\n" + rows;
}

void expect_kept(const std::string& source) {
  const BvhClip clip = parse_bvh(source, "a");
  const std::string written = format_bvh(clip.motion, clip.layout);
  EXPECT_THAT(written, StartsWith(clip.layout.header));
  EXPECT_THAT(source, StartsWith(clip.layout.header));
  EXPECT_LT(largest_difference(values_of(clip), values_of(parse_bvh(written, "b"))), kKeptNumber);
}

// --- the source's layout --------------------------------------------------------------------------------------------

TEST(KeptLayout, GivesTheSourceBackForEveryKindOfFile) {
  for (const char* name :
       {"person.bvh", "person_z_up.bvh", "channel_orders.bvh", "inner_positions.bvh", "names.bvh", "two_joints.bvh"}) {
    SCOPED_TRACE(name);
    expect_kept(file_text(name));
  }
}

TEST(KeptLayout, KeepsTheHeaderAndFrameTimeToTheLetter) {
  std::string source = file_text("names.bvh");
  source.replace(source.find("Frames: 1\nFrame Time: 0.0333333"), 31, "frames :1\r\n\r\nFRAME time:\t.033333  \r\n");
  const BvhClip clip = parse_bvh(source, "a");
  const std::string written = format_bvh(clip.motion, clip.layout);
  const std::size_t end = source.find(".033333") + 7;
  EXPECT_EQ(written.substr(0, end), source.substr(0, end));
}

TEST(KeptLayout, KeepsByteOrderMarkAndLineEnds) {
  const std::string written = [] {
    const BvhClip clip = parse_bvh(
        "\xEF\xBB\xBFHIERARCHY\r\nROOT a\r\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation\r\n}\r\n"
        "MOTION\r\nFrames: 1\r\nFrame Time: 0.5\r\n30\r\n",
        "a");
    return format_bvh(clip.motion, clip.layout);
  }();
  EXPECT_EQ(written,
            "\xEF\xBB\xBFHIERARCHY\r\nROOT a\r\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation\r\n}\r\n"
            "MOTION\r\nFrames: 1\r\nFrame Time: 0.5\r\n30.000000\r\n");
}

TEST(KeptLayout, KeepsTheSourcesAnglesBeyondHalfTurnsAndTheirJumps) {
  expect_kept(text_with_rows("0 0 0 179 0 0 0 0 0\n0 0 0 -179 0 0 360 0 0\n0 0 0 541 10 20 0 0 -720\n", 3));
}

TEST(KeptLayout, KeepsEitherOfTheTwoTriplesThatMeanARotation) {
  expect_kept(text_with_rows("0 0 0 10 20 30 190 160 210\n0 0 0 190 160 210 10 20 30\n", 2));
}

TEST(KeptLayout, KeepsAnglesAtGimbalLock) {
  expect_kept(text_with_rows("0 0 0 30 90 40 70 -90 0\n0 0 0 -30 90 0 10 -90 60\n0 0 0 5 270 7 5 89.9999999 7\n", 3));
}

TEST(KeptLayout, KeepsRandomRows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-400.0, 400.0);
  std::string rows;
  for (int row = 0; row < 200; ++row) {
    rows += "1 2 3";
    for (int i = 0; i < 6; ++i) rows += " " + std::to_string(angle(random));
    rows += "\n";
  }
  expect_kept(text_with_rows(rows, 200));
}

TEST(KeptLayout, AddsToTheOffsetWhatWasReadSo) {
  const BvhReadOptions adding = {LengthUnit::kCentimetre, UpAxis::kY, PositionChannels::kAddToOffset};
  const BvhClip clip = parse_bvh(file_text("inner_positions.bvh"), "a", adding);
  const BvhClip again = parse_bvh(format_bvh(clip.motion, clip.layout), "b", adding);
  EXPECT_LT(largest_difference(values_of(clip), values_of(again)), kKeptNumber);
}

TEST(KeptLayout, FollowsARangeOfFrames) {
  const BvhClip clip =
      parse_bvh(text_with_rows("0 0 0 1 2 3 4 5 6\n0 0 0 361 2 3 4 5 6\n0 0 0 721 2 3 4 5 6\n", 3), "a");
  BvhLayout layout = clip.layout;
  layout.first_source_row = 1;
  const BvhClip again = parse_bvh(format_bvh(clip.motion.slice(1, 3), layout), "b");
  EXPECT_NEAR(values_of(again)[3], 361.0, kKeptNumber);
  EXPECT_NEAR(values_of(again)[12], 721.0, kKeptNumber);
}

TEST(KeptLayout, WritesAnotherFrameRateWhenTheMotionHasOne) {
  const BvhClip clip = parse_bvh(file_text("person.bvh"), "a");
  const std::string written = format_bvh(motion::resample(clip.motion, 60.0), clip.layout);
  EXPECT_THAT(written, HasSubstr("Frames: 5\nFrame Time: 0.01666667\n"));
  EXPECT_EQ(parse_bvh(written, "b").motion.frame_rate(), 60.0);
}

TEST(KeptLayout, MakesTheHeaderAnewForOtherBones) {
  const BvhClip clip = parse_bvh(file_text("person.bvh"), "a");
  std::vector<Joint> joints = clip.motion.skeleton().joints();
  joints[1].offset.y() = 0.33;
  std::vector<Pose> frames = clip.motion.frames();
  for (Pose& pose : frames) pose.translations[1].y() = 0.33;
  const Motion longer(std::make_shared<const Skeleton>(joints), 30.0, frames);
  Diagnostics diagnostics;
  const BvhClip again = parse_bvh(format_bvh(longer, clip.layout, &diagnostics), "b", kCentimetresYUp);
  EXPECT_THAT(diagnostics.entries(), IsEmpty());
  EXPECT_LT(largest_distance(longer, again.motion), kPrintedMetres);
}

TEST(KeptLayout, WritesInOtherUnitsAndAxes) {
  for (const char* name : {"person.bvh", "person_z_up.bvh", "inner_positions.bvh"}) {
    const BvhClip clip = parse_bvh(file_text(name), "a");
    for (const LengthUnit unit : {LengthUnit::kMillimetre, LengthUnit::kInch}) {
      for (const UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
        const BvhLayout layout = with_units(clip.layout, unit, up);
        const BvhClip again = parse_bvh(format_bvh(clip.motion, layout), "b", {unit, up});
        EXPECT_LT(largest_distance(clip.motion, again.motion), kPrintedMetres) << name;
        EXPECT_EQ(again.layout.channels, clip.layout.channels);
      }
    }
  }
}

TEST(KeptLayout, IsRefusedForAnotherNumberOfJoints) {
  const BvhClip clip = parse_bvh(file_text("person.bvh"), "a");
  const BvhLayout other = parse_bvh(file_text("two_joints.bvh"), "b").layout;
  try {
    format_bvh(clip.motion, other);
    FAIL() << "was written";
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "layout: expected channels for 7 joints, got channels for 2");
  }
}

// --- angles of changed motions --------------------------------------------------------------------------------------

TEST(WrittenAngles, GoOnWithoutJumpsThroughWholeTurnsAndGimbalLock) {
  const BvhClip clip = parse_bvh(file_text("two_joints.bvh"), "a");
  const Motion still = clip.motion.slice(0, 1);
  std::vector<Pose> frames(400, still.frame(0));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double angle = 0.05 * static_cast<double>(i);  // three full turns
    frames[i].rotations[0] = math::exp_map({0.0, 0.0, angle});
    frames[i].rotations[1] = math::exp_map({angle, 0.0, 0.0});  // the middle channel passes +-90 degrees
  }
  const Motion turning(clip.motion.shared_skeleton(), 30.0, frames);
  const std::string text = format_bvh(turning, default_layout(turning.skeleton()));
  const auto values = values_of(parse_bvh(text, "b"));
  for (std::size_t i = 9; i < values.size(); ++i) {
    if (i % 9 < 3) continue;  // positions
    EXPECT_LT(std::abs(values[i] - values[i - 9]), 0.05 * 180.0 / std::numbers::pi + 1e-3) << "row " << i / 9;
  }
}

TEST(WrittenAngles, MakeTheSameRotationInEveryOrder) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const BvhClip clip = parse_bvh(file_text("two_joints.bvh"), "a", kCentimetresYUp);
  std::vector<Pose> frames(50, clip.motion.frame(0));
  for (Pose& pose : frames) {
    for (auto& rotation : pose.rotations) {
      rotation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    }
  }
  const Motion source(clip.motion.shared_skeleton(), 30.0, frames);
  std::vector<BvhChannel> order = {BvhChannel::kXRotation, BvhChannel::kYRotation, BvhChannel::kZRotation};
  do {
    for (const UpAxis up : {UpAxis::kY, UpAxis::kZ}) {
      const BvhLayout layout = default_layout(source.skeleton(), LengthUnit::kCentimetre, up, order);
      const Motion again = parse_bvh(format_bvh(source, layout), "b", {LengthUnit::kCentimetre, up}).motion;
      EXPECT_LT(largest_distance(source, again), kPrintedMetres);
      for (int i = 0; i < source.num_frames(); ++i) {
        EXPECT_LT(again.frame(i).rotations[1].angularDistance(source.frame(i).rotations[1]), 1e-6);
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(WrittenAngles, AreReportedWhereTheChannelsAreTooFew) {
  const BvhClip clip = parse_bvh(file_text("channel_orders.bvh"), "a", kCentimetresYUp);
  Pose pose = clip.motion.frame(0);
  pose.rotations[2] = math::exp_map({0.3, 0.1, 0.0});  // the elbow has one channel, about Y
  Diagnostics diagnostics;
  format_bvh(Motion(clip.motion.shared_skeleton(), 100.0, {pose}), clip.layout, &diagnostics);
  ASSERT_THAT(diagnostics.entries(), SizeIs(1));
  EXPECT_EQ(diagnostics.entries()[0].message, "the layout has too few channels for the rotation of 'Elbow'");
}

TEST(WrittenAngles, OfJointsWithFewChannelsFollowARotationTheyCanHold) {
  const BvhClip clip = parse_bvh(file_text("channel_orders.bvh"), "a", kCentimetresYUp);
  std::vector<Pose> frames(200, clip.motion.frame(0));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    frames[i].rotations[2] = math::exp_map({0.0, angle, 0.0});
    frames[i].rotations[4] = math::exp_map({0.0, 0.0, angle}) * math::exp_map({2.0 * angle, 0.0, 0.0});
  }
  const Motion source(clip.motion.shared_skeleton(), 100.0, frames);
  Diagnostics diagnostics;
  const BvhClip again = parse_bvh(format_bvh(source, clip.layout, &diagnostics), "b", kCentimetresYUp);
  EXPECT_THAT(diagnostics.entries(), IsEmpty());
  EXPECT_LT(largest_distance(source, again.motion), kPrintedMetres);
}

// --- the default layout ---------------------------------------------------------------------------------------------

TEST(DefaultLayout, HasRootOffsetZeroSixChannelsThereAndThreeElsewhere) {
  const BvhClip clip = parse_bvh(file_text("inner_positions.bvh"), "a");
  const std::string text = format_bvh(clip.motion, default_layout(clip.motion.skeleton()));
  EXPECT_THAT(text, StartsWith("HIERARCHY\n"
                               "ROOT Root\n{\n"
                               "\tOFFSET 0.000000 0.000000 0.000000\n"
                               "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                               "\tJOINT Hips\n\t{\n"
                               "\t\tOFFSET -0.500000 93.500000 -2.000000\n"
                               "\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n"));
  EXPECT_THAT(text, HasSubstr("MOTION\nFrames: 3\nFrame Time: 0.03333333\n"));
}

TEST(DefaultLayout, MeansTheSameWhetherPositionsReplaceOrAdd) {
  for (const char* name : {"person.bvh", "person_z_up.bvh", "inner_positions.bvh"}) {
    const BvhClip clip = parse_bvh(file_text(name), "a");
    const std::string text = format_bvh(clip.motion, default_layout(clip.motion.skeleton()));
    const Motion replacing = parse_bvh(text, "b", {{}, {}, PositionChannels::kReplaceOffset}).motion;
    const Motion adding = parse_bvh(text, "b", {{}, {}, PositionChannels::kAddToOffset}).motion;
    EXPECT_EQ(largest_distance(replacing, adding), 0.0);
  }
}

TEST(DefaultLayout, CarriesATravellingPelvisByTheRoot) {
  const BvhClip clip = parse_bvh(file_text("inner_positions.bvh"), "a", kCentimetresYUp);
  Diagnostics diagnostics;
  const std::string text = format_bvh(clip.motion, default_layout(clip.motion.skeleton()), &diagnostics);
  EXPECT_THAT(diagnostics.entries(), IsEmpty());
  const BvhClip again = parse_bvh(text, "b", kCentimetresYUp);
  const auto pelvis = static_cast<std::size_t>(clip.motion.skeleton().pelvis());
  EXPECT_LT(largest_distance(clip.motion, again.motion, pelvis), kPrintedMetres);
  // and the test can tell: the root itself did move
  EXPECT_GT(largest_distance(clip.motion, again.motion, 0), 0.1);
}

TEST(DefaultLayout, NamesJointsWhoseTranslationIsLost) {
  const BvhClip clip = parse_bvh(file_text("inner_positions.bvh"), "a", kCentimetresYUp);
  std::vector<Pose> frames = clip.motion.frames();
  frames[1].translations[3].x() += 0.02;
  const Motion stretched(clip.motion.shared_skeleton(), 30.0, frames);
  Diagnostics diagnostics;
  format_bvh(stretched, default_layout(stretched.skeleton()), &diagnostics);
  ASSERT_THAT(diagnostics.entries(), SizeIs(1));
  EXPECT_EQ(diagnostics.entries()[0].severity, Severity::kWarning);
  EXPECT_EQ(diagnostics.entries()[0].message,
            "the layout has no channels for the movement of 'Foot' against the parent joint");
}

TEST(DefaultLayout, WritesJointsInTheOrderOfTheFileWhateverTheirOrderInTheSkeleton) {
  // Breadth first: both legs precede the feet.
  std::vector<Joint> joints = {{"hips", -1, {0, 0, 0}},
                               {"left", 0, {0.1, -0.1, 0}},
                               {"right", 0, {-0.1, -0.1, 0}},
                               {"left foot", 1, {0, -0.8, 0}},
                               {"right foot", 2, {0, -0.8, 0}}};
  const auto skeleton = std::make_shared<const Skeleton>(joints);
  Pose pose = rest_pose(*skeleton);
  for (std::size_t j = 0; j < 5; ++j) pose.rotations[j] = math::exp_map({0.1 * static_cast<double>(j), 0.2, 0.3});
  const Motion motion(skeleton, 30.0, {pose});
  const Motion again = parse_bvh(format_bvh(motion, default_layout(*skeleton)), "a", kCentimetresYUp).motion;
  const auto before = motion::joint_positions_world(motion)[0], after = motion::joint_positions_world(again)[0];
  for (int j = 0; j < 5; ++j) {
    const int same = again.skeleton().find(joints[static_cast<std::size_t>(j)].name);
    ASSERT_GE(same, 0);
    EXPECT_LT((before[static_cast<std::size_t>(j)] - after[static_cast<std::size_t>(same)]).norm(), kPrintedMetres);
  }
}

TEST(DefaultLayout, RefusesAnOrderThatIsNotOne) {
  const Skeleton skeleton({{"a", -1, {0, 0, 0}}});
  const auto with = [&](const std::vector<BvhChannel>& order) {
    return default_layout(skeleton, LengthUnit::kMetre, UpAxis::kY, order);
  };
  EXPECT_THROW(with({}), InvalidArgument);
  EXPECT_THROW(with({BvhChannel::kXRotation, BvhChannel::kXRotation, BvhChannel::kYRotation}), InvalidArgument);
  EXPECT_THROW(with({BvhChannel::kXPosition, BvhChannel::kXRotation, BvhChannel::kYRotation}), InvalidArgument);
}

TEST(DefaultLayout, RefusesANameThatWouldBreakTheFile) {
  const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>{{"a{b", -1, {0, 0, 0}}});
  EXPECT_THROW(format_bvh(Motion(skeleton, 30.0), default_layout(*skeleton)), InvalidArgument);
}

TEST(WrittenFrameTime, ReadsBackAsTheSameRate) {
  const BvhClip clip = parse_bvh(file_text("person.bvh"), "a");
  for (const double rate : {24.0, 25.0, 30.0, 60.0, 100.0, 120.0, 240.0, 33.0, 7.5, 29.5, 1000.0}) {
    const Motion motion(clip.motion.shared_skeleton(), rate, clip.motion.frames());
    const double again = parse_bvh(format_bvh(motion, default_layout(motion.skeleton())), "b").motion.frame_rate();
    EXPECT_NEAR(again, rate, 1e-12 * rate);
  }
}

// --- files ----------------------------------------------------------------------------------------------------------

TEST(WriteBvh, WritesTheTextAndRefusesToOverwrite) {
  const test::TemporaryFolder folder;
  const BvhClip clip = parse_bvh(file_text("person.bvh"), "a");
  const std::string path = folder.file("out.bvh");
  write_bvh(path, clip.motion, clip.layout);
  EXPECT_EQ(read_file(path), format_bvh(clip.motion, clip.layout));
  EXPECT_THROW(write_bvh(path, clip.motion, clip.layout), FileError);
  EXPECT_NO_THROW(write_bvh(path, clip.motion, clip.layout, Overwrite::kAllow));
}

TEST(RealClips, ComeBackNumberForNumberWithTheirHeader) {
  STRUT_REQUIRE_REAL_DATA();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::real_data() + "/bandai-namco")) {
    if (entry.path().extension() != ".bvh" || count++ % 16 != 0) continue;
    const std::string source = read_file(entry.path());
    const BvhClip clip = parse_bvh(source, entry.path());
    const std::string written = format_bvh(clip.motion, clip.layout);
    const std::size_t end = source.find(clip.layout.frame_time) + clip.layout.frame_time.size();
    ASSERT_EQ(written.substr(0, end), source.substr(0, end));
    EXPECT_LT(largest_difference(values_of(clip), values_of(parse_bvh(written, "b"))), kKeptNumber) << entry.path();
  }
  EXPECT_GT(count, 400);
}

TEST(RealClips, KeepTheirBodyInTheDefaultLayout) {
  STRUT_REQUIRE_REAL_DATA();
  for (const char* name : {"walk_elderly_004", "run_normal_003", "walk-turn-right_normal_008"}) {
    const BvhClip clip = read_bvh(test::real_data() + "/bandai-namco/dataset-2_" + name + ".bvh");
    Diagnostics diagnostics;
    const std::string text = format_bvh(clip.motion, default_layout(clip.motion.skeleton()), &diagnostics);
    EXPECT_THAT(diagnostics.entries(), IsEmpty());
    const auto pelvis = static_cast<std::size_t>(clip.motion.skeleton().pelvis());
    // The source prints its rigid bones anew in every frame, rounded to 1e-6 of their size.
    EXPECT_LT(largest_distance(clip.motion, parse_bvh(text, "b").motion, pelvis), 1e-5) << name;
  }
}

}  // namespace
}  // namespace strut
