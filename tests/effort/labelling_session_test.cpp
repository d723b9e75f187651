// SPDX-License-Identifier: MIT
// The order in which raters are shown fragments and blends.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/effort/labelling_session.h>

namespace strut {
namespace {

using namespace effort;

std::vector<LabelTarget> fragments(int count) {
  std::vector<LabelTarget> targets;
  for (int id = 1; id <= count; ++id) targets.push_back({TargetKind::kFragment, id});
  return targets;
}

/// Everything that `rater` is shown after `labelled`.
std::vector<LabellingItem> shown(const std::string& rater, const std::vector<LabelTarget>& targets,
                                 const std::vector<LabelTarget>& labelled = {}) {
  LabellingSession session(rater, targets, labelled);
  std::vector<LabellingItem> items;
  while (const auto item = session.next()) {
    items.push_back(*item);
    session.record(item->target);
  }
  return items;
}

std::vector<LabelTarget> targets_of(const std::vector<LabellingItem>& items) {
  std::vector<LabelTarget> targets;
  for (const LabellingItem& item : items) targets.push_back(item.target);
  return targets;
}

TEST(LabellingSession, ShowsEverythingOnceButRepeats) {
  const auto items = shown("ada", fragments(100));
  std::set<LabelTarget> seen;
  for (const LabellingItem& item : items) EXPECT_EQ(item.is_repeat, !seen.insert(item.target).second);
  EXPECT_EQ(seen.size(), 100U);
}

TEST(LabellingSession, RepeatsOneInTen) {
  for (const int count : {40, 300, 1000}) {
    const auto items = shown("ada", fragments(count));
    const auto repeats = std::count_if(items.begin(), items.end(), [](const auto& item) { return item.is_repeat; });
    EXPECT_NEAR(static_cast<double>(repeats), 0.1 * static_cast<double>(items.size()), 1.0) << count;
  }
}

TEST(LabellingSession, RepeatsWhatWasShownAWhileAgoAndEachOnce) {
  std::map<LabelTarget, std::vector<int>> steps;
  for (const LabellingItem& item : shown("ada", fragments(300))) steps[item.target].push_back(item.step);
  for (const auto& [target, of] : steps) {
    ASSERT_LE(of.size(), 2U);
    EXPECT_TRUE(of.size() == 1 || of[1] - of[0] >= kLeastStepsBetween);
  }
}

TEST(LabellingSession, RepeatsFallOnDifferentStepsOfEveryTen) {
  std::set<int> places;
  for (const LabellingItem& item : shown("ada", fragments(500))) {
    if (item.is_repeat) places.insert(item.step % kStepsPerRepeat);
  }
  EXPECT_GE(places.size(), 8U);  // of 10; 50 repeats miss three of them once in a thousand raters
}

TEST(LabellingSession, HasNoRepeatWhereNothingLiesFarEnoughBack) {
  const auto items = shown("ada", fragments(8));
  EXPECT_EQ(items.size(), 8U);
  EXPECT_TRUE(std::none_of(items.begin(), items.end(), [](const auto& item) { return item.is_repeat; }));
}

TEST(LabellingSession, KnowsHowManyStepsThereWillBe) {
  const auto targets = fragments(77);
  const auto items = shown("ada", targets);
  LabellingSession session("ada", targets, {});
  for (const LabellingItem& item : items) {
    EXPECT_EQ(session.num_steps(), static_cast<int>(items.size()));
    session.record(item.target);
  }
  EXPECT_EQ(session.num_steps(), session.num_labelled());
  EXPECT_TRUE(session.is_finished());
}

TEST(LabellingSession, ShowsOtherOrdersToOtherRaters) {
  const auto ada = targets_of(shown("ada", fragments(100))), eve = targets_of(shown("eve", fragments(100)));
  int in_place = 0;
  for (std::size_t i = 0; i < 100; ++i) in_place += ada[i] == eve[i] ? 1 : 0;
  EXPECT_LE(in_place, 8);  // 1 is expected of two independent orders; 9 or more happens once in a million
}

TEST(LabellingSession, GoesOnFromAnyPointAsIfNothingHadHappened) {
  const auto targets = fragments(60);
  const auto all = shown("ada", targets);
  const auto order = targets_of(all);
  auto backwards = targets;
  std::reverse(backwards.begin(), backwards.end());
  for (std::size_t done = 0; done <= order.size(); ++done) {
    const std::vector<LabelTarget> before(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(done));
    const auto rest = shown("ada", backwards, before);
    ASSERT_EQ(rest.size(), order.size() - done);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      EXPECT_EQ(rest[i].target, order[done + i]);
      EXPECT_EQ(rest[i].is_repeat, all[done + i].is_repeat);
    }
  }
}

TEST(LabellingSession, ShowsWhatWasUndoneAgain) {
  const auto items = shown("ada", fragments(60));
  const auto order = targets_of(items);
  for (std::size_t done = 1; done <= order.size(); ++done) {
    const std::vector<LabelTarget> before(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(done - 1));
    const auto again = LabellingSession("ada", fragments(60), before).next();
    ASSERT_TRUE(again);
    EXPECT_EQ(again->target, items[done - 1].target);
    EXPECT_EQ(again->is_repeat, items[done - 1].is_repeat);
  }
}

TEST(LabellingSession, MixesNewBlendsIntoWhatIsLeft) {
  auto targets = fragments(200);
  auto labelled = targets_of(shown("ada", targets));
  labelled.resize(110);
  for (int id = 1; id <= 100; ++id) targets.push_back({TargetKind::kBlend, id});
  const auto rest = shown("ada", targets, labelled);
  const auto blends_in = [&](std::size_t begin, std::size_t end) {
    return std::count_if(rest.begin() + static_cast<std::ptrdiff_t>(begin),
                         rest.begin() + static_cast<std::ptrdiff_t>(end),
                         [](const auto& item) { return item.target.kind == TargetKind::kBlend && !item.is_repeat; });
  };
  EXPECT_EQ(blends_in(0, rest.size()), 100);
  // Half of what is left are blends: neither first nor last.
  EXPECT_GT(blends_in(0, rest.size() / 2), 25);
  EXPECT_GT(blends_in(rest.size() / 2, rest.size()), 25);
}

TEST(LabellingSession, LeavesOutAsIfItHadNeverBeenThere) {
  auto targets = fragments(50);
  LabellingSession session("ada", targets, {});
  const LabelTarget first = session.next()->target;
  session.leave_out(first);
  session.leave_out({TargetKind::kBlend, 1});
  std::erase(targets, first);
  const auto without = shown("ada", targets);
  EXPECT_EQ(session.num_steps(), static_cast<int>(without.size()));
  for (const LabellingItem& item : without) {
    ASSERT_EQ(session.next()->target, item.target);
    session.record(item.target);
  }
  EXPECT_TRUE(session.is_finished());
}

TEST(LabellingSession, ChangesNothingWhereSomethingElseIsTakenAway) {
  auto targets = fragments(50);
  const LabelTarget first = LabellingSession("ada", targets, {}).next()->target;
  targets.erase(std::find_if(targets.begin(), targets.end(), [&](const auto& target) { return target != first; }));
  EXPECT_EQ(LabellingSession("ada", targets, {}).next()->target, first);
}

TEST(LabellingSession, CountsLabelsOfWhatIsGoneAsSteps) {
  const LabellingSession session("ada", fragments(5), {{TargetKind::kBlend, 9}, {TargetKind::kFragment, 2}});
  EXPECT_EQ(session.num_labelled(), 2);
  EXPECT_EQ(session.num_steps(), 6);
  EXPECT_EQ(session.next()->step, 2);
}

TEST(LabellingSession, NamesItemsSoThatARepeatLooksNew) {
  const auto targets = fragments(100);
  const auto items = shown("ada", targets);
  const LabellingSession session("ada", targets, {});
  std::set<std::string> names;
  for (const LabellingItem& item : items) names.insert(session.name_of(item));
  EXPECT_EQ(names.size(), items.size());
}

TEST(LabellingSession, FindsItemsByName) {
  const auto targets = fragments(40);
  auto labelled = targets_of(shown("ada", targets));
  labelled.resize(25);
  const LabellingSession session("ada", targets, labelled);
  const auto next = *session.next();
  const auto open = session.find(session.name_of(next));
  ASSERT_TRUE(open);
  EXPECT_EQ(open->target, next.target);
  EXPECT_EQ(open->step, 25);
  EXPECT_EQ(open->is_repeat, next.is_repeat);
  const auto done = session.find(session.name_of({labelled[7], 7}));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->target, labelled[7]);
  EXPECT_LT(done->step, session.num_labelled());
  // What was not labelled at that step, what another rater was shown, and what is no name.
  EXPECT_FALSE(session.find(session.name_of({labelled[8], 7})));
  EXPECT_FALSE(session.find(LabellingSession("eve", targets, labelled).name_of(next)));
  for (const char* name : {"", "x", "-1-00", "3", "99999999999999999999-0", "25-0000000000000000"}) {
    EXPECT_FALSE(session.find(name)) << name;
  }
}

TEST(LabellingSession, HasNothingToShowOfNothing) {
  const LabellingSession session("ada", {}, {});
  EXPECT_TRUE(session.is_finished());
  EXPECT_FALSE(session.next());
  EXPECT_EQ(session.num_steps(), 0);
}

TEST(LabelledBy, AreThePersonsOwnLabelsInOrder) {
  std::vector<LabelRecord> labels(4);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i].target.id = static_cast<RecordId>(i + 1);
    labels[i].rater = i == 1 ? "eve" : "ada";
  }
  labels[2].source = LabelSource::kSynthetic;
  const std::vector<LabelTarget> expected{{TargetKind::kFragment, 1}, {TargetKind::kFragment, 4}};
  EXPECT_EQ(labelled_by(labels, "ada"), expected);
}

}  // namespace
}  // namespace strut
