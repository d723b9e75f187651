// SPDX-License-Identifier: MIT
// Plans the steps of a walk. First the content's landings on the content clock, then the style's distances and times
// for them, then where each foot stands.
#include "walk_plan.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <strut/math/rotation.h>

namespace strut::generate::detail {
namespace {

constexpr double kStepRatio = 0.39;      // step length over cadence [m s]: people keep it over speeds (Sekiya 1998)
constexpr double kSidewaysSaving = 0.6;  // sideways steps are that much shorter for their cadence
constexpr double kSlowestCadence = 1.2;  // [steps/s]
constexpr double kStandingSpeed = 0.15;  // below it nobody walks [m/s]
constexpr double kStandingTurn = 0.15;   // [rad/s]
constexpr double kClosingTime = 0.6;     // of the step that brings the feet together [s]
constexpr double kScan = 0.02;           // how often one who stands looks whether to go on [s]
constexpr double kBeyond = 3.0;          // planned past the end, so that the last step is whole [s]
constexpr double kFlatAfter = 0.12;      // from heel strike to the foot lying flat [cycles]
constexpr double kHeelOffAfter = 0.31;   // from landing to the heel rising [cycles]
constexpr double kGrid = 1.0 / 480.0;    // of the path's integration [s]

/// A foot coming down, as the content has it.
struct Landing {
  double s = 0.0;  // content time
  double phase = 0.0;
  int foot = kLeft;
  double length = 0.0;        // of the step that ends here [m]
  double turn = 0.0;          // heading gained since the landing before [rad]
  bool closes = false;        // feet are together
  double stands_until = 0.0;  // content time at which the next step begins; s if at once
};

struct Demand {
  double time = kClosingTime;  // of the next step
  double length = 0.0;
  double turn = 0.0;
  bool walks = false;
};

/// What is asked for at `s`. One who stands goes on when asked to now; one who walks stops when the next step would end
/// at a stand.
Demand demand_at(const WalkContent& content, double s, bool stands) {
  Demand demand;
  double speed = content.speed.at(s);
  const double sideways = std::sin(content.travel_direction.at(s));
  const double ratio = kStepRatio * (1.0 - kSidewaysSaving * sideways * sideways);
  for (int i = 0; i < 4; ++i) {  // the step's duration depends on the mean speed over it
    demand.time = 1.0 / std::max(std::sqrt(speed / ratio), kSlowestCadence);
    speed = content.speed.mean(s, s + demand.time);
  }
  const double turn_rate = content.turn_rate.mean(s, s + demand.time);
  const double decides = stands ? s : s + demand.time;
  demand.walks = content.speed.at(decides) > kStandingSpeed || std::abs(content.turn_rate.at(decides)) > kStandingTurn;
  demand.length = speed * demand.time;
  demand.turn = turn_rate * demand.time;
  return demand;
}

/// Two landings before content time 0 and the one at it, as if what is asked at 0 had always been asked.
std::vector<Landing> first_landings(const WalkContent& content) {
  Demand demand = demand_at(content, 0.0, true);
  if (!demand.walks) demand = {};
  std::vector<Landing> landings;
  const double phase = content.first_foot == kLeft ? 0.0 : 0.5;
  for (int k = -2; k <= 0; ++k) {
    Landing landing;
    landing.s = landing.stands_until = k * demand.time;
    landing.phase = phase + 0.5 * k;
    landing.foot = (content.first_foot + k + 2) % 2;
    landing.length = demand.length;
    landing.turn = demand.turn;
    landing.closes = !demand.walks;
    landings.push_back(landing);
  }
  return landings;
}

std::vector<Landing> plan_landings(const WalkContent& content) {
  std::vector<Landing> landings = first_landings(content);
  const double end = content.duration + kBeyond;
  while (landings.back().stands_until < end) {
    Landing& last = landings.back();
    const Demand demand = demand_at(content, last.stands_until, last.closes);
    if (!demand.walks && last.closes) {
      last.stands_until += kScan;
      continue;
    }
    Landing next;
    next.s = next.stands_until = last.stands_until + (demand.walks ? demand.time : kClosingTime);
    next.phase = last.phase + 0.5;
    next.foot = 1 - last.foot;
    next.length = demand.walks ? demand.length : 0.0;
    next.turn = demand.walks ? demand.turn : 0.0;
    next.closes = !demand.walks;
    landings.push_back(next);
  }
  return landings;
}

/// Standard normal numbers that are the same on every platform.
class Variation {
 public:
  Variation(std::uint64_t seed, double scale) : engine_(seed), scale_(scale) {}
  /// Normal with this deviation, cut at two deviations.
  double operator()(double deviation) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine_() >> 11) * 0x1p-53;
    return scale_ * deviation * std::clamp(sum, -2.0, 2.0);
  }

