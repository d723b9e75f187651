// SPDX-License-Identifier: MIT
#include "cli/align_clips.h"
#include "cli/csv_columns.h"
#include "support/data.h"
#include "support/program.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/align/continuous_warp.h>
#include <strut/align/correspondence.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/alignment_features.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr double kPrinted = 1e-6;  // tables have six decimals

class Align : public AlignClips {};

Json json_of(const ProgramResult& result) {
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

TEST_F(Align, PrintsEAfterEveryRoundAndTheDurations) {
  const ProgramResult result = align({clip("walk.bvh", 1.0), clip("slow.bvh", 0.8), "--method", "imw"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("E after round  1"));
  EXPECT_THAT(result.out, HasSubstr("2.00 s"));
  EXPECT_THAT(result.out, HasSubstr("at the slope limit 2"));
  EXPECT_THAT(result.out, HasSubstr("if stretched evenly"));
}

TEST_F(Align, WritesATableWhoseTimesRise) {
  const std::string table = folder_.file("table.csv");
  const std::string input = clip("walk.bvh", 1.0), output = clip("slow.bvh", 0.8);
  for (const char* method : {"continuous", "imw", "dtw1", "dtw3", "timewarp"}) {
    const ProgramResult result = align({input, output, "--method", method, "--csv", table, "--force"});
    ASSERT_EQ(result.exit_code, 0) << method << ": " << result.err;
    std::istringstream lines(read_file(table));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "frame,time_s,output_frame,output_time_s,differential_warp,smoothed_differential_warp");
    double previous = 0.0;
    int rows = 0;
    for (; std::getline(lines, line); ++rows) {
      const std::string after_time = line.substr(line.find(',', line.find(',') + 1) + 1);
      const double output_frame = std::strtod(after_time.c_str(), nullptr);
      EXPECT_GE(output_frame, previous) << line;
      previous = output_frame;
    }
    EXPECT_EQ(rows, read_bvh(input).motion.num_frames());
    EXPECT_GT(previous, 0.8 * read_bvh(output).motion.num_frames());
  }
}

TEST_F(Align, SaysWhatTheLibrarySaysOfIterativeMotionWarping) {
  const std::string input = clip("walk.bvh", 1.0), output = clip("slow.bvh", 0.8), table = folder_.file("table.csv");
  const Json told =
      json_of(align({input, output, "--csv", table, "--json", "--warp-smoothness", "4", "--method", "imw"}));
  const auto [u, y] = representation::alignment_features(read_bvh(input).motion, read_bvh(output).motion);
  const auto expected = align::iterative_motion_warping(u, y);
  const Eigen::VectorXd& slope = expected.correspondence.differential_warp;
  const Eigen::VectorXd time = expected.correspondence.output_time(),
                        smoothed = align::smooth_differential_warp(slope, 4.0);
  const auto columns = columns_of(table);
  for (Eigen::Index t = 0; t < slope.size(); ++t) {
    const auto row = static_cast<std::size_t>(t);
    EXPECT_NEAR(columns.at("differential_warp")[row], slope[t], kPrinted);
    EXPECT_NEAR(columns.at("output_frame")[row], time[t], kPrinted);
    EXPECT_NEAR(columns.at("output_time_s")[row], time[t] / 30.0, kPrinted);
    EXPECT_NEAR(columns.at("smoothed_differential_warp")[row], smoothed[t], kPrinted);
  }
  const Json& found = told.at("alignments").at(0);
  ASSERT_EQ(found.at("objective").size(), expected.objective.size());
  EXPECT_DOUBLE_EQ(found.at("objective").back(), expected.objective.back());
  EXPECT_DOUBLE_EQ(found.at("warp").at("most"), slope.maxCoeff());
  EXPECT_DOUBLE_EQ(found.at("smoothed_warp").at("share_at_slope_limit"), align::share_at_slope_limit(smoothed, 2.0));
}

TEST_F(Align, IsContinuousUnlessAsked) {
  const std::string input = clip("walk.bvh", 1.0, 4.0), output = clip("slow.bvh", 0.8, 4.0);
  const std::string table = folder_.file("table.csv");
  const Json told = json_of(align({input, output, "--csv", table, "--json"})).at("alignments").at(0);
  EXPECT_EQ(told.at("method"), "continuous");
  EXPECT_EQ(told.at("signals"), "all");
  EXPECT_DOUBLE_EQ(told.at("slope_limit"), 3.0);
  const auto [u, y, weights] = representation::timing_features(read_bvh(input).motion, read_bvh(output).motion);
  align::ContinuousWarpOptions options;
  options.weights = weights;
  const auto expected = align::continuous_warp(u, y, 30.0, options).correspondence;
  const auto columns = columns_of(table);
  const std::vector<double>& place = columns.at("output_frame");
  for (std::size_t t = 0; t < place.size(); ++t) {
    EXPECT_NEAR(columns.at("differential_warp")[t], expected.differential_warp[static_cast<Eigen::Index>(t)], kPrinted);
  }
  EXPECT_EQ(std::adjacent_find(place.begin(), place.end(), std::greater_equal<>()), place.end());
  EXPECT_EQ(columns.at("smoothed_differential_warp"), columns.at("differential_warp"));
}

TEST_F(Align, IsNearerToTheTruthByTheContinuousWarpAndPutsFootplantsNoWorse) {
  constexpr double kDetectorStep = 0.5 / 30.0;  // footplants are found in whole frames [s]
  generate::WalkContent content;
  content.duration = 4.0;
  generate::WalkStyle crouch;
  crouch.crouch = 0.2;
  crouch.cadence_scale = 0.8;
  crouch.seed = 2;
  const generate::Walk walk = generate::generate_walk(content, {}, 30.0);
  const generate::Walk other = generate::generate_walk(content, crouch, 30.0);
  const std::vector<double> truth = generate::true_correspondence(walk, other);
  const std::string input = write("walk.bvh", walk.motion), output = write("crouch.bvh", other.motion);
  const std::string table = folder_.file("table.csv");
  std::map<std::string, double> error, off;
  for (const char* method : {"continuous", "imw"}) {
    const Json told = json_of(align({input, output, "--method", method, "--csv", table, "--force", "--json"}));
    off[method] = told.at("alignments").at(0).at("footplants").at("mean_error_s");
    const std::vector<double> place = columns_of(table).at("output_frame");
    for (std::size_t t = 0; t < truth.size(); ++t) error[method] += std::abs(place[t] - truth[t]);
  }
  EXPECT_LT(error["continuous"], error["imw"]);
  EXPECT_LT(off["continuous"], off["imw"] + kDetectorStep);
}

TEST_F(Align, ComparesTheSignalsAskedForByEveryMethod) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0), slow = clip("slow.bvh", 0.8, 4.0);
  for (const char* method : {"continuous", "imw", "dtw1", "dtw3", "timewarp"}) {
    const auto told = [&](const std::string& signals) {
      return json_of(align({walk, slow, "--method", method, "--signals", signals, "--csv",
                            folder_.file(signals + ".csv"), "--force", "--json"}))
          .at("alignments")
          .at(0);
    };
    const Json posture = told("posture"), all = told("all");
    EXPECT_EQ(posture.at("signals"), "posture");
    const int feet = all.at("degrees_of_freedom").get<int>() - 2 * posture.at("degrees_of_freedom").get<int>();
    EXPECT_EQ(feet, 2) << method;  // posture, as many of movement, two feet
    EXPECT_NE(read_file(folder_.file("posture.csv")), read_file(folder_.file("all.csv"))) << method;
  }
  EXPECT_EQ(align({walk, slow, "--signals", "posture", "--shared-units"}).exit_code, 0);
  const ProgramResult shared = align({walk, slow, "--shared-units"});
  EXPECT_EQ(shared.exit_code, 1);
  EXPECT_THAT(shared.err, HasSubstr("--shared-units: expected --signals posture beside it"));
  const ProgramResult rigid = align({walk, slow, "--slope-limit", "1"});
  EXPECT_EQ(rigid.exit_code, 1);
  EXPECT_THAT(rigid.err, HasSubstr("--slope-limit: expected a number above 1 with --method continuous"));
}

