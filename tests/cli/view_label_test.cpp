// SPDX-License-Identifier: MIT
// Labelling in the page: what raters are asked, that every label is on the disk before the next item comes, that a
// crash loses nothing, and that raters learn nothing of each other.
#include "support/program.h"
#include "support/walks.h"
#include "view_session.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>

namespace strut::test {
namespace {

using effort::FragmentDatabase;
using effort::LabelRecord;
using effort::LabelTarget;
using effort::TargetKind;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr int kFragments = 12;

class ViewLabel : public testing::Test {
 protected:
  ViewLabel() : path_(here_.file("moves.db")) {
    const Motion walk = short_walk(0.0), limp = short_walk(0.8);
    auto database = FragmentDatabase::create(path_, walk.shared_skeleton(), walk.frame_rate());
    std::vector<motion::FrameRange> cuts;
    for (int i = 0; i < kFragments / 2; ++i) cuts.push_back({15 * i, 15 * (i + 1)});
    database.add_clip({"secretly_proud.bvh", "", "strutting"}, walk, cuts);
    database.add_clip({"secretly_sad.bvh", "", "strutting"}, limp, cuts);
  }

  static Json label(const std::string& rater, const Json& item, double flow) {
    return {{"rater", rater},
            {"item", item},
            {"rating", {{"flow", flow}, {"weight", -0.25}, {"time", nullptr}, {"space", nullptr}}},
            {"notPresent", {"time"}},
            {"comment", "as it comes"}};
  }
  static Json progress(const ViewSession& session, const std::string& rater) {
    return session.json("labels/d0?rater=" + rater);
  }
  /// Labels `count` items (all by default); every answer.
  static std::vector<Json> label_items(const ViewSession& session, const std::string& rater, int count = 1000) {
    std::vector<Json> answers{progress(session, rater)};
    for (int i = 0; i < count && !answers.back().at("next").is_null(); ++i) {
      answers.push_back(session.post("labels/d0", label(rater, answers.back().at("next"), 0.01 * i)).json());
    }
    return answers;
  }
  [[nodiscard]] std::vector<LabelRecord> labels_of(const std::string& rater) const {
    std::vector<LabelRecord> all = FragmentDatabase::open(path_).labels();
    std::erase_if(all, [&](const LabelRecord& label) { return label.rater != rater; });
    return all;
  }
  static std::vector<LabelTarget> targets_of(const std::vector<LabelRecord>& labels) {
    std::vector<LabelTarget> targets;
    for (const LabelRecord& label : labels) targets.push_back(label.target);
    return targets;
  }

  Workplace here_;
  std::string path_;
};

TEST_F(ViewLabel, StoresWhatARaterSaid) {
  const ViewSession session({path_});
  const Json before = progress(session, "ada");
  EXPECT_EQ(before.at("done"), 0);
  EXPECT_EQ(before.at("total"), kFragments + 1);  // one repeat
  const Json after = session.post("labels/d0", label("ada", before.at("next"), 0.5)).json();
  EXPECT_EQ(after.at("stored"), "now");
  EXPECT_EQ(after.at("done"), 1);
  EXPECT_EQ(after.at("next"), before.at("afterNext"));
  const auto labels = labels_of("ada");
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].source, effort::LabelSource::kPerson);
  EXPECT_EQ(labels[0].rating[effort::kFlow], 0.5);
  EXPECT_EQ(labels[0].rating[effort::kWeight], -0.25);
  EXPECT_FALSE(effort::is_rated(labels[0].rating[effort::kTime]));
  EXPECT_FALSE(effort::is_rated(labels[0].rating[effort::kSpace]));
  EXPECT_EQ(labels[0].not_present, (std::array{false, false, true, false}));
  EXPECT_EQ(labels[0].comment, "as it comes");
  EXPECT_THAT(labels[0].labelled_at, testing::MatchesRegex("....-..-..T..:..:..\\....Z"));
}

