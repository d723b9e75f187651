// SPDX-License-Identifier: MIT
// strut view and pair lists: what the page is told of one, what is written when it saves, and what is refused.
#include "support/program.h"
#include "support/walks.h"
#include "view_session.h"

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/io/pair_list.h>

namespace strut::test {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kList = R"(# A heading.

# whole: 3.00 -> 3.00 s; distance 0.10
[[pair]]
input = "normal.bvh"
output = "limp.bvh"

# left cycle: 1.23 -> 0.89 m/s, turning +1 -> +0 degrees, 1.10 -> 0.90 s; distance 0.05
# accepted
[[pair]]
input = "normal.bvh"
output = "limp.bvh"
input_frames = [10, 43]
output_frames = [12, 40]
# the end
)";

class ViewPairs : public testing::Test {
 protected:
  ViewPairs() {
    write_clip(here_.file("normal.bvh"), short_walk(0.0));
    write_clip(here_.file("limp.bvh"), short_walk(0.8));
    write_file(list_, kList);
  }
  [[nodiscard]] ViewSession session() const { return ViewSession({list_}); }
  /// The list as the page has it after the file was opened.
  [[nodiscard]] static Json opened(const ViewSession& view) { return view.json("pairs/p0"); }

  Workplace here_;
  std::string list_ = here_.file("pairs.toml");
};

TEST_F(ViewPairs, AreToldWithTheirClipsRangesCommentsAndVerdicts) {
  const ViewSession view = session();
  const Json list = opened(view);
  EXPECT_EQ(list.at("heading"), "A heading.");
  EXPECT_EQ(list.at("ending"), "the end");
  ASSERT_EQ(list.at("pairs").size(), 2U);
  const Json& whole = list.at("pairs")[0];
  const Json& cycle = list.at("pairs")[1];
  EXPECT_TRUE(whole.at("input").at("frames").is_null());
  EXPECT_EQ(whole.at("comment"), "whole: 3.00 -> 3.00 s; distance 0.10");
  EXPECT_EQ(whole.at("verdict"), "none");
  EXPECT_EQ(cycle.at("output").at("frames"), Json({12, 40}));
  EXPECT_EQ(cycle.at("verdict"), "accepted");
  EXPECT_NE(cycle.at("input").at("clip"), cycle.at("output").at("clip"));
  EXPECT_EQ(view.get("clips/" + cycle.at("input").at("clip").get<std::string>()).status, 200);
}

TEST_F(ViewPairs, AreWrittenAsTheyWereIfNothingWasChanged) {
  const ViewSession view = session();
  Json list = opened(view);
  for (int time = 0; time < 2; ++time) {
    const ViewAnswer answer = view.put("pairs/p0", list);
    ASSERT_EQ(answer.status, 200) << answer.body;
    list["version"] = answer.json().at("version");
    EXPECT_EQ(read_file(list_), std::string(kList).insert(std::string(kList).find("# the end"), "\n"));
  }
}

TEST_F(ViewPairs, AreSavedAsAPersonCutThemForLearning) {
  const ViewSession view = session();
  Json list = opened(view);
  list["pairs"][0]["input"]["frames"] = {3, 50};
  list["pairs"][1]["verdict"] = "rejected";
  ASSERT_EQ(view.put("pairs/p0", list).status, 200);
  const auto pairs = read_pair_list(list_);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].input.path, here_.file("normal.bvh"));
  EXPECT_EQ(pairs[0].input.frames, (motion::FrameRange{3, 50}));
  EXPECT_FALSE(pairs[0].output.frames.has_value());
  EXPECT_EQ(pairs[0].comment, "whole: 3.00 -> 3.00 s; distance 0.10");
  EXPECT_THAT(here_.entries(), ElementsAre("limp.bvh", "normal.bvh", "pairs.toml"));
}

TEST_F(ViewPairs, ThatWereRejectedAreThereWhenTheListIsOpenedAgain) {
  const ViewSession view = session();
  Json list = opened(view);
  list["pairs"][1]["verdict"] = "rejected";
  ASSERT_EQ(view.put("pairs/p0", list).status, 200);
  const ViewSession again = session();
  const Json pairs = opened(again).at("pairs");
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[1].at("verdict"), "rejected");
  EXPECT_EQ(pairs[1].at("input").at("frames"), Json({10, 43}));
  EXPECT_THAT(pairs[1].at("comment").get<std::string>(), HasSubstr("distance 0.05"));
}

TEST_F(ViewPairs, AreNotWrittenOverWhatSomebodyElseWrote) {
  const ViewSession view = session();
  const Json list = opened(view);
  const std::string theirs = std::string(kList) + "# and a line of theirs\n";
  write_file(list_, theirs, Overwrite::kAllow);
  const ViewAnswer answer = view.put("pairs/p0", list);
  EXPECT_EQ(answer.status, 409);
  EXPECT_THAT(answer.problem(), HasSubstr("changed on disk"));
  EXPECT_THAT(answer.hint(), HasSubstr("save a copy"));
  EXPECT_EQ(read_file(list_), theirs);
  EXPECT_EQ(view.put("pairs/p0", opened(view)).status, 200);  // read again, it can be saved
}