 private:
  std::mt19937_64 engine_;
  double scale_;
};

/// What the style makes of a landing.
struct Step {
  double length = 0.0, time = 0.0;                      // of the step that ends here [m, s]
  double foothold = 0.0;                                // distance along the path [m]
  double sideways = 0.0, lift = 1.0, liveliness = 1.0;  // variation
};

std::vector<Step> style_steps(const std::vector<Landing>& landings, const WalkStyle& style) {
  Variation vary(style.seed, style.variation);
  std::vector<Step> steps(landings.size());
  for (std::size_t k = 0; k < landings.size(); ++k) {
    Step& step = steps[k];
    const bool bad_foot = landings[k].foot == style.limp_foot;
    const double limp_length = bad_foot ? 1.0 - 0.08 * style.limp : 1.0 - 0.4 * style.limp;
    const double limp_time = bad_foot ? 1.0 + 0.32 * style.limp : 1.0 - 0.18 * style.limp;
    const double content_time = k == 0 ? 0.0 : landings[k].s - landings[k - 1].stands_until;
    step.length = landings[k].length * style.step_length_scale * limp_length * (1.0 + vary(0.02));
    step.time = content_time / style.cadence_scale * limp_time * (1.0 + vary(0.015));
    step.sideways = vary(0.008);
    step.lift = 1.0 + vary(0.08);
    step.liveliness = 1.0 + vary(0.05);
    step.foothold = (k == 0 ? 0.0 : steps[k - 1].foothold) + step.length;
  }
  return steps;
}

/// Values at the knots of all curves: a knot at every landing, and one more where a stand ends.
struct Knots {
  std::vector<double> s, time, phase, distance, heading, reach, gait, liveliness;
};

Knots make_knots(const std::vector<Landing>& landings, const std::vector<Step>& steps) {
  Knots knots;
  double time = 0.0, heading = 0.0, time_at_zero = 0.0, heading_at_zero = 0.0;
  const std::size_t last = landings.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const Landing& landing = landings[k];
    const Step& step = steps[k];
    const Step& next = steps[std::min(k + 1, last)];
    time += step.time;
    heading += landing.turn;
    if (k == 2) {  // first_landings puts content time 0 here
      time_at_zero = time;
      heading_at_zero = heading;
    }
    const bool stands = landing.stands_until > landing.s;
    const auto add = [&](double s) {
      knots.s.push_back(s);
      knots.time.push_back(time);
      knots.phase.push_back(landing.phase);
      knots.distance.push_back(step.foothold - step.length / 2.0);  // between the two feet
      knots.heading.push_back(heading);
      knots.reach.push_back(stands ? 0.0 : (step.length + next.length) / 2.0 / kUsualStepLength);
      knots.gait.push_back(stands ? 0.0 : 1.0);
      knots.liveliness.push_back(step.liveliness);
    };
    add(landing.s);
    if (!stands) continue;
    time += landing.stands_until - landing.s;
    add(landing.stands_until);
  }
  for (double& value : knots.time) value -= time_at_zero;
  for (double& value : knots.heading) value -= heading_at_zero;
  return knots;
}

/// Content time at which the body passes the distance `foothold` between two landings.
double time_over(const math::SmoothCurve& distance, double foothold, double begin, double end) {
  if (distance.at(end) - distance.at(begin) < 1e-6) return (begin + end) / 2.0;  // stepping on the spot
  for (int i = 0; i < 60; ++i) {
    const double middle = (begin + end) / 2.0;
    (distance.at(middle) < foothold ? begin : end) = middle;
  }
  return (begin + end) / 2.0;
}

/// Rolling over the foot belongs to walking forwards; sideways and backwards steps are flat.
double forwardness(double direction) {
  constexpr double kRounding = 1e-9;  // the cosine of a right angle is not quite zero
  const double forward = std::cos(direction);
  return forward > kRounding ? forward : 0.0;
}

