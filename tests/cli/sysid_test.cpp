// SPDX-License-Identifier: MIT
#include "support/program.h"
#include "sysid/known_system.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using nlohmann::json;
using sysid::LtiSystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr double kRecovered = 1e-5;  // of Markov parameters of size one; the table has ten digits
constexpr double kOffset = 7.0;      // of the outputs: what the means must take care of

/// A table of the known system's clips: clip, u1, u2, note, y1, y2, y3.
std::string table(int clips, int frames, double noise) {
  std::ostringstream text;
  text.precision(10);
  text << "clip, u1 ,u2,note,\"y1\",y2,y3\r\n";
  int number = 0;
  for (const sysid::Experiment& clip :
       sysid::test::clips_of(sysid::test::known_system(), {.count = clips, .frames = frames, .noise = noise})) {
    for (int t = 0; t < clip.num_frames(); ++t) {
      text << "clip " << number << "," << clip.input(t, 0) << ",+" << std::abs(clip.input(t, 1)) << ",text";
      for (int o = 0; o < 3; ++o) text << "," << clip.output(t, o) + kOffset;
      text << "\r\n";
    }
    ++number;
  }
  return text.str();
}

/// The same with the signals as they are.
std::string exact_table(int clips, int frames, double noise) {
  std::ostringstream text;
  text.precision(12);
  text << "clip,u1,u2,y1,y2,y3\n";
  int number = 0;
  for (const sysid::Experiment& clip :
       sysid::test::clips_of(sysid::test::known_system(), {.count = clips, .frames = frames, .noise = noise})) {
    for (int t = 0; t < clip.num_frames(); ++t) {
      text << number << "," << clip.input(t, 0) << "," << clip.input(t, 1);
      for (int o = 0; o < 3; ++o) text << "," << clip.output(t, o);
      text << "\n";
    }
    ++number;
  }
  return text.str();
}

Eigen::MatrixXd matrix(const json& rows, Eigen::Index cols) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), cols);
  for (Eigen::Index r = 0; r < out.rows(); ++r) {
    for (Eigen::Index c = 0; c < cols; ++c) out(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  }
  return out;
}

LtiSystem system_of(const json& report) {
  const int order = report["order"];
  return {matrix(report["A"], order), matrix(report["B"], 2), matrix(report["C"], order), matrix(report["D"], 2)};
}

class Sysid : public testing::Test {
 protected:
  ProgramResult run(std::vector<std::string> more) {
    std::vector<std::string> words{"sysid", "@table.csv", "--inputs", "u1,u2", "--outputs", "y1,y2,y3"};
    words.insert(words.end(), more.begin(), more.end());
    return here_.run(STRUT_PROGRAM, words);
  }
  void write_table(const std::string& text) { write_file(here_.file("table.csv"), text, Overwrite::kAllow); }

  Workplace here_;
};

