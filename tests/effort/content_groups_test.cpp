// SPDX-License-Identifier: MIT
#include "effort/average_linkage.h"
#include "effort/real_clips.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <strut/core/error.h>
#include <strut/effort/content_groups.h>
#include <strut/effort/fragment_cuts.h>
#include <strut/effort/fragment_search.h>

namespace strut::effort {
namespace {

/// A closed movement of its own in six dimensions: `content` says which, `style` shifts and swells it a little.
FrameMatrix fragment(int content, double style, int frames) {
  FrameMatrix rows(frames, 6);
  for (int t = 0; t < frames; ++t) {
    const double phase = 2.0 * std::numbers::pi * t / frames;
    for (int d = 0; d < 6; ++d) {
      rows(t, d) = (1.0 + 0.05 * style) * std::sin(phase + 1.7 * content * (d + 1)) + 0.02 * style * std::cos(d);
    }
    rows(t, content) += 2.0;
  }
  return rows;
}

/// Three contents in five styles, at slightly different paces.
std::vector<FrameMatrix> fragments(int contents) {
  std::vector<FrameMatrix> made;
  for (int style = -2; style <= 2; ++style) {
    for (int content = 0; content < contents; ++content) made.push_back(fragment(content, style, 40 + style));
  }
  return made;
}

int count(const ContentGroups& groups, PairVerdict verdict) {
  return static_cast<int>(std::count_if(groups.pairs.begin(), groups.pairs.end(),
                                        [verdict](const MatchedPair& pair) { return pair.verdict == verdict; }));
}

TEST(GroupFragments, JoinsTheStylesOfEveryContent) {
  const ContentGroups groups = group_fragments(fragments(3));
  ASSERT_EQ(groups.num_groups, 3);
  for (std::size_t k = 0; k < 15; ++k) EXPECT_EQ(groups.group[k], static_cast<int>(k % 3));
  EXPECT_EQ(count(groups, PairVerdict::kAccepted), 3 * 10);
}

TEST(GroupFragments, JoinsThemWhereThereIsOneContentOnly) {
  const ContentGroups groups = group_fragments(fragments(1));
  EXPECT_EQ(groups.num_groups, 1);
  EXPECT_EQ(count(groups, PairVerdict::kAccepted), 10);
}

TEST(GroupFragments, KeepsApartWhatIsOutOfStep) {
  std::vector<FrameMatrix> both;
  for (const FrameMatrix& rows : fragments(1)) {
    both.push_back(rows);
    FrameMatrix turned(rows.rows(), rows.cols());
    const Eigen::Index half = rows.rows() / 2;
    turned << rows.bottomRows(rows.rows() - half), rows.topRows(half);
    both.push_back(turned);
  }
  const ContentGroups groups = group_fragments(both, {.max_cost = 10.0});
  EXPECT_EQ(groups.num_groups, 2);
  for (std::size_t k = 0; k < both.size(); ++k) EXPECT_EQ(groups.group[k], static_cast<int>(k % 2));
  EXPECT_EQ(count(groups, PairVerdict::kOutOfStep), 25);
}

TEST(GroupFragments, DoesNotAcceptWhatRunsAtTheSlopeLimit) {
  const ContentGroups groups = group_fragments({fragment(0, 0.0, 30), fragment(0, 0.0, 58)});
  ASSERT_EQ(groups.pairs.size(), 1U);
  EXPECT_EQ(groups.num_groups, 1);
  EXPECT_EQ(groups.pairs[0].verdict, PairVerdict::kSlopeLimit);
  EXPECT_GT(groups.pairs[0].share_at_limit, 0.15);
}

TEST(GroupFragments, NeverPairsWhatIsMoreThanTwiceAsLong) {
  const ContentGroups groups = group_fragments({fragment(0, 0.0, 30), fragment(0, 0.0, 61)});
  EXPECT_EQ(groups.num_groups, 2);
  EXPECT_TRUE(groups.pairs.empty());
}

TEST(GroupFragments, ReportsTheCostOfWholeOnWhole) {
  const auto made = fragments(2);
  const ContentGroups groups = group_fragments(made);
  for (const MatchedPair& pair : groups.pairs) {
    const FrameMatrix &a = made[static_cast<std::size_t>(pair.first)], &b = made[static_cast<std::size_t>(pair.second)];
    const FragmentMatch match = a.rows() <= b.rows() ? whole_match(a, b) : whole_match(b, a);
    EXPECT_LT(pair.first, pair.second);
    EXPECT_FLOAT_EQ(static_cast<float>(pair.cost), static_cast<float>(match.cost));
  }
}

/// Three contents in five styles whose postures lie farther apart than the contents do.
std::vector<FrameMatrix> fragments_of_far_styles() {
  std::vector<FrameMatrix> made = fragments(3);
  for (std::size_t k = 0; k < made.size(); ++k) made[k].array() += 3.0 * static_cast<double>(k / 3);
  return made;
}

TEST(GroupFragments, JoinsStylesOfNamedContentsHoweverFarTheirPostures) {
  GroupOptions options;
  for (int k = 0; k < 15; ++k) options.contents.push_back(std::string(1, static_cast<char>('c' - k % 3)));
  EXPECT_GT(group_fragments(fragments_of_far_styles()).num_groups, 3);
  const ContentGroups groups = group_fragments(fragments_of_far_styles(), options);
  ASSERT_EQ(groups.num_groups, 3);
  for (std::size_t k = 0; k < 15; ++k) EXPECT_EQ(groups.group[k], static_cast<int>(k % 3));
  EXPECT_EQ(count(groups, PairVerdict::kAccepted), 3 * 10);
}

TEST(GroupFragments, NeverJoinsDifferentlyNamedContents) {
  const std::vector<FrameMatrix> equal(4, fragment(0, 0.0, 40));
  const ContentGroups groups = group_fragments(equal, {.contents = {"wave", "", "bow", ""}});
  EXPECT_EQ(groups.group, (std::vector<int>{0, 1, 2, 1}));
  ASSERT_EQ(groups.pairs.size(), 1U);
  EXPECT_EQ(groups.pairs[0].first, 1);
}

TEST(GroupFragments, KeepsStrokesOfOneNamedContentApart) {
  std::vector<FrameMatrix> strokes;
  for (int k = 0; k < 6; ++k) {
    const Eigen::VectorXd way = Eigen::VectorXd::LinSpaced(30 + k, 0.0, 1.0);
    FrameMatrix rows(30 + k, 2);
    rows << way, Eigen::VectorXd::Constant(30 + k, 0.5 * k);
    strokes.push_back(k % 2 == 0 ? rows : FrameMatrix(rows.colwise().reverse()));
  }
  const ContentGroups groups = group_fragments(strokes, {.contents = std::vector<std::string>(6, "raise")});
  EXPECT_EQ(groups.group, (std::vector<int>{0, 1, 0, 1, 0, 1}));
}

TEST(GroupFragments, TellsHowFarItHasCome) {
  std::vector<int> seen;
  group_fragments(fragments(3), {.progress = [&](int done, int total) {
                    EXPECT_EQ(total, 15);
                    seen.push_back(done);
                  }});
  ASSERT_EQ(seen.size(), 15U);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 15);
}

TEST(LikeThreshold, IsThatOfGroupingWithoutNames) {
  const std::vector<FrameMatrix> few = fragments(3);
  EXPECT_EQ(like_threshold(few), group_fragments(few).threshold);
  EXPECT_GT(like_threshold(few), 0.0);
  EXPECT_EQ(like_threshold({}), 0.0);
  EXPECT_EQ(like_threshold({few.front()}), 0.0);
}

TEST(LikeThreshold, LooksAtSomeOfMany) {
  std::vector<FrameMatrix> many;
  for (int k = 0; k < 2; ++k) {
    for (int style = 0; style < 401; ++style) many.push_back(fragment(k, 0.01 * style, 20));
  }
  std::vector<FrameMatrix> third;
  for (std::size_t k = 0; k < many.size(); k += 3) third.push_back(many[k]);
  EXPECT_EQ(like_threshold(many), like_threshold(third));
}

TEST(GroupFragments, TakesAThresholdThatIsGiven) {
  const ContentGroups groups = group_fragments(fragments(3), {.max_cost = 0.0});
  EXPECT_EQ(groups.threshold, 0.0);
  EXPECT_EQ(groups.num_groups, 15);
  EXPECT_TRUE(groups.pairs.empty());
}

TEST(GroupFragments, IsTheSameForAnyNumberOfThreads) {
  const auto made = fragments(3);
  const ContentGroups all = group_fragments(made);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ContentGroups alone = group_fragments(made);
  EXPECT_EQ(all.group, alone.group);
  EXPECT_EQ(all.threshold, alone.threshold);
}

TEST(GroupFragments, OfFewAreFew) {
  EXPECT_EQ(group_fragments({}).num_groups, 0);
  const ContentGroups one = group_fragments({fragment(0, 0.0, 30)});
  EXPECT_EQ(one.num_groups, 1);
  EXPECT_EQ(one.group, std::vector<int>{0});
  EXPECT_TRUE(one.pairs.empty());
  const FrameMatrix still = FrameMatrix::Ones(20, 6);
  EXPECT_EQ(group_fragments({still, still}).num_groups, 1);
}

TEST(GroupFragments, RefusesWhatIsNoFragmentOrOption) {
  EXPECT_THROW(group_fragments({fragment(0, 0.0, 30), FrameMatrix(0, 6)}), InvalidArgument);
  EXPECT_THROW(group_fragments({fragment(0, 0.0, 30), FrameMatrix::Ones(5, 3)}), InvalidArgument);
  EXPECT_THROW(group_fragments({fragment(0, std::nan(""), 30)}), InvalidArgument);
  EXPECT_THROW(group_fragments({fragment(0, 0.0, 30)}, {.contents = {"a", "b"}}), InvalidArgument);
  EXPECT_THROW(group_fragments({}, {.median_share = 0.0}), InvalidArgument);
  EXPECT_THROW(group_fragments({}, {.max_in_step = 1.1}), InvalidArgument);
  EXPECT_THROW(group_fragments({}, {.max_share_at_limit = -0.1}), InvalidArgument);
  EXPECT_THROW(group_fragments({}, {.max_cost = -1.0}), InvalidArgument);
}

TEST(GroupFragments, TellsRealGesturesApart) {
  STRUT_REQUIRE_REAL_DATA();
  std::vector<Motion> clips;
  std::vector<std::string> contents, content_of;
  for (const char* content : {"raise-up-right-hand", "wave-left-hand", "walk"}) {
    for (const char* take : {"normal_001", "normal_002", "feminine_003"}) {
      clips.push_back(test::real_clip(std::string(content) + "_" + take));
      contents.emplace_back(content);
    }
  }
  const auto features = test::projected_clips(clips);
  std::vector<FrameMatrix> made;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    for (const motion::FrameRange& frames : suggest_cuts(clips[k])) {
      made.push_back(features[k].middleRows(frames.begin, frames.num_frames()));
      content_of.push_back(contents[k]);
    }
  }
  const ContentGroups groups = group_fragments(made);
  EXPECT_GT(count(groups, PairVerdict::kAccepted), 0);
  for (const MatchedPair& pair : groups.pairs) {
    if (pair.verdict != PairVerdict::kAccepted) continue;
    EXPECT_EQ(content_of[static_cast<std::size_t>(pair.first)], content_of[static_cast<std::size_t>(pair.second)]);
  }
}

