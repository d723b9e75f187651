// SPDX-License-Identifier: MIT
#include "effort/column_search.h"
#include "effort/plain_search.h"
#include "effort/real_clips.h"

#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>

#include <strut/core/error.h>
#include <strut/effort/fragment_search.h>
#include <strut/math/sampling.h>

namespace strut::effort {
namespace {

constexpr double kFloat = 1e-6;  // relative: numbers are kept as float

FrameMatrix noise(int frames, int dimensions, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return FrameMatrix::NullaryExpr(frames, dimensions, [&] { return normal(generator); });
}

/// A smooth path: noise, drawn in at every step.
FrameMatrix path(int frames, int dimensions, unsigned seed) {
  FrameMatrix rows = noise(frames, dimensions, seed);
  for (Eigen::Index t = 1; t < rows.rows(); ++t) rows.row(t) = 0.95 * rows.row(t - 1) + 0.1 * rows.row(t);
  return rows;
}

/// Whole numbers: distances are often equal, so that ties are decided.
FrameMatrix steps(int frames, int dimensions, unsigned seed) {
  return noise(frames, dimensions, seed).array().round();
}

/// `rows` at `factor` times as many frames.
FrameMatrix stretched(const FrameMatrix& rows, double factor) {
  const auto count = static_cast<Eigen::Index>(static_cast<double>(rows.rows()) * factor);
  return math::sample_rows(rows, Eigen::VectorXd::LinSpaced(count, 0.0, static_cast<double>(rows.rows() - 1)));
}

FrameMatrix joined(const std::vector<FrameMatrix>& parts) {
  Eigen::Index frames = 0;
  for (const FrameMatrix& part : parts) frames += part.rows();
  FrameMatrix all(frames, parts.front().cols());
  Eigen::Index at = 0;
  for (const FrameMatrix& part : parts) {
    all.middleRows(at, part.rows()) = part;
    at += part.rows();
  }
  return all;
}

void expect_equal(const SubsequenceCosts& a, const SubsequenceCosts& b) {
  EXPECT_TRUE((a.cost.array() == b.cost.array()).all());
  EXPECT_TRUE((a.begin.array() == b.begin.array()).all());
  EXPECT_TRUE((a.share_at_limit.array() == b.share_at_limit.array()).all());
}

/// The costs by given kernels in blocks of a given size.
SubsequenceCosts costs_by(const detail::SearchKernels& kernels, const FrameMatrix& query, const FrameMatrix& recording,
                          int block) {
  const SearchIndex index(recording);
  const detail::SearchQuery rows(query, index.dimensions());
  const auto ends = detail::search_columns(kernels, rows, index, 0, index.num_columns(), nullptr, block);
  SubsequenceCosts costs = test::plain_costs(query.topRows(1), recording.topRows(1));
  const int m = rows.num_frames();
  costs.cost.resize(recording.rows());
  costs.begin.resize(recording.rows());
  costs.share_at_limit.resize(recording.rows());
  for (Eigen::Index j = 0; j < recording.rows(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const bool is_match = std::isfinite(ends.cost[at]);
    costs.cost[j] = ends.cost[at] / detail::path_weight(m, ends.trace[at]);
    costs.begin[j] = is_match ? static_cast<int>(j) + 1 - (ends.trace[at] & detail::kSpan) : -1;
    costs.share_at_limit[j] = is_match ? detail::share_at_limit(m, ends.trace[at]) : 0.0F;
  }
  return costs;
}

RC_GTEST_PROP(SubsequenceCosts, AgreeToTheBitWithTheRecurrenceAsItIsWritten, ()) {
  const auto seed = *rc::gen::inRange(0U, 1000000U);
  const int dimensions = *rc::gen::inRange(1, 30), m = *rc::gen::inRange(1, 40), n = *rc::gen::inRange(1, 300);
  const auto make = *rc::gen::element(noise, path, steps);
  const FrameMatrix query = make(m, dimensions, seed), recording = make(n, dimensions, seed + 1);
  const SubsequenceCosts expected = test::plain_costs(query, recording), got = subsequence_costs(query, recording);
  RC_ASSERT((got.cost.array() == expected.cost.array()).all());
  RC_ASSERT((got.begin.array() == expected.begin.array()).all());
  RC_ASSERT((got.share_at_limit.array() == expected.share_at_limit.array()).all());
}

TEST(SubsequenceCosts, AreTheSameForBothKernelsAndAnyBlocks) {
  const FrameMatrix query = steps(33, 7, 1), recording = steps(2000, 7, 2);
  const SubsequenceCosts expected = test::plain_costs(query, recording);
  for (const int block : {1, 130, 1000, 5000}) {
    expect_equal(costs_by(detail::portable_search_kernels(), query, recording, block), expected);
    expect_equal(costs_by(detail::search_kernels(), query, recording, block), expected);
  }
}

TEST(SubsequenceCosts, AreTheSameForAnyNumberOfThreads) {
  const FrameMatrix query = path(50, 24, 3), recording = path(60000, 24, 4);
  const SearchIndex index(recording);
  const SubsequenceCosts all = subsequence_costs(query, index);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  expect_equal(all, subsequence_costs(query, index));
}

TEST(SubsequenceCosts, AgreeToTheBitOnRealClips) {
  STRUT_REQUIRE_REAL_DATA();
  const auto clips = test::projected_clips(
      {test::real_clip("wave-both-hands_normal_001"), test::real_clip("wave-both-hands_active_002")});
  const FrameMatrix query = clips[0].middleRows(40, 90);
  expect_equal(subsequence_costs(query, clips[1]), test::plain_costs(query, clips[1]));
  expect_equal(costs_by(detail::portable_search_kernels(), query, clips[1], 64), test::plain_costs(query, clips[1]));
}

TEST(SubsequenceCosts, OfClipsAreThoseOfEachByItself) {
  const std::vector<FrameMatrix> clips{path(90, 5, 1), FrameMatrix(0, 5), path(3, 5, 2), path(200, 5, 3)};
  const FrameMatrix query = path(20, 5, 4);
  const SearchIndex index(clips);
  const SubsequenceCosts all = subsequence_costs(query, index);
  EXPECT_EQ(index.num_frames(), 293);
  for (const int k : {0, 2, 3}) {
    const motion::FrameRange at = index.clip(k);
    EXPECT_EQ(index.clip_of(at.begin), k);
    EXPECT_EQ(index.clip_of(at.end - 1), k);
    const SubsequenceCosts own = test::plain_costs(query, clips[static_cast<std::size_t>(k)]);
    EXPECT_TRUE((all.cost.segment(at.begin, at.num_frames()).array() == own.cost.array()).all());
    for (int t = 0; t < at.num_frames(); ++t) {
      EXPECT_EQ(all.begin[at.begin + t], own.begin[t] < 0 ? -1 : own.begin[t] + at.begin);
    }
  }
}

TEST(SubsequenceCosts, OfACopyAreZeroAndBeginWithIt) {
  const FrameMatrix query = path(40, 6, 5), recording = joined({path(100, 6, 6), query, path(70, 6, 7)});
  const SubsequenceCosts costs = subsequence_costs(query, recording);
  EXPECT_EQ(costs.cost[139], 0.0F);
  EXPECT_EQ(costs.begin[139], 100);
  EXPECT_EQ(costs.share_at_limit[139], 0.0F);
}

TEST(SubsequenceCosts, FollowAnotherPace) {
  constexpr float kBetweenFrames = 0.2F;  // of what noise costs: stretched rows lie between the query's
  const FrameMatrix query = path(60, 6, 5);
  const float unlike = subsequence_costs(query, path(400, 6, 8)).cost.minCoeff();
  for (const double factor : {0.6, 0.8, 1.3, 1.8}) {
    const FrameMatrix other = stretched(query, factor);
    const SubsequenceCosts costs = subsequence_costs(query, joined({path(150, 6, 6), other, path(70, 6, 7)}));
    EXPECT_LT(costs.cost[149 + other.rows()], kBetweenFrames * unlike) << factor;
  }
}

TEST(SubsequenceCosts, CountWhatRunsAtTheLimitOnly) {
  FrameMatrix query(30, 1), twice(59, 1);
  for (int t = 0; t < 30; ++t) query(t, 0) = t;
  for (int t = 0; t < 59; ++t) twice(t, 0) = 0.5 * t;
  // 29 steps of two columns each, of which all but three follow three others: 26 of 3 in a weight of 30 + 59.
  EXPECT_FLOAT_EQ(static_cast<float>(whole_match(query, twice).share_at_limit), 26.0F * 3.0F / 89.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(whole_match(twice, query).share_at_limit), 26.0F * 3.0F / 89.0F);
  EXPECT_EQ(whole_match(query, stretched(query, 1.4)).share_at_limit, 0.0);
}

TEST(SubsequenceCosts, RefuseWhatCannotBeSearched) {
  const FrameMatrix recording = path(50, 4, 1);
  FrameMatrix broken = path(10, 4, 2);
  broken(3, 3) = std::nan("");
  EXPECT_THROW(subsequence_costs(FrameMatrix(0, 4), recording), InvalidArgument);
  EXPECT_THROW(subsequence_costs(path(10, 3, 1), recording), InvalidArgument);
  EXPECT_THROW(subsequence_costs(broken, recording), InvalidArgument);
  EXPECT_THROW(subsequence_costs(recording, broken), InvalidArgument);
  EXPECT_THROW(subsequence_costs(1e300 * path(10, 4, 1), recording), InvalidArgument);
  EXPECT_THROW(subsequence_costs(path(kMostQueryFrames + 1, 4, 1), recording), InvalidArgument);
  EXPECT_THROW(SearchIndex(std::vector<FrameMatrix>{}), InvalidArgument);
  EXPECT_THROW(SearchIndex(std::vector<FrameMatrix>{FrameMatrix(0, 4)}), InvalidArgument);
  EXPECT_THROW(SearchIndex(std::vector<FrameMatrix>{path(5, 4, 1), path(5, 3, 1)}), InvalidArgument);
}

TEST(SubsequenceCosts, OfARecordingTooShortAreInfinite) {
  const SubsequenceCosts costs = subsequence_costs(path(30, 4, 1), path(10, 4, 2));
  EXPECT_TRUE((costs.cost.array() == std::numeric_limits<float>::infinity()).all());
  EXPECT_TRUE((costs.begin.array() == -1).all());
  EXPECT_TRUE(disjoint_matches(costs).empty());
}

TEST(FindMatches, ReportsEveryCopyOnce) {
  const FrameMatrix query = path(40, 6, 5);
  const FrameMatrix recording =
      joined({path(90, 6, 6), query, path(80, 6, 7), stretched(query, 1.3), query, path(60, 6, 8)});
  const auto matches = find_matches(query, SearchIndex(recording), {.max_cost = 0.05});
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].frames, (motion::FrameRange{90, 130}));
  EXPECT_EQ(matches[2].frames, (motion::FrameRange{262, 302}));
  EXPECT_NEAR(matches[1].frames.begin, 210, 3);  // the ends of a slower copy are not as sharp
  EXPECT_NEAR(matches[1].frames.end, 262, 3);
}

RC_GTEST_PROP(FindMatches, TakesTheCheapestOfWhatIsFreeAgainAndAgain, ()) {
  const auto seed = *rc::gen::inRange(0U, 1000000U);
  const auto make = *rc::gen::element(path, steps);
  const FrameMatrix query = make(*rc::gen::inRange(1, 15), 3, seed), recording = make(200, 3, seed + 1);
  const SubsequenceCosts costs = test::plain_costs(query, recording);
  const MatchOptions options{.max_cost = 0.01 * *rc::gen::inRange(0, 300),
                             .max_share_at_limit = 0.1 * *rc::gen::inRange(0, 10)};
  const auto matches = find_matches(query, SearchIndex(recording), options);
  std::vector<bool> taken(200, false);
  std::size_t found = 0;
  for (;;) {
    int best = -1;
    for (int t = 0; t < 200; ++t) {
      if (costs.begin[t] < 0 || costs.cost[t] > options.max_cost) continue;
      if (costs.share_at_limit[t] > options.max_share_at_limit) continue;
      bool is_free = true;
      for (int s = costs.begin[t]; s <= t; ++s) is_free = is_free && !taken[static_cast<std::size_t>(s)];
      if (is_free && (best < 0 || costs.cost[t] < costs.cost[best])) best = t;
    }
    if (best < 0) break;
    const motion::FrameRange frames{costs.begin[best], best + 1};
    for (int s = frames.begin; s < frames.end; ++s) taken[static_cast<std::size_t>(s)] = true;
    RC_ASSERT(std::any_of(matches.begin(), matches.end(), [&](const auto& match) { return match.frames == frames; }));
    ++found;
  }
  RC_ASSERT(matches.size() == found);
}

TEST(FindMatches, RefusesLimitsThatAreNone) {
  const SearchIndex index(path(50, 4, 1));
  EXPECT_THROW(find_matches(path(5, 4, 2), index, {.max_cost = -1.0}), InvalidArgument);
  EXPECT_THROW(find_matches(path(5, 4, 2), index, {.max_cost = std::nan("")}), InvalidArgument);
  EXPECT_THROW(find_matches(path(5, 4, 2), index, {.max_share_at_limit = -0.1}), InvalidArgument);
}

/// The cost of the whole query on the whole clip by the recurrence as it is written.
float plain_whole(const FrameMatrix& query, const FrameMatrix& clip, int slack) {
  const SubsequenceCosts costs = test::plain_costs(query, clip, [slack](int j) { return j <= slack; });
  return costs.cost.tail(std::min<Eigen::Index>(slack + 1, costs.cost.size())).minCoeff();
}

TEST(WholeMatches, AreThoseOfThePathsFromEndToEnd) {
  const std::vector<FrameMatrix> clips{path(25, 5, 1), path(40, 5, 2), path(50, 5, 3), path(90, 5, 4)};
  const FrameMatrix query = path(40, 5, 5);
  for (const int slack : {0, 4}) {
    const auto matches = whole_matches(query, SearchIndex(clips), 1, 4, slack);
    ASSERT_EQ(matches.size(), 3U);
    for (std::size_t k = 1; k < clips.size(); ++k) {
      EXPECT_EQ(static_cast<float>(matches[k - 1].cost), plain_whole(query, clips[k], slack)) << k;
    }
    EXPECT_EQ(matches[2].frames.num_frames(), 0) << "more than twice as long";
    EXPECT_EQ(whole_match(query, clips[0], slack).cost, whole_matches(query, SearchIndex(clips), 0, 1, slack)[0].cost);
  }
}

TEST(WholeMatches, CoverTheWholeClipsWithoutSlack) {
  const std::vector<FrameMatrix> clips{path(31, 5, 1), path(40, 5, 2)};
  const auto matches = whole_matches(path(40, 5, 5), SearchIndex(clips), 0, 2);
  EXPECT_EQ(matches[0].frames, (motion::FrameRange{0, 31}));
  EXPECT_EQ(matches[1].frames, (motion::FrameRange{31, 71}));
}

TEST(WholeMatches, AreTheSameBothWaysRound) {
  const FrameMatrix a = path(40, 5, 1), b = path(55, 5, 2);
  const double there = whole_match(a, b).cost;
  EXPECT_NEAR(there, whole_match(b, a).cost, kFloat * 100.0 * there);  // the sums run in another order
}

TEST(WholeMatches, RefuseWhatIsNoRange) {
  const SearchIndex index(path(50, 4, 1));
  EXPECT_THROW(whole_matches(path(5, 4, 2), index, 0, 2), InvalidArgument);
  EXPECT_THROW(whole_matches(path(5, 4, 2), index, -1, 1), InvalidArgument);
  EXPECT_THROW(whole_matches(path(5, 4, 2), index, 0, 1, -1), InvalidArgument);
  EXPECT_TRUE(whole_matches(path(5, 4, 2), index, 1, 1).empty());
}

}  // namespace
}  // namespace strut::effort
