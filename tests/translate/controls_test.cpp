// SPDX-License-Identifier: MIT
// What a person feels of the controls: more is always more, a part is that part alone, and nothing jumps when one is
// moved while the stream runs. With a limp learnt from generated walks.
#include "learn/example_walks.h"
#include "support/small_model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/kinematics.h>
#include <strut/translate/controls.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

using Models = std::vector<std::shared_ptr<const StyleModel>>;
using Change = std::function<void(TranslatorControls&, double)>;

// Of the whole change, in one frame at 30 frames/s: the steepest step of two filters of 0.08 s in a row has 0.153.
constexpr double kLargestShare = 0.16;
constexpr int kArrival = 15;          // frames: half a second
constexpr double kNotArrived = 0.02;  // of the whole change; 0.014 is left by then
constexpr double kRounded = 1e-7;     // [rad, m/s]: an angle between rounded quaternions comes out as large as that

Motion new_walk() {
  return generate::generate_walk(test::content(1.25, 0.1, 4.0), {.seed = 77}, test::kExampleRate).motion;
}

const std::shared_ptr<const StyleModel>& limp() {
  static const auto model = test::learn_from(test::varied_clips()).model;
  return model;
}

/// Frames out, the controls changed to `later` at frame `from`.
Motion run(const Models& models, const Motion& clip, const TranslatorControls& controls, int from = 0,
           const TranslatorControls* later = nullptr) {
  Translator translator(models, {.controls = controls, .generalization = {.enabled = false}});
  std::vector<Pose> frames = clip.frames();
  for (int t = 0; t < clip.num_frames(); ++t) {
    if (later != nullptr && t == from) translator.set_controls(*later);
    Pose& pose = frames[static_cast<std::size_t>(t)];
    translator.push(pose, pose);
  }
  return {clip.shared_skeleton(), clip.frame_rate(), std::move(frames)};
}

double angle(const Motion& a, const Motion& b, int t, std::size_t joint) {
  return a.frame(t).rotations[joint].angularDistance(b.frame(t).rotations[joint]);
}

/// Mean over frames and the joints that `counts` [rad].
double distance(const Motion& a, const Motion& b, const std::vector<bool>& counts) {
  double sum = 0.0;
  for (int t = 0; t < a.num_frames(); ++t) {
    for (std::size_t joint = 1; joint < counts.size(); ++joint) sum += counts[joint] ? angle(a, b, t, joint) : 0.0;
  }
  return sum / (a.num_frames() * static_cast<double>(std::count(counts.begin(), counts.end(), true)));
}

std::vector<bool> all_joints(const Motion& clip) {
  return std::vector<bool>(static_cast<std::size_t>(clip.skeleton().num_joints()), true);
}

std::vector<bool> joints_of(const Motion& clip, std::size_t part) {
  std::vector<bool> counts;
  for (const motion::BodyPart of_joint : motion::body_parts(clip)) {
    counts.push_back(static_cast<std::size_t>(of_joint) == part);
  }
  return counts;
}

struct Control {
  std::string name;
  TranslatorControls others;  ///< with which its effect stands alone
  Change set;
  std::vector<bool> joints;  ///< it acts on
};

std::vector<Control> controls_of(const Motion& clip) {
  std::vector<Control> controls = {
      {"strength", {}, [](auto& c, double x) { c.strength = x; }, all_joints(clip)},
      {"pose", {.movement = 0.0}, [](auto& c, double x) { c.pose = x; }, all_joints(clip)},
      {"movement", {.pose = 0.0}, [](auto& c, double x) { c.movement = x; }, all_joints(clip)}};
  for (std::size_t part = 0; part < motion::kNumBodyParts; ++part) {
    controls.push_back({motion::kBodyPartNames.at(part),
                        {},
                        [part](auto& c, double x) { c.parts.at(part) = x; },
                        joints_of(clip, part)});
  }
  return controls;
}

