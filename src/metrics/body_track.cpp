// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/math/rotation.h>
#include <strut/metrics/body_track.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>

namespace strut::metrics {
namespace {

/// The pelvis and everything below it: parents precede children, so one pass finds them all.
std::vector<int> body_joints(const Skeleton& skeleton) {
  std::vector<int> joints{skeleton.pelvis()};
  for (int j = skeleton.pelvis() + 1; j < skeleton.num_joints(); ++j) {
    if (std::binary_search(joints.begin(), joints.end(), skeleton.joint(j).parent)) joints.push_back(j);
  }
  return joints;
}

void set_row(BodyTrack& track, int row, const motion::WorldPose& world, const motion::Legs& legs) {
  const auto at = [&world](int joint) -> const Eigen::Vector3d& {
    return world.positions[static_cast<std::size_t>(joint)];
  };
  const Eigen::Vector3d hips = 0.5 * (at(legs.left.hip) + at(legs.right.hip));
  const double heading = motion::facing(legs, world);
  const double before = row > 0 ? track.heading[row - 1] : heading;
  track.heading[row] = before + math::wrap_angle(heading - before);
  track.hips_world.row(row) = hips.transpose();
  for (const int side : {0, 1}) {
    const auto foot = static_cast<std::size_t>(side);
    track.ankles_world[foot].row(row) = at(track.ankles[foot]).transpose();
    track.toes_world[foot].row(row) = motion::toe_position(legs.foot(side), world).transpose();
  }
  const Eigen::Matrix3d turn = math::rotation_about_y(-heading).toRotationMatrix();
  const Eigen::Vector3d ground(hips.x(), 0.0, hips.z());
  for (std::size_t j = 0; j < track.joints.size(); ++j) {
    track.positions_heading.block<1, 3>(row, 3 * static_cast<Eigen::Index>(j)) =
        (turn * (at(track.joints[j]) - ground)).transpose();
  }
}

int last_joint(const motion::Leg& leg) {
  return leg.toe >= 0 ? leg.toe : leg.ankle;
}

void resize(BodyTrack& track, Eigen::Index frames) {
  track.positions_heading.resize(frames, 3 * track.num_joints());
  track.hips_world.resize(frames, 3);
  track.heading.resize(frames);
  for (FrameMatrix* path :
       {&track.ankles_world[0], &track.ankles_world[1], &track.toes_world[0], &track.toes_world[1]}) {
    path->resize(frames, 3);
  }
}

}  // namespace

Place BodyTrack::place(int joint, double row) const {
  const double time = row / rate;
  return {joint, static_cast<int>(std::floor(time * source_rate + 0.5)), time};
}

double measuring_rate(double frame_rate) {
  return frame_rate / std::max(1.0, std::round(frame_rate / kComparisonRate));
}

BodyTrack body_track(const Motion& motion, double rate) {
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  const auto legs = motion::find_legs(motion);
  if (!legs) throw InvalidArgument("motion", "a body with two legs", "none found in its skeleton");
  const Motion at_rate = motion::resample(motion, rate);
  BodyTrack track;
  track.skeleton = motion.shared_skeleton();
  track.rate = rate;
  track.source_rate = motion.frame_rate();
  track.joints = body_joints(motion.skeleton());
  track.ankles = {legs->left.ankle, legs->right.ankle};
  track.toes = {last_joint(legs->left), last_joint(legs->right)};
  resize(track, at_rate.num_frames());
  motion::WorldPose world;
  for (int row = 0; row < at_rate.num_frames(); ++row) {
    motion::forward_kinematics(at_rate.skeleton(), at_rate.frame(row), world);
    set_row(track, row, world, *legs);
  }
  return track;
}

}  // namespace strut::metrics
