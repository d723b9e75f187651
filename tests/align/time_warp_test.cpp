// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"
#include "align/warp_oracle.h"

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

using test::cost_of;

constexpr double kRounding = 1e-9;  // distances come from a matrix product: relative to sums of squares of size 1..100

int slots_of(const TimeWarp& warp) {
  return std::accumulate(warp.repetitions.begin(), warp.repetitions.end(), warp.begin + warp.rest);
}

struct Problem {
  int input, output;
  double slope_limit;
  int resolution;  // 0: the slope limit, a whole number
  Ends ends;
};

void PrintTo(const Problem& problem, std::ostream* os) {
  *os << problem.input << " x " << problem.output << ", slope limit " << problem.slope_limit << ", resolution "
      << problem.resolution << ", ends " << static_cast<int>(problem.ends);
}

class TimeWarpOracle : public testing::TestWithParam<Problem> {};

TEST_P(TimeWarpOracle, FindsTheLeastCostOfAllAllowedWarps) {
  const Problem& problem = GetParam();
  const int s = problem.resolution == 0 ? static_cast<int>(problem.slope_limit) : problem.resolution;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const FrameMatrix p = test::noise(problem.input, 2, seed), q = test::noise(problem.output, 2, seed + 100);
    TimeWarpOptions options{.slope_limit = problem.slope_limit, .resolution = problem.resolution, .ends = problem.ends};
    options.weights = test::noise(2, 1, seed).cwiseAbs().col(0);
    const TimeWarp found = time_warp(p, q, options);
    double least = std::numeric_limits<double>::infinity();
    bool is_allowed = false;
    test::for_each_warp(problem.input, problem.output, problem.slope_limit, s, problem.ends, [&](const TimeWarp& warp) {
      least = std::min(least, cost_of(p, q, warp, options.weights));
      is_allowed = is_allowed || warp == found;
    });
    EXPECT_TRUE(is_allowed) << "seed " << seed;
    EXPECT_EQ(slots_of(found), problem.output * s);
    EXPECT_NEAR(cost_of(p, q, found, options.weights), least, kRounding) << "seed " << seed;
  }
}

constexpr auto kFixed = Ends::kFixed, kOpenBegin = Ends::kOpenBegin, kOpenEnd = Ends::kOpenEnd, kOpen = Ends::kOpen;

INSTANTIATE_TEST_SUITE_P(PaperForm, TimeWarpOracle,
                         testing::Values(Problem{5, 5, 2, 0, kFixed}, Problem{6, 4, 2, 0, kFixed},
                                         Problem{4, 7, 2, 0, kFixed}, Problem{6, 3, 2, 0, kFixed},
                                         Problem{3, 6, 2, 0, kFixed}, Problem{4, 4, 1, 0, kFixed},
                                         Problem{3, 5, 3, 0, kFixed}, Problem{5, 2, 3, 0, kFixed},
                                         Problem{1, 1, 2, 0, kFixed}));
INSTANTIATE_TEST_SUITE_P(AnyLimitAndResolution, TimeWarpOracle,
                         testing::Values(Problem{6, 6, 1.25, 5, kFixed}, Problem{6, 7, 1.5, 3, kFixed},
                                         Problem{5, 6, 1.5, 2, kFixed}, Problem{4, 4, 2.5, 4, kFixed},
                                         Problem{3, 9, 3.5, 2, kFixed}, Problem{5, 6, 2, 1, kFixed},
                                         Problem{3, 4, 4, 2, kFixed}, Problem{2, 3, 5, 4, kFixed},
                                         Problem{2, 2, 9, 30, kFixed}, Problem{3, 4, 3.5, 6, kFixed}));
