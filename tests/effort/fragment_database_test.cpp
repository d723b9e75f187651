// SPDX-License-Identifier: MIT
// The fragment database: what is written comes back, what does not fit is refused and changes nothing, and a crash
// leaves whole transactions only.
#include "effort/small_database.h"

#include <cstdio>
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>
#include <strut/math/rotation.h>

namespace strut::test {
namespace {

using namespace effort;
using motion::FrameRange;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kRotationError = 4e-7;  // of floats near pi [rad]
constexpr double kTravelError = 1e-9;    // what counts as standing still [m]

double rotation_error(const Motion& a, const Motion& b) {
  double worst = 0.0;
  for (int i = 0; i < a.num_frames(); ++i) {
    for (std::size_t j = 0; j < a.frame(i).rotations.size(); ++j) {
      const Eigen::Quaterniond between = a.frame(i).rotations[j].conjugate() * b.frame(i).rotations[j];
      worst = std::max(worst, math::log_map(between).norm());
    }
  }
  return worst;
}

double travel_error(const Motion& a, const Motion& b) {
  double worst = 0.0;
  for (int i = 0; i < a.num_frames(); ++i) {
    for (std::size_t j = 0; j < a.frame(i).translations.size(); ++j) {
      worst = std::max(worst, (a.frame(i).translations[j] - b.frame(i).translations[j]).norm());
    }
  }
  return worst;
}

TEST_F(FragmentDatabaseTest, GivesFramesBackWithinTheStatedErrors) {
  const RecordId clip = made().add_clip({"a.bvh", "", ""}, walk_, {});
  const FragmentDatabase database = FragmentDatabase::open(path_);
  const Motion all = database.motion(clip);
  ASSERT_EQ(all.num_frames(), walk_.num_frames());
  EXPECT_LT(rotation_error(walk_, all), kRotationError);
  EXPECT_LT(travel_error(walk_, all), kTravelError);
  EXPECT_EQ(all.frame_rate(), walk_.frame_rate());
}

TEST_F(FragmentDatabaseTest, KeepsTravelFarFromTheOriginAndRotationsNearAHalfTurn) {
  std::vector<Pose> frames(70, rest_pose(walk_.skeleton()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].translations[0] = {12345.678 + 1e-3 * static_cast<double>(i), 0.9, -98765.4};
    frames[i].translations[3].y() += 1e-4 * static_cast<double>(i);
    frames[i].rotations[2] = math::exp_map({0.0, 3.141592 - 1e-6 * static_cast<double>(i), 1e-3});
  }
  const Motion far(walk_.shared_skeleton(), 30.0, std::move(frames));
  FragmentDatabase database = made();
  const Motion back = database.motion(database.add_clip({"far", "", ""}, far, {}));
  EXPECT_LT(rotation_error(far, back), kRotationError);
  EXPECT_LT(travel_error(far, back), kTravelError);
}

TEST_F(FragmentDatabaseTest, ReadsAnyRangeAsTheWholeHasIt) {
  FragmentDatabase database = made();
  const RecordId clip = database.add_clip({"a.bvh", "", ""}, walk_, {});
  const Motion all = database.motion(clip);
  for (const auto& [begin, end] : {std::pair(0, 1), {0, 64}, {63, 65}, {64, 90}, {10, 80}, {5, 5}}) {
    const Motion part = database.motion(clip, {begin, end});
    EXPECT_EQ(part.frames(), all.slice(begin, end).frames()) << begin << " to " << end;
  }
  EXPECT_THROW((void)database.motion(clip, {-1, 5}), InvalidArgument);
  EXPECT_THROW((void)database.motion(clip, {5, walk_.num_frames() + 1}), InvalidArgument);
  EXPECT_THROW((void)database.motion(clip + 1), InvalidArgument);
}

TEST_F(FragmentDatabaseTest, KeepsTheSkeletonToTheBit) {
  made();
  const FragmentDatabase database = FragmentDatabase::open(path_);
  for (int j = 0; j < walk_.skeleton().num_joints(); ++j) {
    const Joint &before = walk_.skeleton().joint(j), &after = database.skeleton()->joint(j);
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(after.offset, before.offset);
    EXPECT_EQ(after.has_end_site, before.has_end_site);
    EXPECT_EQ(after.end_site, before.end_site);
  }
}

TEST_F(FragmentDatabaseTest, ListsClipsAndFragmentsInOrder) {
  filled();
  const FragmentDatabase database = FragmentDatabase::open(path_);
  const auto fragments = database.fragments();
  ASSERT_EQ(fragments.size(), 6U);
  EXPECT_EQ(fragments[4].clip_name, "b.bvh");
  EXPECT_EQ(fragments[4].performer, "bob");
  EXPECT_EQ(fragments[4].action, "limp");
  EXPECT_EQ(fragments[4].frames, (FrameRange{20, 50}));
  EXPECT_EQ(fragments[4].group, 0);
  EXPECT_EQ(fragments[5].group, -1);
  EXPECT_EQ(database.motion(fragments[4]).num_frames(), 30);
  const DatabaseCounts counts = database.counts();
  EXPECT_EQ(counts.clips, 2);
  EXPECT_EQ(counts.frames, walk_.num_frames() + short_walk(0.8).num_frames());
  EXPECT_EQ(counts.groups, 1);
  EXPECT_EQ(counts.pairs, 2);
  EXPECT_EQ(counts.accepted_pairs, 1);
}

TEST_F(FragmentDatabaseTest, ResamplesOtherRatesWithANote) {
  const Motion fast(walk_.shared_skeleton(), 60.0, walk_.frames());
  Diagnostics diagnostics;
  FragmentDatabase database = made();
  const RecordId clip = database.add_clip({"fast.bvh", "", ""}, fast, {{20, 60}}, CutSource::kPerson, &diagnostics);
  EXPECT_EQ(database.motion(clip).num_frames(), (walk_.num_frames() + 1) / 2);
  EXPECT_EQ(database.fragments().front().frames, (FrameRange{10, 30}));
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_THAT(diagnostics.entries().front().message, HasSubstr("resampled"));
}

/// A body `factor` times as large that moves alike.
Motion scaled(const Motion& motion, double factor) {
  std::vector<Joint> joints = motion.skeleton().joints();
  for (Joint& joint : joints) {
    joint.offset *= factor;
    joint.end_site *= factor;
  }
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    for (Eigen::Vector3d& translation : pose.translations) translation *= factor;
  }
  return {std::make_shared<const Skeleton>(std::move(joints)), motion.frame_rate(), std::move(frames)};
}

TEST_F(FragmentDatabaseTest, PutsAnotherActorOnItsOwnBody) {
  FragmentDatabase database = made();
  Diagnostics diagnostics;
  const RecordId clip =
      database.add_clip({"child.bvh", "", ""}, scaled(walk_, 0.8), {{0, 40}}, CutSource::kSuggested, &diagnostics);
  const Motion back = database.motion(clip);
  constexpr double kScaled = 1e-6;  // what scaling there and back loses [m]
  EXPECT_LT(travel_error(walk_, back), kScaled);
  EXPECT_LT(rotation_error(walk_, back), kRotationError);
  ASSERT_EQ(diagnostics.entries().size(), 1U);
  EXPECT_THAT(diagnostics.entries().front().message, HasSubstr("scaled by 1.25"));
}

TEST_F(FragmentDatabaseTest, KeepsBonesOfItsBodyWhereProportionsDiffer) {
  std::vector<Joint> joints = walk_.skeleton().joints();
  const std::size_t head = joints.size() - 1;
  joints[head].offset *= 1.5;
  std::vector<Pose> frames = walk_.frames();
  for (Pose& pose : frames) pose.translations[head] = joints[head].offset;
  FragmentDatabase database = made();
  const RecordId clip = database.add_clip(
      {"other.bvh", "", ""}, Motion(std::make_shared<const Skeleton>(std::move(joints)), 30.0, std::move(frames)), {});
  EXPECT_LT(travel_error(walk_, database.motion(clip)), kTravelError);
}

TEST_F(FragmentDatabaseTest, NamesTheJointsOfAnotherSkeleton) {
  FragmentDatabase database = made();
  try {
    database.add_clip({"other", "", ""}, renamed(walk_, 4, "Tail"), {});
    FAIL();
  } catch (const SkeletonMismatch& error) {
    EXPECT_THAT(error.what(), HasSubstr("Tail"));
  }
  EXPECT_TRUE(database.clips().empty());
}

TEST_F(FragmentDatabaseTest, RefusesClipsTwiceAndCutsThatOverlapOrLeaveTheClip) {
  FragmentDatabase database = filled();
  EXPECT_THROW(database.add_clip({"a.bvh", "", ""}, walk_, {}), InvalidArgument);
  EXPECT_THROW(database.add_clip({"", "", ""}, walk_, {}), InvalidArgument);
  for (const auto& cuts : std::vector<std::vector<FrameRange>>{
           {{0, 20}, {19, 30}}, {{5, 5}}, {{-1, 4}}, {{80, walk_.num_frames() + 1}}, {{30, 40}, {0, 10}}}) {
    EXPECT_THROW(database.add_clip({"c.bvh", "", ""}, walk_, cuts), InvalidArgument);
    EXPECT_THROW(database.set_cuts(1, cuts, CutSource::kPerson), InvalidArgument);
  }
  EXPECT_EQ(database.counts().clips, 2);
  EXPECT_EQ(database.counts().fragments, 6);
}

TEST_F(FragmentDatabaseTest, CuttingAnewKeepsIdsAndLabelsOfWhatStays) {
  FragmentDatabase database = filled();
  database.add_labels({label(kFirstFragment, "eve", 0.5, kNoon)});
  database.set_cuts(1, {{0, 20}, {25, 50}, {60, 90}}, CutSource::kPerson);
  const auto fragments = database.fragments();
  EXPECT_EQ(fragments[0].id, 1);
  EXPECT_EQ(fragments[1].id, 7) << "an id is never given again";
  EXPECT_EQ(fragments[1].cut, CutSource::kPerson);
  EXPECT_EQ(fragments[2].id, 3);
  EXPECT_EQ(database.labels().size(), 1U);
  EXPECT_TRUE(database.pairs().empty()) << "both pairs were of fragment 2";
}

TEST_F(FragmentDatabaseTest, DoesNotCutLabelsAwayUnasked) {
  FragmentDatabase database = filled();
  const RecordId blend = database.add_blend(1, 2, 0.5);
  database.add_labels({label({TargetKind::kBlend, blend}, "eve", 0.5, kNoon)});
  ASSERT_EQ(database.labelled_without(1, {{60, 90}}).size(), 2U);
  EXPECT_THROW(database.set_cuts(1, {{0, 20}}, CutSource::kPerson), InvalidArgument);
  EXPECT_THROW(database.remove_clip(1), InvalidArgument);
  EXPECT_EQ(database.counts().fragments, 6);
  database.set_cuts(1, {{0, 20}}, CutSource::kPerson, OnLabels::kDiscard);
  EXPECT_TRUE(database.labels().empty());
  EXPECT_TRUE(database.blends().empty());
  database.remove_clip(1);
  EXPECT_EQ(database.counts().fragments, 3);
}

TEST_F(FragmentDatabaseTest, WhatPeopleSayOfPairsOutlivesMatching) {
  FragmentDatabase database = filled();
  database.decide_pair(2, 1, false);
  database.decide_pair(2, 3, true);
  database.decide_pair(6, 4, true);
  database.set_matching({}, {{1, 2, 0.2, 0.0, PairStatus::kAccepted}, {2, 3, 0.6, 0.2, PairStatus::kRejected}});
  const auto pairs = database.pairs();
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].status, PairStatus::kRejectedByPerson);
  EXPECT_EQ(pairs[0].cost, 0.2);
  EXPECT_EQ(pairs[1].status, PairStatus::kAcceptedByPerson);
  EXPECT_EQ(pairs[2].first, 4);
  EXPECT_EQ(pairs[2].second, 6);
  EXPECT_FALSE(is_rated(pairs[2].cost));
  EXPECT_EQ(database.accepted_pairs().size(), 2U);
  EXPECT_EQ(database.counts().pairs, 3);
  EXPECT_EQ(database.counts().accepted_pairs, 2);
}

