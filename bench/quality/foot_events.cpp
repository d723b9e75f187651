// SPDX-License-Identifier: MIT
#include "foot_events.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <strut/math/rotation.h>
#include <strut/math/sampling.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/relative_root.h>

namespace strut::study {
namespace {

constexpr int kFine = 20;                           // samples per frame
constexpr double kShortest = 0.25, kLongest = 2.5;  // of a gait cycle [s]
constexpr double kTurningScale = 0.35;              // [rad]
constexpr double kSpeedWeight = 0.5;
constexpr double kLeastSpeedDeviation = 0.03;  // [m/s]
constexpr double kFarthest = 2.0;              // scales between pieces that still belong together
constexpr double kGrid = 0.1;                  // of the least error [frames]

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

/// A toe's speed, over two frames at 30 frames/s, kFine times per frame.
struct ToeSpeed {
  std::vector<double> speed;  // [m/s]
  double landing = 0.0, leaving = 0.0;

  ToeSpeed(const Motion& motion, const motion::Leg& leg) {
    FrameMatrix toe(motion.num_frames(), 3);
    double length = 0.0;
    for (int t = 0; t < motion.num_frames(); ++t) {
      toe.row(t) =
          motion::toe_position(leg, motion::forward_kinematics(motion.skeleton(), motion.frame(t))).transpose();
    }
    const Pose& pose = motion.frame(0);
    for (const int joint : {leg.knee, leg.ankle}) length += pose.translations[static_cast<std::size_t>(joint)].norm();
    const int count = (motion.num_frames() - 1) * kFine + 1;
    const double half = motion.frame_rate() / 30.0, last = motion.num_frames() - 1;
    Eigen::VectorXd before(count), after(count);
    for (int i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / kFine;
      before[i] = std::max(0.0, t - half);
      after[i] = std::min(last, t + half);
    }
    const FrameMatrix way = math::sample_rows(toe, after) - math::sample_rows(toe, before);
    for (int i = 0; i < count; ++i) speed.push_back(way.row(i).norm() / (after[i] - before[i]) * motion.frame_rate());
    set_thresholds(length);
  }

  /// As the detector sets them.
  void set_thresholds(double leg_length) {
    const postprocess::FootplantDetectorOptions options;
    const double fast = quantile(speed, 0.95);
    const double slow = std::min(quantile(speed, 0.1), 0.3 * fast);
    landing = std::max(options.least_speed * leg_length, slow + options.landing_speed * (fast - slow));
    leaving = std::max(options.least_speed * leg_length, slow + options.leaving_speed * (fast - slow));
  }

  /// Outwards from the middle of a detected footplant.
  [[nodiscard]] Plant around(double middle) const {
    Plant plant;
    const int size = static_cast<int>(speed.size());
    int i = std::min(static_cast<int>(middle * kFine), size - 1), k = i;
    while (i > 0 && at(i) <= landing) --i;
    while (k + 1 < size && at(k) <= leaving) ++k;
    if (at(i) > landing) plant.landing = (i + share(i, landing)) / kFine;
    if (at(k) > leaving) plant.leaving = (k - 1 + share(k - 1, leaving)) / kFine;
    return plant;
  }

