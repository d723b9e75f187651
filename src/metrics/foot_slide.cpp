// SPDX-License-Identifier: MIT
#include "metrics/ground_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/metrics/foot_slide.h>

namespace strut::metrics {
namespace {

constexpr double kStandingSeconds = 0.15;  // shorter than the stance of a sprint, longer than a frame at 24 frames/s
constexpr double kRowRounding = 1e-9;      // a plant's end falls on a row if it misses it by less than this

struct Stretch {
  double speed;
  Place place;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The slowest stretch of each whole second (of all there is, if that is less).
void add_slowest(const BodyTrack& track, std::size_t side, std::vector<Stretch>& slowest) {
  const Eigen::VectorXd speed = ground_speed(track.toes_world[side], track.rate);
  const Eigen::Index span = std::clamp<Eigen::Index>(std::lround(kStandingSeconds * track.rate),
                                                     std::min<Eigen::Index>(2, speed.size()), speed.size());
  const Eigen::VectorXd mean = moving_mean(speed, span);
  const Eigen::Index second = std::min<Eigen::Index>(std::max(1L, std::lround(track.rate)), mean.size());
  for (Eigen::Index begin = 0; begin + second <= mean.size(); begin += second) {
    Eigen::Index where = 0;
    const double least = mean.segment(begin, second).minCoeff(&where);
    const double middle = static_cast<double>(begin + where) + 0.5 * static_cast<double>(span - 1);
    slowest.push_back({least, track.place(track.toes[side], middle)});
  }
}

FootSlide with_worst(double speed, const std::vector<Stretch>& stretches) {
  if (stretches.empty()) return {};
  const Stretch& worst = *std::max_element(stretches.begin(), stretches.end(),
                                           [](const Stretch& a, const Stretch& b) { return a.speed < b.speed; });
  return {speed, worst.speed, worst.place};
}

void check(const motion::Footplant& plant, const BodyTrack& track) {
  if (plant.foot != 0 && plant.foot != 1) {
    throw InvalidArgument("plants", "foot 0 (left) or 1 (right)", std::to_string(plant.foot));
  }
  const double last = (track.num_frames() - 1) * track.source_rate / track.rate;
  if (plant.begin < 0 || plant.end < plant.begin || plant.end - 1 > last + track.source_rate / track.rate) {
    throw InvalidArgument("plants", "frames inside the clip",
                          std::to_string(plant.begin) + " to " + std::to_string(plant.end));
  }
}

/// The rows [begin, end) of the track that lie inside a plant.
std::pair<Eigen::Index, Eigen::Index> rows_of(const motion::Footplant& plant, const BodyTrack& track) {
  const double rows_per_frame = track.rate / track.source_rate;
  const double last = std::floor((plant.end - 1) * rows_per_frame + kRowRounding);
  return {static_cast<Eigen::Index>(std::ceil(plant.begin * rows_per_frame - kRowRounding)),
          std::min<Eigen::Index>(track.num_frames(), static_cast<Eigen::Index>(last) + 1)};
}

/// How far the foot's slower end moves over the ground from `row` to the next [m].
double slide_after(const BodyTrack& track, std::size_t side, Eigen::Index row) {
  return std::min(ground_distance(track.ankles_world[side], row, row + 1),
                  ground_distance(track.toes_world[side], row, row + 1));
}

/// The same in the rows [begin, end) together.
double slide_between(const BodyTrack& track, std::size_t side, Eigen::Index begin, Eigen::Index end) {
  double slid = 0.0;
  for (Eigen::Index row = begin; row + 1 < end; ++row) slid += slide_after(track, side, row);
  return slid;
}

std::size_t side_of(int foot) {
  if (foot != 0 && foot != 1) throw InvalidArgument("foot", "0 (left) or 1 (right)", std::to_string(foot));
  return static_cast<std::size_t>(foot);
}

}  // namespace

FootSlide foot_slide(const BodyTrack& track) {
  if (track.num_frames() < 2) throw InvalidArgument("track", "at least two frames", "fewer");
  std::vector<Stretch> slowest;
  for (const std::size_t side : {0, 1}) add_slowest(track, side, slowest);
  std::vector<double> speeds;
  speeds.reserve(slowest.size());
  for (const Stretch& stretch : slowest) speeds.push_back(stretch.speed);
  return with_worst(median(speeds), slowest);
}

FootSlide foot_slide(const BodyTrack& track, const std::vector<motion::Footplant>& plants) {
  std::vector<Stretch> slides;
  double length = 0.0;
  double duration = 0.0;
  for (const motion::Footplant& plant : plants) {
    check(plant, track);
    const auto side = static_cast<std::size_t>(plant.foot);
    const auto [begin, end] = rows_of(plant, track);
    if (end - begin < 2) continue;
    const double slid = slide_between(track, side, begin, end);
    const double seconds = static_cast<double>(end - begin - 1) / track.rate;
    slides.push_back({slid / seconds, track.place(track.toes[side], 0.5 * static_cast<double>(begin + end - 1))});
    length += slid;
    duration += seconds;
  }
  return with_worst(duration > 0.0 ? length / duration : 0.0, slides);
}

Curve foot_slide_curve(const BodyTrack& track, const std::vector<motion::Footplant>& plants, int foot) {
  const std::size_t side = side_of(foot);
  if (track.num_frames() < 2) throw InvalidArgument("track", "at least two frames", "fewer");
  Curve curve{track.rate, 0.5 / track.rate, Eigen::VectorXd(track.num_frames() - 1)};
  curve.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (const motion::Footplant& plant : plants) {
    check(plant, track);
    if (plant.foot != foot) continue;
    const auto [begin, end] = rows_of(plant, track);
    for (Eigen::Index row = begin; row + 1 < end; ++row) curve.values[row] = slide_after(track, side, row) * track.rate;
  }
  return curve;
}

Curve foot_height_curve(const BodyTrack& track, int foot) {
  const std::size_t side = side_of(foot);
  return {track.rate, 0.0, track.ankles_world[side].col(1).cwiseMin(track.toes_world[side].col(1))};
}

}  // namespace strut::metrics