TEST_F(FragmentDatabaseTest, KeepsLabelsAsTheyWereGiven) {
  FragmentDatabase database = filled();
  const RecordId blend = database.add_blend(1, 2, 0.3);
  EXPECT_EQ(database.add_blend(1, 2, 0.3), blend);
  LabelRecord full = label({TargetKind::kBlend, blend}, "Zo\xc3\xab", -1.0, kNoon);
  full.source = LabelSource::kSynthetic;
  full.rating[kTime] = 1.0 / 3.0;
  full.not_present[kWeight] = true;
  full.is_repeat = true;
  full.comment = "says \"stop\", then turns";
  EXPECT_EQ(database.add_labels({full}), 1);
  const LabelRecord back = database.labels().front();
  EXPECT_EQ(back.target, full.target);
  EXPECT_EQ(back.rater, full.rater);
  EXPECT_EQ(back.labelled_at, full.labelled_at);
  EXPECT_EQ(back.source, full.source);
  EXPECT_EQ(back.rating[kFlow], -1.0);
  EXPECT_EQ(back.rating[kTime], 1.0 / 3.0);
  EXPECT_FALSE(is_rated(back.rating[kWeight]));
  EXPECT_EQ(back.not_present, full.not_present);
  EXPECT_TRUE(back.is_repeat);
  EXPECT_EQ(back.comment, full.comment);
}

