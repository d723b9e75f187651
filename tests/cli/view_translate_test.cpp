// SPDX-License-Identifier: MIT
// strut view, translating: the page gets what strut translate writes, its controls take effect, and what cannot be
// translated is refused in the library's words.
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"
#include "view_session.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/resample.h>

namespace strut::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// The exaggerating model, which also moves slower.
StyleModelParts slow_parts(const Motion& clip) {
  StyleModelParts parts = exaggerating_parts(clip, 0.3, 1.5);
  Eigen::VectorXd mean = parts.output_scaling.mean();
  mean.tail(1).setConstant(std::log(1.25));
  parts.output_scaling = {mean, parts.output_scaling.scale()};
  return parts;
}

class ViewTranslate : public testing::Test {
 protected:
  ViewTranslate() {
    write_clip(here_.file("walk.bvh"), walk_);
    write_clip(here_.file("tail.bvh"), renamed(walk_, 4, "Tail"));
    write_clip(here_.file("pose.bvh"), walk_.slice(0, 1));
    write_style_model(here_.file("style.strut"), StyleModel(slow_parts(walk_)));
    write_style_model(here_.file("copy.strut"), *copying_model(walk_));
    write_style_model(here_.file("fast.strut"), *copying_model(motion::resample(walk_, 60.0)));
    session_ = std::make_unique<ViewSession>(
        std::vector<std::string>{here_.file("walk.bvh"), here_.file("tail.bvh"), here_.file("pose.bvh"),
                                 here_.file("style.strut"), here_.file("copy.strut"), here_.file("fast.strut")});
  }
  /// The walk in the style, with `controls` beside.
  static json request(const json& controls = json::object()) {
    json all{{"clip", "c0"}, {"models", {{{"id", "m0"}}}}};
    all.update(controls);
    return all;
  }
  [[nodiscard]] ViewContainer translated(const json& controls = json::object()) const {
    const ViewAnswer answer = session_->post("translate", request(controls));
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.status == 200 ? read_container(answer.body) : ViewContainer{};
  }
  /// What the command writes.
  [[nodiscard]] std::string written(std::vector<std::string> options) const {
    options.insert(options.begin(), {"translate", "@style.strut", "@walk.bvh", "-o", "@out.bvh", "--force"});
    const ProgramResult result = here_.run(STRUT_PROGRAM, options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_file(here_.file("out.bvh"));
  }

  Workplace here_;
  Motion walk_ = short_walk(0.0, 2.0);
  std::unique_ptr<ViewSession> session_;
};

json blend() {
  return {{{"id", "m0"}}, {{"id", "m1"}, {"share", 0.3}}};
}

TEST_F(ViewTranslate, SavesTheBytesThatTheCommandWrites) {
  const std::string copy_share = here_.file("copy.strut") + "=0.3";
  for (const auto& [controls, options] : std::vector<std::pair<json, std::vector<std::string>>>{
           {json::object(), {}},
           {{{"strength", 0.7}, {"pose", 0.4}, {"movement", 1.2}},
            {"--strength", "0.7", "--pose", "0.4", "--movement", "1.2"}},
           {{{"left_arm", 0.1}, {"head", 0}}, {"--part", "left_arm=0.1", "--part", "head=0"}},
           {{{"generalization", false}, {"retime", false}}, {"--no-generalization", "--no-retime"}},
           {{{"confidence", 0.8}, {"preference", 3.5}, {"warmUp", 1}},
            {"--confidence", "0.8", "--preference", "3.5", "--warm-up", "1"}},
           {{{"cleanFeet", false}, {"keepLayout", true}}, {"--no-clean-feet", "--keep-layout"}},
           {{{"models", blend()}}, {"--blend", copy_share}}}) {
    const ViewAnswer answer = session_->post("translate/bvh", request(controls));
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.body, written(options)) << controls;
    EXPECT_THAT(answer.headers.at("content-disposition"), AllOf(HasSubstr("attachment"), HasSubstr("walk_style")));
  }
}

TEST_F(ViewTranslate, SaysTheCommandThatDoesTheSame) {
  const json controls{{"strength", 1.0 / 3}, {"left_leg", 0.5}, {"cleanFeet", false}, {"models", blend()}};
  const json answer = session_->post("translate/command", request(controls)).json();
  EXPECT_EQ(answer.at("saveAs"), "walk_style_copy.bvh");
  EXPECT_EQ(answer.at("command"), "strut translate " + here_.file("style.strut") + " " + here_.file("walk.bvh") +
                                      " -o walk_style_copy.bvh --blend " + here_.file("copy.strut") +
                                      "=0.3 --strength 0.3333333333333333 --part left_leg=0.5 --no-clean-feet");
  EXPECT_EQ(session_->post("translate/bvh", request(controls)).body,
            written({"--blend", here_.file("copy.strut") + "=0.3", "--strength", "0.3333333333333333", "--part",
                     "left_leg=0.5", "--no-clean-feet"}));
}

/// What the command `line` writes, run by a shell in `here` with the built program as strut.
std::string written_by(const std::string& line, const Workplace& here) {
  const std::string program = std::filesystem::path(STRUT_PROGRAM).parent_path().string();
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "PATH='" + program + "':$PATH; cd '" + here.file("") + "' && " + line + " --force"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read_file(here.file("a_walk_style.bvh"));
}

