// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/math/rotation.h>
#include <strut/motion/gait_cycles.h>
#include <strut/motion/kinematics.h>

namespace strut::motion {
namespace {

// From the fastest sprinter's cycle to the slowest shuffle [s].
constexpr double kShortestCycle = 0.25;
constexpr double kLongestCycle = 2.5;
// A cycle longer than the motion's median by this factor holds a halt.
constexpr double kHalt = 1.7;

/// Where the pelvis is on the ground and how far the body has turned since the first frame, frame by frame.
struct Course {
  std::vector<Eigen::Vector2d> place;  // x, z [m]
  std::vector<double> facing;          // unwrapped [rad]
};

Course course_of(const Motion& motion, const Legs& legs) {
  Course course;
  WorldPose world;
  for (const Pose& pose : motion.frames()) {
    forward_kinematics(motion.skeleton(), pose, world);
    const Eigen::Vector3d& pelvis = world.positions[static_cast<std::size_t>(motion.skeleton().pelvis())];
    course.place.emplace_back(pelvis.x(), pelvis.z());
    const double facing = motion::facing(legs, world);
    const double previous = course.facing.empty() ? facing : course.facing.back();
    course.facing.push_back(previous + math::wrap_angle(facing - previous));
  }
  return course;
}

/// Length of the path between two points of it at the same phase of the gait: the chord, made an arc by the turning
/// between them. The path itself also sways from side to side.
double path_length(double chord, double turning) {
  const double half = std::min(0.5 * std::abs(turning), 1.5);
  return half < 1e-6 ? chord : chord * half / std::sin(half);
}

std::vector<int> onsets_of(const std::vector<Footplant>& footplants, int foot) {
  std::vector<int> onsets;
  for (const auto& plant : footplants) {
    if (plant.foot == foot && plant.begin > 0) onsets.push_back(plant.begin);
  }
  std::sort(onsets.begin(), onsets.end());
  return onsets;
}

std::string in_seconds(double seconds) {
  const auto hundredths = std::to_string(std::lround(100.0 * seconds) % 100);
  return std::to_string(std::lround(100.0 * seconds) / 100) + "." + (hundredths.size() < 2 ? "0" : "") + hundredths +
         " s";
}

/// Why no gait has this cycle; empty if one may.
std::string impossible(const GaitCycle& cycle, const std::vector<int>& other_onsets) {
  if (cycle.duration < kShortestCycle) return "it takes only " + in_seconds(cycle.duration);
  if (cycle.duration > kLongestCycle) return "it takes " + in_seconds(cycle.duration);
  const auto inside = std::count_if(other_onsets.begin(), other_onsets.end(),
                                    [&](int onset) { return onset > cycle.frames.begin && onset < cycle.frames.end; });
  if (inside == 0) return "the other foot does not come down in it";
  if (inside > 1) return "the other foot comes down " + std::to_string(inside) + " times in it";
  return {};
}

double median_duration(const std::vector<GaitCycle>& cycles) {
  std::vector<double> durations;
  for (const GaitCycle& cycle : cycles) durations.push_back(cycle.duration);
  const auto middle = durations.begin() + static_cast<std::ptrdiff_t>(durations.size() / 2);
  std::nth_element(durations.begin(), middle, durations.end());
  return *middle;
}

void report(Diagnostics* diagnostics, const GaitCycle& cycle, const std::string& why) {
  if (diagnostics == nullptr) return;
  diagnostics->note("gait cycles", std::string(cycle.foot == 0 ? "left" : "right") + " cycle at frames " +
                                       std::to_string(cycle.frames.begin) + " to " + std::to_string(cycle.frames.end) +
                                       " left out: " + why);
}

void drop_halts(std::vector<GaitCycle>& cycles, Diagnostics* diagnostics) {
  if (cycles.empty()) return;
  const double longest = kHalt * median_duration(cycles);
  const auto first = std::stable_partition(cycles.begin(), cycles.end(),
                                           [&](const GaitCycle& cycle) { return cycle.duration <= longest; });
  std::for_each(first, cycles.end(), [&](const GaitCycle& cycle) {
    report(diagnostics, cycle, "it takes " + in_seconds(cycle.duration) + ", far longer than the others: a halt");
  });
  cycles.erase(first, cycles.end());
}

}  // namespace

std::vector<GaitCycle> gait_cycles(const Motion& motion, const Legs& legs, const std::vector<Footplant>& footplants,
                                   Diagnostics* diagnostics) {
  const Course course = course_of(motion, legs);
  std::vector<GaitCycle> cycles;
  for (int foot = 0; foot < 2; ++foot) {
    const std::vector<int> onsets = onsets_of(footplants, foot);
    const std::vector<int> others = onsets_of(footplants, 1 - foot);
    for (std::size_t i = 0; i + 1 < onsets.size(); ++i) {
      const auto begin = static_cast<std::size_t>(onsets[i]);
      const auto end = static_cast<std::size_t>(onsets[i + 1]);
      GaitCycle cycle{{onsets[i], onsets[i + 1]}, foot, (onsets[i + 1] - onsets[i]) / motion.frame_rate(), 0.0, 0.0};
      cycle.turning = course.facing[end] - course.facing[begin];
      cycle.speed = path_length((course.place[end] - course.place[begin]).norm(), cycle.turning) / cycle.duration;
      const std::string why = impossible(cycle, others);
      if (why.empty()) {
        cycles.push_back(cycle);
      } else {
        report(diagnostics, cycle, why);
      }
    }
  }
  drop_halts(cycles, diagnostics);
  std::stable_sort(cycles.begin(), cycles.end(),
                   [](const GaitCycle& a, const GaitCycle& b) { return a.frames.begin < b.frames.begin; });
  return cycles;
}

}  // namespace strut::motion
