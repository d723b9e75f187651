// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/motion_segmentation.h>

namespace strut::effort {
namespace {

constexpr double kBoundary = 0.7, kUnmatched = 1.0;
constexpr double kRounding = 1e-12;  // sums of a few costs, in another order

double price(const std::vector<SnippetCandidate>& all, const std::vector<int>& chosen, int num_frames) {
  double cost = 0.0;
  int covered = 0;
  for (const int i : chosen) {
    const SnippetCandidate& candidate = all[static_cast<std::size_t>(i)];
    cost += candidate.cost * candidate.frames.num_frames() + kBoundary;
    covered += candidate.frames.num_frames();
  }
  return cost + kUnmatched * (num_frames - covered);
}

bool overlap(const motion::FrameRange& a, const motion::FrameRange& b) {
  return a.begin < b.end && b.begin < a.end;
}

/// The price of the best of all subsets.
double cheapest_of_all(const std::vector<SnippetCandidate>& all, int num_frames) {
  double best = price(all, {}, num_frames);
  for (unsigned subset = 1; subset < 1U << all.size(); ++subset) {
    std::vector<int> chosen;
    bool fits = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((subset >> i & 1U) == 0) continue;
      for (const int other : chosen)
        fits = fits && !overlap(all[static_cast<std::size_t>(other)].frames, all[i].frames);
      chosen.push_back(static_cast<int>(i));
    }
    if (fits) best = std::min(best, price(all, chosen, num_frames));
  }
  return best;
}

TEST(CheapestCut, IsTheBestOfAll) {
  std::mt19937 engine(3);
  int not_empty = 0;
  for (int round = 0; round < 60; ++round) {
    constexpr int kFrames = 14;
    std::vector<SnippetCandidate> all;
    for (int i = 0; i < 11; ++i) {
      const int begin = static_cast<int>(engine() % (kFrames - 1));
      const int end = begin + 1 + static_cast<int>(engine() % static_cast<unsigned>(kFrames - begin));
      all.push_back({{begin, end}, i, static_cast<double>(engine() % 1000) / 800.0});
    }
    const std::vector<int> chosen = cheapest_cut(all, kFrames, kBoundary, kUnmatched);
    for (std::size_t i = 1; i < chosen.size(); ++i) {
      EXPECT_LE(all[static_cast<std::size_t>(chosen[i - 1])].frames.end,
                all[static_cast<std::size_t>(chosen[i])].frames.begin);
    }
    EXPECT_NEAR(price(all, chosen, kFrames), cheapest_of_all(all, kFrames), kRounding);
    not_empty += chosen.empty() ? 0 : 1;
  }
  EXPECT_GT(not_empty, 40);
}

TEST(CheapestCut, RefusesCandidatesOutside) {
  EXPECT_THROW(cheapest_cut({{{0, 5}, 0, 0.1}}, 4, kBoundary, kUnmatched), InvalidArgument);
  EXPECT_THROW(cheapest_cut({{{2, 2}, 0, 0.1}}, 4, kBoundary, kUnmatched), InvalidArgument);
  EXPECT_THROW(cheapest_cut({{{0, 2}, 0, std::nan("")}}, 4, kBoundary, kUnmatched), InvalidArgument);
  EXPECT_TRUE(cheapest_cut({}, 0, kBoundary, kUnmatched).empty());
}

/// A movement of `frames` frames in three dimensions: `kind` tells movements apart.
FrameMatrix movement(int kind, int frames) {
  FrameMatrix rows(frames, 3);
  for (int t = 0; t < frames; ++t) {
    const double phase = std::numbers::pi * t / (frames - 1.0);
    const double lift = std::sin(phase), sway = std::sin(2.0 * phase);
    rows.row(t) = kind == 0 ? Eigen::RowVector3d(lift, 0.5 * sway, 0.0) : Eigen::RowVector3d(0.0, -0.6 * sway, lift);
  }
  return rows;
}

FrameMatrix joined(const std::vector<FrameMatrix>& parts) {
  FrameMatrix all(0, 3);
  for (const FrameMatrix& part : parts) {
    all.conservativeResize(all.rows() + part.rows(), 3);
    all.bottomRows(part.rows()) = part;
  }
  return all;
}

class Segmentation : public testing::Test {
 protected:
  std::vector<KnownFragment> fragments_{{movement(0, 30), 0}, {movement(0, 36), 0}, {movement(1, 24), 1}};
  SegmentationOptions options_{0.15};
  FrameMatrix elsewhere_ = FrameMatrix::Constant(25, 3, -2.0);
};

TEST_F(Segmentation, FindsWhatWasPutTogether) {
  const FrameMatrix recording =
      joined({movement(0, 33), movement(1, 30), elsewhere_, movement(1, 20), movement(0, 40), movement(0, 28)});
  const auto snippets = segment_motion(fragments_, recording, options_);
  ASSERT_EQ(snippets.size(), 6U);
  const std::vector<int> groups{0, 1, kNoMatch, 1, 0, 0};
  const std::vector<int> ends{33, 63, 88, 108, 148, 176};
  constexpr int kNear = 3;  // frames: the movements begin and end at rest
  for (std::size_t i = 0; i < snippets.size(); ++i) {
    EXPECT_EQ(snippets[i].group, groups[i]) << i;
    EXPECT_NEAR(snippets[i].frames.end, ends[i], kNear) << i;
    EXPECT_EQ(snippets[i].frames.begin, i == 0 ? 0 : snippets[i - 1].frames.end);
  }
  EXPECT_NEAR(coverage(snippets), 1.0 - 25.0 / 176.0, 0.05);
}

TEST_F(Segmentation, MatchesNothingWhereNothingIsAlike) {
  const auto snippets = segment_motion(fragments_, elsewhere_, options_);
  ASSERT_EQ(snippets.size(), 1U);
  EXPECT_EQ(snippets.front(), (Snippet{{0, 25}}));
  EXPECT_EQ(coverage(snippets), 0.0);
  EXPECT_EQ(coverage(segment_motion(fragments_, movement(0, 9), options_)), 0.0) << "shorter than half of any";
  EXPECT_TRUE(segment_motion(fragments_, FrameMatrix(0, 3), options_).empty());
}

TEST_F(Segmentation, RefusesWhatMakesNoSense) {
  EXPECT_THROW(segment_motion({}, elsewhere_, options_), InvalidArgument);
  EXPECT_THROW(segment_motion(fragments_, elsewhere_, {0.0}), InvalidArgument);
  EXPECT_THROW(segment_motion(fragments_, elsewhere_, {0.1, -1.0}), InvalidArgument);
  EXPECT_THROW(segment_motion(fragments_, FrameMatrix::Zero(20, 2), options_), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