 private:
  [[nodiscard]] double at(int i) const { return speed[static_cast<std::size_t>(i)]; }
  /// Where between samples i and i + 1 the speed is `level`.
  [[nodiscard]] double share(int i, double level) const { return (level - at(i)) / (at(i + 1) - at(i)); }
};

Plant rounded(Plant plant) {
  if (plant.landing) plant.landing = std::ceil(*plant.landing);
  if (plant.leaving) plant.leaving = std::ceil(*plant.leaving);
  return plant;
}

/// The only landing of `plants` in (begin, end), or none.
const Plant* only_landing(const std::vector<Plant>& plants, double begin, double end) {
  const Plant* found = nullptr;
  for (const Plant& plant : plants) {
    if (!plant.landing || *plant.landing <= begin || *plant.landing >= end) continue;
    if (found != nullptr) return nullptr;
    found = &plant;
  }
  return found;
}

void measure(Piece& piece, const Motion& motion, const Eigen::Quaterniond& upright) {
  double way = 0.0;
  auto place = [&](int t) {
    return representation::placement(representation::pelvis_world(motion.skeleton(), motion.frame(t)), upright);
  };
  auto here = place(piece.begin);
  for (int t = piece.begin + 1; t < piece.end; ++t) {
    const auto next = place(t);
    way += std::hypot(next.x - here.x, next.z - here.z);
    piece.turning += math::wrap_angle(next.heading - here.heading);
    here = next;
  }
  piece.speed = way / (piece.end - piece.begin - 1) * motion.frame_rate();
}

/// Mean and deviation of the pieces' speeds.
std::pair<double, double> speeds_of(const std::vector<Piece>& pieces) {
  double mean = 0.0, square = 0.0;
  const auto n = static_cast<double>(pieces.size());
  for (const Piece& piece : pieces) mean += piece.speed / n;
  for (const Piece& piece : pieces) square += std::pow(piece.speed - mean, 2) / n;
  return {mean, std::max(std::sqrt(square), kLeastSpeedDeviation)};
}

}  // namespace

std::vector<std::vector<Plant>> foot_events(const Motion& motion, EventKind kind) {
  const auto legs = motion::find_legs(motion);
  if (!legs) return {};
  std::vector<std::vector<Plant>> events(2);
  const auto plants = postprocess::detect_footplants(motion, *legs);
  for (int foot = 0; foot < 2; ++foot) {
    const ToeSpeed toe(motion, legs->foot(foot));
    for (const motion::Footplant& plant : plants) {
      if (plant.foot != foot) continue;
      Plant found;
      if (plant.begin > 0) found.landing = plant.begin;
      if (plant.end < motion.num_frames()) found.leaving = plant.end;
      if (kind != EventKind::kDetected) found = toe.around(0.5 * (plant.begin + plant.end));
      if (kind == EventKind::kRounded) found = rounded(found);
      events[static_cast<std::size_t>(foot)].push_back(found);
    }
  }
  return events;
}

std::vector<Piece> pieces_of(const Motion& motion, int clip, EventKind kind) {
  std::vector<Piece> pieces;
  const auto events = foot_events(motion, kind);
  const Eigen::Quaterniond upright = motion::upright_reference(motion);
  for (int foot = 0; foot < static_cast<int>(events.size()); ++foot) {
    std::vector<Plant> own;
    for (const Plant& plant : events[static_cast<std::size_t>(foot)]) {
      if (plant.landing) own.push_back(plant);
    }
    const std::vector<Plant>& others = events[static_cast<std::size_t>(1 - foot)];
    for (std::size_t i = 0; i + 2 < own.size(); ++i) {
      const double begin = *own[i].landing, middle = *own[i + 1].landing, end = *own[i + 2].landing;
      const double least = kShortest * motion.frame_rate(), most = kLongest * motion.frame_rate();
      if (std::min(middle - begin, end - middle) < least || std::max(middle - begin, end - middle) > most) continue;
      const Plant* first = only_landing(others, begin, middle);
      const Plant* second = only_landing(others, middle, end);
      if (first == nullptr || second == nullptr) continue;
      Piece piece{clip, foot, static_cast<int>(std::ceil(begin - 1e-9)), static_cast<int>(std::ceil(end - 1e-9)), 0,
                  0,    {}};
      const Plant* before = first == others.data() ? nullptr : first - 1;
      const std::optional<double> nothing;
      const std::optional<double> times[] = {first->landing,
                                             middle,
                                             second->landing,
                                             own[i].leaving,
                                             own[i + 1].leaving,
                                             first->leaving,
                                             before ? before->leaving : nothing};
      for (int name = 0; name < 7; ++name) {
        const std::optional<double> time = times[name];
        if (time && *time > piece.begin && *time < piece.end - 1) piece.events.push_back({name, name < 3, *time});
      }
      measure(piece, motion, upright);
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

std::vector<std::pair<int, int>> match(const std::vector<Piece>& inputs, const std::vector<Piece>& outputs) {
  std::vector<std::pair<int, int>> pairs;
  const auto [input_mean, input_deviation] = speeds_of(inputs);
  const auto [output_mean, output_deviation] = speeds_of(outputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    double best = kFarthest;
    int found = -1;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const double ratio = static_cast<double>(outputs[k].end - outputs[k].begin) / (inputs[i].end - inputs[i].begin);
      if (outputs[k].foot != inputs[i].foot || ratio > 1.9 || ratio < 1.0 / 1.9) continue;
      const double speed =
          (inputs[i].speed - input_mean) / input_deviation - (outputs[k].speed - output_mean) / output_deviation;
      const double distance =
          std::hypot((inputs[i].turning - outputs[k].turning) / kTurningScale, kSpeedWeight * speed);
      if (distance >= best) continue;
      best = distance;
      found = static_cast<int>(k);
    }
    if (found >= 0) pairs.emplace_back(static_cast<int>(i), found);
  }
  return pairs;
}

double least_mean_error(const Piece& input, const Piece& output, double slope_limit, bool landings_alone) {
  struct Knot {
    double from, to;
  };
  std::vector<Knot> knots;
  for (const Event& a : input.events) {
    for (const Event& b : output.events) {
      if (a.name != b.name || (landings_alone && !a.is_landing)) continue;
      knots.push_back({a.time - input.begin + 0.5, b.time - output.begin + 0.5});
    }
  }
  if (knots.empty()) return 0.0;
  std::sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.from < b.from; });
  const double count = static_cast<double>(knots.size());
  knots.push_back({static_cast<double>(input.end - input.begin), static_cast<double>(output.end - output.begin)});
  // The least summed error of the knots so far when the last of them is put at each place of a grid.
  const int places = static_cast<int>(std::lround(knots.back().to / kGrid)) + 1;
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  std::vector<double> least(static_cast<std::size_t>(places), kNowhere), next;
  least[0] = 0.0;
  double from = 0.0;
  for (const Knot& knot : knots) {
    const double step = knot.from - from;
    const int low = static_cast<int>(std::floor(step / slope_limit / kGrid));
    const int high = static_cast<int>(std::ceil(step * slope_limit / kGrid));
    next.assign(static_cast<std::size_t>(places), kNowhere);
    for (int to = 0; to < places; ++to) {
      double& best = next[static_cast<std::size_t>(to)];
      for (int k = std::max(0, to - high); k <= to - low; ++k)
        best = std::min(best, least[static_cast<std::size_t>(k)]);
      if (&knot != &knots.back()) best += std::abs(to * kGrid - knot.to);
    }
    least.swap(next);
    from = knot.from;
  }
  return least.back() / count;
}

}  // namespace strut::study
