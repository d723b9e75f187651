// SPDX-License-Identifier: MIT
#include "clip_variations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/metrics/body_track.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>

namespace strut::quality {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using motion::FrameRange;
using motion::WorldPose;

constexpr double kRamp = 0.4;  // a variation comes and goes within this [s]

std::size_t at(int joint) {
  return static_cast<std::size_t>(joint);
}

FrameRange all_frames(const Motion& clip) {
  return {0, clip.num_frames()};
}

motion::Legs legs_of(const Motion& clip) {
  const auto legs = motion::find_legs(clip);
  if (!legs) throw InvalidArgument("clip", "a body with two legs", "none");
  return *legs;
}

/// The clip with every pose changed.
Motion changed(const Motion& clip, const std::function<void(Pose&, int)>& change) {
  std::vector<Pose> frames = clip.frames();
  for (int t = 0; t < clip.num_frames(); ++t) change(frames[at(t)], t);
  return {clip.shared_skeleton(), clip.frame_rate(), std::move(frames)};
}

/// 0 before `begin` and after `end`, 1 well between, smooth ramps inside [s].
double presence(double time, double begin, double end) {
  const double rise = std::clamp(std::min(time - begin, end - time) / kRamp, 0.0, 1.0);
  return rise * rise * (3.0 - 2.0 * rise);
}

/// The middle third, and the ramps before and after it.
VariedClip changed_in_the_middle(const Motion& clip, const std::function<void(Pose&, double, int)>& change) {
  const int third = clip.num_frames() / 3;
  const FrameRange full{third, clip.num_frames() - third};
  const double begin = full.begin / clip.frame_rate() - kRamp, end = (full.end - 1) / clip.frame_rate() + kRamp;
  return {changed(clip, [&](Pose& pose, int t) { change(pose, presence(t / clip.frame_rate(), begin, end), t); }),
          full};
}

Quaterniond parent_rotation(const Skeleton& skeleton, const WorldPose& world, int joint) {
  const int parent = skeleton.joint(joint).parent;
  return parent < 0 ? Quaterniond::Identity() : world.rotations[at(parent)];
}

/// Turns `joint` of `pose` by `rotation`, given in the world.
void turn(const Skeleton& skeleton, const WorldPose& world, Pose& pose, int joint, const Quaterniond& rotation) {
  const Quaterniond parent = parent_rotation(skeleton, world, joint);
  pose.rotations[at(joint)] = (parent.conjugate() * rotation * world.rotations[at(joint)]).normalized();
}

/// The angle opposite to side c of a triangle.
double opposite_angle(double a, double b, double c) {
  return std::acos(std::clamp((a * a + b * b - c * c) / (2.0 * a * b), -1.0, 1.0));
}

/// The axis about which the shin turns to open the knee; `to_right`: of a leg that is straight.
Vector3d knee_axis(const Vector3d& thigh, const Vector3d& shin, const Vector3d& to_right) {
  constexpr double kStraight = 1e-3;  // sine of the angle below which the leg's own plane is noise
  const Vector3d axis = (-thigh).cross(shin);
  return axis.norm() > kStraight * thigh.norm() * shin.norm() ? axis.normalized() : to_right;
}

/// Bends a leg so that its ankle is where, and turned as, it is in `wanted`.
void reach(const Skeleton& skeleton, const motion::Leg& leg, const WorldPose& wanted, const Vector3d& to_right,
           Pose& pose) {
  WorldPose world = motion::forward_kinematics(skeleton, pose);
  const Vector3d hip = world.positions[at(leg.hip)];
  const Vector3d thigh = world.positions[at(leg.knee)] - hip;
  const Vector3d shin = world.positions[at(leg.ankle)] - world.positions[at(leg.knee)];
  const Vector3d target = wanted.positions[at(leg.ankle)] - hip;
  const double now = opposite_angle(thigh.norm(), shin.norm(), (thigh + shin).norm());
  const double then = opposite_angle(thigh.norm(), shin.norm(), target.norm());
  turn(skeleton, world, pose, leg.knee, math::exp_map((then - now) * knee_axis(thigh, shin, to_right)));
  motion::forward_kinematics(skeleton, pose, world);
  const Vector3d reached = world.positions[at(leg.ankle)] - hip;
  turn(skeleton, world, pose, leg.hip, Quaterniond::FromTwoVectors(reached, target));
  motion::forward_kinematics(skeleton, pose, world);
  const Quaterniond foot = wanted.rotations[at(leg.ankle)] * world.rotations[at(leg.ankle)].conjugate();
  turn(skeleton, world, pose, leg.ankle, foot);
}

/// The deviations of a joint's rotation from their mean, as rotation vectors. (frames x 3)
struct Deviations {
  Quaterniond mean;
  FrameMatrix vectors;
};

Deviations deviations(const Motion& clip, int joint) {
  std::vector<Quaterniond> rotations;
  for (const Pose& pose : clip.frames()) rotations.push_back(pose.rotations[at(joint)]);
  Deviations result{math::mean_rotation(rotations), FrameMatrix(clip.num_frames(), 3)};
  for (int t = 0; t < clip.num_frames(); ++t) {
    result.vectors.row(t) = math::log_map(result.mean.conjugate() * rotations[at(t)]).transpose();
  }
  return result;
}

/// The pelvis's rotation in the world, every other joint's in its parent's frame. Frame by frame from `from` to `to`.
FrameMatrix rotation_differences(const Motion& from, const Motion& to, int joint) {
  const auto rotation = [&](const Motion& clip, int t) {
    if (joint != clip.skeleton().pelvis()) return clip.frame(t).rotations[at(joint)];
    return motion::forward_kinematics(clip.skeleton(), clip.frame(t)).rotations[at(joint)];
  };
  FrameMatrix differences(from.num_frames(), 3);
  for (int t = 0; t < from.num_frames(); ++t) {
    differences.row(t) = math::log_map(rotation(to, t) * rotation(from, t).conjugate()).transpose();
  }
  return differences;
}

double correlation(FrameMatrix a, FrameMatrix b) {
  a.rowwise() -= a.colwise().mean().eval();
  b.rowwise() -= b.colwise().mean().eval();
  const double scale = a.norm() * b.norm();
  return scale > 0.0 ? a.cwiseProduct(b).sum() / scale : 0.0;
}

}  // namespace

