// SPDX-License-Identifier: MIT
#include "small_effort.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/effort_synthesis.h>
#include <strut/effort/inertialization.h>
#include <strut/metrics/body_track.h>
#include <strut/metrics/foot_slide.h>
#include <strut/motion/kinematics.h>

namespace strut::effort {
namespace {

using test::gesture;
using test::kLifts;
using test::kReaches;

EffortCurve only_time(double time) {
  return EffortCurve(EffortVector(kNotRated, kNotRated, time));
}

/// Angular acceleration of every joint at every inner frame [rad/s^2] (frames - 2 x joints).
Eigen::MatrixXd joint_accelerations(const Motion& motion) {
  const double rate = motion.frame_rate();
  Eigen::MatrixXd out(motion.num_frames() - 2, motion.skeleton().num_joints());
  for (int f = 1; f + 1 < motion.num_frames(); ++f) {
    for (int j = 0; j < motion.skeleton().num_joints(); ++j) {
      const auto at = [&](int frame) { return motion.frame(frame).rotations[static_cast<std::size_t>(j)]; };
      const Eigen::AngleAxisd before(at(f - 1).conjugate() * at(f)), after(at(f).conjugate() * at(f + 1));
      const Eigen::Vector3d change = after.angle() * after.axis() - before.angle() * before.axis();
      out(f - 1, j) = change.norm() * rate * rate;
    }
  }
  return out;
}

double quantile(const Eigen::MatrixXd& values, double share) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * (static_cast<double>(sorted.size()) - 1.0))];
}

class EffortSynthesis : public testing::Test {
 protected:
  static const BlendChooser& chooser() {
    static const BlendChooser chooser(test::small_effort_model());
    return chooser;
  }
  /// A reach, a lift and a reach, all neutral.
  static Motion clip(double frame_rate = 30.0, const generate::Performer& who = {}) {
    const EffortVector neutral = EffortVector::Zero();
    return join({gesture(kReaches, neutral, frame_rate, who), gesture(kLifts, neutral, frame_rate, who),
                 gesture(kReaches, neutral, frame_rate, who)})
        .motion;
  }
};

TEST_F(EffortSynthesis, ReplacesEverySnippet) {
  const Motion motion = clip();
  const AppliedEffort applied = apply_effort(chooser(), motion, only_time(0.6));
  ASSERT_EQ(applied.snippets.size(), 3U);
  EXPECT_EQ(applied.coverage, 1.0);
  const int groups[] = {kReaches, kLifts, kReaches};
  for (std::size_t i = 0; i < 3; ++i) {
    const AppliedSnippet& snippet = applied.snippets[i];
    EXPECT_EQ(snippet.group, groups[i]);
    EXPECT_EQ(snippet.input.begin, i == 0 ? 0 : applied.snippets[i - 1].input.end);
    EXPECT_EQ(snippet.output.begin, i == 0 ? 0 : applied.snippets[i - 1].output.end);
    EXPECT_EQ(snippet.wanted[kTime], 0.6);
    EXPECT_EQ(snippet.wanted[kFlow], snippet.before[kFlow]) << "not asked for: as it is";
    EXPECT_TRUE(is_rated(snippet.after[kTime]));
  }
  EXPECT_EQ(applied.snippets.back().input.end, motion.num_frames());
  EXPECT_EQ(applied.snippets.back().output.end, applied.motion.num_frames());
  EXPECT_EQ(applied.motion.shared_skeleton(), motion.shared_skeleton());
}

TEST_F(EffortSynthesis, IsMoreSuddenTheMoreIsAskedFor) {
  const Motion motion = clip();
  double before = -1e9;
  for (const double time : {-0.8, 0.0, 0.8}) {
    const AppliedEffort applied = apply_effort(chooser(), motion, only_time(time));
    const double acceleration = describe(applied.motion)[kLogAcceleration];
    EXPECT_GT(acceleration, before);
    before = acceleration;
  }
}

TEST_F(EffortSynthesis, FollowsSlidersOverTime) {
  const Motion motion = clip();
  const double end = motion.duration();
  const EffortCurve curve(
      std::vector<EffortKey>{{0.0, {kNotRated, kNotRated, -0.8}}, {end, {kNotRated, kNotRated, 0.8}}});
  const AppliedEffort applied = apply_effort(chooser(), motion, curve);
  ASSERT_EQ(applied.snippets.size(), 3U);
  EXPECT_LT(applied.snippets[0].wanted[kTime], -0.3);
  EXPECT_GT(applied.snippets[2].wanted[kTime], 0.3);
  EXPECT_GT(applied.snippets[2].after[kTime], applied.snippets[0].after[kTime]);
  EXPECT_LT(applied.snippets[2].output.num_frames(), applied.snippets[0].output.num_frames());
}

