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
// Its slow speed, at which it slides where it should stand, is that of the slowest frames: any gait stands for longer.
constexpr double kSlowQuantile = 0.1;
// A foot that slides faster than this share of its peak does not stand.
constexpr double kFastestSlide = 0.3;
// The ground is where the lowest share of frames ends, so that a glitch does not set it.
constexpr double kGroundQuantile = 0.05;
// A foot that moves farther than this [leg lengths] in a gap was really off the ground.
constexpr double kGapTravel = 0.04;
// A toe that is still for only this long may just be turning round [s].
constexpr double kStillFor = 1.0 / 30.0;

/// A toe over time, and the thresholds that are its own.
struct Toe {
  std::vector<Eigen::Vector3d> position;  // [m]
  std::vector<double> speed;              // smooth [m/s]
  double frame_rate = 0.0;                // [frames/s]
  double ground = 0.0;                    // its height when the foot stands [m]
  double leg_length = 0.0;                // [m]
  double landing_speed = 0.0, leaving_speed = 0.0;
  double landing_height = 0.0, leaving_height = 0.0;
  int half_window = 1;  // of the smooth speed [frames]

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
  toe.frame_rate = motion.frame_rate();
  toe.half_window = std::max(1, static_cast<int>(std::lround(kHalfWindow * motion.frame_rate())));
  toe.speed = speeds_of(toe.position, toe.half_window, motion.frame_rate());
  toe.ground = quantile(std::move(heights), kGroundQuantile);
  const double peak = quantile(toe.speed, kPeakQuantile);
  const double slow = std::min(quantile(toe.speed, kSlowQuantile), kFastestSlide * peak);
  const double least = options.least_speed * toe.leg_length;
  toe.landing_speed = std::max(least, slow + options.landing_speed * (peak - slow));
  toe.leaving_speed = std::max(least, slow + options.leaving_speed * (peak - slow));
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

/// Long enough for a footplant, or cut by the clip's ends.
bool lasts(const Toe& toe, const Footplant& plant, const FootplantDetectorOptions& options) {
  const bool is_cut = plant.begin == 0 || plant.end == static_cast<int>(toe.position.size());
  return plant.end > plant.begin && (is_cut || plant.end - plant.begin >= options.shortest_plant * toe.frame_rate);
}

/// How far the toe's velocity is, from each frame of `plant` to the next, from what it is in the middle of the plant:
/// a foot that slides evenly is as still as it gets [m/s].
struct Stillness {
  std::vector<double> motion;  // per frame of the plant but the last
  double ordinary = 0.0;       // their median

  Stillness(const Toe& toe, const Footplant& plant) {
    if (plant.end - plant.begin < 2) return;
    std::vector<Eigen::Vector3d> velocity;
    for (auto t = static_cast<std::size_t>(plant.begin); t + 1 < static_cast<std::size_t>(plant.end); ++t) {
      velocity.push_back((toe.position[t + 1] - toe.position[t]) * toe.frame_rate);
    }
    Eigen::Vector3d slide;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> component;
      for (const Eigen::Vector3d& v : velocity) component.push_back(v[axis]);
      slide[axis] = quantile(std::move(component), 0.5);
    }
    for (const Eigen::Vector3d& v : velocity) motion.push_back((v - slide).norm());
    ordinary = quantile(motion, 0.5);
  }
};

/// The first of the frames from which `motion` stays within `limit` for `count` frames; all of them if there is none.
int first_still(const std::vector<double>& motion, double limit, int count) {
  int still = 0;
  for (std::size_t t = 0; t < motion.size(); ++t) {
    still = motion[t] <= limit ? still + 1 : 0;
    if (still == count) return static_cast<int>(t) + 1 - count;
  }
  return static_cast<int>(motion.size());
}