INSTANTIATE_TEST_SUITE_P(OpenEnds, TimeWarpOracle,
                         testing::Values(Problem{4, 7, 2, 0, kOpenBegin}, Problem{4, 7, 2, 0, kOpenEnd},
                                         Problem{4, 7, 2, 0, kOpen}, Problem{3, 30, 1.5, 4, kOpen},
                                         Problem{4, 4, 1, 0, kOpen}, Problem{5, 4, 2.5, 2, kOpen},
                                         Problem{2, 5, 3.5, 6, kOpen}, Problem{1, 3, 3, 0, kOpenEnd},
                                         Problem{2, 9, 1, 1, kOpenBegin}));

TEST(DefaultResolution, IsTheLimitItselfWhereThatIsWhole) {
  for (int limit = 1; limit <= kLargestSlopeLimit; ++limit) EXPECT_EQ(default_resolution(limit), limit);
}

TEST(DefaultResolution, ComesNearBothLimitsWhereTheyAreNot) {
  EXPECT_EQ(default_resolution(1.25), 5);
  EXPECT_EQ(default_resolution(1.5), 6);
  for (int twentieths = 21; twentieths < 160; ++twentieths) {
    const double limit = twentieths / 20.0;
    const double s = default_resolution(limit);
    EXPECT_GE(s, limit);
    EXPECT_LE(s, kLargestResolution);
    EXPECT_GE(std::floor(s * limit + kRounding) / s, std::pow(limit, 0.8) - kRounding) << limit;
    EXPECT_LE(std::ceil(s / limit - kRounding) / s, std::pow(limit, -0.8) + kRounding) << limit;
  }
}

TEST(TimeWarp, FindsAClipInsideALongOne) {
  const FrameMatrix output = test::smooth_curves(300, 5, 21);
  const FrameMatrix input = output.middleRows(117, 60);
  const TimeWarp found = time_warp(input, output, {.ends = kOpen});
  EXPECT_EQ(found.begin, 2 * 117);
  EXPECT_EQ(found.rest, 2 * (300 - 117 - 60));
  EXPECT_THAT(found.repetitions, testing::Each(2));
  const Correspondence correspondence = found.correspondence();
  EXPECT_DOUBLE_EQ(correspondence.output_begin, 117.0);
  EXPECT_NEAR(correspondence.output_time()[0], 117.0, kRounding);
  EXPECT_LT((warp_to_input(output, correspondence) - input).cwiseAbs().maxCoeff(), kRounding);
}

RC_GTEST_PROP(TimeWarp, FindsAWarpedClipInsideALongOne, ()) {
  // Whole frames repeated once or twice: exactly known, for noise has no equals.
  const int frames = *rc::gen::inRange(5, 30), before = *rc::gen::inRange(0, 40), after = *rc::gen::inRange(0, 40);
  std::vector<int> counts(static_cast<std::size_t>(frames));
  for (int& count : counts) count = *rc::gen::inRange(1, 3);
  const FrameMatrix input = test::noise(frames, 4, 7), inside = test::repeated(input, counts);
  FrameMatrix output(before + inside.rows() + after, 4);
  output << test::noise(before, 4, 8), inside, test::noise(after, 4, 9);
  const TimeWarp found = time_warp(input, output, {.slope_limit = 2.0, .resolution = 1, .ends = kOpen});
  // The ends may cover less than they could: a mean over fewer equals is the same.
  RC_ASSERT(cost_of(input, output, found) < kRounding);
  RC_ASSERT(found.begin >= before && found.begin <= before + 1);
  for (std::size_t i = 1; i + 1 < counts.size(); ++i) RC_ASSERT(found.repetitions[i] == counts[i]);
}

