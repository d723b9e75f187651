// SPDX-License-Identifier: MIT
// From clips to the stretches of them that can be paired, with what they are matched by.
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/learn/clip_pair.h>
#include <strut/math/rotation.h>
#include <strut/motion/gait_cycles.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>

namespace strut::learn {
namespace {

// A body moves while its fastest joint is faster than this share of the clip's fast moments.
constexpr double kMovingShare = 0.15;
constexpr double kFastQuantile = 0.95;
// Kept before the first movement and after the last [s].
constexpr double kMargin = 0.1;
// Below this nothing moves but noise [m/s].
constexpr double kStill = 0.02;
// Slower than this a clip is one pose, held [m/s].
constexpr double kNoMovement = 0.001;
// A clip that steps travels if its strides are longer than this share of the leg.
constexpr double kLeastStride = 0.25;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// The fastest joint's speed in the world at every frame, over a tenth of a second [m/s].
std::vector<double> fastest_speeds(const Motion& motion) {
  const auto positions = motion::joint_positions_world(motion);
  const int last = motion.num_frames() - 1;
  const int half = std::max(1, static_cast<int>(std::lround(0.05 * motion.frame_rate())));
  std::vector<double> speeds;
  for (int t = 0; t <= last; ++t) {
    const int before = std::max(0, t - half);
    const int after = std::min(last, t + half);
    double fastest = 0.0;
    for (std::size_t j = 0; j < positions[at(t)].size(); ++j) {
      fastest = std::max(fastest, (positions[at(after)][j] - positions[at(before)][j]).norm());
    }
    speeds.push_back(fastest * motion.frame_rate() / std::max(1, after - before));
  }
  return speeds;
}

/// Joint positions about the pelvis, turned so that the body faces +Z: 3 x joints per frame, and the path it takes.
struct Body {
  std::vector<Eigen::Matrix3Xd> joints;
  std::vector<Eigen::Vector3d> pelvis;
  std::vector<double> heading;  // unwrapped [rad]
};

Body body_over(const Motion& motion, const Eigen::Quaterniond& upright, const FrameRange& frames) {
  Body body;
  const auto pelvis = at(motion.skeleton().pelvis());
  motion::WorldPose world;
  for (int t = frames.begin; t < frames.end; ++t) {
    motion::forward_kinematics(motion.skeleton(), motion.frame(t), world);
    const double heading = math::heading(world.rotations[pelvis] * upright.conjugate());
    const double previous = body.heading.empty() ? heading : body.heading.back();
    const Eigen::Matrix3d turn = math::rotation_about_y(-heading).toRotationMatrix();
    Eigen::Matrix3Xd joints(3, motion.skeleton().num_joints() - motion.skeleton().pelvis());
    for (Eigen::Index j = 0; j < joints.cols(); ++j) {
      joints.col(j) = turn * (world.positions[pelvis + static_cast<std::size_t>(j)] - world.positions[pelvis]);
    }
    body.joints.push_back(joints);
    body.pelvis.push_back(world.positions[pelvis]);
    body.heading.push_back(previous + math::wrap_angle(heading - previous));
  }
  return body;
}

double movement_of(const Body& body) {
  Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, body.joints.front().cols());
  for (const auto& joints : body.joints) mean += joints / static_cast<double>(body.joints.size());
  double sum = 0.0;
  for (const auto& joints : body.joints) sum += (joints - mean).squaredNorm();
  return std::sqrt(sum / static_cast<double>(mean.cols() * static_cast<Eigen::Index>(body.joints.size())));
}

double path_length(const Body& body) {
  double length = 0.0;
  for (std::size_t t = 1; t < body.pelvis.size(); ++t) {
    const Eigen::Vector3d step = body.pelvis[t] - body.pelvis[t - 1];
    length += std::hypot(step.x(), step.z());
  }
  return length;
}

Stretch whole_clip(const Motion& motion, int clip) {
  Stretch stretch{clip, moving_part(motion), PairKind::kWhole, 0, {}};
  const Body body = body_over(motion, motion::upright_reference(motion), stretch.frames);
  stretch.features.duration = stretch.frames.num_frames() / motion.frame_rate();
  stretch.features.speed = path_length(body) / stretch.features.duration;
  stretch.features.turning = body.heading.back() - body.heading.front();
  stretch.features.movement = movement_of(body);
  return stretch;
}

bool travels(const Motion& motion, const motion::Legs& legs, const std::vector<motion::GaitCycle>& cycles) {
  if (cycles.empty()) return false;
  const Pose& pose = motion.frame(0);
  const double leg = pose.translations[at(legs.left.knee)].norm() + pose.translations[at(legs.left.ankle)].norm();
  double stride = 0.0;
  for (const motion::GaitCycle& cycle : cycles) {
    stride += cycle.speed * cycle.duration / static_cast<double>(cycles.size());
  }
  return stride > kLeastStride * leg;
}

std::vector<Stretch> cycles_of(const Motion& motion, int clip, const PairingOptions& options,
                               Diagnostics* diagnostics) {
  const auto legs = motion::find_legs(motion);
  if (!legs) return {};
  Diagnostics found;
  const auto footplants = postprocess::detect_footplants(motion, *legs, options.footplants);
  const auto cycles = motion::gait_cycles(motion, *legs, footplants, &found);
  if (!travels(motion, *legs, cycles)) return {};
  if (diagnostics != nullptr) {
    for (const Diagnostic& entry : found.entries()) diagnostics->note("clip " + std::to_string(clip), entry.message);
  }
  const Eigen::Quaterniond upright = motion::upright_reference(motion);
  std::vector<Stretch> stretches;
  for (const motion::GaitCycle& cycle : cycles) {
    const double movement = movement_of(body_over(motion, upright, cycle.frames));
    stretches.push_back(
        {clip, cycle.frames, PairKind::kGaitCycle, cycle.foot, {cycle.duration, cycle.speed, cycle.turning, movement}});
  }
  return stretches;
}

/// Empty for a clip that can be used.
std::string reason_to_leave_out(const Motion& motion) {
  const int frames = motion.num_frames();
  if (frames < 2 || frames < kShortestStretch * motion.frame_rate()) {
    return "it has " + std::to_string(frames) + (frames == 1 ? " frame" : " frames") + ", shorter than 0.2 s";
  }
  const std::vector<double> speeds = fastest_speeds(motion);
  const bool moves = std::any_of(speeds.begin(), speeds.end(), [](double speed) { return speed > kNoMovement; });
  return moves ? "" : "nothing moves in it";
}

}  // namespace