VariedClip exaggerated(const Motion& clip, int joint, double factor) {
  const Deviations from_mean = deviations(clip, joint);
  return {changed(clip,
                  [&](Pose& pose, int t) {
                    pose.rotations[at(joint)] =
                        from_mean.mean * math::exp_map(factor * from_mean.vectors.row(t).transpose());
                  }),
          all_frames(clip)};
}

VariedClip bent(const Motion& clip, int joint, Direction direction, double amplitude, double frequency) {
  const FrameMatrix vectors = deviations(clip, joint).vectors;
  const FrameMatrix centred = vectors.rowwise() - vectors.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred.transpose() * centred);  // ascending
  const Vector3d axis = axes.eigenvectors().col(direction == Direction::kMost ? 2 : 0);
  const double pulse = 2.0 * std::numbers::pi * frequency / clip.frame_rate();
  return {
      changed(clip, [&](Pose& pose,
                        int t) { pose.rotations[at(joint)] *= math::exp_map(amplitude * std::sin(pulse * t) * axis); }),
      all_frames(clip)};
}

VariedClip raised(const Motion& clip, int joint, double angle) {
  const motion::Legs legs = legs_of(clip);
  const Skeleton& skeleton = clip.skeleton();
  return changed_in_the_middle(clip, [&](Pose& pose, double presence, int /*frame*/) {
    const WorldPose world = motion::forward_kinematics(skeleton, pose);
    const Quaterniond facing = math::rotation_about_y(motion::facing(legs, world));
    const Vector3d from_pelvis = world.positions[at(joint)] - world.positions[at(skeleton.pelvis())];
    const double side = from_pelvis.dot(facing * Vector3d::UnitX()) > 0.0 ? 1.0 : -1.0;  // +X is the body's left
    turn(skeleton, world, pose, joint, math::exp_map(presence * side * angle * (facing * Vector3d::UnitZ())));
  });
}

VariedClip ducked(const Motion& clip, double share) {
  const motion::Legs legs = legs_of(clip);
  const Skeleton& skeleton = clip.skeleton();
  const double leg_length =
      skeleton.joint(legs.left.knee).offset.norm() + skeleton.joint(legs.left.ankle).offset.norm();
  return changed_in_the_middle(clip, [&](Pose& pose, double presence, int /*frame*/) {
    const WorldPose before = motion::forward_kinematics(skeleton, pose);
    const Vector3d down(0.0, -presence * share * leg_length, 0.0);
    pose.translations[at(skeleton.pelvis())] += parent_rotation(skeleton, before, skeleton.pelvis()).conjugate() * down;
    const Vector3d to_right = math::rotation_about_y(motion::facing(legs, before)) * -Vector3d::UnitX();
    for (const motion::Leg* leg : {&legs.left, &legs.right}) reach(skeleton, *leg, before, to_right, pose);
  });
}

