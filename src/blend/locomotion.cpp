// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <strut/blend/locomotion.h>
#include <strut/core/error.h>
#include <strut/math/smooth_curve.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/representation/representation.h>

namespace strut::blend {
namespace {

constexpr double kMostTurning = 2.0;  // [rad/s]
constexpr double kLongest = 36000.0;  // [s]
constexpr int kCyclesBefore = 4;      // for feet to be held as in an endless walk, before and after a looping cycle
constexpr double kTold = 0.005;       // beyond the examples by less is not worth telling [m/s, or share]

std::string shown(double number) {
  const std::string text = std::to_string(number);
  return text.substr(0, text.find('.') + 3);
}

/// Controls over time.
class Schedule {
 public:
  explicit Schedule(const std::vector<GaitKey>& keys) : keys_(keys) {
    if (keys.empty()) throw InvalidArgument("keys", "at least one key", "none");
    std::vector<double> times;
    for (const GaitKey& key : keys) {
      if (!std::isfinite(key.time) || (!times.empty() && key.time <= times.back())) {
        throw InvalidArgument(
            "keys", "times that ascend",
            times.empty() ? "a time that is not finite" : shown(key.time) + " s after " + shown(times.back()) + " s");
      }
      if (key.controls.weights.size() != keys.front().controls.weights.size()) {
        throw InvalidArgument("keys", "weights of one number of styles", "several");
      }
      times.push_back(key.time);
    }
    if (keys.size() < 2) return;
    const auto curve = [&](auto value) {
      std::vector<double> values;
      for (const GaitKey& key : keys) values.push_back(value(key.controls));
      return math::SmoothCurve(times, values);
    };
    speed_ = curve([](const GaitControls& c) { return c.speed; });
    turn_rate_ = curve([](const GaitControls& c) { return c.turn_rate; });
    for (Eigen::Index s = 0; s < keys.front().controls.weights.size(); ++s) {
      weights_.push_back(curve([s](const GaitControls& c) { return c.weights[s]; }));
    }
  }

  [[nodiscard]] GaitControls at(double time) const {
    if (keys_.size() < 2 || time <= keys_.front().time) return keys_.front().controls;
    if (time >= keys_.back().time) return keys_.back().controls;
    GaitControls controls{Eigen::VectorXd(weights_.size()), speed_->at(time), turn_rate_->at(time)};
    for (std::size_t s = 0; s < weights_.size(); ++s) {
      controls.weights[static_cast<Eigen::Index>(s)] = weights_[s].at(time);
    }
    // Curves with limited slopes need not keep their sum at 1.
    const double spare = 1.0 - controls.weights.sum();
    controls.weights.array() += spare / static_cast<double>(weights_.size());
    return controls;
  }

 private:
  const std::vector<GaitKey>& keys_;
  std::optional<math::SmoothCurve> speed_, turn_rate_;
  std::vector<math::SmoothCurve> weights_;
};

/// How far beyond the examples was gone, at worst.
struct Beyond {
  double amount = 0.0, time = 0.0, value = 0.0, limit = 0.0;
  void see(double by, double at, double what, double bound) {
    if (by > amount) *this = {by, at, what, bound};
  }
};

class Excursions {
 public:
  explicit Excursions(const GaitModel& model) : model_(model), over_(model.styles().size()) {}

  void see(const GaitControls& controls, double time) {
    const SpeedRange range = model_.speeds(controls.weights);
    fast_.see(controls.speed - range.fastest, time, controls.speed, range.fastest);
    slow_.see(range.slowest - controls.speed, time, controls.speed, range.slowest);
    for (std::size_t s = 0; s < over_.size(); ++s) {
      const double weight = controls.weights[static_cast<Eigen::Index>(s)];
      over_[s].see(std::max(weight - 1.0, -weight), time, weight, weight > 1.0 ? 1.0 : 0.0);
    }
  }