TEST_F(Sysid, WritesTheSystemThatMadeTheTable) {
  write_table(exact_table(12, 60, 0.0));
  const ProgramResult result = run({"--clip", "clip", "--keep-means", "-o", "@system.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(read_file(here_.file("system.json")));
  EXPECT_EQ(report["order"], 4);
  EXPECT_LT(sysid::test::markov_difference(system_of(report), sysid::test::known_system()), kRecovered);
  EXPECT_EQ(report["initial_states"].size(), 12u);
  EXPECT_EQ(report["poles"].size(), 4u);
  EXPECT_EQ(report["inputs"], json({"u1", "u2"}));
  EXPECT_GT(report["fit"]["training"]["simulated_from_rest"]["mean"], 99.99);
  EXPECT_THAT(result.out, HasSubstr("<- chosen"));
  EXPECT_THAT(result.err, HasSubstr("the system leaves no error"));
}

TEST_F(Sysid, JsonIsWhatItWrites) {
  write_table(exact_table(6, 60, 0.2));
  const ProgramResult result =
      run({"--clip", "clip", "--order", "3", "--refine", "--test", "0.4", "--json", "-o", "@system.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, read_file(here_.file("system.json")));
  const json report = json::parse(result.out);
  EXPECT_EQ(report["order"], 3);
  EXPECT_EQ(report["refined_left_out_fit"].size(), 4u);
  EXPECT_EQ(report["initial_states"].size(), 4u) << "two of six are for testing";
  EXPECT_TRUE(report["fit"].contains("test"));
  EXPECT_TRUE(report["noise"]["is_filter"]);
  EXPECT_EQ(report["K"].size(), 3u);
  EXPECT_EQ(report["residuals"]["prediction"]["probability_if_white"].size(), 3u);
}

TEST_F(Sysid, ReportsForAPerson) {
  write_table(table(1, 400, 0.1));
  const ProgramResult result = run({"--test", "0.25", "--refine"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* told : {"trained on 300 rows in 1 clip, tested on 100 rows in 1 clip\n", "order  singular value",
                           "left-out fit", "refined", "\npoles\n", "modulus", "training, simulated from rest",
                           "test, initial state fitted", "predicted one row ahead", "Ljung-Box", "y3: u1"}) {
    EXPECT_THAT(result.out, HasSubstr(told));
  }
}

TEST_F(Sysid, TakesMeansOffAndTellsThem) {
  write_table(table(1, 400, 0.0));
  const json report = json::parse(run({"--json"}).out);
  EXPECT_NEAR(report["output_mean"][0], kOffset, 1.0);
  EXPECT_GT(report["input_mean"][1], 0.5) << "of a modulus";
  const json raw = json::parse(run({"--json", "--keep-means"}).out);
  EXPECT_EQ(raw["output_mean"], json({0.0, 0.0, 0.0}));
}

TEST_F(Sysid, TakesTheMeanOfSeveralEstimates) {
  write_table(exact_table(8, 60, 1.0));
  const std::vector<std::string> how{"--clip", "clip", "--combine", "--radius", "0.9", "--max-order", "4"};
  const ProgramResult result = run(how);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* told : {"regularized, filtered", "<- taken", "mean of those taken"}) {
    EXPECT_THAT(result.out, HasSubstr(told));
  }
  std::vector<std::string> as_json = how;
  as_json.emplace_back("--json");
  const json report = json::parse(run(as_json).out);
  EXPECT_EQ(report["estimates"].size(), 5u);
  EXPECT_EQ(report["order"], report["A"].size());
}

TEST_F(Sysid, HasEveryMethod) {
  write_table(exact_table(8, 60, 0.01));
  for (const char* weighting : {"n4sid", "moesp", "CVA"}) {
    for (const char* way : {"simulation", "states"}) {
      for (const char* order : {"auto", "gap", "4"}) {
        const ProgramResult result =
            run({"--clip", "clip", "--keep-means", "--weighting", weighting, "--bd", way, "--order", order, "--json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(json::parse(result.out)["order"], 4) << weighting << way << order;
      }
    }
  }
}

TEST_F(Sysid, StandsTablesThatSayLittle) {
  write_table("u1,u2,y1,y2,y3\n1,2,3,4,5\n");
  EXPECT_EQ(run({}).exit_code, 0) << "a single row";
  write_table("u1,u2,y1,y2,y3\n1,2,3,4,5\n1,2,3,4,5\n1,2,3,4,5\n");
  const ProgramResult constant = run({"--refine"});
  EXPECT_EQ(constant.exit_code, 0);
  EXPECT_THAT(constant.err, HasSubstr("no input ever differs from zero"));
  EXPECT_THAT(constant.out, HasSubstr("poles: none, a static map"));
  std::string collinear = "u1,u2,y1,y2,y3\n";
  for (int t = 0; t < 200; ++t) {
    const int u = t % 7 - t % 3;
    collinear += std::to_string(u) + "," + std::to_string(2 * u) + "," + std::to_string(t % 5) + ",1," +
                 std::to_string(3 * u) + "\n";
  }
  write_table(collinear);
  const ProgramResult result = run({"--refine", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("null"))) << "JSON has no infinity";
  write_table(exact_table(3, 10, 0.1));
  EXPECT_THAT(run({"--clip", "clip"}).err, HasSubstr("too few or too short for a system with states"));
}

TEST_F(Sysid, NamesThePlaceOfEveryFault) {
  const std::string path = here_.file("table.csv");
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", ": error: expected a line of column names, found nothing\n"},
      {"\n\n", ": error: expected a line of column names, found nothing\n"},
      {"u1,u2,y1,y2,y3\n", ":1: error: expected a line of numbers, found the end of the file\n"},
      {"u1,u2,y1,y2\n1,2,3,4\n", ":1: error: expected a column named 'y3', found none\nhint: the columns are: u1, u2"},
      {"u1,u2,y1,y2,y3,u1\n1,2,3,4,5,6\n", ":1:16: error: expected every name once, found 'u1' again\n"},
      {"u1,u2,y1,y2,y3\n1,2,3,4,5\n1,2,3,4\n", ":3: error: expected 5 fields, found 4\n"},
      {"u1,u2,y1,y2,y3\n1,2,3,4,5\n\n1,2,3,4,5\n", ":3: error: expected 5 fields, found 1\n"},
      {"u1,u2,y1,y2,y3\n1,2, abc,4,5\n", ":2:6: error: expected a finite number, found 'abc'\n"},
      {"u1,u2,y1,y2,y3\n1,2,nan,4,5\n", ":2:5: error: expected a finite number, found 'nan'\n"},
      {"u1,u2,y1,y2,y3\n1,-inf,3,4,5\n", ":2:3: error: expected a finite number, found '-inf'\n"},
      {"u1,u2,y1,y2,y3\n1,2,3,4,\n", ":2:9: error: expected a finite number, found ''\n"},
      {"u1,u2,y1,y2,y3\n1,1e999,3,4,5\n", ":2:3: error: expected a finite number, found '1e999'\n"},
      {"u1,u2,y1,y2,\"y3\n1,2,3,4,5\n", ":1:13: error: expected a closing quote, found the end of the line\n"},
      {"u1,u2,y1,y2,y3\n1,\"2\"x,3,4,5\n", ":2:3: error: expected a field that ends with its quote, found '\"2\"x'\n"}};
  for (const auto& [text, message] : faults) {
    write_table(text);
    const ProgramResult result = run({"-o", "@new.json"});
    EXPECT_EQ(result.exit_code, 3) << text;
    EXPECT_THAT(result.err, HasSubstr(message)) << text;
    EXPECT_THAT(result.err, StartsWith(path));
    EXPECT_EQ(here_.entries(), std::set<std::string>{"table.csv"});
  }
}

TEST_F(Sysid, FilesThatCannotBeReadEndInCode3) {
  write_file(here_.file("junk"), std::string("\x7f\x45\0\xff,\n\r", 7));
  for (const char* name : {"missing", "junk", "."}) {
    const ProgramResult result =
        here_.run(STRUT_PROGRAM, {"sysid", "@" + std::string(name), "--inputs", "u", "--outputs", "y"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, StartsWith(here_.file(name)));
    EXPECT_THAT(result.err, HasSubstr(": error: "));
  }
}

TEST_F(Sysid, RefusesWhatCannotBeMeant) {
  write_table(exact_table(1, 50, 0.1));
  const auto words = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"sysid", "@table.csv"});
    return more;
  };
  const ProgramResult twice = here_.run(STRUT_PROGRAM, words({"--inputs", "u1,u1", "--outputs", "y1"}));
  EXPECT_EQ(twice.exit_code, 3);
  EXPECT_THAT(twice.err, HasSubstr("the column 'u1' is asked for twice"));
  EXPECT_EQ(here_.run(STRUT_PROGRAM, words({"--inputs", "u1"})).exit_code, 2);
  for (const auto& [option, value] :
       {std::pair("--order", "many"), std::pair("--order", "-1"), std::pair("--order", "21"), std::pair("--test", "1"),
        std::pair("--radius", "1"), std::pair("--lags", "0"), std::pair("--weighting", "best")}) {
    const ProgramResult result = run({option, value});
    EXPECT_EQ(result.exit_code, 2) << option << value;
    EXPECT_THAT(result.err, StartsWith("strut sysid: error: " + std::string(option)));
  }
  EXPECT_EQ(run({"-o", "@table.csv", "--force"}).exit_code, 1) << "its own input";
}

}  // namespace
}  // namespace strut::test