FrameRange moving_part(const Motion& motion) {
  const FrameRange all{0, motion.num_frames()};
  if (motion.num_frames() < 2) return all;
  const std::vector<double> speeds = fastest_speeds(motion);
  std::vector<double> sorted = speeds;
  std::sort(sorted.begin(), sorted.end());
  const double fast = sorted[static_cast<std::size_t>(kFastQuantile * static_cast<double>(sorted.size() - 1))];
  if (fast < kStill) return all;
  const auto moves = [&](double speed) { return speed > kMovingShare * fast; };
  const auto first = std::find_if(speeds.begin(), speeds.end(), moves) - speeds.begin();
  const auto last = speeds.rend() - std::find_if(speeds.rbegin(), speeds.rend(), moves);
  const int margin = static_cast<int>(std::lround(kMargin * motion.frame_rate()));
  return {std::max(0, static_cast<int>(first) - margin), std::min(all.end, static_cast<int>(last) + margin)};
}

std::vector<Stretch> stretches_of(const std::vector<Motion>& clips, const PairingOptions& options,
                                  Diagnostics* diagnostics) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const int clip = static_cast<int>(i);
    if (const std::string reason = reason_to_leave_out(clips[i]); !reason.empty()) {
      if (diagnostics != nullptr) diagnostics->warn("clip " + std::to_string(i), "left out: " + reason);
      continue;
    }
    std::vector<Stretch> found;
    if (!options.whole) found = cycles_of(clips[i], clip, options, diagnostics);
    if (found.empty()) found.push_back(whole_clip(clips[i], clip));
    stretches.insert(stretches.end(), found.begin(), found.end());
  }
  return stretches;
}

}  // namespace strut::learn