TEST_F(ViewPairs, AreTextForACopyWhateverIsOnDisk) {
  const ViewSession view = session();
  const Json list = opened(view);
  write_file(list_, "not a list", Overwrite::kAllow);
  const ViewAnswer answer = view.post("pairs/p0/text", list);
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(parse_pair_list(answer.body, list_).size(), 2U);
  EXPECT_THAT(answer.headers.at("content-disposition"), HasSubstr("pairs.toml"));
  EXPECT_EQ(read_file(list_), "not a list");
}

struct Spoilt {
  const char* what;
  Json patch;
  const char* problem;
};

TEST_F(ViewPairs, AreRefusedWithWhatIsNotOfTheSession) {
  const ViewSession view = session();
  const Json list = opened(view);
  const std::vector<Spoilt> all{
      {"beyond the clip", Json::parse(R"([{"op":"replace","path":"/pairs/1/input/frames","value":[10,9000]}])"),
       "pair 2: frames 10 to 9000 reach beyond normal.bvh"},
      {"reversed", Json::parse(R"([{"op":"replace","path":"/pairs/1/input/frames","value":[10,10]}])"),
       "pair 2: frames 10 to 10"},
      {"negative", Json::parse(R"([{"op":"replace","path":"/pairs/0/output/frames","value":[-1,10]}])"), "pair 1"},
      {"a path", Json::parse(R"([{"op":"replace","path":"/pairs/0/input/clip","value":"/etc/passwd"}])"), "pair 1"},
      {"the list itself", Json::parse(R"([{"op":"replace","path":"/pairs/0/input/clip","value":"p0"}])"), "pair 1"},
      {"fractions", Json::parse(R"([{"op":"replace","path":"/pairs/0/input/frames","value":[0.5,10]}])"), "pair 1"},
      {"a verdict", Json::parse(R"([{"op":"replace","path":"/pairs/0/verdict","value":"maybe"}])"), "pair 1"},
      {"no pair", Json::parse(R"([{"op":"replace","path":"/pairs","value":[]}])"), "at least one pair"},
      {"no pairs", Json::parse(R"([{"op":"remove","path":"/pairs"}])"), "not understood"},
  };
  for (const Spoilt& spoilt : all) {
    const ViewAnswer answer = view.put("pairs/p0", list.patch(spoilt.patch));
    EXPECT_GE(answer.status, 400) << spoilt.what;
    EXPECT_LT(answer.status, 500) << spoilt.what;
    EXPECT_THAT(answer.problem(), HasSubstr(spoilt.problem)) << spoilt.what;
  }
  EXPECT_EQ(view.put("pairs/p1", list).status, 404);
  EXPECT_EQ(read_file(list_), kList);
}

TEST_F(ViewPairs, AreAlignedFrameByFrameWithinTheirStretches) {
  const ViewSession view = session();
  const Json cycle = opened(view).at("pairs")[1];
  const ViewAnswer answer = view.post("pairs/p0/alignment", cycle);
  ASSERT_EQ(answer.status, 200) << answer.body;
  const auto moments = answer.json().at("moments").get<std::vector<double>>();
  ASSERT_EQ(moments.size(), 33U);
  for (std::size_t i = 1; i < moments.size(); ++i) EXPECT_GE(moments[i], moments[i - 1]);
  EXPECT_GE(moments.front(), 12.0);
  EXPECT_LE(moments.back(), 39.0);
}

TEST_F(ViewPairs, ThatCannotBeAlignedAreSaidToBeLeftOut) {
  const ViewSession view = session();
  Json pair = opened(view).at("pairs")[1];
  pair["output"]["frames"] = {0, 90};
  pair["input"]["frames"] = {0, 20};
  const ViewAnswer answer = view.post("pairs/p0/alignment", pair);
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.problem(), HasSubstr("factor of 3"));
  EXPECT_THAT(answer.hint(), HasSubstr("strut learn leaves"));
}

TEST_F(ViewPairs, AreNeverHalfWrittenWhenTheProgramIsKilled) {
  constexpr std::size_t kPairs = 300;  // long enough to be caught in the middle
  for (int round = 0; round < 5; ++round) {
    ViewSession view = session();
    Json list = opened(view);
    while (list["pairs"].size() < kPairs) list["pairs"].push_back(list["pairs"][1]);
    std::thread saver([&] {
      for (int i = 0;; ++i) {
        list["heading"] = "Save " + std::to_string(i);
        const ViewAnswer answer = view.put("pairs/p0", list);
        if (answer.status != 200) return;  // it was killed
        list["version"] = answer.json().at("version");
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 7 * round));
    view.program().send(SIGKILL);
    saver.join();
    EXPECT_THAT(read_pair_list(list_).size(), testing::AnyOf(2U, kPairs));
    EXPECT_EQ(parse_annotated_pair_list(read_file(list_), list_).ending, "the end");
  }
}

}  // namespace
}  // namespace strut::test
