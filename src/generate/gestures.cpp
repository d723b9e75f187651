// SPDX-License-Identifier: MIT
// Gestures sampled at frames: the content time is integrated along its pace, a posture becomes a pose, and what is
// known is kept beside it.
#include "body_pose.h"
#include "gesture_path.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include <strut/core/error.h>
#include <strut/generate/gestures.h>
#include <strut/generate/walker.h>
#include <strut/math/rotation.h>

namespace strut::generate {
namespace {

using detail::about_x;
using detail::about_y;
using detail::about_z;
using detail::GesturePath;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kUnitHeight = 1.75;                 // of the body that postures are told for [m]
constexpr double kExtension = 0.985;                 // of the leg's length at most
constexpr double kSoftness = 0.008;                  // over which the pelvis gives way before a leg is straight [m]
constexpr double kAhead = 0.03;                      // of the pelvis before the ankles of one who stands [m]
constexpr double kToeOut = 0.15;                     // [rad]
constexpr double kLift = 0.22;                       // of a foot that steps, per length of its way
constexpr double kGrid = 1.0 / 480.0;                // longest step of the integration of content time [s]
constexpr int kNumPerformers = 5, kNumSettings = 6;  // of the standard set

void check_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidArgument(name, "a number from " + std::to_string(low) + " to " + std::to_string(high),
                        std::to_string(value));
}

void check(const GestureContent& content, const GestureStyle& style, const Performer& who, double frame_rate) {
  if (content.keys.empty()) throw InvalidArgument("content.keys", "at least one key", "none");
  for (const GestureKey& key : content.keys) {
    check_range("content.keys.duration", key.duration, 0.05, 60.0);
    check_range("content.keys.accent", key.accent, 0.0, 1.0);
    for (const double part : key.posture) check_range("content.keys.posture", part, -3.2, 3.2);
  }
  check_range("style.suddenness", style.suddenness, -1.0, 1.0);
  check_range("style.boundness", style.boundness, -1.0, 1.0);
  check_range("style.strength", style.strength, -1.0, 1.0);
  check_range("style.extent", style.extent, 0.4, 1.6);
  check_range("style.curvature", style.curvature, -1.0, 1.0);
  check_range("style.variation", style.variation, 0.0, 3.0);
  check_range("who.height", who.height, 1.2, 2.1);
  check_range("who.tempo", who.tempo, 0.5, 2.0);
  check_range("who.expression", who.expression, 0.0, 1.5);
  check_range("who.extent", who.extent, 0.6, 1.4);
  check_range("who.crouch", who.crouch, 0.0, 0.1);
  check_range("who.hunch", who.hunch, -0.3, 0.6);
  check_range("who.arm_spread", who.arm_spread, -0.3, 0.6);
  check_range("who.elbow_bend", who.elbow_bend, -0.3, 0.8);
  check_range("who.stance", who.stance, 0.1, 0.4);
  check_range("who.tremor", who.tremor, 0.0, 0.05);
  check_range("who.habit", who.habit, 0.0, 0.3);
  check_range("frame_rate", frame_rate, 1.0, 10000.0);
}

/// Postures as poses of one body.
class GesturePoser {
 public:
  GesturePoser(const GesturePath& path, const Performer& who)
      : path_(path), skeleton_(walker_skeleton(who.height)), scale_(who.height / kUnitHeight), stance_(who.stance) {}

  [[nodiscard]] Pose pose(double s, double t) const {
    const Posture posture = path_.at(s, t);
    Pose pose = rest_pose(*skeleton_);
    const detail::FootState feet[] = {foot(0, posture, s), foot(1, posture, s)};
    const Quaterniond pelvis =
        about_y(posture[kPelvisTurn]) * about_x(posture[kPelvisLean]) * about_z(-0.3 * posture[kSpineSide]);
    Vector3d position = scale_ * Vector3d(posture[kPelvisSide], 0.0, kAhead + posture[kPelvisForward]);
    position.y() = height(position, pelvis, feet, scale_ * posture[kPelvisDrop]);
    pose.translations[detail::kHips] = position;
    pose.rotations[detail::kHips] = pelvis;
    pose_trunk(posture, pose);
    for (int side = 0; side < 2; ++side) {
      const auto arm = static_cast<std::size_t>(side == 0 ? kLeftFlexion : kRightFlexion);
      detail::place_arm(side, {posture[arm], posture[arm + 1], posture[arm + 2], posture[arm + 3], posture[arm + 4]},
                        pose);
      const Vector3d ahead = about_y(0.5 * (posture[kPelvisTurn] + feet[side].yaw)) * Vector3d::UnitZ();
      detail::place_leg(*skeleton_, side, position, pelvis, ahead, feet[side], pose);
    }
    return pose;
  }