void roll_plant(Plant& plant, std::size_t k, const std::vector<Landing>& landings, const std::vector<Step>& steps,
                const WalkContent& content, const WalkStyle& style) {
  const double forward = forwardness(content.travel_direction.at(landings[k].s));
  const double bad = landings[k].foot == style.limp_foot ? style.limp : 0.0;
  const auto ratio = [](double length) { return std::clamp(length / kUsualStepLength, 0.0, 1.25); };
  plant.strike = style.heel_strike * ratio(steps[k].length) * forward * (1.0 - 0.7 * bad);
  plant.flat = plant.land + (plant.strike > 0.0 ? kFlatAfter : 0.0);
  if (k + 2 >= landings.size()) return;
  const bool stands = landings[k + 1].stands_until > landings[k + 1].s;
  plant.heel_off = plant.land + (stands ? 0.5 : kHeelOffAfter);
  plant.toe_off = plant.land + 0.5 + kDoubleSupport;
  const double stride = (steps[k + 2].foothold - steps[k].foothold) / 2.0;
  plant.push = style.push_off * (0.25 + 0.75 * ratio(stride) * forward) * (1.0 - 0.5 * bad);
}

Plant make_plant(std::size_t k, const std::vector<Landing>& landings, const std::vector<Step>& steps,
                 const math::SmoothCurve& distance, const math::SmoothCurve& heading, const GroundPath& path,
                 const WalkContent& content, const WalkStyle& style) {
  const Landing& landing = landings[k];
  const bool is_last = k + 1 == landings.size();
  const double until = is_last ? landing.s + kClosingTime : landings[k + 1].s;
  // The second of two feet that stand together stands where the body stops; so does the first.
  const double s = landing.closes && landing.stands_until > landing.s
                       ? landing.s
                       : time_over(distance, steps[k].foothold, landing.s, until);
  const double side = landing.foot == kLeft ? 1.0 : -1.0;
  const double bad = landing.foot == style.limp_foot ? style.limp : 0.0;
  const double across = std::abs(std::sin(content.travel_direction.at(s))) * steps[k].length;
  Plant plant;
  plant.land = landing.phase;
  plant.yaw = heading.at(s) + side * style.toe_out;
  // Walking sideways the feet open and close but never cross: the tracks lie apart by the step's length more.
  plant.ground = path.at(s) + math::rotation_about_y(heading.at(s)) *
                                  Eigen::Vector3d(side * (style.step_width + across) / 2.0 + steps[k].sideways, 0, 0);
  plant.lift = style.foot_lift * steps[k].lift * (1.0 - 0.5 * bad);
  plant.swing_out = 0.07 * bad;
  roll_plant(plant, k, landings, steps, content, style);
  return plant;
}

}  // namespace

GroundPath::GroundPath(const math::SmoothCurve& distance, const math::SmoothCurve& heading, const Schedule& direction)
    : begin_(distance.x().front()) {
  const auto velocity = [&](double s) -> Eigen::Vector3d {
    const double angle = heading.at(s) + direction.at(s);
    return distance.slope(s) * Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  };
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (double s = begin_; s <= distance.x().back() + kGrid; s += kGrid) {
    points_.push_back(point);
    velocities_.push_back(velocity(s));
    point += kGrid / 6.0 * (velocities_.back() + 4.0 * velocity(s + kGrid / 2.0) + velocity(s + kGrid));  // Simpson
  }
  const Eigen::Vector3d origin = at(0.0);
  for (Eigen::Vector3d& p : points_) p -= origin;
}

Eigen::Vector3d GroundPath::at(double s) const {
  const double position = std::clamp((s - begin_) / kGrid, 0.0, static_cast<double>(points_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(position);
  const double u = position - static_cast<double>(i);
  const Eigen::Vector3d rise = (points_[i + 1] - points_[i]) * (u * u * (3.0 - 2.0 * u));
  return points_[i] + rise +
         kGrid * (velocities_[i] * (u * (1.0 - u) * (1.0 - u)) - velocities_[i + 1] * (u * u * (1.0 - u)));
}

WalkPlan plan_walk(const WalkContent& content, const WalkStyle& style) {
  const std::vector<Landing> landings = plan_landings(content);
  const std::vector<Step> steps = style_steps(landings, style);
  const Knots knots = make_knots(landings, steps);
  const math::SmoothCurve distance(knots.s, knots.distance);
  const math::SmoothCurve heading(knots.s, knots.heading);
  WalkPlan plan{math::SmoothCurve(knots.s, knots.time),
                math::SmoothCurve(knots.s, knots.phase),
                distance,
                heading,
                math::SmoothCurve(knots.s, knots.reach),
                math::SmoothCurve(knots.s, knots.gait),
                math::SmoothCurve(knots.s, knots.liveliness),
                GroundPath(distance, heading, content.travel_direction),
                {}};
  for (std::size_t k = 0; k < landings.size(); ++k) {
    plan.plants[static_cast<std::size_t>(landings[k].foot)].push_back(
        make_plant(k, landings, steps, distance, heading, plan.path, content, style));
  }
  return plan;
}

}  // namespace strut::generate::detail
