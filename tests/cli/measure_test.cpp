// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"
#include "support/data.h"
#include "support/program.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using metrics::test::test_motion;
using testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kPrinted = 1e-2;  // [cm]: BVH files hold a few decimals

class Measure : public testing::Test {
 protected:
  /// Writes a clip of the test body and returns its path. Six channels on every joint keep what `move` shifts.
  std::string clip(const std::string& name, const std::function<void(Pose&, double)>& move = {}, double rate = 30.0) {
    const Motion motion = test_motion(static_cast<int>(3.0 * rate), rate, move);
    BvhLayout layout = default_layout(motion.skeleton());
    layout.channels.assign(layout.channels.size(), layout.channels.front());
    write_bvh(folder_.file(name), motion, layout, Overwrite::kAllow);
    return folder_.file(name);
  }
  static ProgramResult measure(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "measure");
    return run_program(STRUT_PROGRAM, arguments);
  }
  TemporaryFolder folder_;
};

void raise_head(Pose& pose, double) {
  pose.translations[metrics::test::kHead].y() += 0.13;
}

void glide(Pose& pose, double t) {
  pose.translations[0].z() += 0.5 * t;
}

TEST_F(Measure, GivesFiguresWithTheirWorstPlacesAsJson) {
  const ProgramResult result = measure({clip("glide.bvh", glide), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out).at("clips").at(0);
  EXPECT_NEAR(json.at("foot_slide_cm_per_s"), 50.0, kPrinted);
  EXPECT_NEAR(json.at("worst_foot_slide").at("cm_per_s"), 50.0, kPrinted);
  EXPECT_THAT(json.at("worst_foot_slide").at("joint").get<std::string>(), HasSubstr("toe_"));
  EXPECT_NEAR(json.at("speed_m_per_s"), 0.5 * 89.0 / 90.0, kPrinted / 100.0);
  EXPECT_EQ(json.at("cadence_per_s"), 0.0);
  EXPECT_FALSE(json.contains("distance_cm"));
}

TEST_F(Measure, GivesDistancesToEachAndTheirMean) {
  const std::string low = clip("low.bvh");
  const std::string high = clip("high.bvh", raise_head, 60.0);
  const ProgramResult result = measure({low, "--against", low, high, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  const Json& against = json.at("clips").at(0).at("against");
  EXPECT_NEAR(against.at(0).at("distance_cm"), 0.0, kPrinted);
  EXPECT_NEAR(against.at(1).at("distance_cm"), 1.0, kPrinted);
  EXPECT_EQ(against.at(1).at("worst").at("joint"), "head");
  EXPECT_NEAR(json.at("distance_cm"), 0.5, kPrinted);
}

TEST_F(Measure, TellsAPersonTheSame) {
  const ProgramResult result = measure({clip("low.bvh"), "--against", clip("high.bvh", raise_head)});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("low.bvh: 90 frames at 30 frames/s"));
  EXPECT_THAT(result.out, HasSubstr("1.00 cm"));
  EXPECT_THAT(result.out, HasSubstr("(head 13.00 cm)"));
}

TEST_F(Measure, RefusesAnotherSkeletonByNameWithExitCode4) {
  const std::string low = clip("low.bvh");
  std::string text = read_file(low);
  text.replace(text.find("knee_l"), 6, "patell");
  write_file(folder_.file("other.bvh"), text);
  const ProgramResult result = measure({low, "--against", folder_.file("other.bvh")});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("missing 'knee_l'; unknown 'patell'"));
}

TEST_F(Measure, NamesTheFileThatCannotBeMeasured) {
  const Motion short_clip = test_motion(2, 30.0);
  write_bvh(folder_.file("short.bvh"), short_clip, default_layout(short_clip.skeleton()));
  const ProgramResult result = measure({folder_.file("short.bvh")});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("short.bvh: error: expected 4 frames at 30 frames/s, got 2\n"));
}

TEST_F(Measure, ExitsWith3ForAMissingFileAnd2WithoutOne) {
  EXPECT_EQ(measure({folder_.file("missing.bvh")}).exit_code, 3);
  EXPECT_EQ(measure({}).exit_code, 2);
}

}  // namespace
}  // namespace strut::test
