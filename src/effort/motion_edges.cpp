// SPDX-License-Identifier: MIT
#include "effort/motion_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <strut/math/rotation.h>

namespace strut::effort {
namespace {

constexpr double kNear = 0.1;  // of an edge [s]; what velocities come apart by in it counts like a distance

/// Of every joint, in its own frame.
Eigen::Vector3d turn(const Pose& from, const Pose& to, std::size_t joint) {
  return math::log_map(from.rotations[joint].conjugate() * to.rotations[joint]);
}

/// Of every joint at inner frame `frame`.
template <typename Take>
void each_acceleration(const Motion& motion, int frame, const Take& take) {
  const Pose &before = motion.frame(frame - 1), &here = motion.frame(frame), &after = motion.frame(frame + 1);
  const double rate = motion.frame_rate();
  for (std::size_t j = 0; j < here.rotations.size(); ++j) {
    take((turn(here, after, j) - turn(before, here, j)).norm() * rate * rate);
  }
}

int near_frames(const Motion& motion) {
  return std::min(motion.num_frames(), 1 + static_cast<int>(std::lround(kNear * motion.frame_rate())));
}

}  // namespace

std::vector<MotionEdge> edges_within(const Motion& motion, int begin, int end, const PostureSpace& in) {
  const int from = std::max(0, std::min(begin, motion.num_frames() - 2));
  const int to = std::min(end + 1, motion.num_frames());
  const FrameMatrix rows = project(in.space, joint_features(motion.slice(from, to), in.upright));
  std::vector<MotionEdge> edges;
  for (int frame = begin; frame < end; ++frame) {
    MotionEdge edge{rows.row(frame - from).transpose(), Eigen::VectorXd::Zero(rows.cols())};
    const Eigen::Index step = std::min<Eigen::Index>(frame - from, rows.rows() - 2);
    if (step >= 0) edge.velocity = motion.frame_rate() * (rows.row(step + 1) - rows.row(step)).transpose();
    edges.push_back(std::move(edge));
  }
  return edges;
}

double largest_acceleration(const Motion& motion, int begin, int end) {
  double largest = 0.0;
  for (int frame = std::max(begin, 1); frame < std::min(end, motion.num_frames() - 1); ++frame) {
    each_acceleration(motion, frame, [&](double value) { largest = std::max(largest, value); });
  }
  return largest;
}

std::vector<double> joint_accelerations(const Motion& motion) {
  std::vector<double> all;
  for (int frame = 1; frame + 1 < motion.num_frames(); ++frame) {
    each_acceleration(motion, frame, [&](double value) { all.push_back(value); });
  }
  return all;
}

MotionEdge beginning(const Motion& motion, const PostureSpace& in) {
  MotionEdge edge = edges_within(motion, 0, 1, in).front();
  edge.acceleration = largest_acceleration(motion, 0, near_frames(motion));
  return edge;
}

MotionEdge ending(const Motion& motion, const PostureSpace& in) {
  const int frames = motion.num_frames();
  MotionEdge edge = edges_within(motion, frames - 1, frames, in).front();
  edge.acceleration = largest_acceleration(motion, frames - near_frames(motion), frames);
  return edge;
}

double misfit(const MotionEdge& last, const MotionEdge& next, double frame_time, double unit) {
  const double apart = (next.posture - last.posture - 0.5 * frame_time * (last.velocity + next.velocity)).squaredNorm();
  return (apart + kNear * kNear * (next.velocity - last.velocity).squaredNorm()) / (unit * unit);
}

std::vector<std::size_t> cheapest_sequence(const std::vector<std::vector<SequenceCandidate>>& places,
                                           double join_weight, double frame_time, double unit) {
  std::vector<double> sums;                    // of the cheapest way to each candidate of a place
  std::vector<std::vector<std::size_t>> from;  // by which candidate of the place before
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<double> next(places[k].size(), std::numeric_limits<double>::infinity());
    from.emplace_back(places[k].size(), 0);
    for (std::size_t c = 0; c < places[k].size(); ++c) {
      if (k == 0) next[c] = 0.0;
      for (std::size_t b = 0; b < sums.size(); ++b) {
        const double sum = sums[b] + join_weight * misfit(places[k - 1][b].end, places[k][c].begin, frame_time, unit);
        if (sum >= next[c]) continue;
        next[c] = sum;
        from[k][c] = b;
      }
      next[c] += places[k][c].price;
    }
    sums = std::move(next);
  }
  std::vector<std::size_t> chosen(places.size(), 0);
  if (places.empty()) return chosen;
  chosen.back() = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  for (std::size_t k = places.size() - 1; k > 0; --k) chosen[k - 1] = from[k][chosen[k]];
  return chosen;
}

}  // namespace strut::effort