TEST_F(Align, WeighsAJointsMovementWithItAndFeetByName) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  const auto num_signals = [&](std::vector<std::string> weights) {
    weights.insert(weights.begin(), {walk, slow, "--json"});
    return json_of(align(weights)).at("alignments").at(0).at("degrees_of_freedom").get<int>();
  };
  const int all = num_signals({});
  const int less = num_signals({"--weight", "LeftLeg x=0"});
  EXPECT_EQ(all - less, 2);
  EXPECT_EQ(all - num_signals({"--weight", "feet=0"}), 2);
  EXPECT_EQ(all - num_signals({"--weight", "feet=0", "--weight", "LeftLeg x=0"}), 4);
  EXPECT_EQ(align({walk, slow, "--method", "imw", "--weight", "feet=0"}).exit_code, 1);  // by posture: no such joint
}

/// When each foot comes down, in frames.
std::vector<std::vector<double>> onsets_of(const std::string& path) {
  const Motion motion = read_bvh(path).motion;
  std::vector<std::vector<double>> onsets(2);
  for (const auto& plant : postprocess::detect_footplants(motion, motion::find_legs(motion).value())) {
    if (plant.begin > 0) onsets[static_cast<std::size_t>(plant.foot)].push_back(plant.begin);
  }
  return onsets;
}