TEST_F(FragmentDatabaseTest, LeavesOutALabelThatIsThere) {
  FragmentDatabase database = filled();
  EXPECT_EQ(database.add_labels({label(kFirstFragment, "eve", 0.5, kNoon)}), 1);
  EXPECT_EQ(database.add_labels({label(kFirstFragment, "eve", -0.5, kNoon), label(kFirstFragment, "kim", 0.1, kNoon)}),
            1);
  EXPECT_EQ(database.labels().front().rating[kFlow], 0.5);
}

TEST_F(FragmentDatabaseTest, OneBadLabelKeepsAllOut) {
  FragmentDatabase database = filled();
  const LabelRecord good = label(kFirstFragment, "eve", 0.5, kNoon);
  std::vector<LabelRecord> bad(9, good);
  bad[0].rating[kFlow] = 1.01;
  bad[1].rating[kFlow] = kNotRated;
  bad[2].rater.clear();
  bad[3].labelled_at = "yesterday";
  bad[4].target.id = 99;
  bad[5].target.kind = TargetKind::kBlend;
  bad[6].not_present[kFlow] = true;
  bad[7].comment = "two\nlines";
  bad[8].labelled_at = "2026-02-30T12:00:00Z";
  for (const LabelRecord& one : bad) EXPECT_THROW(database.add_labels({good, one}), InvalidArgument);
  EXPECT_TRUE(database.labels().empty());
}

