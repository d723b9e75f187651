// SPDX-License-Identifier: MIT
#include "support/small_model.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/model/radial_map.h>

namespace strut {
namespace {

using representation::kHeight;
using representation::kNumRootDofs;
using representation::kTiltX;
using representation::Representation;

constexpr double kRounding = 1e-12;

Representation small_style() {
  return test::copying_parts(test::turning_motion(30.0, 1.0)).input;
}

/// Of a map of 8 degrees of freedom, three centres, two lags and two contexts, changed.
template <typename Change>
std::string refusal(Change change) {
  RadialMap map = test::some_radial_map(8, 3);
  change(map);
  try {
    check_radial_map(map, 8, 2);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RadialMap, IsAcceptedIfItsPartsFit) {
  EXPECT_EQ(refusal([](RadialMap&) {}), "accepted");
  EXPECT_EQ(refusal([](RadialMap& map) {
              map.fast = 2.0;
              map.smoothing = 0.0;
              map.share[0] = 0.0;
              map.share[1] = 1.0;
              map.lags[1] = 10000;
            }),
            "accepted");
}

TEST(RadialMap, RefusesLagsThatDoNotRiseFromZero) {
  EXPECT_EQ(refusal([](RadialMap& map) { map.lags = {}; }), "lags: expected a first lag of 0, got none");
  EXPECT_EQ(refusal([](RadialMap& map) { map.lags = {1, 2}; }), "lags: expected a first lag of 0, got none");
  EXPECT_EQ(refusal([](RadialMap& map) {
              map.lags = {0, 0};
            }),
            "lags: expected rising numbers, got one that does not rise");
  EXPECT_EQ(refusal([](RadialMap& map) {
              map.lags = {0, -3};
            }),
            "lags: expected rising numbers, got one that does not rise");
  EXPECT_EQ(refusal([](RadialMap& map) { map.lags = {0, 10001}; }), "lags: expected at most 10000 frames, got 10001");
}

TEST(RadialMap, RefusesShapesThatDoNotFit) {
  EXPECT_EQ(refusal([](RadialMap& map) { map.lags = {0, 1, 2}; }), "basis: expected 6 features, got 4");
  EXPECT_EQ(refusal([](RadialMap& map) { map.input.resize(8, 4); }), "input: expected 8 x 3, got 8 x 4");
  EXPECT_EQ(refusal([](RadialMap& map) { map.output = map.input; }), "output: expected 9 x 3, got 8 x 3");
  EXPECT_EQ(refusal([](RadialMap& map) { map.spread.resize(9); }), "spread: expected 8 x 1, got 9 x 1");
  EXPECT_EQ(refusal([](RadialMap& map) { map.share.resize(0); }), "share: expected 8 x 1, got 0 x 1");
}

TEST(RadialMap, RefusesNumbersOutOfRange) {
  EXPECT_EQ(refusal([](RadialMap& map) { map.input(2, 1) = NAN; }),
            "input: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal([](RadialMap& map) { map.output(8, 0) = INFINITY; }),
            "output: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal([](RadialMap& map) { map.spread[3] = 0.0; }),
            "spread: expected numbers above 0, got one that is not");
  EXPECT_EQ(refusal([](RadialMap& map) { map.spread[3] = NAN; }),
            "spread: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal([](RadialMap& map) { map.share[0] = -0.1; }),
            "share: expected numbers from 0 to 1, got one outside");
  EXPECT_EQ(refusal([](RadialMap& map) { map.share[7] = 1.1; }),
            "share: expected numbers from 0 to 1, got one outside");
  EXPECT_EQ(refusal([](RadialMap& map) { map.fast = -0.5; }), "fast: expected 0 to 2, got -0.500000");
  EXPECT_EQ(refusal([](RadialMap& map) { map.fast = NAN; }), "fast: expected 0 to 2, got nan");
  EXPECT_EQ(refusal([](RadialMap& map) { map.smoothing = -1.0; }),
            "smoothing: expected 0 or more frames, got -1.000000");
  EXPECT_EQ(refusal([](RadialMap& map) { map.smoothing = INFINITY; }), "smoothing: expected 0 or more frames, got inf");
}

TEST(DetailParts, CoverEveryDegreeOfFreedomOnceInOrder) {
  const Representation style = small_style();
  Eigen::Index next = 0;
  for (const DetailPart& part : detail_parts(style, style)) {
    EXPECT_EQ(part.first, next);
    EXPECT_GE(part.size, 1);
    EXPECT_LE(part.size, 3);
    EXPECT_EQ(part.is_velocity, part.first < kHeight);
    EXPECT_LT((part.turn - Eigen::Matrix3d::Identity()).norm(), kRounding);
    next += part.size;
  }
  EXPECT_EQ(next, style.num_dofs());
}

TEST(DetailParts, SeeADetailFromTheOutputStylesMean) {
  const Representation input = small_style();
  std::vector<Eigen::Quaterniond> means = input.mean_rotations();
  const int joint = input.joints()[1];
  const auto j = static_cast<std::size_t>(joint);
  means[j] = Eigen::Quaterniond(math::exp_map({0.3, -0.8, 0.5}));
  const Representation output(input.shared_skeleton(), means, input.upright(), input.travel_joint());
  const DetailPart part = detail_parts(input, output)[4];  // behind velocities, height, tilt and the first joint
  ASSERT_EQ(part.first, kNumRootDofs + 3);
  const Eigen::Vector3d detail(0.1, 0.2, -0.3);
  EXPECT_LT((means[j] * (part.turn * detail) - input.mean_rotations()[j] * detail).norm(), kRounding);
}

}  // namespace
}  // namespace strut