TEST_F(Align, MeasuresHowFarFootplantsAreFromWhereItPutsThem) {
  const std::string input = clip("walk.bvh", 1.0, 4.0), output = clip("slow.bvh", 0.8, 4.0);
  const std::string table = folder_.file("table.csv");
  const Json told = json_of(align({input, output, "--csv", table, "--json"}));
  const auto place = columns_of(table).at("output_frame");
  const auto in = onsets_of(input), out = onsets_of(output);
  double sum = 0.0, largest = 0.0;
  int pairs = 0;
  for (const std::size_t foot : {0U, 1U}) {
    ASSERT_EQ(in[foot].size(), out[foot].size());  // so that the pairs are known without looking for them
    for (std::size_t k = 0; k < in[foot].size(); ++k, ++pairs) {
      const double error = std::abs(place[static_cast<std::size_t>(in[foot][k])] - out[foot][k]) / 30.0;
      sum += error;
      largest = std::max(largest, error);
    }
  }
  const Json& found = told.at("alignments").at(0).at("footplants");
  ASSERT_GE(pairs, 6);
  ASSERT_GT(sum, 0.0);
  EXPECT_EQ(found.at("paired"), pairs);
  EXPECT_EQ(found.at("unpaired_input"), 0);
  EXPECT_EQ(found.at("unpaired_output"), 0);
  EXPECT_NEAR(found.at("mean_error_s"), sum / pairs, kPrinted);
  EXPECT_NEAR(found.at("largest_error_s"), largest, kPrinted);
}

TEST_F(Align, LeavesFootplantsWithoutCounterpartUnpaired) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0);
  const std::string half = beginning("half.bvh", walk, 66);
  const Json told = json_of(align({half, walk, "--json"}));
  const Json& found = told.at("alignments").at(0).at("footplants");
  const auto in = onsets_of(half), out = onsets_of(walk);
  EXPECT_LE(found.at("paired").get<std::size_t>(), in[0].size() + in[1].size());
  EXPECT_EQ(found.at("paired").get<std::size_t>() + found.at("unpaired_output").get<std::size_t>(),
            out[0].size() + out[1].size());
  EXPECT_GT(found.at("unpaired_output"), 0);
}

/// How much has passed before each frame and after the last.
std::vector<double> passed(const std::vector<double>& slopes) {
  std::vector<double> sums{0.0};
  for (const double slope : slopes) sums.push_back(sums.back() + slope);
  return sums;
}

TEST_F(Align, InvertsTheWarpExactly) {
  const std::string input = clip("walk.bvh", 1.0), output = clip("slow.bvh", 0.8);
  const std::string table = folder_.file("table.csv"), inverse = folder_.file("inverse.csv");
  ASSERT_EQ(align({input, output, "--csv", table, "--inverse-csv", inverse}).exit_code, 0);
  const auto there = columns_of(table), back = columns_of(inverse);
  ASSERT_EQ(back.at("input_frame").size(), static_cast<std::size_t>(read_bvh(output).motion.num_frames()));
  for (const char* column : {"differential_warp", "smoothed_differential_warp"}) {
    const std::vector<double> forward = passed(there.at(column)), backward = passed(back.at(column));
    for (std::size_t j = 0; j < backward.size(); ++j) {
      const auto t = std::min(static_cast<std::size_t>(backward[j]), forward.size() - 2);
      const double place = forward[t] + (backward[j] - static_cast<double>(t)) * (forward[t + 1] - forward[t]);
      EXPECT_NEAR(place, static_cast<double>(j), 200 * kPrinted) << column;  // roundings of all rows before it add up
    }
  }
}