  void report(Diagnostics* diagnostics) const {
    if (diagnostics == nullptr) return;
    for (const auto& [what, beyond] : {std::pair{"faster", &fast_}, std::pair{"slower", &slow_}}) {
      if (beyond->amount < kTold) continue;
      diagnostics->warn("blend",
                        shown(beyond->value) + " m/s, asked for at " + shown(beyond->time) + " s, is " + what +
                            " than the examples of these styles by " + shown(beyond->amount) + " m/s (they end at " +
                            shown(beyond->limit) + " m/s)",
                        "what is made there is extrapolated");
    }
    for (std::size_t s = 0; s < over_.size(); ++s) {
      if (over_[s].amount < kTold) continue;
      diagnostics->warn("blend",
                        "the weight " + shown(over_[s].value) + " of style '" + model_.styles()[s].name + "' at " +
                            shown(over_[s].time) + " s is beyond the examples by " + shown(over_[s].amount),
                        "what is made there is exaggerated");
    }
  }

 private:
  const GaitModel& model_;
  Beyond fast_, slow_;
  std::vector<Beyond> over_;
};

/// Frames with their plants as stretches.
SynthesizedGait assembled(const std::shared_ptr<const Skeleton>& skeleton, double frame_rate,
                          std::vector<GaitFrame> frames) {
  std::vector<motion::Footplant> plants;
  const int count = static_cast<int>(frames.size());
  for (const int foot : {0, 1}) {
    const auto stands = [&](int f) {
      return frames[static_cast<std::size_t>(f)].planted[static_cast<std::size_t>(foot)];
    };
    for (int f = 0; f < count; ++f) {
      if (!stands(f)) continue;
      const int begin = f;
      while (f < count && stands(f)) ++f;
      plants.push_back({foot, begin, f});
    }
  }
  std::vector<Pose> poses;
  for (GaitFrame& frame : frames) poses.push_back(std::move(frame.pose));
  return {Motion(skeleton, frame_rate, std::move(poses)), std::move(plants)};
}

void clean(SynthesizedGait& gait, const postprocess::FootskateOptions& options, Diagnostics* diagnostics) {
  const auto legs = motion::find_legs(gait.motion);
  if (!legs) return;
  gait.motion = postprocess::clean_footskate(gait.motion, *legs, gait.footplants, options, diagnostics);
}

/// The `count` frames from `begin`, which turn smoothly into those a cycle earlier: what follows these is frame
/// `begin`.
std::vector<Pose> looped(const Motion& walk, int begin, int count, int travel_joint) {
  const auto carried = static_cast<std::size_t>(travel_joint);
  const Eigen::Vector3d cycle =
      walk.frame(begin).translations[carried] - walk.frame(begin - count).translations[carried];
  std::vector<Pose> frames;
  for (int f = 0; f < count; ++f) {
    const double x = static_cast<double>(f) / count;
    Pose earlier = walk.frame(begin - count + f);
    earlier.translations[carried] += cycle;
    frames.push_back(motion::interpolate(walk.frame(begin + f), earlier, x * x * (3.0 - 2.0 * x)));
  }
  return frames;
}

/// How far the phase gets within `time` [cycles], by the classical Runge-Kutta method: a cycle then ends when its
/// duration says, to six digits.
double advance_of(const GaitLoop& loop, double phase, double time) {
  const double first = loop.pace(phase);
  const double second = loop.pace(phase + 0.5 * time * first);
  const double third = loop.pace(phase + 0.5 * time * second);
  const double fourth = loop.pace(phase + time * third);
  return time * (first + 2.0 * second + 2.0 * third + fourth) / 6.0;
}

std::shared_ptr<const GaitModel> checked_model(std::shared_ptr<const GaitModel> model, double frame_rate) {
  if (!model) throw InvalidArgument("model", "a gait model", "null");
  if (!(frame_rate > 0.0 && std::isfinite(frame_rate))) {
    throw InvalidArgument("frame_rate", "a positive number", std::to_string(frame_rate));
  }
  return model;
}

double checked_rate(const GaitModel& model, double frame_rate) {
  if (frame_rate == 0.0) return model.frame_rate();
  if (frame_rate >= 5.0 && frame_rate <= 1000.0) return frame_rate;
  throw InvalidArgument("frame_rate", "5 to 1000 frames per second", std::to_string(frame_rate));
}

}  // namespace

Walker::Walker(std::shared_ptr<const GaitModel> model, double frame_rate, double phase)
    : model_(checked_model(std::move(model), frame_rate)),
      frame_time_(1.0 / frame_rate),
      phase_(phase),
      bones_(rest_pose(model_->representation().skeleton())),
      layout_(model_->representation().num_dofs()),
      decoder_(model_->representation(), frame_rate),
      slots_(static_cast<std::size_t>(layout_.num_slots())) {
  if (!std::isfinite(phase)) throw InvalidArgument("phase", "a finite number", std::to_string(phase));
}

GaitFrame Walker::next(const GaitControls& controls) {
  if (!(std::abs(controls.turn_rate) <= kMostTurning)) {
    throw InvalidArgument("turn_rate", "-2 to 2 radians per second", std::to_string(controls.turn_rate));
  }
  if (loop_.empty() || controls.speed != latest_.speed || controls.weights != latest_.weights) {
    loop_.assign(1, model_->loop(controls.weights, controls.speed));
    latest_ = controls;
  }
  const GaitLoop& loop = loop_.front();
  const double advance = started_ ? advance_of(loop, phase_, frame_time_) : 0.0;
  // A row's velocities are those on the way to it.
  const Eigen::VectorXd on_the_way = loop.at(phase_ + 0.5 * advance);
  phase_ += advance;
  started_ = true;
  Eigen::VectorXd row = loop.at(phase_).head(model_->representation().num_dofs());
  row.head<representation::kHeight>() = on_the_way.head<representation::kHeight>();
  row[representation::kTurningRate] += controls.turn_rate;
  layout_.pack(row.transpose(), slots_.data());
  GaitFrame frame{bones_, {loop.plants()[0].holds(phase_), loop.plants()[1].holds(phase_)}};
  decoder_.decode(slots_.data(), view(bones_), view(frame.pose));
  return frame;
}

SynthesizedGait synthesize(const std::shared_ptr<const GaitModel>& model, const std::vector<GaitKey>& keys,
                           double seconds, const SynthesisOptions& options, Diagnostics* diagnostics) {
  if (!(seconds > 0.0 && seconds <= kLongest)) {
    throw InvalidArgument("seconds", "above 0, up to 36000", std::to_string(seconds));
  }
  if (!model) throw InvalidArgument("model", "a gait model", "null");
  const double rate = checked_rate(*model, options.frame_rate);
  const Schedule schedule(keys);
  Walker walker(model, rate);
  Excursions excursions(*model);
  std::vector<GaitFrame> frames;
  const int count = std::max(2, static_cast<int>(std::lround(seconds * rate)));
  for (int f = 0; f < count; ++f) {
    const double time = f / rate;
    const GaitControls controls = schedule.at(time);
    try {
      frames.push_back(walker.next(controls));
    } catch (const InvalidArgument& error) {
      throw InvalidArgument("at " + shown(time) + " s", error);
    }
    excursions.see(controls, time);
  }
  excursions.report(diagnostics);
  SynthesizedGait gait = assembled(model->representation().shared_skeleton(), rate, std::move(frames));
  if (options.clean_feet) clean(gait, options.footskate, diagnostics);
  return gait;
}

SynthesizedGait synthesize_cycle(const std::shared_ptr<const GaitModel>& model, const GaitControls& controls,
                                 const SynthesisOptions& options, Diagnostics* diagnostics) {
  if (!model) throw InvalidArgument("model", "a gait model", "null");
  if (controls.turn_rate != 0.0) {
    throw InvalidArgument("turn_rate", "0 for a cycle that loops", std::to_string(controls.turn_rate));
  }
  const double rate = checked_rate(*model, options.frame_rate);
  const double duration = model->loop(controls.weights, controls.speed).duration();
  const int count = std::max(3, static_cast<int>(std::lround(duration * rate)));
  // At this rate a cycle lasts whole frames; the frames are then shown at the rate asked for.
  SynthesisOptions whole = options;
  whole.frame_rate = std::clamp(count / duration, 5.0, 1000.0);
  const int cycles = 2 * kCyclesBefore + 1;
  const SynthesizedGait gait =
      synthesize(model, {{0.0, controls}}, (cycles * count + 0.5) / whole.frame_rate, whole, diagnostics);
  const int begin = kCyclesBefore * count, end = begin + count;
  std::vector<motion::Footplant> plants;
  for (const motion::Footplant& plant : gait.footplants) {
    if (plant.begin < end && plant.end > begin) {
      plants.push_back({plant.foot, std::max(plant.begin, begin) - begin, std::min(plant.end, end) - begin});
    }
  }
  return {Motion(gait.motion.shared_skeleton(), rate,
                 looped(gait.motion, begin, count, model->representation().travel_joint())),
          std::move(plants)};
}

}  // namespace strut::blend