  [[nodiscard]] const std::shared_ptr<const Skeleton>& skeleton() const { return skeleton_; }

 private:
  [[nodiscard]] detail::FootState foot(int side, const Posture& posture, double s) const {
    const double sign = side == 0 ? 1.0 : -1.0;
    detail::FootState foot;
    foot.yaw = sign * kToeOut;
    foot.ankle = Vector3d(0.5 * sign * stance_ * scale_, detail::ankle_height(*skeleton_), 0.0);
    if (side == 0) return foot;
    const auto [stroke, u] = path_.place(s);
    const double w = 4.0 * u * (1.0 - u), lift = w * w * w * path_.foot_way(stroke);
    foot.ankle += scale_ * Vector3d(0.0, kLift * lift, posture[kRightFootForward]);
    foot.pitch = -0.5 * lift;
    return foot;
  }

  /// Where the drop puts the pelvis, but never, softly, so high that a leg would be straight.
  [[nodiscard]] double height(const Vector3d& position, const Quaterniond& pelvis, const detail::FootState (&feet)[2],
                              double drop) const {
    const double leg = kExtension * -(offset(detail::kShank).y() + offset(detail::kFoot).y());
    const double standing = detail::ankle_height(*skeleton_) + leg - offset(detail::kThigh).y();
    double excess = 0.0;
    const double wanted = standing - drop;
    for (int side = 0; side < 2; ++side) {
      const Vector3d hip = pelvis * offset(detail::kThigh + side * detail::kSideOfLeg);
      const Vector3d& ankle = feet[side].ankle;
      const double across = std::hypot(position.x() + hip.x() - ankle.x(), position.z() + hip.z() - ankle.z());
      const double reachable = ankle.y() + std::sqrt(std::max(0.0, leg * leg - across * across)) - hip.y();
      excess += std::exp((wanted - reachable) / kSoftness);
    }
    return wanted - kSoftness * std::log1p(excess);
  }

  static void pose_trunk(const Posture& posture, Pose& pose) {
    const Quaterniond half =
        about_y(0.5 * posture[kSpineTurn]) * about_x(0.5 * posture[kSpineBend]) * about_z(-0.5 * posture[kSpineSide]);
    pose.rotations[detail::kSpine] = half;
    pose.rotations[detail::kChest] = half;
    const double straighten = posture[kNod] - 0.6 * (posture[kPelvisLean] + posture[kSpineBend]);
    const double look = posture[kLook] - 0.8 * (posture[kSpineTurn] + posture[kPelvisTurn]);
    pose.rotations[detail::kNeck] = about_y(0.5 * look) * about_x(0.5 * straighten);
    pose.rotations[detail::kHead] = pose.rotations[detail::kNeck];
  }

  [[nodiscard]] const Vector3d& offset(int joint) const { return skeleton_->joint(joint).offset; }

  const GesturePath& path_;
  std::shared_ptr<const Skeleton> skeleton_;
  double scale_, stance_;
};

/// The content time `step` seconds on (Runge and Kutta's fourth order).
double advance(const GesturePath& path, double s, double step) {
  const int parts = static_cast<int>(std::ceil(step / kGrid));
  const double h = step / parts;
  for (int i = 0; i < parts; ++i) {
    const double a = path.pace(s), b = path.pace(s + 0.5 * h * a), c = path.pace(s + 0.5 * h * b);
    s += h / 6.0 * (a + 2.0 * b + 2.0 * c + path.pace(s + h * c));
  }
  return s;
}

/// The left foot stands throughout, the right one in strokes that do not move it.
std::vector<motion::Footplant> footplants(const GesturePath& path, const std::vector<double>& content_time) {
  std::vector<motion::Footplant> plants = {{kLeft, 0, static_cast<int>(content_time.size())}};
  bool stands = false;
  for (int i = 0; i < static_cast<int>(content_time.size()); ++i) {
    const detail::StrokePlace place = path.place(content_time[static_cast<std::size_t>(i)]);
    const bool now = path.foot_way(place.stroke) == 0.0;
    if (now && !stands) plants.push_back({kRight, i, i});
    if (now) plants.back().end = i + 1;
    stands = now;
  }
  return plants;
}

}  // namespace

