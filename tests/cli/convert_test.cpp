// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/program.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kPrinted = 1e-5;  // six decimals of a metre through a few joints [m]

class Convert : public testing::Test {
 protected:
  ProgramResult convert(const std::string& input, std::vector<std::string> options) {
    options.insert(options.begin(), {"convert", input, "-o", output()});
    return run_program(STRUT_PROGRAM, options);
  }
  [[nodiscard]] std::string output() const { return folder_.file("out.bvh"); }
  [[nodiscard]] bool wrote_something() const { return !std::filesystem::is_empty(folder_.path()); }
  TemporaryFolder folder_;
};

const std::string kPerson = test_file("data/person.bvh");
const std::string kCarried = test_file("data/inner_positions.bvh");

double largest_distance(const Motion& a, const Motion& b) {
  const auto x = motion::joint_positions_world(a), y = motion::joint_positions_world(b);
  EXPECT_EQ(x.size(), y.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    for (std::size_t j = 0; j < x[i].size(); ++j) largest = std::max(largest, (x[i][j] - y[i][j]).norm());
  }
  return largest;
}

TEST_F(Convert, ChangesUnitAndUpAxisButNotTheMotion) {
  const ProgramResult result = convert(kPerson, {"--unit", "m", "--up", "z"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, kPerson + ": note: lengths read as centimetres (the skeleton spans 166), Y as up\n");
  const BvhClip clip = read_bvh(output());
  EXPECT_EQ(clip.layout.unit, LengthUnit::kMetre);
  EXPECT_EQ(clip.layout.up, UpAxis::kZ);
  EXPECT_LT(largest_distance(clip.motion, read_bvh(kPerson).motion), kPrinted);
}

TEST_F(Convert, TakesTheInputsUnitAndAxisAsGiven) {
  ASSERT_EQ(convert(kPerson, {"--from-unit", "mm", "--from-up", "z", "--unit", "cm"}).exit_code, 0);
  const Motion written = read_bvh(output(), {LengthUnit::kCentimetre, UpAxis::kZ}).motion;
  EXPECT_LT(largest_distance(written, read_bvh(kPerson, {LengthUnit::kMillimetre, UpAxis::kZ}).motion), kPrinted);
}

TEST_F(Convert, TakesARangeOfFramesThenResamples) {
  ASSERT_EQ(convert(kPerson, {"--frames", "1:3", "--frame-rate", "60"}).exit_code, 0);
  const Motion written = read_bvh(output()).motion;
  EXPECT_EQ(written.frame_rate(), 60.0);
  ASSERT_EQ(written.num_frames(), 3);
  EXPECT_NEAR(written.frame(0).translations[0].y(), 0.91, kPrinted);
  EXPECT_NEAR(written.frame(1).translations[0].y(), 0.915, kPrinted);
  EXPECT_NEAR(written.frame(2).translations[0].y(), 0.92, kPrinted);
}

TEST_F(Convert, TakesARangeThatIsOpenAtOneEnd) {
  ASSERT_EQ(convert(kPerson, {"--frames", ":2"}).exit_code, 0);
  EXPECT_EQ(read_bvh(output()).motion.num_frames(), 2);
  ASSERT_EQ(convert(kPerson, {"--frames", "2:", "--force"}).exit_code, 0);
  EXPECT_EQ(read_bvh(output()).motion.num_frames(), 1);
}

TEST_F(Convert, KeepsTheLayoutOnlyIfAsked) {
  ASSERT_EQ(convert(kCarried, {"--keep-layout"}).exit_code, 0);
  const BvhClip source = read_bvh(kCarried), kept = read_bvh(output());
  EXPECT_EQ(kept.layout.header, source.layout.header);
  EXPECT_EQ(kept.layout.frame_time, source.layout.frame_time);
  ASSERT_EQ(convert(kCarried, {"--force", "--rotation-order", "yxz"}).exit_code, 0);
  EXPECT_THAT(read_file(output()), HasSubstr("\t\tCHANNELS 3 Yrotation Xrotation Zrotation\n"));
}

TEST_F(Convert, KeepsTheSourcesNumbersInARangeOfItsLayout) {
  ASSERT_EQ(convert(kCarried, {"--keep-layout", "--frames", "1:"}).exit_code, 0);
  const std::vector<double> source = *read_bvh(kCarried).layout.source_values;
  const std::vector<double> written = *read_bvh(output()).layout.source_values;
  ASSERT_EQ(written.size(), 2U * 24U);
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_NEAR(written[i], source[24 + i], 1e-5);
}

TEST_F(Convert, ScalesEveryLength) {
  ASSERT_EQ(convert(kPerson, {"--scale", "2", "--keep-layout"}).exit_code, 0);
  const Motion written = read_bvh(output(), {LengthUnit::kCentimetre, UpAxis::kY}).motion;
  EXPECT_NEAR(written.skeleton().joint(1).offset.y(), 0.5, kPrinted);
  EXPECT_NEAR(written.skeleton().joint(2).end_site.y(), 0.4, kPrinted);
  EXPECT_NEAR(written.frame(0).translations[0].y(), 1.8, kPrinted);
}

TEST_F(Convert, RefusesToOverwriteWithoutForce) {
  ASSERT_EQ(convert(kPerson, {}).exit_code, 0);
  const ProgramResult result = convert(kPerson, {});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, output() + ": error: the file already exists\nhint: use --force to overwrite it\n");
  EXPECT_EQ(convert(kPerson, {"--force"}).exit_code, 0);
}

TEST_F(Convert, RefusesWhatItCannotReadAndWritesNothing) {
  EXPECT_EQ(convert("missing.bvh", {}).exit_code, 3);
  EXPECT_EQ(convert(test_file("malformed/row_too_long.bvh"), {}).exit_code, 3);
  EXPECT_FALSE(wrote_something());
}

TEST_F(Convert, RefusesOptionsThatMakeNoSense) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--frames", "5"}, "--frames: expected BEGIN:END with frames from 0, got '5'"},
      {{"--frames", "a:b"}, "--frames: expected BEGIN:END with frames from 0, got 'a:b'"},
      {{"--frames", "2:1"}, "--frames: expected BEGIN before END, got '2:1'"},
      {{"--unit", "furlong"}, "--unit: expected m, cm, mm, in or ft, got 'furlong'"},
      {{"--up", "x"}, "--up: expected y or z, got 'x'"},
      {{"--rotation-order", "xxy"}, "--rotation-order: expected x, y and z once each, e.g. zxy, got 'xxy'"},
      {{"--positions", "both"}, "--positions: expected replace or add, got 'both'"}};
  for (const auto& [options, message] : wrong) {
    const ProgramResult result = convert(kPerson, options);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.err, StartsWith("strut convert: error: " + message + "\n"));
  }
  EXPECT_EQ(convert(kPerson, {"--frame-rate", "0"}).exit_code, 2);
  EXPECT_EQ(convert(kPerson, {"--rotation-order", "xyz", "--keep-layout"}).exit_code, 2);
  EXPECT_FALSE(wrote_something());
}

TEST_F(Convert, RefusesFramesThatTheClipDoesNotHave) {
  for (const char* range : {"0:10", "3:", "7:9"}) {
    const ProgramResult result = convert(kPerson, {"--frames", range});
    EXPECT_EQ(result.exit_code, 1) << range;
    EXPECT_THAT(result.err, StartsWith("strut: error: --frames: expected a range inside 0:3, got ")) << range;
  }
  EXPECT_FALSE(wrote_something());
}

}  // namespace
}  // namespace strut::test