TEST_F(ViewTranslate, SaysTheCommandThatReadsTheClipAsTheSessionDoes) {
  const json wanted{{"clip", "c0"}, {"models", {{{"id", "m0"}}}}};
  std::string text = format_bvh(walk_, default_layout(walk_.skeleton()));
  const std::size_t offset = text.find("OFFSET");
  text.replace(offset, text.find('\n', offset) - offset, "OFFSET 7 7 7");  // which --positions is about
  write_file(here_.file("a walk.bvh"), text);
  std::set<std::string> results;
  const std::vector<std::vector<std::string>> all_options{
      {}, {"--unit", "in"}, {"--up", "Z"}, {"--positions", "add"}, {"--unit", "ft", "--up", "z", "--positions", "add"}};
  for (const std::vector<std::string>& options : all_options) {
    std::vector<std::string> arguments{here_.file("a walk.bvh"), here_.file("style.strut")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ViewSession session(arguments);
    const std::string command = session.post("translate/command", wanted).json().at("command");
    const std::string saved = session.post("translate/bvh", wanted).body;
    EXPECT_EQ(saved, written_by(command, here_)) << command;
    results.insert(saved);
  }
  EXPECT_EQ(results.size(), all_options.size());
}

TEST_F(ViewTranslate, EveryControlTakesEffect) {
  const std::vector<float> usual = translated().arrays.at("positions");
  std::vector<json> changes;
  for (const char* text : {R"({"strength": 0.5})", R"({"pose": 0.5})", R"({"movement": 0.5})", R"({"confidence": 0.2})",
                           R"({"retime": false})", R"({"cleanFeet": false})"}) {
    changes.push_back(json::parse(text));
  }
  changes.push_back({{"models", blend()}});
  for (const char* part : motion::kBodyPartNames) changes.push_back({{part, 0.5}});
  for (const json& change : changes) EXPECT_NE(translated(change).arrays.at("positions"), usual) << change;
}

TEST_F(ViewTranslate, TellsTheMomentsWhereTheStyleRetimes) {
  const ViewContainer slow = translated();
  const std::vector<float>& moments = slow.arrays.at("moments");
  ASSERT_EQ(moments.size(), static_cast<std::size_t>(walk_.num_frames()));
  EXPECT_NEAR(moments[20], 25.0, 0.01);  // 20 frames that each last a quarter longer
  EXPECT_GT(slow.header.at("numFrames"), walk_.num_frames());
  EXPECT_EQ(translated({{"retime", false}}).arrays.count("moments"), 0U);
}

TEST_F(ViewTranslate, GivesEveryResultAnIdUnderWhichItsCurvesAreFound) {
  const std::string first = translated().header.at("id");
  const ViewContainer second = translated({{"strength", 0.5}});
  EXPECT_NE(second.header.at("id"), first);
  const std::string name = second.header.at("curves").back().at("name");
  for (const std::string& id : {first, second.header.at("id").get<std::string>()}) {
    EXPECT_EQ(session_->get("clips/" + id + "/curve?name=" + name).status, 200);
  }
  EXPECT_THAT(session_->get("clips/made-99/curve?name=" + name).problem(), HasSubstr("no file 'made-99'"));
}

TEST_F(ViewTranslate, TellsWhatModelsAreAndWhatControlsMayBe) {
  const json model = session_->json("models/m0");
  EXPECT_EQ(model.at("frame_rate"), 30.0);
  EXPECT_EQ(model.at("num_joints"), walk_.skeleton().num_joints());
  const json controls = session_->json("translate/controls");
  EXPECT_EQ(controls.at("numbers").size(), 6U + motion::kNumBodyParts);
  EXPECT_EQ(controls.at("numbers")[0],
            (json{{"name", "strength"}, {"group", "style"}, {"least", 0.0}, {"greatest", 1.5}, {"usual", 1.0}}));
  EXPECT_EQ(controls.at("switches").size(), 4U);
}

TEST_F(ViewTranslate, RefusesWhatItCannotTranslate) {
  const auto refused = [this](const json& change) { return session_->post("translate", request(change)).problem(); };
  EXPECT_THAT(refused({{"clip", "c1"}}), HasSubstr("tail.bvh: error: the skeleton does not fit: missing '" +
                                                   walk_.skeleton().joint(4).name + "'; unknown 'Tail'"));
  EXPECT_THAT(refused({{"clip", "c2"}}), HasSubstr("pose.bvh: error: expected at least two frames, got 1"));
  EXPECT_THAT(refused({{"clip", "c9"}}), HasSubstr("no file 'c9'"));
  EXPECT_THAT(refused({{"clip", "m0"}}), HasSubstr("no file 'm0'"));
  EXPECT_THAT(refused({{"models", json::array()}}), HasSubstr("a style model is needed"));
  EXPECT_THAT(refused({{"models", {{{"id", "m0"}}, {{"id", "m2"}, {"share", 0.5}}}}}),
              HasSubstr("fast.strut: error: runs at 60 frames per second"));
  EXPECT_THAT(refused({{"models", {{{"id", "m0"}}, {{"id", "m1"}, {"share", 1.5}}}}}),
              HasSubstr("expected shares from 0 to 1, got 1.5"));
}

TEST_F(ViewTranslate, RefusesControlsThatAreOutOfRangeOrNone) {
  const auto refused = [this](const json& change) { return session_->post("translate", request(change)).problem(); };
  EXPECT_EQ(refused({{"strength", 2}}), "strength: expected a number from 0 to 1.5, got 2");
  EXPECT_EQ(refused({{"warmUp", -1}}), "warmUp: expected a number from 0 to 60, got -1");
  EXPECT_EQ(refused({{"charm", 1}}), "there is no control 'charm'");
  for (const json& change : std::vector<json>{{{"strength", "much"}}, {{"retime", 3}}, {{"models", "m0"}}}) {
    EXPECT_THAT(refused(change), HasSubstr("not understood")) << change;
  }
  EXPECT_EQ(session_->request("POST", "/" + session_->token() + "/api/translate", {}, "{", "application/json").status,
            400);
}

}  // namespace
}  // namespace strut::test
