// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

constexpr double kRounding = 1e-9;  // distances come from a matrix product: relative to sums of squares of size 1..100

double cost_of(const FrameMatrix& p, const FrameMatrix& q, int s, const std::vector<int>& counts,
               const Eigen::VectorXd& weights) {
  double cost = 0.0;
  int slot = 0;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    for (int k = 0; k < counts[t]; ++k, ++slot) {
      cost += (p.row(static_cast<Eigen::Index>(t)) - q.row(slot / s)).cwiseAbs2().dot(weights.transpose());
    }
  }
  return cost;
}

/// The least cost over every vector of counts 1 ... s^2 with the right sum.
double brute_force(const FrameMatrix& p, const FrameMatrix& q, int s, const Eigen::VectorXd& weights) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> counts;
  const int slots = static_cast<int>(q.rows()) * s;
  const std::function<void(int)> extend = [&](int filled) {
    if (static_cast<int>(counts.size()) == p.rows()) {
      if (filled == slots) least = std::min(least, cost_of(p, q, s, counts, weights));
      return;
    }
    for (int r = 1; r <= s * s && filled + r <= slots; ++r) {
      counts.push_back(r);
      extend(filled + r);
      counts.pop_back();
    }
  };
  extend(0);
  return least;
}

struct Lengths {
  int input, output, slope_limit;
};

class TimeWarpOracle : public testing::TestWithParam<Lengths> {};

TEST_P(TimeWarpOracle, FindsTheLeastCostOfAllRepetitionVectors) {
  const auto [m, n, s] = GetParam();
  for (unsigned seed = 0; seed < 8; ++seed) {
    const FrameMatrix p = test::noise(m, 2, seed), q = test::noise(n, 2, seed + 100);
    const Eigen::VectorXd weights = test::noise(2, 1, seed).cwiseAbs().col(0);
    const std::vector<int> counts = time_warp(p, q, s, weights);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), n * s);
    EXPECT_NEAR(cost_of(p, q, s, counts, weights), brute_force(p, q, s, weights), kRounding) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Lengths, TimeWarpOracle,
                         testing::Values(Lengths{5, 5, 2}, Lengths{6, 4, 2}, Lengths{4, 7, 2}, Lengths{6, 3, 2},
                                         Lengths{3, 6, 2}, Lengths{4, 4, 1}, Lengths{3, 5, 3}, Lengths{5, 2, 3},
                                         Lengths{1, 1, 2}));

RC_GTEST_PROP(TimeWarp, RecoversAKnownRepetitionVector, ()) {
  constexpr int kLimit = 2;
  const int frames = 2 * *rc::gen::inRange(20, 60);
  std::vector<int> counts(static_cast<std::size_t>(frames));
  for (int& count : counts) count = *rc::gen::inRange(1, kLimit * kLimit + 1);
  if (std::accumulate(counts.begin(), counts.end(), 0) % kLimit != 0) counts[0] = counts[0] == 1 ? 2 : counts[0] - 1;
  // The output is q of the lengthened output taken back: a frame of q lies under slots of one input frame or of two, so
  // only warps that change at even slots can be known exactly. Make them so: count pairs of equal parity.
  int slot = 0;
  for (int& count : counts) {
    if ((slot + count) % kLimit != 0) count = count == kLimit * kLimit ? count - 1 : count + 1;
    slot += count;
  }
  const FrameMatrix input = test::noise(frames, 4, 7);
  const FrameMatrix lengthened = test::repeated(input, counts);
  FrameMatrix output(lengthened.rows() / kLimit, lengthened.cols());
  for (Eigen::Index j = 0; j < output.rows(); ++j) output.row(j) = lengthened.row(kLimit * j);
  RC_ASSERT(time_warp(input, output, kLimit) == counts);
}

TEST(TimeWarp, OfASignalWithItselfIsEven) {
  const FrameMatrix signal = test::smooth_curves(100, 6, 3);
  EXPECT_THAT(time_warp(signal, signal, 2), testing::Each(2));
}

TEST(TimeWarp, OfConstantSignalsIsEven) {
  const FrameMatrix still = FrameMatrix::Constant(30, 2, 4.0);
  EXPECT_THAT(time_warp(still, still, 3), testing::Each(3));
  EXPECT_THAT(time_warp(0.0 * still, 0.0 * still, 2), testing::Each(2));
}

TEST(TimeWarp, IgnoresADegreeOfFreedomOfNoWeight) {
  FrameMatrix input = test::smooth_curves(60, 3, 4), output = test::smooth_curves(70, 3, 9);
  const Eigen::VectorXd weights = Eigen::Vector3d(1.0, 2.0, 0.0);
  const std::vector<int> counts = time_warp(input, output, 2, weights);
  output.col(2) = 5.0 * test::noise(70, 1, 1);
  EXPECT_EQ(time_warp(input, output, 2, weights), counts);
}

TEST(TimeWarp, RefusesLengthsThatDifferTooMuch) {
  const FrameMatrix five = FrameMatrix::Zero(5, 1);
  EXPECT_NO_THROW(time_warp(five, FrameMatrix::Zero(10, 1), 2));
  EXPECT_NO_THROW(time_warp(five, FrameMatrix::Zero(3, 1), 2));
  EXPECT_THROW(time_warp(five, FrameMatrix::Zero(2, 1), 2), InvalidArgument);
  try {
    time_warp(five, FrameMatrix::Zero(11, 1), 2);
    FAIL() << "eleven frames are more than twice five";
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("5 frames"), testing::HasSubstr("11 frames")));
    EXPECT_THAT(error.hint(), testing::HasSubstr("slope limit of 3"));
  }
}

TEST(TimeWarp, RefusesBadSignals) {
  const FrameMatrix good = FrameMatrix::Zero(5, 2);
  FrameMatrix bad = good;
  bad(3, 1) = std::nan("");
  EXPECT_THROW(time_warp(good, bad, 2), InvalidArgument);
  EXPECT_THROW(time_warp(bad, good, 2), InvalidArgument);
  EXPECT_THROW(time_warp(good, FrameMatrix::Zero(5, 3), 2), InvalidArgument);
  EXPECT_THROW(time_warp(good, FrameMatrix::Zero(0, 2), 2), InvalidArgument);
  EXPECT_THROW(time_warp(good, good, 0), InvalidArgument);
  EXPECT_THROW(time_warp(good, good, kLargestSlopeLimit + 1), InvalidArgument);
  EXPECT_THROW(time_warp(good, good, 2, Eigen::VectorXd::Ones(3)), InvalidArgument);
  EXPECT_THROW(time_warp(good, good, 2, -Eigen::VectorXd::Ones(2)), InvalidArgument);
}

}  // namespace
}  // namespace strut::align
