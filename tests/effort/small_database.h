// SPDX-License-Identifier: MIT
// A small fragment database that tests write to and read from.
#pragma once

#include "support/data.h"
#include "support/walks.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/effort/fragment_database.h>

namespace strut::test {

inline constexpr const char* kNoon = "2026-03-01T12:00:00Z";
inline constexpr effort::LabelTarget kFirstFragment{effort::TargetKind::kFragment, 1};

class FragmentDatabaseTest : public testing::Test {
 protected:
  FragmentDatabaseTest() : walk_(short_walk(0.0)), path_(here_.file("moves.db")) {}

  effort::FragmentDatabase made() {
    return effort::FragmentDatabase::create(path_, walk_.shared_skeleton(), walk_.frame_rate());
  }
  /// With two clips of three fragments each, all of them in one group, neighbours paired.
  effort::FragmentDatabase filled() {
    effort::FragmentDatabase database = made();
    const std::vector<motion::FrameRange> cuts{{0, 20}, {20, 50}, {60, 90}};
    database.add_clip({"a.bvh", "ann", "walk"}, walk_, cuts);
    database.add_clip({"b.bvh", "bob", "limp"}, short_walk(0.8), cuts);
    database.set_matching({{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}, {{1, 2, 0.1, 0.0, effort::PairStatus::kAccepted},
                                                                     {2, 3, 0.5, 0.2, effort::PairStatus::kRejected}});
    return database;
  }
  static effort::LabelRecord label(effort::LabelTarget target, const std::string& rater, double flow,
                                   const std::string& at) {
    effort::LabelRecord made;
    made.target = target;
    made.rater = rater;
    made.labelled_at = at;
    made.rating[effort::kFlow] = flow;
    return made;
  }

  TemporaryFolder here_;
  Motion walk_;
  std::string path_;
};

}  // namespace strut::test
