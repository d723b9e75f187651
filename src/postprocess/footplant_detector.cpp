// SPDX-License-Identifier: MIT
#include <algorithm>
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
/// A toe over time, and the thresholds that are its own.
struct Toe {
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<double> speed;              // [m/s]
  double ground = 0.0;                    // its height when the foot stands [m]
  double leg_length = 0.0;                // [m]
  double landing_speed = 0.0, leaving_speed = 0.0;
  double landing_height = 0.0, leaving_height = 0.0;

  [[nodiscard]] double height(std::size_t t) const { return position[t].y() - ground; }
  [[nodiscard]] bool has_landed(std::size_t t) const {
    return speed[t] <= landing_speed && height(t) <= landing_height;
  }
  [[nodiscard]] bool still_stands(std::size_t t) const {
    return speed[t] <= leaving_speed && height(t) <= leaving_height;
  }
};

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

/// Mean speeds from `half` frames before each frame to `half` frames after it [m/s].
std::vector<double> speeds_of(const std::vector<Eigen::Vector3d>& position, int half, double frame_rate) {
  const auto last = static_cast<int>(position.size()) - 1;
  std::vector<double> speeds;
  for (int t = 0; t <= last; ++t) {
    const int after = std::min(last, t + half);
    const int before = std::max(0, t - half);
    const double time = std::max(1, after - before) / frame_rate;
    speeds.push_back((position[static_cast<std::size_t>(after)] - position[static_cast<std::size_t>(before)]).norm() /
                     time);
  }
  return speeds;
}

Toe measure(const Motion& motion, const motion::Leg& leg, const FootplantDetectorOptions& options) {
  Toe toe;
  std::vector<double> heights;
  motion::WorldPose world;
  for (const Pose& pose : motion.frames()) {
    motion::forward_kinematics(motion.skeleton(), pose, world);
    toe.position.push_back(motion::toe_position(leg, world));
    heights.push_back(toe.position.back().y());
    toe.leg_length += (pose.translations[static_cast<std::size_t>(leg.knee)].norm() +
                       pose.translations[static_cast<std::size_t>(leg.ankle)].norm()) /
                      motion.num_frames();
  }
  const int half = std::max(1, static_cast<int>(std::lround(kHalfWindow * motion.frame_rate())));
  toe.speed = speeds_of(toe.position, half, motion.frame_rate());
  toe.ground = quantile(std::move(heights), kGroundQuantile);
  const double peak = quantile(toe.speed, kPeakQuantile);
  const double least = options.least_speed * toe.leg_length;
  toe.landing_speed = std::max(least, options.landing_speed * peak);
  toe.leaving_speed = std::max(least, options.leaving_speed * peak);
  toe.landing_height = options.height * toe.leg_length;
  toe.leaving_height = options.leaving_height * toe.leg_length;
  return toe;
}

std::vector<Footplant> raw_footplants(const Toe& toe, int index) {
  std::vector<Footplant> plants;
  bool planted = false;
  for (std::size_t t = 0; t < toe.speed.size(); ++t) {
    const bool before = planted;
    planted = planted ? toe.still_stands(t) : toe.has_landed(t);
    const int frame = static_cast<int>(t);
    if (planted && !before) plants.push_back({index, frame, frame});
    if (planted) plants.back().end = frame + 1;
  }
  return plants;
}

/// Whether the toe stays where it was across the gap between two plants.
bool stays(const Toe& toe, const Footplant& before, const Footplant& after) {
  const auto last = static_cast<std::size_t>(before.end - 1);
  const auto next = static_cast<std::size_t>(after.begin);
  return (toe.position[next] - toe.position[last]).norm() < kGapTravel * toe.leg_length;
}

std::vector<Footplant> close_gaps(const Toe& toe, const std::vector<Footplant>& plants, double longest_frames) {
  std::vector<Footplant> closed;
  for (const Footplant& plant : plants) {
    const bool joins =
        !closed.empty() && plant.begin - closed.back().end < longest_frames && stays(toe, closed.back(), plant);
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
    const Toe toe = measure(motion, legs.foot(index), options);
    const auto plants = close_gaps(toe, raw_footplants(toe, index), options.longest_gap * motion.frame_rate());
    const double shortest = options.shortest_plant * motion.frame_rate();
    std::copy_if(plants.begin(), plants.end(), std::back_inserter(found), [&](const Footplant& plant) {
      const bool is_cut = plant.begin == 0 || plant.end == motion.num_frames();
      return is_cut || plant.end - plant.begin >= shortest;
    });
  }
  return found;
}

}  // namespace strut::postprocess