RC_GTEST_PROP(TimeWarp, DoesNotDependOnWhereASignalsZeroIs, ()) {
  const int m = *rc::gen::inRange(8, 40), n = *rc::gen::inRange(m, 2 * m);
  const auto seed = *rc::gen::inRange(0U, 100000U);
  TimeWarpOptions options;
  options.ends = *rc::gen::element(kFixed, kOpenBegin, kOpenEnd, kOpen);
  const FrameMatrix input = test::noise(m, 3, seed), output = test::noise(n, 3, seed + 1);
  const TimeWarp found = time_warp(input, output, options);
  RC_ASSERT(time_warp(4.0 * input, 4.0 * output, options) == found);
  const FrameMatrix moved_input = input.array() + 100.0, moved_output = output.array() + 100.0;
  RC_ASSERT(time_warp(moved_input, moved_output, options) == found);
  // Time reversed, the ends change places.
  options.ends = options.ends == kOpenBegin ? kOpenEnd : options.ends == kOpenEnd ? kOpenBegin : options.ends;
  TimeWarp reversed = time_warp(input.colwise().reverse(), output.colwise().reverse(), options);
  RC_ASSERT(reversed.begin == found.rest);
  std::reverse(reversed.repetitions.begin(), reversed.repetitions.end());
  RC_ASSERT(reversed.repetitions == found.repetitions);
}

// ---- coarse to fine -------------------------------------------------------------------------------------------------

/// A smooth signal and a warped, noisy copy of it.
struct LongPair {
  FrameMatrix input, output;
};
LongPair long_pair(int frames, double noise, unsigned seed) {
  const FrameMatrix curves = test::smooth_curves(2 * frames, 6, seed);
  LongPair pair{curves.topRows(frames), FrameMatrix(frames, 6)};
  for (int j = 0; j < frames; ++j) {
    const double time = j + 0.08 * frames * std::sin(6.28 * j / frames);
    const auto before = static_cast<Eigen::Index>(std::max(0.0, time));
    const double share = std::max(0.0, time) - static_cast<double>(before);
    pair.output.row(j) = (1.0 - share) * curves.row(before) + share * curves.row(before + 1);
  }
  pair.output += noise * test::noise(frames, 6, seed + 1);
  return pair;
}

TEST(CoarseToFine, OfSmoothSignalsIsTheBestOfAll) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const LongPair pair = long_pair(700, 0.1, seed);
    for (const Ends ends : {kFixed, kOpenEnd}) {
      TimeWarpOptions options{.ends = ends};
      const TimeWarp exact = time_warp(pair.input, pair.output, options);
      options.exact_steps = 20000;
      options.band_radius = 30;
      const TimeWarp found = time_warp(pair.input, pair.output, options);
      EXPECT_TRUE(exact.is_exact);
      EXPECT_FALSE(found.is_exact);
      EXPECT_EQ(found.repetitions, exact.repetitions) << "seed " << seed;
    }
  }
}

RC_GTEST_PROP(CoarseToFine, IsAlwaysAllowedAndNeverBetterThanTheBest, ()) {
  const int m = *rc::gen::inRange(64, 200);
  TimeWarpOptions options;
  options.slope_limit = *rc::gen::element(1.0, 1.1, 1.25, 2.0, 3.5);
  options.ends = *rc::gen::element(kFixed, kOpenBegin, kOpenEnd, kOpen);
  const int s = default_resolution(options.slope_limit);
  const int fewest = static_cast<int>(std::ceil(m * std::ceil(s / options.slope_limit - kRounding) / s));
  const int most = static_cast<int>(std::floor(m * std::floor(s * options.slope_limit + kRounding) / s));
  const int n = *rc::gen::element(fewest, most, *rc::gen::inRange(fewest, most + 1));
  const auto seed = *rc::gen::inRange(0U, 100000U);
  const FrameMatrix input = test::noise(m, 2, seed), output = test::noise(n, 2, seed + 1);
  const TimeWarp exact = time_warp(input, output, options);
  options.exact_steps = 1;
  options.band_radius = *rc::gen::inRange(1, 10);
  const TimeWarp found = time_warp(input, output, options);
  RC_ASSERT(slots_of(found) == n * s);
  for (const int count : found.repetitions) {
    RC_ASSERT(count * options.slope_limit >= s - kRounding);
    RC_ASSERT(count <= s * options.slope_limit + kRounding);
  }
  RC_ASSERT(cost_of(input, output, found) >= cost_of(input, output, exact) * (1.0 - kRounding));
}