TEST_F(FragmentDatabaseTest, TakesBackARatersOwnLastLabel) {
  FragmentDatabase database = filled();
  LabelRecord formula = label(kFirstFragment, "eve", 0.9, "2026-03-03T12:00:00Z");
  formula.source = LabelSource::kSynthetic;
  database.add_labels({label(kFirstFragment, "eve", 0.4, kNoon), label({TargetKind::kFragment, 2}, "eve", 0.6, kNoon),
                       label(kFirstFragment, "kim", -0.5, kNoon), formula});
  const auto removed = database.remove_last_label("eve");
  ASSERT_TRUE(removed);
  EXPECT_EQ(removed->target.id, 2);
  EXPECT_EQ(removed->rating[kFlow], 0.6);
  EXPECT_EQ(database.labels().size(), 3U);
  EXPECT_EQ(database.remove_last_label("eve")->target, kFirstFragment);
  EXPECT_FALSE(database.remove_last_label("eve")) << "a formula's label is nobody's to take back";
  EXPECT_FALSE(database.remove_last_label("nobody"));
  EXPECT_EQ(database.labels().size(), 2U);
}

TEST_F(FragmentDatabaseTest, TakesNothingBackWhenOpenedForReading) {
  filled().add_labels({label(kFirstFragment, "eve", 0.4, kNoon)});
  FragmentDatabase database = FragmentDatabase::open(path_);
  EXPECT_THROW(database.remove_last_label("eve"), FileError);
  EXPECT_EQ(database.labels().size(), 1U);
}