TEST(TranslatorControls, MoreIsAlwaysFartherFromTheInput) {
  const Motion clip = new_walk();
  for (const Control& control : controls_of(clip)) {
    double before = -1.0;
    for (double x = 0.0; x <= kMostStrength; x += 0.25) {
      TranslatorControls controls = control.others;
      control.set(controls, x);
      const double now = distance(run({limp()}, clip, controls), clip, control.joints);
      EXPECT_GT(now, before) << control.name << " at " << x;
      before = x == 0.0 ? std::max(now, kRounded) : now;
      if (x == 0.0) {
        EXPECT_LT(now, kRounded) << control.name;
      }
    }
  }
}

TEST(TranslatorControls, PartsMoveTheirJointsAlone) {
  const Motion clip = new_walk();
  const Motion whole = run({limp()}, clip, {});
  for (std::size_t part = 0; part < motion::kNumBodyParts; ++part) {
    TranslatorControls controls;
    controls.parts.at(part) = 0.0;
    const Motion without = run({limp()}, clip, controls);
    const std::vector<bool> its_own = joints_of(clip, part);
    for (int t = 0; t < clip.num_frames(); ++t) {
      for (std::size_t joint = 1; joint < its_own.size(); ++joint) {
        EXPECT_LT(angle(without, its_own[joint] ? clip : whole, t, joint), kRounded)
            << motion::kBodyPartNames.at(part) << " joint " << joint;
      }
    }
  }
}

TEST(TranslatorControls, WeightsLeadFromOneModelsOutputToTheOthers) {
  const Motion clip = new_walk();
  const Models models{limp(), std::make_shared<const StyleModel>(test::exaggerating_parts(clip, 0.3, 1.4))};
  const Motion first = run({models[0]}, clip, {}), second = run({models[1]}, clip, {});
  const std::vector<bool> all = all_joints(clip);
  double from_first = -1.0, from_second = 1e9;
  for (double weight = 0.0; weight <= 1.0; weight += 0.125) {
    const Motion blend = run(models, clip, {.weights = {1.0 - weight, weight}});
    EXPECT_GT(distance(blend, first, all), from_first) << weight;
    EXPECT_LT(distance(blend, second, all), from_second) << weight;
    from_first = distance(blend, first, all);
    from_second = distance(blend, second, all);
    if (weight == 0.0) {
      EXPECT_LT(from_first, kRounded);
    }
  }
  EXPECT_LT(from_second, kRounded);
}

/// From frame to frame: a joint's turning [rad], and the change of the root's speed [m/s].
double turn(const Motion& clip, int t, std::size_t joint) {
  return clip.frame(t).rotations[joint].angularDistance(clip.frame(t - 1).rotations[joint]);
}

double speed(const Motion& clip, int t) {
  const auto pelvis = static_cast<std::size_t>(clip.skeleton().pelvis());
  const auto place = [&](int frame) {
    return motion::forward_kinematics(clip.skeleton(), clip.frame(frame)).positions[pelvis];
  };
  Eigen::Vector3d step = place(t) - place(t - 1);
  step.y() = 0.0;
  return step.norm() * clip.frame_rate();
}

double largest(const Motion& clip, int begin, const std::function<double(int)>& of_frame) {
  double result = 0.0;
  for (int t = begin; t < clip.num_frames(); ++t) result = std::max(result, of_frame(t));
  return result;
}