TEST_F(ViewLabel, ShowsAFragmentThatTellsNothingOfItself) {
  const ViewSession session({path_});
  const Json at = progress(session, "ada");
  const auto shown = session.get("labels/d0/items/" + at.at("next").get<std::string>() + "?rater=ada");
  ASSERT_EQ(shown.status, 200);
  EXPECT_THAT(shown.body, Not(HasSubstr("secretly")));
  EXPECT_THAT(shown.body, Not(HasSubstr("strutting")));
  const ViewContainer clip = read_container(shown.body);
  EXPECT_EQ(clip.header.at("name"), "fragment");
  EXPECT_EQ(clip.header.at("numFrames"), 15);
}

TEST_F(ViewLabel, RepeatsOneBlindly) {
  const ViewSession session({path_});
  const auto answers = label_items(session, "ada");
  ASSERT_EQ(answers.size(), static_cast<std::size_t>(kFragments + 2));
  EXPECT_EQ(answers.back().at("done"), kFragments + 1);
  std::set<std::string> names;
  for (std::size_t i = 0; i + 1 < answers.size(); ++i) {
    EXPECT_TRUE(names.insert(answers[i].at("next").get<std::string>()).second) << "a repeat has another name";
    EXPECT_FALSE(answers[i].contains("consistency"));
    EXPECT_THAT(answers[i].dump(), Not(HasSubstr("epeat")));
    EXPECT_EQ(answers[i].size(), i == 0 ? 6U : 7U) << "every answer says the same things of its item";
    EXPECT_EQ(answers[i].at("total"), kFragments + 1);
  }
  const auto labels = labels_of("ada");
  std::set<LabelTarget> seen;
  int repeats = 0;
  for (const LabelRecord& label : labels) {
    EXPECT_EQ(label.is_repeat, !seen.insert(label.target).second);
    repeats += label.is_repeat ? 1 : 0;
  }
  EXPECT_EQ(repeats, 1);
  EXPECT_EQ(answers.back().at("consistency").at("repeats"), 1);
  EXPECT_GT(answers.back().at("consistency").at("factors").at(0).at("meanDifference").get<double>(), 0.0);
}

TEST_F(ViewLabel, StoresNothingTwice) {
  const ViewSession session({path_});
  const Json said = label("ada", progress(session, "ada").at("next"), 0.5);
  EXPECT_EQ(session.post("labels/d0", said).json().at("stored"), "now");
  const Json again = session.post("labels/d0", said).json();
  EXPECT_EQ(again.at("stored"), "before");
  EXPECT_EQ(again.at("done"), 1);
  EXPECT_EQ(labels_of("ada").size(), 1U);
}

TEST_F(ViewLabel, StoresNothingOfWhatIsNotAskedFor) {
  const ViewSession session({path_});
  const Json at = progress(session, "ada");
  EXPECT_EQ(session.post("labels/d0", label("eve", at.at("next"), 0.5)).json().at("stored"), "no");
  EXPECT_EQ(session.post("labels/d0", label("ada", at.at("afterNext"), 0.5)).json().at("stored"), "no");
  EXPECT_EQ(session.post("labels/d0", label("ada", "0-0000000000000000", 0.5)).json().at("stored"), "no");
  EXPECT_TRUE(FragmentDatabase::open(path_).labels().empty());
}

TEST_F(ViewLabel, RefusesWhatIsNoLabelInWords) {
  const ViewSession session({path_});
  const Json next = progress(session, "ada").at("next");
  EXPECT_THAT(session.post("labels/d0", label("ada", next, 1.5)).problem(), HasSubstr("from -1 to 1"));
  EXPECT_THAT(session.post("labels/d0", label("  ", next, 0.5)).problem(), HasSubstr("rater's name"));
  Json bad = label("ada", next, 0.5);
  bad["comment"] = "two\nlines";
  EXPECT_THAT(session.post("labels/d0", bad).problem(), HasSubstr("one line"));
  bad = label("ada", next, 0.5);
  bad["rating"]["grace"] = 0.1;
  EXPECT_THAT(session.post("labels/d0", bad).problem(), HasSubstr("grace"));
  bad = label("ada", next, 0.5);
  bad["rating"]["flow"] = "much";
  for (const Json& said : {bad, Json::object(), Json("x"), Json(nullptr), Json{{"rater", 7}}}) {
    const auto answer = session.post("labels/d0", said);
    EXPECT_EQ(answer.status, 400) << said;
    EXPECT_NE(answer.problem(), "") << said;
  }
  EXPECT_EQ(session.get("labels/d7?rater=ada").status, 404);
  EXPECT_EQ(session.get("labels/d0").status, 400);
  EXPECT_EQ(session.get("labels/d0/items/nothing?rater=ada").status, 404);
  EXPECT_TRUE(FragmentDatabase::open(path_).labels().empty());
}

