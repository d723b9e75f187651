// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include <strut/core/error.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::postprocess {
namespace {

using motion::Footplant;

// Velocities are differences over twice this time [s]: one frame either way at 30 frames/s, the same at any other rate.
constexpr double kHalfWindow = 1.0 / 30.0;
// The swinging foot's speed is this share of the fastest frames' away from the top, so that a glitch does not set it.
constexpr double kPeakQuantile = 0.95;
// The ground is where the lowest share of frames ends, for the same reason.
constexpr double kGroundQuantile = 0.05;
// A foot that moves farther than this [leg lengths] in a gap was really off the ground.
constexpr double kGapTravel = 0.04;

/// One end of a foot over time.
struct Track {
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<double> speed;              // [m/s]
  double ground = 0.0;                    // its height when the foot stands [m]
};

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

Track track(std::vector<Eigen::Vector3d> position, double frame_rate) {
  Track result{std::move(position), {}, 0.0};
  const auto& x = result.position;
  const auto last = static_cast<int>(x.size()) - 1;
  const int half = std::max(1, static_cast<int>(std::lround(kHalfWindow * frame_rate)));
  std::vector<double> heights;
  for (int t = 0; t <= last; ++t) {
    const int before = std::max(0, t - half);
    const int after = std::min(last, t + half);
    const double time = std::max(1, after - before) / frame_rate;
    result.speed.push_back((x[static_cast<std::size_t>(after)] - x[static_cast<std::size_t>(before)]).norm() / time);
    heights.push_back(x[static_cast<std::size_t>(t)].y());
  }
  result.ground = quantile(std::move(heights), kGroundQuantile);
  return result;
}

/// Both ends of one foot, and the thresholds that are its own.
struct Foot {
  std::array<Track, 2> ends;  // ankle, toe
  double leg_length = 0.0;    // [m]
  double landing_speed = 0.0, leaving_speed = 0.0;
  double landing_height = 0.0, leaving_height = 0.0;

  [[nodiscard]] std::size_t num_frames() const { return ends[0].speed.size(); }

  [[nodiscard]] bool stands(std::size_t t, double speed, double height) const {
    return std::any_of(ends.begin(), ends.end(), [&](const Track& end) {
      return end.speed[t] <= speed && end.position[t].y() - end.ground <= height;
    });
  }
};

Foot measure(const Motion& motion, const motion::Leg& leg, const FootplantDetectorOptions& options) {
  std::vector<Eigen::Vector3d> ankle, toe;
  Foot foot;
  motion::WorldPose world;
  for (const Pose& pose : motion.frames()) {
    motion::forward_kinematics(motion.skeleton(), pose, world);
    ankle.push_back(world.positions[static_cast<std::size_t>(leg.ankle)]);
    toe.push_back(motion::toe_position(leg, world));
    foot.leg_length += (pose.translations[static_cast<std::size_t>(leg.knee)].norm() +
                        pose.translations[static_cast<std::size_t>(leg.ankle)].norm()) /
                       motion.num_frames();
  }
  foot.ends = {track(std::move(ankle), motion.frame_rate()), track(std::move(toe), motion.frame_rate())};
  std::vector<double> slower;
  for (std::size_t t = 0; t < foot.num_frames(); ++t) {
    slower.push_back(std::min(foot.ends[0].speed[t], foot.ends[1].speed[t]));
  }
  const double peak = quantile(std::move(slower), kPeakQuantile);
  const double least = options.least_speed * foot.leg_length;
  foot.landing_speed = std::max(least, options.landing_speed * peak);
  foot.leaving_speed = std::max(least, options.leaving_speed * peak);
  foot.landing_height = options.height * foot.leg_length;
  foot.leaving_height = options.leaving_height * foot.leg_length;
  return foot;
}

std::vector<Footplant> raw_footplants(const Foot& foot, int index) {
  std::vector<Footplant> plants;
  bool planted = false;
  for (std::size_t t = 0; t < foot.num_frames(); ++t) {
    const bool before = planted;
    planted = planted ? foot.stands(t, foot.leaving_speed, foot.leaving_height)
                      : foot.stands(t, foot.landing_speed, foot.landing_height);
    const int frame = static_cast<int>(t);
    if (planted && !before) plants.push_back({index, frame, frame});
    if (planted) plants.back().end = frame + 1;
  }
  return plants;
}

/// Whether one end of the foot stays where it was across the gap between two plants.
bool stays(const Foot& foot, const Footplant& before, const Footplant& after) {
  const auto last = static_cast<std::size_t>(before.end - 1);
  const auto next = static_cast<std::size_t>(after.begin);
  return std::any_of(foot.ends.begin(), foot.ends.end(), [&](const Track& end) {
    return (end.position[next] - end.position[last]).norm() < kGapTravel * foot.leg_length;
  });
}

std::vector<Footplant> close_gaps(const Foot& foot, const std::vector<Footplant>& plants, double longest_frames) {
  std::vector<Footplant> closed;
  for (const Footplant& plant : plants) {
    const bool joins =
        !closed.empty() && plant.begin - closed.back().end < longest_frames && stays(foot, closed.back(), plant);
    if (joins) {
      closed.back().end = plant.end;
    } else {
      closed.push_back(plant);
    }
  }
  return closed;
}

void check(const FootplantDetectorOptions& options) {
  const auto ordered = [](const char* name, double low, double high) {
    if (low >= 0.0 && high >= low) return;
    throw InvalidArgument(name, "at least 0, and no more for landing than for leaving",
                          std::to_string(low) + " and " + std::to_string(high));
  };
  ordered("landing_speed", options.landing_speed, options.leaving_speed);
  ordered("height", options.height, options.leaving_height);
  ordered("least_speed", 0.0, options.least_speed);
  ordered("longest_gap", 0.0, options.longest_gap);
  ordered("shortest_plant", 0.0, options.shortest_plant);
}

}  // namespace

std::vector<Footplant> detect_footplants(const Motion& motion, const motion::Legs& legs,
                                         const FootplantDetectorOptions& options) {
  check(options);
  std::vector<Footplant> found;
  if (motion.num_frames() == 0) return found;
  for (int index = 0; index < 2; ++index) {
    const Foot foot = measure(motion, legs.foot(index), options);
    const auto plants = close_gaps(foot, raw_footplants(foot, index), options.longest_gap * motion.frame_rate());
    const double shortest = options.shortest_plant * motion.frame_rate();
    std::copy_if(plants.begin(), plants.end(), std::back_inserter(found), [&](const Footplant& plant) {
      const bool is_cut = plant.begin == 0 || plant.end == motion.num_frames();
      return is_cut || plant.end - plant.begin >= shortest;
    });
  }
  return found;
}

}  // namespace strut::postprocess