TEST_F(FragmentDatabaseTest, AveragesWithinARaterFirst) {
  FragmentDatabase database = filled();
  LabelRecord repeat = label(kFirstFragment, "eve", 0.6, "2026-03-02T12:00:00Z");
  repeat.is_repeat = true;
  LabelRecord other = label(kFirstFragment, "kim", -0.5, kNoon);
  other.rating[kTime] = 0.25;
  database.add_labels({label(kFirstFragment, "eve", 0.4, kNoon), repeat, other});
  const auto means = database.mean_labels();
  ASSERT_EQ(means.size(), 1U);
  EXPECT_DOUBLE_EQ(means[0].mean[kFlow], 0.0);
  EXPECT_DOUBLE_EQ(means[0].mean[kTime], 0.25);
  EXPECT_FALSE(is_rated(means[0].mean[kWeight]));
  EXPECT_EQ(means[0].num_raters, Eigen::Vector4i(2, 0, 1, 0));
  ASSERT_EQ(means[0].raters.size(), 2U);
  EXPECT_EQ(means[0].raters[0].num_labels, 2);
}

TEST_F(FragmentDatabaseTest, NeverMixesSyntheticLabelsWithPeoples) {
  FragmentDatabase database = filled();
  LabelRecord formula = label(kFirstFragment, "formula", -1.0, kNoon);
  formula.source = LabelSource::kSynthetic;
  LabelRecord alone = formula;
  alone.target.id = 2;
  database.add_labels({label(kFirstFragment, "eve", 0.5, kNoon), formula, alone});
  EXPECT_EQ(database.labels().size(), 3U);
  const auto means = database.mean_labels();
  ASSERT_EQ(means.size(), 1U) << "fragment 2 has no person's label";
  EXPECT_EQ(means[0].mean[kFlow], 0.5);
  EXPECT_EQ(means[0].num_raters[kFlow], 1);
  const auto named = database.mean_labels("formula");
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[0].mean[kFlow], -1.0);
  EXPECT_TRUE(database.mean_labels("nobody").empty());
}

TEST_F(FragmentDatabaseTest, ABlendAndItsMirrorAreOne) {
  FragmentDatabase database = filled();
  const RecordId blend = database.add_blend(2, 1, 0.7);
  EXPECT_EQ(database.add_blend(1, 2, 0.3), blend);
  EXPECT_EQ(database.add_blend(1, 2, 1.0 - 0.7), blend);
  const auto blends = database.blends();
  ASSERT_EQ(blends.size(), 1U);
  EXPECT_EQ(blends[0].first, 1);
  EXPECT_EQ(blends[0].alpha, 0.3);
  EXPECT_NE(database.add_blend(1, 2, 0.7), blend);
  const RecordId third = database.add_blend(1, 2, 1.0 / 3.0);
  EXPECT_EQ(database.add_blend(2, 1, 2.0 / 3.0), third);
  ASSERT_TRUE(database.find_blend(2, 1, 0.7));
  EXPECT_EQ(database.find_blend(2, 1, 0.7)->id, blend);
  EXPECT_FALSE(database.find_blend(1, 2, 0.9));
}