TEST_F(ViewLabel, TakesTheLastLabelBackOnce) {
  const ViewSession session({path_});
  const auto answers = label_items(session, "ada", 3);
  const Json back = session.post("labels/d0/undo", {{"rater", "ada"}, {"done", 3}}).json();
  EXPECT_EQ(back.at("done"), 2);
  EXPECT_EQ(back.at("next"), answers[2].at("next"));
  // Asked again, because the answer was lost.
  EXPECT_EQ(session.post("labels/d0/undo", {{"rater", "ada"}, {"done", 3}}).json().at("done"), 2);
  EXPECT_EQ(labels_of("ada").size(), 2U);
  const Json again = session.post("labels/d0", label("ada", back.at("next"), 0.9)).json();
  EXPECT_EQ(again.at("stored"), "now");
  EXPECT_EQ(again.at("next"), answers[3].at("next"));
}

TEST_F(ViewLabel, ShowsARepeatAgainAfterUndo) {
  const ViewSession session({path_});
  label_items(session, "ada");
  const auto before = labels_of("ada");
  for (int done = kFragments + 1; done > 6; --done) {
    ASSERT_EQ(session.post("labels/d0/undo", {{"rater", "ada"}, {"done", done}}).status, 200);
  }
  label_items(session, "ada");
  const auto after = labels_of("ada");
  ASSERT_EQ(targets_of(after), targets_of(before));
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].is_repeat, before[i].is_repeat);
}

TEST_F(ViewLabel, GoesOnAsIfItHadNotBeenKilled) {
  label_items(ViewSession({path_}), "ada");
  const auto undisturbed = targets_of(labels_of("ada"));
  {
    auto database = FragmentDatabase::open(path_, effort::Access::kReadWrite);
    while (database.remove_last_label("ada")) {
    }
  }
  for (int acknowledged = 0; acknowledged < kFragments + 1;) {
    ViewSession session({path_});
    acknowledged = label_items(session, "ada", 2).back().at("done").get<int>();
    session.kill();
    EXPECT_EQ(labels_of("ada").size(), static_cast<std::size_t>(acknowledged));
  }
  EXPECT_EQ(targets_of(labels_of("ada")), undisturbed);
}