TEST_F(Align, AlignsSeveralClipsEachIntoAFileOfItsOwn) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8), brisk = clip("brisk.bvh", 1.2);
  std::filesystem::create_directory(folder_.file("all"));
  const ProgramResult all = align({walk, slow, brisk, "--csv", folder_.file("all"), "--plot", folder_.file("all")});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_THAT(all.out, testing::AllOf(HasSubstr("slow.bvh: "), HasSubstr("brisk.bvh: "), Not(HasSubstr("round"))));
  std::filesystem::create_directory(folder_.file("one"));
  ASSERT_EQ(align({walk, brisk, "--csv", folder_.file("one.csv")}).exit_code, 0);
  ASSERT_EQ(align({walk, brisk, "--csv", folder_.file("one/")}).exit_code, 0);
  for (const char* table : {"all/brisk.csv", "one/brisk.csv"}) {
    EXPECT_EQ(read_file(folder_.file(table)), read_file(folder_.file("one.csv"))) << table;
  }
  for (const char* file : {"all/slow.csv", "all/slow.svg", "all/brisk.svg"}) {
    EXPECT_NE(read_file(folder_.file(file)), "") << file;
  }
  const Json told = json_of(align({walk, slow, brisk, "--json"}));
  ASSERT_EQ(told.at("alignments").size(), 2U);
  EXPECT_EQ(told.at("alignments").at(1).at("output").at("path"), brisk);
}

TEST_F(Align, RefusesOneFileForSeveralClips) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  const ProgramResult file = align({walk, slow, walk, "--csv", folder_.file("table.csv")});
  EXPECT_EQ(file.exit_code, 1);
  EXPECT_THAT(file.err, HasSubstr("make a folder of this name first"));
  std::filesystem::create_directory(folder_.file("all"));
  const ProgramResult twice = align({walk, slow, slow, "--csv", folder_.file("all")});
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_THAT(twice.err, HasSubstr("slow.csv"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.file("all")));
}

TEST_F(Align, WeighsJoints) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  const Json plain = json_of(align({walk, slow, "--json"})).at("alignments").at(0);
  const Json less = json_of(align({walk, slow, "--json", "--weight", "leftleg=0", "--weight", "RightLeg x=0"}));
  EXPECT_LT(less.at("alignments").at(0).at("degrees_of_freedom"), plain.at("degrees_of_freedom"));
  EXPECT_LT(less.at("alignments").at(0).at("objective").at(0), plain.at("objective").at(0));
  const Json rootless = json_of(align({walk, slow, "--json", "--weight", "hips=0"})).at("alignments").at(0);
  EXPECT_LT(rootless.at("degrees_of_freedom"), plain.at("degrees_of_freedom"));
  EXPECT_THAT(align({walk, slow, "--weight", "root forward velocity=1"}).err, HasSubstr("travel is not compared"));
  EXPECT_THAT(align({walk, slow, "--weight", "tail=1"}).err, testing::AllOf(HasSubstr("'tail'"), HasSubstr("Spine x")));
  for (const char* wrong : {"LeftLeg", "=1", "LeftLeg=", "LeftLeg=-1", "LeftLeg=nan", "LeftLeg=inf"}) {
    const ProgramResult result = align({walk, slow, "--weight", wrong});
    EXPECT_EQ(result.exit_code, 1) << wrong;
    EXPECT_THAT(result.err, HasSubstr("NAME=X")) << wrong;
  }
}

