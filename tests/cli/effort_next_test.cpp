// SPDX-License-Identifier: MIT
// strut effort next: blends to label, with numbers that stay, a table to fill in and clips to look at.
#include "support/program.h"

#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>
#include <strut/generate/gestures.h>
#include <strut/io/bvh.h>

namespace strut {
namespace {

using effort::FragmentDatabase;
using effort::RecordId;
using testing::HasSubstr;

/// Eight reaches by one body, all of a group, every pair accepted; labelled if asked for.
void make_database(const std::string& path, bool labelled) {
  const auto content = generate::gesture_content(generate::GestureAction::kReach);
  std::vector<RecordId> fragments;
  const Motion first = generate::generate_gesture(content, {}, {}, 30.0).motion;
  auto database = FragmentDatabase::create(path, first.shared_skeleton(), 30.0);
  for (int k = 0; k < 8; ++k) {
    generate::GestureStyle style;
    style.suddenness = -0.7 + 0.2 * k;
    style.strength = k % 2 == 0 ? -0.5 : 0.5;
    style.seed = static_cast<std::uint64_t>(k + 1);
    const Motion motion = generate::generate_gesture(content, style, {}, 30.0).motion;
    database.add_clip({"reach" + std::to_string(k), "", "reach"}, motion, {{0, motion.num_frames()}});
  }
  for (const auto& fragment : database.fragments()) fragments.push_back(fragment.id);
  std::vector<FragmentDatabase::GroupOf> groups;
  std::vector<effort::PairRecord> pairs;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    groups.push_back({fragments[i], 0});
    for (std::size_t j = i + 1; j < fragments.size(); ++j) {
      pairs.push_back({fragments[i], fragments[j], 0.1, 0.0, effort::PairStatus::kAccepted});
    }
  }
  database.set_matching(groups, pairs);
  std::vector<effort::LabelRecord> labels;
  for (std::size_t i = 0; labelled && i < fragments.size(); ++i) {
    effort::LabelRecord label;
    label.target = {effort::TargetKind::kFragment, fragments[i]};
    label.rater = "ada";
    label.labelled_at = "2026-03-01T14:05:00Z";
    label.rating << 0.1, i % 2 == 0 ? -0.4 : 0.4, -0.7 + 0.2 * static_cast<double>(i), effort::kNotRated;
    labels.push_back(label);
  }
  database.add_labels(labels);
}

TEST(EffortNext, NamesBlendsAndKeepsTheirNumbers) {
  const test::Workplace place;
  make_database(place.file("moves.db"), true);
  const auto run = place.run(STRUT_PROGRAM, {"effort", "next", "@moves.db", "--count", "4", "--csv", "@ask.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("0 blends labelled so far"));
  const auto database = FragmentDatabase::open(place.file("moves.db"));
  ASSERT_EQ(database.blends().size(), 4U);
  const std::string table = read_file(place.file("ask.csv"));
  for (const auto& blend : database.blends()) {
    const auto pair = std::to_string(blend.first) + "," + std::to_string(blend.second) + ",";
    const auto turned = std::to_string(blend.second) + "," + std::to_string(blend.first) + ",";
    EXPECT_TRUE(table.find("\n" + pair) != std::string::npos || table.find("\n" + turned) != std::string::npos);
  }
  // Asked again, the same blends come with the same numbers.
  const auto again = place.run(STRUT_PROGRAM, {"effort", "next", "@moves.db", "--count", "4"});
  EXPECT_EQ(again.out, run.out);
  EXPECT_EQ(database.blends().size(), 4U);
}

TEST(EffortNext, WritesClipsToLookAt) {
  const test::Workplace place;
  make_database(place.file("moves.db"), true);
  const auto run = place.run(STRUT_PROGRAM, {"effort", "next", "@moves.db", "--count", "2", "--write", "@look"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const auto& blend : FragmentDatabase::open(place.file("moves.db")).blends()) {
    const auto clip = read_bvh(place.file("look") + "/blend-" + std::to_string(blend.id) + ".bvh");
    EXPECT_GT(clip.motion.num_frames(), 10);
  }
}

TEST(EffortNext, LeavesTheDatabaseAloneWhereItCannotWrite) {
  const test::Workplace place;
  make_database(place.file("moves.db"), true);
  write_file(place.file("look"), "a file, no folder");
  const auto run = place.run(STRUT_PROGRAM, {"effort", "next", "@moves.db", "--write", "@look"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_TRUE(FragmentDatabase::open(place.file("moves.db")).blends().empty());
}

TEST(EffortNext, SaysWhatToDoWhereNothingIsLabelled) {
  const test::Workplace place;
  make_database(place.file("moves.db"), false);
  const auto run = place.run(STRUT_PROGRAM, {"effort", "next", "@moves.db"});
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_THAT(run.err, HasSubstr("hint"));
}

}  // namespace
}  // namespace strut