TEST_F(EffortSynthesis, JoinsWithoutAPop) {
  constexpr double kMost = 1.5;  // times the sources' 99th percentile
  Eigen::MatrixXd sources(0, 0);
  std::vector<double> all;
  for (const ModelFragment& fragment : chooser().model().fragments()) {
    const Eigen::MatrixXd some = joint_accelerations(fragment.motion);
    all.insert(all.end(), some.data(), some.data() + some.size());
  }
  const double usual = quantile(Eigen::Map<Eigen::VectorXd>(all.data(), std::ssize(all)), 0.99);
  ApplyOptions options;
  options.clean_feet = false;
  const AppliedEffort applied = apply_effort(chooser(), clip(), only_time(0.7), options);
  const Eigen::MatrixXd accelerations = joint_accelerations(applied.motion);
  for (std::size_t i = 1; i < applied.snippets.size(); ++i) {
    const int join = applied.snippets[i].output.begin;
    const Eigen::MatrixXd around = accelerations.middleRows(join - 3, 6);
    EXPECT_LT(around.maxCoeff(), kMost * usual) << "at frame " << join;
  }
}

TEST_F(EffortSynthesis, FeetStand) {
  constexpr double kSlide = 0.03;  // m/s; recordings have 0.01 to 0.02
  const AppliedEffort applied = apply_effort(chooser(), clip(), only_time(-0.5));
  const auto track = metrics::body_track(applied.motion, applied.motion.frame_rate());
  ASSERT_FALSE(applied.plants.empty());
  EXPECT_LT(metrics::foot_slide(track, applied.plants).speed, kSlide);
}

TEST_F(EffortSynthesis, IsTheSameEveryTime) {
  const BlendChooser fresh(test::small_effort_model());
  const AppliedEffort a = apply_effort(chooser(), clip(), only_time(0.3));
  const AppliedEffort b = apply_effort(fresh, clip(), only_time(0.3));
  EXPECT_EQ(a.motion.frames(), b.motion.frames());
}

TEST_F(EffortSynthesis, KeepsWhatIsLikeNothing) {
  const Motion reach = gesture(kReaches, EffortVector::Zero());
  const Motion bow =
      generate::generate_gesture(generate::gesture_content(generate::GestureAction::kBow), {}, {}, 30.0).motion;
  const Motion motion = join({reach, bow, reach}).motion;
  const AppliedEffort applied = apply_effort(chooser(), motion, only_time(0.8));
  ASSERT_EQ(applied.snippets.size(), 3U);
  EXPECT_EQ(applied.snippets[1].group, kNoMatch);
  constexpr double kMoved = 6.0;  // frames: each end, to where it fits, by 0.1 s at most
  EXPECT_NEAR(applied.snippets[1].output.num_frames(), applied.snippets[1].input.num_frames(), kMoved);
  EXPECT_GT(applied.coverage, 0.4);
  EXPECT_LT(applied.coverage, 0.9);
  Diagnostics diagnostics;
  const AppliedEffort nothing = apply_effort(chooser(), bow, only_time(0.8), {}, &diagnostics);
  EXPECT_EQ(nothing.coverage, 0.0);
  EXPECT_EQ(nothing.motion.frames(), bow.frames());
}

TEST_F(EffortSynthesis, GoesOntoOtherBodiesAtOtherRates) {
  generate::Performer tall;
  tall.height = 1.95;
  const Motion motion = clip(60.0, tall);
  const AppliedEffort applied = apply_effort(chooser(), motion, only_time(0.5));
  EXPECT_EQ(applied.motion.frame_rate(), 60.0);
  EXPECT_EQ(applied.motion.shared_skeleton(), motion.shared_skeleton());
  EXPECT_GT(applied.coverage, 0.8);
  const auto height = [](const Motion& m) {
    return motion::forward_kinematics(m.skeleton(), m.frame(0))
        .positions[static_cast<std::size_t>(m.skeleton().pelvis())]
        .y();
  };
  constexpr double kStance = 0.06;  // m: another gesture's stance
  EXPECT_NEAR(height(applied.motion), height(motion), kStance);
}

TEST_F(EffortSynthesis, RefusesWhatMakesNoSense) {
  const Motion motion = clip();
  EXPECT_THROW(apply_effort(chooser(), motion.slice(0, 3), only_time(0.0)), InvalidArgument);
  std::vector<Joint> joints = motion.skeleton().joints();
  joints[3].name = "Beak";
  const Motion other(std::make_shared<const Skeleton>(joints), 30.0, motion.frames());
  EXPECT_THROW(apply_effort(chooser(), other, only_time(0.0)), SkeletonMismatch);
  ApplyOptions options;
  options.unasked_weight = -1.0;
  EXPECT_THROW(apply_effort(chooser(), motion, only_time(0.0), options), InvalidArgument);
  options.unasked_weight = 0.25;
  options.jerk_weight = std::nan("");
  EXPECT_THROW(apply_effort(chooser(), motion, only_time(0.0), options), InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