// ---- known and degenerate signals -----------------------------------------------------------------------------------

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
  RC_ASSERT(time_warp(input, output).repetitions == counts);
}

TEST(TimeWarp, OfASignalWithItselfIsEven) {
  const FrameMatrix signal = test::smooth_curves(100, 6, 3);
  EXPECT_THAT(time_warp(signal, signal).repetitions, testing::Each(2));
}

TEST(TimeWarp, OfConstantSignalsIsEven) {
  const FrameMatrix still = FrameMatrix::Constant(30, 2, 4.0), longer = FrameMatrix::Constant(45, 2, 1.0 / 3.0);
  EXPECT_THAT(time_warp(still, still, {.slope_limit = 3.0}).repetitions, testing::Each(3));
  EXPECT_THAT(time_warp(0.0 * still, 0.0 * still).repetitions, testing::Each(2));
  EXPECT_THAT(time_warp(still, longer).repetitions, testing::Each(3));
  EXPECT_THAT(time_warp(still, longer, {.resolution = 4, .ends = kOpen}).repetitions, testing::Each(6));
  EXPECT_EQ(time_warp(still, longer, {.slope_limit = 1.0, .ends = kOpen}).begin, 7);
}

TEST(TimeWarp, OfASingleFrameCoversTheOutput) {
  const FrameMatrix one = FrameMatrix::Constant(1, 1, 3.0), two = FrameMatrix::Constant(2, 1, 1.0);
  EXPECT_EQ(time_warp(one, one).repetitions, std::vector<int>{2});
  EXPECT_EQ(time_warp(one, two).repetitions, std::vector<int>{4});
  EXPECT_EQ(time_warp(two, one).repetitions, (std::vector<int>{1, 1}));
}

TEST(TimeWarp, IgnoresADegreeOfFreedomOfNoWeight) {
  FrameMatrix input = test::smooth_curves(60, 3, 4), output = test::smooth_curves(70, 3, 9);
  TimeWarpOptions options;
  options.weights = Eigen::Vector3d(1.0, 2.0, 0.0);
  const TimeWarp found = time_warp(input, output, options);
  output.col(2) = 5.0 * test::noise(70, 1, 1);
  EXPECT_EQ(time_warp(input, output, options), found);
}

// ---- what is refused ------------------------------------------------------------------------------------------------

struct Refusal {
  std::string what, hint;
};
Refusal refusal(const FrameMatrix& input, const FrameMatrix& output, const TimeWarpOptions& options = {}) {
  try {
    time_warp(input, output, options);
  } catch (const InvalidArgument& error) {
    return {error.what(), error.hint()};
  }
  return {"not refused", ""};
}
Refusal refusal(const TimeWarpOptions& options) {
  return refusal(FrameMatrix::Zero(5, 2), FrameMatrix::Zero(5, 2), options);
}

TEST(TimeWarp, RefusesLengthsThatDifferTooMuchAndSaysWhatWouldDo) {
  const FrameMatrix five = FrameMatrix::Zero(5, 1), eleven = FrameMatrix::Zero(11, 1);
  EXPECT_NO_THROW(time_warp(five, FrameMatrix::Zero(10, 1)));
  EXPECT_NO_THROW(time_warp(five, FrameMatrix::Zero(3, 1)));
  EXPECT_THROW(time_warp(five, FrameMatrix::Zero(2, 1)), InvalidArgument);
  const Refusal found = refusal(five, eleven);
  EXPECT_EQ(
      found.what,
      "output: expected 3 to 10 frames for an input of 5 frames at slope limit 2 and resolution 2, got 11 frames");
  EXPECT_EQ(found.hint, "a slope limit of 2.3 would allow it");
  EXPECT_NO_THROW(time_warp(five, eleven, {.slope_limit = 2.3}));
  EXPECT_EQ(refusal(five, FrameMatrix::Zero(400, 1)).hint, "trim the longer one");
  EXPECT_EQ(
      refusal(five, FrameMatrix::Zero(1, 1), {.ends = kOpen}).what,
      "output: expected at least 3 frames for an input of 5 frames at slope limit 2 and resolution 2, got 1 frames");
}