VariedClip replaced(const Motion& clip, const Motion& other) {
  if (other.num_frames() != clip.num_frames() || other.skeleton().num_joints() != clip.skeleton().num_joints()) {
    throw InvalidArgument("other", "a clip of as many frames and joints", "another");
  }
  return changed_in_the_middle(clip, [&](Pose& pose, double presence, int frame) {
    const Pose& there = other.frame(frame);
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      pose.rotations[j] = pose.rotations[j].slerp(presence, there.rotations[j]).normalized();
      pose.translations[j] += presence * (there.translations[j] - pose.translations[j]);
    }
  });
}

VariedClip halted(const Motion& clip, double seconds) {
  const double last = (clip.num_frames() - 1) / clip.frame_rate();
  const double begin = 0.5 * last, end = begin + seconds + 2.0 * kRamp;
  std::vector<Pose> frames;
  double source = 0.0;  // [s]
  for (double time = 0.0; source <= last; time += clip.frame_time()) {
    frames.push_back(motion::sample(clip, source));
    source += (1.0 - presence(time, begin, end)) * clip.frame_time();
  }
  return {Motion(clip.shared_skeleton(), clip.frame_rate(), std::move(frames)),
          {static_cast<int>(std::ceil((begin + kRamp) * clip.frame_rate())),
           static_cast<int>(std::floor((end - kRamp) * clip.frame_rate()))}};
}

VariedClip stretched(const Motion& clip, double factor) {
  Motion longer =
      motion::resample(Motion(clip.shared_skeleton(), clip.frame_rate() / factor, clip.frames()), clip.frame_rate());
  const FrameRange frames = all_frames(longer);
  return {std::move(longer), frames};
}

VariedClip resized(const Motion& clip, double factor) {
  std::vector<Joint> joints = clip.skeleton().joints();
  for (Joint& joint : joints) {
    joint.offset *= factor;
    joint.end_site *= factor;
  }
  std::vector<Pose> frames = clip.frames();
  for (Pose& pose : frames) {
    for (Vector3d& translation : pose.translations) translation *= factor;
  }
  return {Motion(std::make_shared<const Skeleton>(std::move(joints)), clip.frame_rate(), std::move(frames)),
          all_frames(clip)};
}

Response response(const Motion& input, const Motion& varied_input, const Motion& output, const Motion& varied_output,
                  int joint) {
  for (const Motion* clip : {&varied_input, &output, &varied_output}) {
    if (clip->num_frames() != input.num_frames()) {
      throw InvalidArgument("clips", std::to_string(input.num_frames()) + " frames each",
                            std::to_string(clip->num_frames()));
    }
  }
  double energy = 0.0;
  for (int j = input.skeleton().pelvis(); j < input.skeleton().num_joints(); ++j) {
    energy += rotation_differences(output, varied_output, j).squaredNorm();
  }
  const FrameMatrix added = rotation_differences(input, varied_input, joint);
  const FrameMatrix answer = rotation_differences(output, varied_output, joint);
  return {energy > 0.0 ? answer.squaredNorm() / energy : 0.0, correlation(added, answer),
          added.norm() > 0.0 ? answer.norm() / added.norm() : 0.0};
}

double frame_distance(const Motion& first, const Motion& second, const motion::FrameRange& frames) {
  if (frames.begin < 0 || frames.num_frames() < 1 || frames.end > std::min(first.num_frames(), second.num_frames())) {
    throw InvalidArgument("frames", "a range inside both clips",
                          std::to_string(frames.begin) + " to " + std::to_string(frames.end));
  }
  const metrics::BodyTrack a = metrics::body_track(first, first.frame_rate());
  const metrics::BodyTrack b = metrics::body_track(second, second.frame_rate());
  double sum = 0.0;
  for (int t = frames.begin; t < frames.end; ++t) {
    for (int j = 0; j < a.num_joints(); ++j) {
      sum += (a.positions_heading.block<1, 3>(t, 3 * j) - b.positions_heading.block<1, 3>(t, 3 * j)).norm();
    }
  }
  return sum / (frames.num_frames() * a.num_joints());
}

}  // namespace strut::quality