TEST_F(Align, RefusesWhatItCannotDoAndWritesNothing) {
  const std::string table = folder_.file("table.csv"), plot = folder_.file("plot.svg");
  const std::string walk = clip("walk.bvh", 1.0), brief = clip("brief.bvh", 1.0, 0.6);
  const ProgramResult lengths = align({walk, brief, "--csv", table});
  EXPECT_EQ(lengths.exit_code, 3);
  EXPECT_THAT(lengths.err, HasSubstr("brief.bvh: error: expected 20 to 180 frames for an input of 60 frames, got 18"));
  const ProgramResult counted = align({walk, brief, "--method", "imw", "--csv", table});
  EXPECT_EQ(counted.exit_code, 3);
  EXPECT_THAT(counted.err, testing::ContainsRegex("slope limit of [34]"));
  const ProgramResult dof = align({walk, walk, "--csv", table, "--plot", plot, "--dof", "tail"});
  EXPECT_EQ(dof.exit_code, 1);
  EXPECT_THAT(dof.err, testing::AllOf(HasSubstr("'tail'"), HasSubstr("LeftUpLeg x")));
  EXPECT_EQ(align({walk, walk, "--method", "guess", "--csv", table}).exit_code, 2);
  EXPECT_EQ(align({walk, folder_.file("missing.bvh"), "--csv", table}).exit_code, 3);
  EXPECT_EQ(align({walk, test_file("data/person.bvh"), "--csv", table}).exit_code, 4);
  EXPECT_EQ(align({walk, beginning("one.bvh", walk, 1), "--csv", table}).exit_code, 3);
  EXPECT_THROW(read_file(table), FileError);
  EXPECT_THROW(read_file(plot), FileError);
}

TEST_F(Align, RefusesAClipInWhichNothingMoves) {
  const std::string walk = clip("walk.bvh", 1.0), still_clip = still("still.bvh", walk, 60);
  for (const auto& clips : {std::vector{walk, still_clip}, std::vector{still_clip, walk}}) {
    for (const char* method : {"continuous", "imw", "dtw1", "timewarp"}) {
      const ProgramResult result = align({clips[0], clips[1], "--method", method});
      EXPECT_EQ(result.exit_code, 3) << method;
      EXPECT_THAT(result.err, HasSubstr("still.bvh: error: nothing moves in it")) << method;
    }
  }
}

TEST_F(Align, WarnsOfClipsShorterThanAGaitCycle) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0), slow = clip("slow.bvh", 0.8, 4.0);
  const ProgramResult result = align({beginning("a.bvh", walk, 20), beginning("b.bvh", slow, 30), "--json"});
  EXPECT_THAT(result.err, HasSubstr("a.bvh: warning: is shorter (0.67 s) than a gait cycle"));
  EXPECT_THAT(json_of(result).at("alignments").at(0).at("warnings").dump(), HasSubstr("a.bvh"));
  EXPECT_THAT(align({walk, slow}).err, Not(HasSubstr("warning")));
}

TEST_F(Align, WarnsOfLengthsThatLeaveNoChoice) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0);
  for (const int limit : {2, 3}) {
    const std::string part = beginning("part.bvh", walk, read_bvh(walk).motion.num_frames() / limit + 1);
    const ProgramResult result = align({part, walk, "--method", limit == 2 ? "imw" : "continuous"});
    EXPECT_THAT(result.err, HasSubstr("times as long as the other: a slope limit of " + std::to_string(limit) +
                                      " leaves the warp hardly a choice"));
  }
  EXPECT_THAT(align({folder_.file("part.bvh"), walk, "--slope-limit", "6"}).err, Not(HasSubstr("hardly a choice")));
}

TEST_F(Align, WarnsWhereDynamicTimeWarpingStandsStill) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0);
  const ProgramResult result = align({beginning("a.bvh", walk, 20), walk, "--method", "dtw1"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::ContainsRegex("one frame of one clip belongs to [0-9]+ frames"));
  EXPECT_THAT(align({walk, clip("slow.bvh", 0.8, 4.0), "--method", "dtw1"}).err, Not(HasSubstr("one frame of")));
}

