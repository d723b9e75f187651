// SPDX-License-Identifier: MIT
// What strut learn says of the examples, and strut info of the model that keeps it.
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/model/style_model_io.h>

namespace strut::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

/// Two recordings of each style and pairs of whole clips.
class LearnReportInWords : public testing::Test {
 protected:
  LearnReportInWords() {
    for (const char* take : {"1", "2"}) {
      const double seconds = take[0] == '1' ? 3.0 : 2.5;
      write_clip(here_.file(std::string("normal_") + take + ".bvh"), short_walk(0.0, seconds));
      write_clip(here_.file(std::string("limp_") + take + ".bvh"), short_walk(0.5, seconds));
    }
  }
  ProgramResult learn(const std::vector<std::string>& takes, const std::vector<std::string>& options = {}) {
    std::string list;
    for (const std::string& take : takes) {
      list += "[[pair]]\ninput = \"normal_" + take + ".bvh\"\noutput = \"limp_" + take + ".bvh\"\n";
    }
    write_file(here_.file("pairs.toml"), list, Overwrite::kAllow);
    std::vector<std::string> arguments{"learn", "@pairs.toml", "-o", "@limp.strut"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return here_.run(STRUT_PROGRAM, arguments);
  }
  [[nodiscard]] Json report_in_model() const {
    const ProgramResult result = here_.run(STRUT_PROGRAM, {"info", "@limp.strut", "--json"});
    return Json::parse(result.out).at(0);
  }

  Workplace here_;
};

TEST_F(LearnReportInWords, TellsWhatTheExamplesCoverAndWhatIsMissing) {
  const ProgramResult result = learn({"1", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("learnt from 2 pairs of 2 input and 2 output clips"), HasSubstr("covers speeds of "),
                    HasSubstr("turning from "), HasSubstr("stretches of 2.50 to 3.00 s, which take "),
                    HasSubstr("a radial map of "), HasSubstr("predicted poorly, below 20 % on pairs left out: "),
                    HasSubstr("another take would help, more than 10 points lost on pairs left out: ")));
}

TEST_F(LearnReportInWords, OfOneRecordingSaysThatNothingCouldBeLeftOut) {
  const ProgramResult result = learn({"1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("no pair could be left out"), Not(HasSubstr("predicted poorly"))));
  EXPECT_THAT(result.err, HasSubstr("all pairs are from one recording of each style"));
  const Json report = report_in_model().at("provenance").at("report");
  EXPECT_EQ(report.at("pairs_left_out"), 0);
  EXPECT_TRUE(report.at("blocks").at(0).at("left_out_fit").is_null());
}

TEST_F(LearnReportInWords, IsKeptInTheModelWordForWord) {
  const ProgramResult learnt = learn({"1", "2"});
  ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
  EXPECT_THAT(here_.run(STRUT_PROGRAM, {"info", "@limp.strut"}).out, HasSubstr(learnt.out));
}

TEST_F(LearnReportInWords, OfARadialMapCountsCentresAndOfLinearSystemsStates) {
  ASSERT_EQ(learn({"1", "2"}).exit_code, 0);
  const Json radial = report_in_model();
  EXPECT_GT(radial.at("radial_map").at("num_centres"), 0);
  EXPECT_EQ(radial.at("radial_map").at("num_centres"), radial.at("provenance").at("report").at("centres"));
  EXPECT_GT(radial.at("num_contexts"), 0);
  const ProgramResult linear = learn({"1", "2"}, {"--method", "paper", "--force"});
  ASSERT_EQ(linear.exit_code, 0) << linear.err;
  EXPECT_THAT(linear.out, HasSubstr("linear systems of "));
  const Json paper = report_in_model();
  EXPECT_TRUE(paper.at("radial_map").is_null());
  EXPECT_EQ(paper.at("num_contexts"), 0);
}

TEST(ModelInfo, ReadsReportsFromBeforeRadialMaps) {
  const Workplace here;
  StyleModelParts parts = copying_parts(turning_motion(30.0, 1.0));
  parts.provenance =
      R"({"report":{"pairs":320,"pairs_refused":1,"seconds":177.5,"speed":[0.8,1.3],"turning_rate":[-0.1,0.1],)"
      R"("duration_ratio":0.9,"blocks":[{"name":"Spine","states":4,"left_out_fit":12.0,"fit":60.0}]}})";
  write_style_model(here.file("old.strut"), StyleModel(std::move(parts)));
  const ProgramResult result = here.run(STRUT_PROGRAM, {"info", "@old.strut"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("learnt from 320 pairs, 177.5 s of input (1 refused)"),
                                HasSubstr("linear systems of "), HasSubstr("left out: Spine (12 %)"),
                                HasSubstr("left out: Spine (60 to 12 %)"), Not(HasSubstr("stretches"))));
}

TEST(ModelInfo, NamesTheFirstOfManyPartsAndSaysIfItIsAll) {
  const Workplace here;
  const auto info = [&](int short_of_takes) {
    Json report = Json::parse(R"({"pairs":8,"pairs_refused":0,"seconds":9.0,"speed":[0.8,1.3],)"
                              R"("turning_rate":[-0.1,0.1],"duration_ratio":0.9,"blocks":[]})");
    for (int k = 0; k < 8; ++k) {
      const double left_out = k < short_of_takes ? 40.0 - k : 60.0;
      report["blocks"].push_back(
          {{"name", "j" + std::to_string(k)}, {"states", 0}, {"left_out_fit", left_out}, {"fit", 60.0}});
    }
    StyleModelParts parts = copying_parts(turning_motion(30.0, 1.0));
    parts.provenance = Json{{"report", report}}.dump();
    write_style_model(here.file("many.strut"), StyleModel(std::move(parts)), Overwrite::kAllow);
    return here.run(STRUT_PROGRAM, {"info", "@many.strut"}).out;
  };
  EXPECT_THAT(info(7), HasSubstr("left out: j6 (60 to 34 %), j5 (60 to 35 %), j4 (60 to 36 %), j3 (60 to 37 %), "
                                 "j2 (60 to 38 %), j1 (60 to 39 %) and 1 more\n"));
  EXPECT_THAT(info(8), HasSubstr("left out: every part, most of all j7 (60 to 33 %), "));
  EXPECT_THAT(info(0), HasSubstr("left out: none\n"));
}

TEST(ModelInfo, TellsAModelWithoutAReportFromOneWith) {
  const Workplace here;
  write_style_model(here.file("made.strut"), *copying_model(turning_motion(30.0, 1.0)));
  EXPECT_THAT(here.run(STRUT_PROGRAM, {"info", "@made.strut"}).out,
              AllOf(HasSubstr("linear systems of "), HasSubstr("it does not say how it was learnt")));
}

}  // namespace
}  // namespace strut::test