/// `moved` goes over from `before` to `after` at frame `from`: without a jump, and is there half a second later.
void expect_to_glide(const Motion& before, const Motion& after, const Motion& moved, int from,
                     const std::string& what) {
  for (std::size_t joint = 1; joint < moved.frame(0).rotations.size(); ++joint) {
    const double whole = largest(moved, 0, [&](int t) { return angle(before, after, t, joint); });
    const auto fastest = [&](const Motion& clip) {
      return largest(clip, 1, [&](int t) { return turn(clip, t, joint); });
    };
    EXPECT_LT(fastest(moved), std::max(fastest(before), fastest(after)) + kLargestShare * whole + kRounded)
        << what << " joint " << joint;
    EXPECT_LT(largest(moved, from + kArrival, [&](int t) { return angle(moved, after, t, joint); }),
              kNotArrived * whole + kRounded)
        << what << " joint " << joint;
    for (int t = 0; t < from; ++t) EXPECT_LT(angle(moved, before, t, joint), kRounded);
  }
  const double whole = largest(moved, 1, [&](int t) { return std::abs(speed(before, t) - speed(after, t)); });
  const auto steepest = [](const Motion& clip) {
    return largest(clip, 2, [&](int t) { return std::abs(speed(clip, t) - speed(clip, t - 1)); });
  };
  EXPECT_LT(steepest(moved), std::max(steepest(before), steepest(after)) + kLargestShare * whole + kRounded) << what;
  EXPECT_LT(largest(moved, from + kArrival, [&](int t) { return std::abs(speed(moved, t) - speed(after, t)); }),
            kNotArrived * whole + kRounded)
      << what;
}

TEST(TranslatorControls, GlideWhenTheyAreMovedInAStream) {
  const Motion clip = new_walk();
  constexpr int kMoment = 40;
  for (const Control& control : controls_of(clip)) {
    for (const auto& [from, to] : {std::pair(0.0, 1.5), std::pair(1.5, 0.0)}) {
      TranslatorControls before = control.others, after = control.others;
      control.set(before, from);
      control.set(after, to);
      expect_to_glide(run({limp()}, clip, before), run({limp()}, clip, after),
                      run({limp()}, clip, before, kMoment, &after), kMoment, control.name);
    }
  }
  const Models models{limp(), std::make_shared<const StyleModel>(test::exaggerating_parts(clip, 0.3, 1.4))};
  const TranslatorControls first{.weights = {1.0, 0.0}}, second{.weights = {0.0, 1.0}};
  expect_to_glide(run(models, clip, first), run(models, clip, second), run(models, clip, first, kMoment, &second),
                  kMoment, "weights");
}

TEST(TranslatorControls, AJumpWouldBeSeen) {
  const Motion clip = new_walk();
  const Motion before = run({limp()}, clip, {.strength = 0.0}), after = run({limp()}, clip, {.strength = 1.5});
  std::vector<Pose> frames = before.frames();
  std::copy(after.frames().begin() + 40, after.frames().end(), frames.begin() + 40);
  const Motion jumps(clip.shared_skeleton(), clip.frame_rate(), frames);
  std::size_t seen = 0;
  for (std::size_t joint = 1; joint < frames[0].rotations.size(); ++joint) {
    const double whole = largest(clip, 0, [&](int t) { return angle(before, after, t, joint); });
    const double usual = std::max(largest(before, 1, [&](int t) { return turn(before, t, joint); }),
                                  largest(after, 1, [&](int t) { return turn(after, t, joint); }));
    seen += turn(jumps, 40, joint) > usual + kLargestShare * whole ? 1 : 0;
  }
  EXPECT_GT(seen, 0U);
}

TEST(TranslatorControls, AreRefusedOutOfRange) {
  EXPECT_NO_THROW(check_controls({}, 1));
  for (const double wrong : {-0.1, 1.6, std::nan("")}) {
    EXPECT_THROW(check_controls({.strength = wrong}, 1), InvalidArgument);
    EXPECT_THROW(check_controls({.pose = wrong}, 1), InvalidArgument);
    EXPECT_THROW(check_controls({.movement = wrong}, 1), InvalidArgument);
    EXPECT_THROW(check_controls({.parts = {1, 1, wrong, 1, 1, 1}}, 1), InvalidArgument);
  }
  EXPECT_THROW(check_controls({.weights = {1.0}}, 2), InvalidArgument);
  EXPECT_THROW(check_controls({.weights = {0.0, 0.0}}, 2), InvalidArgument);
  EXPECT_THROW(check_controls({.weights = {1.0, -1.0}}, 2), InvalidArgument);
  EXPECT_NO_THROW(check_controls({.weights = {0.0, 3.0}}, 2));
}

}  // namespace
}  // namespace strut