/// The plant from the frame at which the toe has come to rest to the one at which it leaves; empty if it never rests.
/// A landing is sharp, but a toe leaves slowly as the foot rolls over it, and can be held meanwhile.
/// `ordinary`: what the toe moves at while it stands, however still this plant is [m/s].
Footplant cut_to_held(const Toe& toe, Footplant plant, Stillness still, double ordinary,
                      const FootplantDetectorOptions& options) {
  const int count = std::min(static_cast<int>(still.motion.size()),
                             std::max(1, static_cast<int>(std::lround(kStillFor * toe.frame_rate))));
  const double limit = options.held_spread * ordinary;
  const int late = first_still(still.motion, std::max(limit, options.held_speed * toe.leg_length), count);
  std::reverse(still.motion.begin(), still.motion.end());
  const int early = first_still(still.motion, std::max(limit, options.released_speed * toe.leg_length), count);
  plant.begin += late;
  plant.end = std::max(plant.begin, plant.end - early);
  if (late == static_cast<int>(still.motion.size())) plant.end = plant.begin;
  return plant;
}

/// Every plant cut down to where the toe is held. Of one that the clip's ends cut off only the landing may be there:
/// what counts as still in it is known from the whole ones.
std::vector<Footplant> cut_to_held(const Toe& toe, const std::vector<Footplant>& plants,
                                   const FootplantDetectorOptions& options) {
  const auto num_frames = static_cast<int>(toe.position.size());
  const auto is_whole = [&](const Footplant& plant) { return plant.begin > 0 && plant.end < num_frames; };
  std::vector<Stillness> still;
  double loosest = 0.0;
  for (const Footplant& plant : plants) {
    still.emplace_back(toe, plant);
    if (is_whole(plant)) loosest = std::max(loosest, still.back().ordinary);
  }
  const bool is_known = std::any_of(plants.begin(), plants.end(), is_whole);
  std::vector<Footplant> cut;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    double ordinary = still[i].ordinary;
    if (is_known && !is_whole(plants[i])) ordinary = std::min(ordinary, loosest);
    if (plants[i].end - plants[i].begin < 2) continue;
    const Footplant held = cut_to_held(toe, plants[i], still[i], ordinary, options);
    const bool is_seen = is_whole(plants[i]) ? held.end > held.begin : lasts(toe, held, options);
    if (is_seen) cut.push_back(held);
  }
  return cut;
}

/// Smooth speeds see the swing half a window too early: there is room for the plant to be longer than they say.
std::vector<Footplant> widened(const Toe& toe, const std::vector<Footplant>& plants) {
  const auto num_frames = static_cast<int>(toe.position.size());
  std::vector<Footplant> wider = plants;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const int before = i == 0 ? plants[i].begin : (plants[i].begin - plants[i - 1].end) / 2;
    const int after =
        i + 1 == plants.size() ? num_frames - plants[i].end : (plants[i + 1].begin - plants[i].end - 1) / 2;
    wider[i].begin -= std::min(before, toe.half_window);
    wider[i].end += std::min(after, toe.half_window);
  }
  return wider;
}

std::vector<Footplant> plants_of(const Toe& toe, int foot, const FootplantDetectorOptions& options) {
  std::vector<Footplant> plants = close_gaps(toe, raw_footplants(toe, foot), options.longest_gap * toe.frame_rate);
  std::erase_if(plants, [&](const Footplant& plant) { return !lasts(toe, plant, options); });
  return cut_to_held(toe, widened(toe, plants), options);
}

/// A foot that is in the air all the time has no ground of its own.
void share_ground(Toe& one, Toe& other) {
  if (one.ground > other.ground + one.leaving_height) one.ground = other.ground;
  if (other.ground > one.ground + other.leaving_height) other.ground = one.ground;
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
  ordered("held_speed", options.held_speed, options.released_speed);
  ordered("held_spread", 0.0, options.held_spread);
  ordered("longest_gap", 0.0, options.longest_gap);
  ordered("shortest_plant", 0.0, options.shortest_plant);
}

}  // namespace

std::vector<Footplant> detect_footplants(const Motion& motion, const motion::Legs& legs,
                                         const FootplantDetectorOptions& options) {
  check(options);
  if (motion.num_frames() == 0) return {};
  Toe left = measure(motion, legs.left, options);
  Toe right = measure(motion, legs.right, options);
  share_ground(left, right);
  std::vector<Footplant> found = plants_of(left, 0, options);
  const std::vector<Footplant> rights = plants_of(right, 1, options);
  found.insert(found.end(), rights.begin(), rights.end());
  return found;
}

}  // namespace strut::postprocess