TEST_F(Align, TakesAnySlopeLimitAndResolution) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  const std::string table = folder_.file("table.csv");
  const Json told = json_of(align({walk, slow, "--method", "imw", "--slope-limit", "1.6", "--resolution", "8", "--csv",
                                   table, "--json"}))
                        .at("alignments")
                        .at(0);
  EXPECT_DOUBLE_EQ(told.at("slope_limit"), 1.6);
  EXPECT_LE(told.at("warp").at("most"), 1.6);
  EXPECT_GE(told.at("warp").at("least"), 1.0 / 1.6);
  const auto columns = columns_of(table);
  for (const double slope : columns.at("differential_warp")) EXPECT_EQ(8.0 * slope, std::round(8.0 * slope));
  for (const char* wrong : {"0.5", "100", "two"}) {
    EXPECT_EQ(align({walk, slow, "--slope-limit", wrong}).exit_code, 2) << wrong;
  }
  for (const char* option : {"--warp-smoothness", "--smoothness"}) {
    EXPECT_EQ(align({walk, slow, option, "1e300"}).exit_code, 2) << option;
    EXPECT_EQ(align({walk, slow, option, "1e12"}).exit_code, 0) << option;
  }
  EXPECT_EQ(align({walk, slow, "--resolution", "0"}).exit_code, 2);
  EXPECT_EQ(align({walk, slow, "--resolution", "2.5"}).exit_code, 2);
}

TEST_F(Align, FindsAShortClipInsideALongOne) {
  const std::string walk = clip("walk.bvh", 1.0, 2.5);
  const Motion whole = read_bvh(walk).motion;
  const std::string part = write("part.bvh", whole.slice(20, 50));
  const std::string table = folder_.file("table.csv"), inverse = folder_.file("inverse.csv");
  const ProgramResult result =
      align({part, walk, "--ends", "open", "--csv", table, "--inverse-csv", inverse, "--json"});
  const Json told = json_of(result).at("alignments").at(0);
  constexpr double kFrame = 1.0 / 30.0;  // ends are free to lose a part of a frame
  EXPECT_NEAR(told.at("output_begin_s"), 20.0 / 30.0, kFrame);
  EXPECT_NEAR(told.at("output_end_s"), 50.0 / 30.0, kFrame);
  const auto there = columns_of(table), back = columns_of(inverse);
  EXPECT_NEAR(there.at("output_frame")[15], 35.0, 0.5);
  EXPECT_NEAR(back.at("frame").front(), 20.0, 1.0);
  EXPECT_NEAR(static_cast<double>(back.at("frame").size()), 30.0, 1.0);
  for (std::size_t k = 0; k < back.at("frame").size(); ++k) {
    EXPECT_NEAR(back.at("input_frame")[k], back.at("frame")[k] - 20.0, 1.0);
  }
  EXPECT_EQ(told.at("method"), "imw");  // the continuous warp cannot
  const ProgramResult told_as_text = align({part, walk, "--ends", "open"});
  EXPECT_THAT(told_as_text.out, HasSubstr("of the output"));
  for (const std::string method : {"continuous", "dtw1"}) {
    const ProgramResult refused = align({part, walk, "--ends", "open", "--method", method});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("--ends: expected fixed with --method " + method));
  }
}

TEST_F(Align, WarnsWhereAClipFitsAtSeveralPlaces) {
  const Motion steps = read_bvh(clip("walk.bvh", 1.0, 2.5)).motion.slice(10, 43);  // one gait cycle
  std::vector<Pose> twice = steps.frames();
  twice.insert(twice.end(), steps.frames().begin(), steps.frames().end());
  const std::string whole = write("twice.bvh", Motion(steps.shared_skeleton(), 30.0, twice));
  const ProgramResult result = align({write("once.bvh", steps), whole, "--ends", "open"});
  EXPECT_THAT(result.err, HasSubstr("from 1.10 s on it is nearly as like the input as from 0.00 s on"));
  const std::string once = write("part.bvh", steps.slice(3, 30));
  EXPECT_THAT(align({once, folder_.file("once.bvh"), "--ends", "open"}).err, Not(HasSubstr("nearly as like")));
}

TEST_F(Align, DoesNotOverwriteUnasked) {
  const std::string walk = clip("walk.bvh", 1.0), table = folder_.file("table.csv");
  write_file(table, "mine");
  for (const char* option : {"--csv", "--inverse-csv", "--plot"}) {
    EXPECT_EQ(align({walk, walk, option, table}).exit_code, 1) << option;
    EXPECT_EQ(read_file(table), "mine") << option;
  }
  EXPECT_EQ(align({walk, walk, "--csv", walk, "--force"}).exit_code, 1);
  EXPECT_EQ(align({walk, walk, "--csv", table, "--plot", table, "--force"}).exit_code, 1);
}

}  // namespace
}  // namespace strut::test