TEST_F(FragmentDatabaseTest, EstimatesNeverCountAsLabels) {
  FragmentDatabase database = filled();
  database.set_estimates({{1, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.6}}, {2, {0.0, kNotRated, 1.0}, {0.0, 0.0, 1.0}}});
  EXPECT_TRUE(database.labels().empty());
  EXPECT_TRUE(database.mean_labels().empty());
  const auto back = database.estimates();
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].effort, EffortVector(0.1, -0.2, 0.3));
  EXPECT_FALSE(is_rated(back[1].effort[kWeight]));
  EXPECT_THROW(database.set_estimates({{99, {0, 0, 0}, {0, 0, 0}}}), InvalidArgument);
  EXPECT_THROW(database.set_estimates({{1, {2, 0, 0}, {0, 0, 0}}}), InvalidArgument);
  EXPECT_THROW(database.set_estimates({{1, {0, 0, 0}, {0, 0, 1.5}}}), InvalidArgument);
  EXPECT_EQ(database.estimates().size(), 2U) << "a refused change leaves all as it was";
}

TEST_F(FragmentDatabaseTest, AnUncommittedTransactionNeverWas) {
  FragmentDatabase database = filled();
  {
    const FragmentDatabase::Transaction transaction(database);
    database.add_clip({"c.bvh", "", ""}, walk_, {{0, 10}});
    database.add_blend(1, 2, 0.5);
  }
  EXPECT_EQ(database.counts().clips, 2);
  {
    FragmentDatabase::Transaction transaction(database);
    EXPECT_THROW(database.add_labels({label(kFirstFragment, "", 0.0, kNoon)}), InvalidArgument);
    database.add_blend(1, 2, 0.5);
    transaction.commit();
  }
  EXPECT_EQ(database.counts().blends, 1);
}

TEST_F(FragmentDatabaseTest, RefusesOtherFilesInOneLine) {
  write_file(here_.file("empty"), "");
  write_file(here_.file("text"), "HIERARCHY\nROOT Hips\n" + std::string(200, 'x'));
  made();
  std::string bytes = read_file(path_);
  bytes[68] = 'x';
  write_file(here_.file("other.db"), bytes);
  EXPECT_THROW(FragmentDatabase::open(here_.file("missing")), FileError);
  EXPECT_THROW(FragmentDatabase::open(here_.path()), FileError);
  for (const char* name : {"empty", "text", "other.db"}) {
    EXPECT_THROW(FragmentDatabase::open(here_.file(name)), ParseError) << name;
  }
  EXPECT_THROW(made(), FileError) << "it is there";
  EXPECT_EQ(here_.file("moves.db"), path_);
}

TEST_F(FragmentDatabaseTest, RefusesANewerVersion) {
  made();
  std::string bytes = read_file(path_);
  bytes[63] = 2;
  write_file(here_.file("newer.db"), bytes);
  EXPECT_THROW(FragmentDatabase::open(here_.file("newer.db")), VersionError);
}

TEST_F(FragmentDatabaseTest, DamageIsAnErrorNotACrash) {
  filled();
  const std::string bytes = read_file(path_);
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string damaged = bytes;
    for (int k = 0; k < 40; ++k) damaged[100 + random() % (damaged.size() - 100)] = static_cast<char>(random());
    if (round % 5 == 0) damaged.resize(damaged.size() / 2);
    write_file(here_.file("damaged.db"), damaged, Overwrite::kAllow);
    try {
      const FragmentDatabase database = FragmentDatabase::open(here_.file("damaged.db"));
      for (const FragmentRecord& fragment : database.fragments()) (void)database.motion(fragment);
      (void)database.labels();
      (void)database.pairs();
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);
}

TEST_F(FragmentDatabaseTest, ReadingChangesNoByte) {
  filled();
  const std::string before = read_file(path_);
  const FragmentDatabase database = FragmentDatabase::open(path_);
  (void)database.fragments();
  (void)database.motion(1);
  (void)database.counts();
  EXPECT_EQ(read_file(path_), before);
  FragmentDatabase again = FragmentDatabase::open(path_);
  EXPECT_THROW(again.add_blend(1, 2, 0.5), FileError) << "opened for reading";
  EXPECT_EQ(read_file(path_), before);
}

}  // namespace
}  // namespace strut::test
