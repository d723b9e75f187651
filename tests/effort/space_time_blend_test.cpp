// SPDX-License-Identifier: MIT
// Blends of two fragments: their ends, what they do not depend on, their time, their feet, and what is refused.
#include "support/data.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/space_time_blend.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>
#include <strut/metrics/foot_slide.h>
#include <strut/metrics/smoothness.h>
#include <strut/motion/kinematics.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::effort {
namespace {

using testing::HasSubstr;

constexpr double kExactAngle = 1e-5, kExactPlace = 1e-5;  // what effort.md asks of the ends [rad], [m]
constexpr double kSame = 1e-6;  // of what is computed twice by different ways [rad, m]; measured: below 1e-8

Motion walk(const generate::WalkStyle& style, double speed = 1.2, double turn_rate = 0.0) {
  generate::WalkContent content;
  content.duration = 3.0;
  content.speed = speed;
  content.turn_rate = turn_rate;
  return generate::generate_walk(content, style, 30.0).motion;
}

generate::WalkStyle brisk() {
  generate::WalkStyle style;
  style.cadence_scale = 1.3;
  style.step_length_scale = 1.1;
  style.arm_swing = 0.6;
  return style;
}

generate::WalkStyle heavy() {
  generate::WalkStyle style;
  style.cadence_scale = 0.85;
  style.crouch = 0.12;
  style.torso_lean = 0.3;
  style.foot_lift = 0.1;
  return style;
}

/// Largest differences of two motions.
struct Difference {
  double angle = 0.0;  ///< of joints in the world [rad]
  double place = 0.0;  ///< alike [m]
};

/// From the pelvis down: what is above only carries it about.
Difference difference(const Motion& a, const Motion& b) {
  Difference largest;
  EXPECT_EQ(a.num_frames(), b.num_frames());
  for (int t = 0; t < std::min(a.num_frames(), b.num_frames()); ++t) {
    const auto one = motion::forward_kinematics(a.skeleton(), a.frame(t));
    const auto other = motion::forward_kinematics(b.skeleton(), b.frame(t));
    for (auto j = static_cast<std::size_t>(a.skeleton().pelvis()); j < one.positions.size(); ++j) {
      largest.place = std::max(largest.place, (one.positions[j] - other.positions[j]).norm());
      largest.angle = std::max(largest.angle, one.rotations[j].angularDistance(other.rotations[j]));
    }
  }
  return largest;
}

void expect_same(const Motion& a, const Motion& b, double angle, double place) {
  const Difference apart = difference(a, b);
  EXPECT_LE(apart.angle, angle);
  EXPECT_LE(apart.place, place);
}

/// `motion` moved and turned so that it starts where `other` does, facing the same way.
Motion started_as(const Motion& motion, const Motion& other) {
  const auto root = [](const Motion& m) { return motion::forward_kinematics(m.skeleton(), m.frame(0)); };
  const auto pelvis = static_cast<std::size_t>(motion.skeleton().pelvis());
  const double turn = math::heading(root(other).rotations[pelvis] * root(motion).rotations[pelvis].conjugate());
  const Motion turned = motion::moved(motion, Eigen::Vector3d::Zero(), turn);
  Eigen::Vector3d shift = root(other).positions[pelvis] - root(turned).positions[pelvis];
  shift.y() = 0.0;
  return motion::moved(turned, shift, 0.0);
}

TEST(SpaceTimeBlend, EndsInItsFragments) {
  const Motion a = walk(brisk()), b = walk(heavy(), 1.0, 0.3);
  const SpaceTimeBlend blend(a, b);
  expect_same(blend.at(0.0).motion, a, kExactAngle, kExactPlace);
  const Motion at_second = blend.at(1.0).motion;
  expect_same(at_second, started_as(b, at_second), kExactAngle, kExactPlace);
}

TEST(SpaceTimeBlend, OfAFragmentAndItselfIsIt) {
  const Motion a = walk(heavy(), 1.1, 0.2);
  const SpaceTimeBlend blend(a, a);
  for (const double alpha : {-2.0, -0.7, 0.0, 0.3, 1.0, 1.9, 3.0}) {
    expect_same(blend.at(alpha).motion, a, kExactAngle, kExactPlace);
  }
}

TEST(SpaceTimeBlend, DoesNotDependOnWhereFragmentsStandAndFace) {
  const Motion a = walk(brisk()), b = walk(heavy());
  const SpaceTimeBlend blend(a, b);
  const SpaceTimeBlend second_moved(a, motion::moved(b, {3.0, 0.0, -8.0}, 2.4));
  const SpaceTimeBlend first_moved(motion::moved(a, {-5.0, 0.0, 2.0}, -1.9), b);
  for (const double alpha : {-0.5, 0.4, 1.6}) {
    const Motion plain = blend.at(alpha).motion;
    expect_same(second_moved.at(alpha).motion, plain, kSame, kSame);
    expect_same(started_as(first_moved.at(alpha).motion, plain), plain, kSame, kSame);
  }
}

TEST(SpaceTimeBlend, TreatsBothFragmentsAlike) {
  const Motion a = walk(brisk()), b = walk(heavy(), 1.0, 0.3);
  const SpaceTimeBlend there(a, b), back(b, a);
  for (const double alpha : {-1.5, -0.5, 0.25, 0.5, 1.4, 2.5}) {
    const Blend one = there.at(alpha), other = back.at(1.0 - alpha);
    expect_same(started_as(other.motion, one.motion), one.motion, kSame, kSame);
    if (alpha == 0.5) continue;  // plants of one fragment only go with the nearer one
    EXPECT_EQ(one.plants, other.plants);
  }
}

TEST(SpaceTimeBlend, LastsLongerTheMoreTheSlowerOneCounts) {
  const Motion quick = walk(brisk()), slow = walk(heavy());
  const SpaceTimeBlend blend(quick, slow);
  int before = 0;
  for (double alpha = -2.0; alpha <= 3.0; alpha += 0.1) {
    const int frames = blend.at(alpha).motion.num_frames();
    EXPECT_GE(frames, before) << alpha;
    before = frames;
  }
  const double halfway = 0.5 * (quick.num_frames() - 1 + slow.num_frames() - 1) + 1.0;
  EXPECT_NEAR(blend.at(0.5).motion.num_frames(), halfway, 0.5);
}

TEST(SpaceTimeBlend, KeepsItsOwnTiming) {
  // A pose that is told by its joint's angle comes at (1 - alpha) p + alpha q.
  const auto reach = [](int frames, double at) {
    const auto skeleton = std::make_shared<const Skeleton>(
        std::vector<Joint>{{"hips", -1, {0.0, 1.0, 0.0}}, {"arm", 0, {0.2, 0.4, 0.0}}, {"spine", 0, {0.0, 0.5, 0.0}}});
    std::vector<Pose> poses(static_cast<std::size_t>(frames), rest_pose(*skeleton));
    for (int t = 0; t < frames; ++t) {
      const double phase = (t - at) / 8.0;
      poses[static_cast<std::size_t>(t)].rotations[1] = math::exp_map({1.2 * std::exp(-phase * phase), 0.0, 0.0});
    }
    return Motion(skeleton, 30.0, std::move(poses));
  };
  const SpaceTimeBlend blend(reach(60, 25.0), reach(60, 35.0));
  for (const double alpha : {-0.5, 0.0, 0.3, 0.5, 1.0, 1.5}) {
    const Motion made = blend.at(alpha).motion;
    int highest = 0;
    for (int t = 0; t < made.num_frames(); ++t) {
      const auto angle = [&](int frame) { return math::log_map(made.frame(frame).rotations[1]).x(); };
      if (angle(t) > angle(highest)) highest = t;
    }
    constexpr double kFrames = 1.5;  // the alignment's own error, and that of a whole frame
    EXPECT_NEAR(highest, 25.0 + 10.0 * alpha, kFrames) << alpha;
  }
}

bool rises(const Eigen::VectorXd& values) {
  for (Eigen::Index k = 0; k + 1 < values.size(); ++k) {
    if (!(values[k + 1] > values[k])) return false;
  }
  return true;
}

TEST(SpaceTimeBlend, AlwaysGoesOnInTime) {
  // The second hurries where the first takes its time, as far as the slope limit lets it.
  generate::WalkContent hastening, slackening;
  hastening.duration = slackening.duration = 4.0;
  hastening.speed = generate::Schedule({{1.0, 0.7}, {3.0, 1.7}});
  slackening.speed = generate::Schedule({{1.0, 1.7}, {3.0, 0.7}});
  const Motion a = generate::generate_walk(hastening, heavy(), 30.0).motion;
  const Motion b = generate::generate_walk(slackening, brisk(), 30.0).motion;
  for (const double limit : {1.6, 2.0, 5.0}) {
    SpaceTimeBlendOptions options;
    options.slope_limit = limit;
    const SpaceTimeBlend blend(a, b, options);
    for (double alpha = -2.0; alpha <= 3.0; alpha += 0.125) {
      const Blend made = blend.at(alpha);
      EXPECT_TRUE(rises(made.first_frames)) << limit << " " << alpha;
      EXPECT_TRUE(rises(made.second_frames)) << limit << " " << alpha;
      EXPECT_DOUBLE_EQ(made.first_frames.tail<1>()[0], a.num_frames() - 1.0);
      EXPECT_DOUBLE_EQ(made.second_frames.tail<1>()[0], b.num_frames() - 1.0);
    }
  }
}

TEST(SpaceTimeBlend, ChangesSmoothlyWithAlpha) {
  // Past where time stops being linear too: a thousandth of alpha never moves the middle by more than a tenth of a
  // frame.
  const SpaceTimeBlend blend(walk(brisk()), walk(heavy()));
  Blend before = blend.at(-2.0);
  for (double alpha = -1.995; alpha <= 3.0; alpha += 0.005) {
    Blend here = blend.at(alpha);
    const auto middle = [](const Blend& b) {
      const Eigen::Index last = b.first_frames.size() - 1;
      return 0.5 * (b.first_frames[last / 2] + b.first_frames[last - last / 2]);
    };
    EXPECT_NEAR(middle(here), middle(before), 0.5) << alpha;
    EXPECT_LE(std::abs(here.motion.num_frames() - before.motion.num_frames()), 1) << alpha;
    before = std::move(here);
  }
}

TEST(SpaceTimeBlend, CarriesAndBlendsFootplants) {
  generate::WalkContent content;
  content.duration = 3.0;
  const auto a = generate::generate_walk(content, brisk(), 30.0), b = generate::generate_walk(content, heavy(), 30.0);
  const SpaceTimeBlend blend(a.motion, b.motion);
  const auto at_first = blend.at(0.0).plants, at_half = blend.at(0.5).plants, at_second = blend.at(1.0).plants;
  const auto detected = postprocess::detect_footplants(a.motion, motion::find_legs(a.motion).value());
  EXPECT_EQ(at_first, detected);
  ASSERT_EQ(at_half.size(), at_first.size());
  ASSERT_EQ(at_second.size(), at_first.size());
  constexpr double kFrames = 1.5;  // frames are whole
  for (std::size_t i = 0; i < at_half.size(); ++i) {
    EXPECT_EQ(at_half[i].foot, at_first[i].foot);
    EXPECT_NEAR(at_half[i].begin, 0.5 * (at_first[i].begin + at_second[i].begin), kFrames);
    EXPECT_NEAR(at_half[i].end, 0.5 * (at_first[i].end + at_second[i].end), kFrames);
  }
}

TEST(SpaceTimeBlend, IsAboutAsSmoothAsItsFragments) {
  const Motion a = walk(brisk()), b = walk(heavy());
  const SpaceTimeBlend blend(a, b);
  const double most = std::max(metrics::smoothness(a).jerk, metrics::smoothness(b).jerk);
  constexpr double kShare = 1.2;  // of the rougher fragment's mean jerk; measured: at most 1.0
  for (const double alpha : {0.25, 0.5, 0.75})
    EXPECT_LE(metrics::smoothness(blend.at(alpha).motion).jerk, kShare * most);
}

TEST(SpaceTimeBlend, OfABodyWithoutLegsHasNoPlants) {
  const auto skeleton = std::make_shared<const Skeleton>(std::vector<Joint>{{"base", -1, {0.0, 0.0, 0.0}},
                                                                            {"arm", 0, {0.0, 0.3, 0.0}},
                                                                            {"hand", 1, {0.0, 0.3, 0.0}},
                                                                            {"tail", 0, {0.0, 0.0, -0.3}}});
  const auto swing = [&](double size, int frames) {
    std::vector<Pose> poses(static_cast<std::size_t>(frames), rest_pose(*skeleton));
    for (int t = 0; t < frames; ++t) {
      const double angle = size * std::sin(std::numbers::pi * t / (frames - 1));
      poses[static_cast<std::size_t>(t)].rotations[1] = math::exp_map({angle, 0.0, 0.0});
    }
    return Motion(skeleton, 30.0, std::move(poses));
  };
  const SpaceTimeBlend blend(swing(0.4, 30), swing(0.8, 40));
  EXPECT_FALSE(blend.legs().has_value());
  EXPECT_TRUE(blend.at(0.5).plants.empty());
  expect_same(blend.at(1.0).motion, swing(0.8, 40), kExactAngle, kExactPlace);
}

TEST(SpaceTimeBlend, PutsTheSecondOnTheFirstsBody) {
  generate::WalkStyle tall = heavy();
  tall.body_height = 2.1;
  const Motion small = walk(brisk()), other = walk(tall);
  const Motion made = SpaceTimeBlend(small, other).at(1.0).motion;
  EXPECT_EQ(made.shared_skeleton(), small.shared_skeleton());
  const auto lowest = [](const Motion& motion) {
    double low = 1e9;
    for (const auto& frame : motion::joint_positions_world(motion)) {
      for (const auto& place : frame) low = std::min(low, place.y());
    }
    return low;
  };
  constexpr double kGround = 0.01;  // feet of another size roll a little differently [m]
  EXPECT_NEAR(lowest(made), lowest(other) / 2.1 * 1.75, kGround);
}

TEST(SpaceTimeBlend, BlendsBonesThatMove) {
  const Motion plain = walk(brisk());
  const auto stretched = [&](double by) {
    std::vector<Pose> poses = plain.frames();
    for (std::size_t t = 0; t < poses.size(); ++t) {
      poses[t].translations[4].y() += by * std::sin(0.2 * static_cast<double>(t));
    }
    return Motion(plain.shared_skeleton(), plain.frame_rate(), std::move(poses));
  };
  const SpaceTimeBlend blend(stretched(0.01), stretched(0.03));
  expect_same(blend.at(1.0).motion, stretched(0.03), kExactAngle, kExactPlace);
  expect_same(blend.at(0.5).motion, stretched(0.02), kExactAngle, kExactPlace);
}

TEST(SpaceTimeBlend, SaysWhatCannotBeBlended) {
  const Motion a = walk(brisk());
  const auto message = [](auto make) -> std::string {
    try {
      make();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(message([&] { SpaceTimeBlend(a, a.slice(0, a.num_frames() / 3)); }), HasSubstr("at most 2"));
  EXPECT_THAT(message([&] { SpaceTimeBlend(a, a.slice(0, 3)); }), HasSubstr("at least 4 frames"));
  EXPECT_THAT(message([&] { SpaceTimeBlend(a, Motion(a.shared_skeleton(), 60.0, a.frames())); }),
              HasSubstr("frames/s"));
  std::vector<Pose> turned = a.frames();
  for (std::size_t t = 10; t < 20; ++t) {
    turned[t].rotations[8] = turned[t].rotations[8] * math::exp_map({0.0, 2.3, 0.0});
  }
  const std::string apart = message([&] { SpaceTimeBlend(a, Motion(a.shared_skeleton(), a.frame_rate(), turned)); });
  EXPECT_THAT(apart, HasSubstr(a.skeleton().joint(8).name + ", 1"));
  const SpaceTimeBlend blend(a, a);
  for (const double alpha : {-2.01, 3.01, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(blend.at(alpha)), InvalidArgument) << alpha;
  }
  SpaceTimeBlendOptions options;
  for (const double limit : {1.0, std::nan(""), 17.0}) {
    options.slope_limit = limit;
    EXPECT_THROW(SpaceTimeBlend(a, a, options), InvalidArgument) << limit;
  }
}

TEST(SpaceTimeBlend, HoldsForRealGesturesAndWalks) {
  STRUT_REQUIRE_REAL_DATA();
  const auto clip = [](const std::string& name) {
    return read_bvh(test::real_data() + "/bandai-namco/dataset-2_" + name + ".bvh").motion;
  };
  for (const auto& [one, other] : {std::pair{"raise-up-right-hand_normal_001", "raise-up-right-hand_active_001"},
                                   std::pair{"walk_normal_002", "walk_active_002"}}) {
    const Motion a = clip(one), b = clip(other);
    const SpaceTimeBlend blend(a, b);
    expect_same(blend.at(0.0).motion, a, kExactAngle, kExactPlace);
    const Motion at_second = blend.at(1.0).motion;
    expect_same(at_second, started_as(b, at_second), kExactAngle, kExactPlace);
    const double most = std::max(metrics::smoothness(a).worst_jerk, metrics::smoothness(b).worst_jerk);
    EXPECT_LE(metrics::smoothness(blend.at(0.5).motion).worst_jerk, most);
  }
}

}  // namespace
}  // namespace strut::effort