TEST_F(ViewLabel, HasEveryAcknowledgedLabelWheneverItIsKilled) {
  for (const int milliseconds : {5, 20, 45, 80}) {
    ViewSession session({path_});
    const auto done_before = labels_of("ada").size();
    std::atomic<std::size_t> acknowledged = done_before;
    std::thread rater([&] {
      Json at = Json::parse(session.get("labels/d0?rater=ada").body, nullptr, false);
      while (at.is_object() && !at.at("next").is_null()) {
        at = Json::parse(session.post("labels/d0", label("ada", at.at("next"), 0.5)).body, nullptr, false);
        if (at.is_object()) acknowledged = at.at("done").get<std::size_t>();
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    session.program().send(SIGKILL);
    rater.join();
    const auto stored = labels_of("ada").size();
    EXPECT_GE(stored, acknowledged);
    EXPECT_LE(stored, acknowledged + 1);  // stored, but killed before it could say so
  }
}

TEST_F(ViewLabel, TellsARaterNothingOfOthers) {
  {
    auto database = FragmentDatabase::open(path_, effort::Access::kReadWrite);
    LabelRecord other;
    other.rater = "Zebulon";
    other.labelled_at = "2026-03-01T12:00:00Z";
    other.comment = "obviously furious";
    other.rating[effort::kFlow] = 0.123456;
    other.target = {TargetKind::kFragment, 1};
    database.add_labels({other});
    database.set_estimates({{2, effort::EffortVector::Constant(0.654321), effort::EffortVector::Ones()}});
  }
  const ViewSession session({path_});
  std::vector<std::string> said{session.get("session").body};
  for (const Json& answer : label_items(session, "ada")) {
    said.push_back(answer.dump());
    if (answer.at("next").is_null()) continue;
    said.push_back(session.get("labels/d0/items/" + answer.at("next").get<std::string>() + "?rater=ada").body);
  }
  for (const std::string& answer : said) {
    for (const char* secret : {"Zebulon", "furious", "0.123456", "0.654321", "secretly", "strutting"}) {
      EXPECT_THAT(answer, Not(HasSubstr(secret)));
    }
  }
  EXPECT_EQ(progress(session, "eve").at("done"), 0);
  EXPECT_EQ(labels_of("Zebulon").size(), 1U);
}

TEST_F(ViewLabel, CountsImportedLabelsAsDone) {
  {
    auto database = FragmentDatabase::open(path_, effort::Access::kReadWrite);
    LabelRecord mine;
    mine.rater = "ada";
    mine.labelled_at = "2026-03-01T12:00:00Z";
    mine.rating[effort::kFlow] = 0.1;
    for (mine.target.id = 1; mine.target.id <= kFragments; ++mine.target.id) database.add_labels({mine});
  }
  const ViewSession session({path_});
  EXPECT_EQ(progress(session, "ada").at("done"), kFragments);
  EXPECT_TRUE(progress(session, "ada").at("next").is_null());
}

TEST_F(ViewLabel, TakesInBlendsThatAreAddedMeanwhile) {
  const ViewSession session({path_});
  EXPECT_TRUE(label_items(session, "ada").back().at("next").is_null());
  {
    auto database = FragmentDatabase::open(path_, effort::Access::kReadWrite);
    database.add_blend(1, 7, 0.5);
    database.add_blend(1, 2, 9.0);  // no blend goes so far
  }
  const auto answers = label_items(session, "ada");
  EXPECT_TRUE(answers.back().at("next").is_null());
  EXPECT_THAT(answers.back().at("notes").dump(), HasSubstr("blend 2 cannot be made and is left out"));
  const auto labels = labels_of("ada");
  EXPECT_EQ(labels.size(), static_cast<std::size_t>(answers.back().at("done").get<int>()));
  const LabelTarget blend{TargetKind::kBlend, 1};
  EXPECT_THAT(targets_of(labels), testing::Contains(blend));
}

TEST_F(ViewLabel, SaysThatAnotherProgramWritesAndLosesNothing) {
  const ViewSession session({path_});
  const Json said = label("ada", progress(session, "ada").at("next"), 0.5);
  {
    auto database = FragmentDatabase::open(path_, effort::Access::kReadWrite);
    const FragmentDatabase::Transaction transaction(database);
    const auto answer = session.post("labels/d0", said);
    EXPECT_EQ(answer.status, 400);
    EXPECT_THAT(answer.problem(), HasSubstr("another program is writing"));
  }
  EXPECT_EQ(session.post("labels/d0", said).json().at("stored"), "now");
  EXPECT_EQ(labels_of("ada").size(), 1U);
}

TEST_F(ViewLabel, LeavesADatabaseAloneThatIsOnlyLookedAt) {
  const auto before = read_file(path_);
  const ViewSession session({path_});
  const Json at = progress(session, "ada");
  (void)session.container("labels/d0/items/" + at.at("next").get<std::string>() + "?rater=ada");
  EXPECT_EQ(read_file(path_), before);
}

TEST_F(ViewLabel, ShowsWhatIsWrongWithADamagedDatabase) {
  std::string bytes = read_file(path_);
  for (std::size_t i = 4096; i < bytes.size(); ++i) bytes[i] = 'x';
  write_file(path_, bytes, Overwrite::kAllow);
  const ViewSession session({path_});
  const auto answer = session.get("labels/d0?rater=ada");
  EXPECT_EQ(answer.status, 400);
  EXPECT_THAT(answer.problem(), HasSubstr("moves.db"));
  EXPECT_THAT(answer.problem(), HasSubstr("intact fragment database"));
}

}  // namespace
}  // namespace strut::test