double GestureContent::duration() const {
  double sum = 0.0;
  for (const GestureKey& key : keys) sum += key.duration;
  return sum;
}

Gesture generate_gesture(const GestureContent& content, const GestureStyle& style, const Performer& who,
                         double frame_rate) {
  check(content, style, who, frame_rate);
  const GesturePath path(content, style, who);
  const GesturePoser poser(path, who);
  std::vector<Pose> frames;
  std::vector<double> content_time, time;
  for (double s = 0.0; s <= path.duration(); s = advance(path, s, 1.0 / frame_rate)) {
    time.push_back(static_cast<double>(time.size()) / frame_rate);
    content_time.push_back(s);
    frames.push_back(poser.pose(s, time.back()));
  }
  auto plants = footplants(path, content_time);
  math::SmoothCurve timing(content_time, time);
  return {Motion(poser.skeleton(), frame_rate, std::move(frames)), std::move(content_time), std::move(plants),
          std::move(timing)};
}

Performer performer(int number, std::uint64_t seed) {
  std::mt19937_64 random(seed * 1000003ULL + static_cast<std::uint64_t>(number));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  Performer who;
  who.height = between(1.58, 1.90);
  who.tempo = std::exp(between(-0.12, 0.12));
  who.expression = between(0.75, 1.2);
  who.extent = between(0.88, 1.12);
  who.crouch = between(0.0, 0.03);
  who.hunch = between(-0.06, 0.18);
  who.arm_spread = between(-0.04, 0.14);
  who.elbow_bend = between(-0.05, 0.25);
  who.stance = between(0.17, 0.30);
  who.tremor = between(0.0, 0.004);
  who.habit = 0.10;
  who.seed = random();
  return who;
}

std::vector<double> true_correspondence(const Gesture& a, const Gesture& b) {
  const double difference = std::abs(a.content_time.back() - b.content_time.back());
  // Both end at the last frame within their content; the pace is far below 8.
  if (difference > 8.0 * std::max(a.motion.frame_time(), b.motion.frame_time())) {
    throw InvalidArgument("b", "a gesture of the same content as a", "contents that differ in duration");
  }
  std::vector<double> frames;
  for (const double s : a.content_time) {
    const double frame = b.timing.at(s) * b.motion.frame_rate();
    frames.push_back(std::clamp(frame, 0.0, b.motion.num_frames() - 1.0));
  }
  return frames;
}

std::vector<StandardGesture> standard_gestures(std::uint64_t seed, double frame_rate) {
  std::vector<StandardGesture> all;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int action = 0; action < kNumGestureActions; ++action) {
    for (int number = 0; number < kNumPerformers; ++number) {
      std::array<std::array<int, kNumSettings>, 3> order{};
      for (auto& row : order) {
        std::iota(row.begin(), row.end(), 0);
        std::shuffle(row.begin(), row.end(), random);
      }
      for (std::size_t k = 0; k < kNumSettings; ++k) {
        const auto setting = [&](std::size_t factor) {
          return -1.0 + 2.0 * (order[factor][k] + unit(random)) / kNumSettings;
        };
        GestureStyle style;
        style.boundness = setting(0);
        style.strength = setting(1);
        style.suddenness = setting(2);
        style.extent = 0.85 + 0.3 * unit(random);
        style.curvature = -0.5 + unit(random);
        style.seed = random();
        const auto what = static_cast<GestureAction>(action);
        all.push_back(
            {what, number, style, generate_gesture(gesture_content(what), style, performer(number, seed), frame_rate)});
      }
    }
  }
  return all;
}

}  // namespace strut::generate
