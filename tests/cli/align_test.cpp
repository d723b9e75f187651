// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/program.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Align : public testing::Test {
 protected:
  std::string clip(const std::string& name, double cadence, double duration = 2.0) {
    generate::WalkContent content;
    content.duration = duration;
    generate::WalkStyle style;
    style.cadence_scale = cadence;
    const Motion motion = generate::generate_walk(content, style, 30.0).motion;
    write_bvh(folder_.file(name), motion, default_layout(motion.skeleton()), Overwrite::kAllow);
    return folder_.file(name);
  }
  static ProgramResult align(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "align");
    return run_program(STRUT_PROGRAM, arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(Align, PrintsEAfterEveryRoundAndTheDurations) {
  const ProgramResult result = align({clip("walk.bvh", 1.0), clip("slow.bvh", 0.8)});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("E after round  1"));
  EXPECT_THAT(result.out, HasSubstr("2.00 s"));
  EXPECT_THAT(result.out, HasSubstr("at the slope limit 2"));
}

TEST_F(Align, WritesATableWhoseTimesRise) {
  const std::string table = folder_.file("table.csv");
  const std::string input = clip("walk.bvh", 1.0), output = clip("slow.bvh", 0.8);
  for (const char* method : {"imw", "dtw1", "dtw3", "timewarp"}) {
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

TEST_F(Align, DrawsThreePanels) {
  const std::string plot = folder_.file("plot.svg");
  const ProgramResult result =
      align({clip("walk & run.bvh", 1.0), clip("slow.bvh", 0.8), "--plot", plot, "--dof", "leftupleg"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string svg = read_file(plot);
  for (const char* text : {"Correspondence by IMW", "Time-warped by DTW, Type I", "Time-warped by IMW", "LeftUpLeg x",
                           "[degrees]", "walk &amp; run.bvh", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST_F(Align, RefusesWhatItCannotDoAndWritesNothing) {
  const std::string table = folder_.file("table.csv"), plot = folder_.file("plot.svg");
  const std::string walk = clip("walk.bvh", 1.0), brief = clip("brief.bvh", 1.0, 0.7);
  const ProgramResult lengths = align({walk, brief, "--csv", table});
  EXPECT_EQ(lengths.exit_code, 3);
  EXPECT_THAT(lengths.err, HasSubstr("slope limit of 3"));
  const ProgramResult dof = align({walk, walk, "--csv", table, "--plot", plot, "--dof", "tail"});
  EXPECT_EQ(dof.exit_code, 1);
  EXPECT_THAT(dof.err, testing::AllOf(HasSubstr("'tail'"), HasSubstr("LeftUpLeg x")));
  EXPECT_EQ(align({walk, walk, "--method", "guess", "--csv", table}).exit_code, 2);
  EXPECT_EQ(align({walk, folder_.file("missing.bvh"), "--csv", table}).exit_code, 3);
  EXPECT_THROW(read_file(table), FileError);
  EXPECT_THROW(read_file(plot), FileError);
}

TEST_F(Align, DoesNotOverwriteUnasked) {
  const std::string walk = clip("walk.bvh", 1.0), table = folder_.file("table.csv");
  write_file(table, "mine");
  EXPECT_EQ(align({walk, walk, "--csv", table}).exit_code, 1);
  EXPECT_EQ(read_file(table), "mine");
}

}  // namespace
}  // namespace strut::test