TEST(TimeWarp, SaysWhenTheResolutionIsWhatIsInTheWay) {
  const FrameMatrix ten = FrameMatrix::Zero(10, 1), eleven = FrameMatrix::Zero(11, 1);
  const Refusal found = refusal(ten, eleven, {.slope_limit = 1.25, .resolution = 2});
  EXPECT_EQ(found.what,
            "output: expected 10 to 10 frames for an input of 10 frames at slope limit 1.25 and resolution 2, got 11 "
            "frames");
  EXPECT_EQ(found.hint, "a resolution of 4 would allow it");
  EXPECT_NO_THROW(time_warp(ten, eleven, {.slope_limit = 1.25, .resolution = 4}));
}

TEST(TimeWarp, RefusesOptionsOutOfRange) {
  const auto with = [](auto set) {
    TimeWarpOptions options;
    set(options);
    return refusal(options).what;
  };
  for (const double limit : {0.0, 0.99, -2.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(with([&](auto& o) { o.slope_limit = limit; }),
                testing::StartsWith("slope_limit: expected 1 to 16, got"));
  }
  for (const int resolution : {-1, 33, 1000000, std::numeric_limits<int>::max()}) {
    EXPECT_THAT(with([&](auto& o) { o.resolution = resolution; }),
                testing::StartsWith("resolution: expected 1 to 32, or 0 to have it chosen, got"));
  }
  EXPECT_EQ(with([](auto& o) { o.exact_steps = 0; }), "exact_steps: expected at least 1, got 0");
  EXPECT_EQ(with([](auto& o) { o.band_radius = 0; }), "band_radius: expected at least 1, got 0");
  EXPECT_EQ(with([](auto& o) { o.weights = Eigen::VectorXd::Ones(3); }), "weights: expected 2 numbers or none, got 3");
  EXPECT_EQ(with([](auto& o) { o.weights = -Eigen::VectorXd::Ones(2); }),
            "weights: expected finite numbers that are not negative, got another");
  EXPECT_EQ(with([](auto& o) { o.weights = Eigen::VectorXd::Constant(2, std::nan("")); }),
            "weights: expected finite numbers that are not negative, got another");
  EXPECT_EQ(with([](auto& o) { o.weights = Eigen::VectorXd::Zero(2); }),
            "weights: expected at least one above zero, got zeros");
  EXPECT_THAT(with([](auto& o) { o.weights = Eigen::VectorXd::Constant(2, 1e200); }),
              testing::StartsWith("weights: expected numbers up to 1e100"));
}

TEST(TimeWarp, RefusesBadSignals) {
  const FrameMatrix good = FrameMatrix::Zero(5, 2);
  FrameMatrix bad = good;
  bad(3, 1) = std::nan("");
  EXPECT_EQ(refusal(good, bad).what, "output: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal(bad, good).what, "input: expected finite numbers, got NaN or infinity");
  bad(3, 1) = -1e200;
  EXPECT_THAT(refusal(bad, good).what, testing::StartsWith("input: expected numbers up to 1e100"));
  EXPECT_EQ(refusal(good, FrameMatrix::Zero(5, 3)).what,
            "output: expected 2 degrees of freedom, as the input has, got 3");
  EXPECT_EQ(refusal(good, FrameMatrix::Zero(0, 2)).what, "output: expected at least one frame, got none");
  EXPECT_EQ(refusal(FrameMatrix::Zero(0, 2), good).what, "input: expected at least one frame, got none");
}

TEST(TimeWarp, RefusesMoreSlotsThanCanBeNumbered) {
  const FrameMatrix long_clip = FrameMatrix::Zero(3000000, 1);
  EXPECT_THAT(refusal(long_clip, long_clip, {.slope_limit = 16.0, .resolution = 32}).what,
              testing::HasSubstr("at most 2097152 frames of either signal at resolution 32"));
}

}  // namespace
}  // namespace strut::align