/// Joins the two nearest groups, again and again.
std::vector<int> plain_linkage(Eigen::MatrixXd distances, double height) {
  const auto count = static_cast<int>(distances.rows());
  std::vector<int> group(static_cast<std::size_t>(count)), sizes(static_cast<std::size_t>(count), 1);
  for (int i = 0; i < count; ++i) group[static_cast<std::size_t>(i)] = i;
  for (;;) {
    int a = -1, b = -1;
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        if (sizes[static_cast<std::size_t>(i)] == 0 || sizes[static_cast<std::size_t>(j)] == 0) continue;
        if (a < 0 || distances(i, j) < distances(a, b)) std::tie(a, b) = std::pair(i, j);
      }
    }
    if (a < 0 || distances(a, b) > height) return group;
    int &of_a = sizes[static_cast<std::size_t>(a)], &of_b = sizes[static_cast<std::size_t>(b)];
    for (int k = 0; k < count; ++k) {
      distances(a, k) = distances(k, a) = (of_a * distances(a, k) + of_b * distances(b, k)) / (of_a + of_b);
    }
    of_a += std::exchange(of_b, 0);
    for (int& member : group) member = member == b ? a : member;
  }
}

TEST(AverageLinkage, JoinsAsThePlainProgramDoes) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform;
  for (int count = 1; count < 30; ++count) {
    Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(count, count);
    detail::AverageLinkage linkage(count, 9.0F);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j) {
        distances(i, j) = distances(j, i) = uniform(generator);
        linkage.set(i, j, static_cast<float>(distances(i, j)));
      }
    }
    const std::vector<int> expected = plain_linkage(distances, 0.45), got = linkage.groups(0.45);
    for (std::size_t i = 0; i < got.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(got[i] == got[j], expected[i] == expected[j]);
    }
  }
}

}  // namespace
}  // namespace strut::effort
