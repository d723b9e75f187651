// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/descriptors.h>
#include <strut/generate/gestures.h>
#include <strut/generate/walker.h>
#include <strut/motion/kinematics.h>

namespace strut::effort {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using generate::gesture_content;
using generate::GestureAction;
using generate::GestureStyle;

constexpr double kRounding = 1e-8;    // turning a clip rounds its positions
constexpr double kRate = 1e-6;        // content time is integrated in other steps at another rate
constexpr double kUnevenRate = 0.03;  // positions are read between frames

VectorXd described(GestureAction action, const GestureStyle& style, double frame_rate = 30.0) {
  return describe(generate::generate_gesture(gesture_content(action), style, {}, frame_rate).motion);
}

TEST(Describe, IsTheSameWhereverTheBodyStandsAndFaces) {
  const Motion motion = generate::generate_walk({.duration = 3.0, .turn_rate = 0.4}, {}, 60.0).motion;
  const VectorXd here = describe(motion), there = describe(motion::moved(motion, {3.0, 0.5, -2.0}, 1.3));
  EXPECT_LT((here - there).cwiseAbs().maxCoeff(), kRounding);
}

TEST(Describe, IsTheSameAtAnotherFrameRate) {
  const GestureStyle style{.boundness = 0.8};
  const VectorXd at30 = described(GestureAction::kThrow, style, 30.0);
  EXPECT_LT((described(GestureAction::kThrow, style, 60.0) - at30).cwiseAbs().maxCoeff(), kRate);
  EXPECT_LT((described(GestureAction::kThrow, style, 120.0) - at30).cwiseAbs().maxCoeff(), kRate);
  const VectorXd at75 = described(GestureAction::kThrow, style, 75.0);
  for (int k = 0; k < kNumDescriptors; ++k) {
    EXPECT_NEAR(at75[k], at30[k], kUnevenRate * std::max(1.0, std::abs(at30[k]))) << kDescriptorNames[k];
  }
}

TEST(Describe, FindsWhatEachSettingDoes) {
  for (int a = 0; a < generate::kNumGestureActions; ++a) {
    const auto action = static_cast<GestureAction>(a);
    SCOPED_TRACE(gesture_content(action).name);
    EXPECT_GT(described(action, {.suddenness = 0.8})[kLogAcceleration],
              described(action, {.suddenness = -0.8})[kLogAcceleration]);
    EXPECT_LT(described(action, {.suddenness = 0.8})[kLogDuration],
              described(action, {.suddenness = -0.8})[kLogDuration]);
    EXPECT_LT(described(action, {.boundness = 0.9})[kHandSmoothness],
              described(action, {.boundness = -0.9})[kHandSmoothness]);
    EXPECT_LT(described(action, {.strength = 0.8})[kHeight], described(action, {.strength = -0.8})[kHeight]);
    EXPECT_GT(described(action, {.extent = 1.3})[kLogPeakSpeed], described(action, {.extent = 0.7})[kLogPeakSpeed]);
  }
}

TEST(Describe, IsFiniteForABodyAtRestAndOneThatIsNone) {
  const auto skeleton = generate::walker_skeleton();
  const Motion still(skeleton, 30.0, std::vector<Pose>(10, rest_pose(*skeleton)));
  EXPECT_TRUE(describe(still).allFinite());
  EXPECT_EQ(describe(still)[kHandSmoothness], 0.0);
  const auto point = std::make_shared<const Skeleton>(std::vector<Joint>{{"thing", -1, {0, 1, 0}}});
  EXPECT_TRUE(describe(Motion(point, 30.0, std::vector<Pose>(10, rest_pose(*point)))).allFinite());
}

TEST(Describe, NeedsFourFramesAtItsRate) {
  const auto skeleton = generate::walker_skeleton();
  const auto still = [&](double rate, std::size_t frames) {
    return Motion(skeleton, rate, std::vector<Pose>(frames, rest_pose(*skeleton)));
  };
  EXPECT_NO_THROW(describe(still(30.0, 4)));
  EXPECT_THROW(describe(still(30.0, 3)), InvalidArgument);
  EXPECT_THROW(describe(still(120.0, 12)), InvalidArgument);
}

VectorXd bells(int count, double gap) {
  VectorXd speed = VectorXd::Zero(60 + static_cast<int>(60 * gap));
  for (int bell = 0; bell < count; ++bell) {
    for (int i = 0; i < 60; ++i) {
      const double u = (i + 0.5) / 60.0;
      speed[i + bell * static_cast<int>(60 * gap)] += 30.0 * u * u * (1.0 - u) * (1.0 - u);
    }
  }
  return speed;
}

TEST(SpectralArcLength, OfTheAuthorsExampleIsWhatTheyGive) {
  constexpr double kTheirs = -1.41403;  // of exp(-5 t^2) over [-1, 1) s at 100 samples/s, by their program
  constexpr double kBin = 5e-3;         // their spectrum has other bins
  VectorXd speed(200);
  for (int i = 0; i < 200; ++i) speed[i] = std::exp(-5.0 * std::pow(0.01 * i - 1.0, 2));
  EXPECT_NEAR(spectral_arc_length(speed, 100.0), kTheirs, kBin);
}

TEST(SpectralArcLength, IsLessSmoothTheFartherTwoMovementsAreApart) {
  const double one = spectral_arc_length(bells(1, 0.0), 60.0);
  const double near = spectral_arc_length(bells(2, 0.5), 60.0), far = spectral_arc_length(bells(2, 1.0), 60.0);
  EXPECT_LT(near, one);
  EXPECT_LT(far, near);
}

TEST(SpectralArcLength, IsTheSameForAFasterOrLargerMovementAndAnotherRate) {
  const VectorXd speed = bells(2, 0.5);
  const double at60 = spectral_arc_length(speed, 60.0);
  EXPECT_NEAR(spectral_arc_length(7.0 * speed, 60.0), at60, kRounding);
  EXPECT_NEAR(spectral_arc_length(speed, 90.0), at60, 0.02);  // its last frequency is found to a bin
  EXPECT_EQ(spectral_arc_length(VectorXd::Zero(30), 60.0), 0.0);
}

TEST(DescriptorScale, MakesAGroupMeanZeroDeviationOne) {
  MatrixXd rows(5, static_cast<int>(kNumDescriptors));
  for (int i = 0; i < 5; ++i) rows.row(i) = described(GestureAction::kReach, {.suddenness = 0.3 * i - 0.6}).transpose();
  rows.col(kHeight).setConstant(1.2);
  const DescriptorScale scale = descriptor_scale(rows);
  MatrixXd z(5, rows.cols());
  for (int i = 0; i < 5; ++i) z.row(i) = standardized(scale, rows.row(i).transpose()).transpose();
  EXPECT_LT(z.colwise().mean().cwiseAbs().maxCoeff(), kRounding);
  for (int k = 0; k < kNumDescriptors; ++k) {
    EXPECT_NEAR(z.col(k).squaredNorm() / 5.0, k == kHeight ? 0.0 : 1.0, kRounding) << kDescriptorNames[k];
  }
}

TEST(DescriptorScale, TakesTheSpeedOutOfBraking) {
  MatrixXd rows = MatrixXd::Zero(6, static_cast<int>(kNumDescriptors));
  for (int i = 0; i < 6; ++i) {
    rows(i, kLogPeakSpeed) = i;
    rows(i, kLogPeakDeceleration) = 2.0 * i + (i % 2);
  }
  const DescriptorScale scale = descriptor_scale(rows);
  double product = 0.0;
  for (int i = 0; i < 6; ++i) {
    const VectorXd z = standardized(scale, rows.row(i).transpose());
    product += z[kLogPeakDeceleration] * z[kLogPeakSpeed];
  }
  EXPECT_NEAR(product, 0.0, kRounding);
}

TEST(DescriptorScale, RefusesWhatAreNoDescriptors) {
  EXPECT_THROW(descriptor_scale(MatrixXd(0, static_cast<int>(kNumDescriptors))), InvalidArgument);
  EXPECT_THROW(descriptor_scale(MatrixXd::Zero(3, 2)), InvalidArgument);
  EXPECT_THROW(standardized(DescriptorScale{}, VectorXd::Zero(kNumDescriptors)), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
