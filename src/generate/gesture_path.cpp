// SPDX-License-Identifier: MIT
// Strokes are quintics through the keys, smooth to the second derivative; the pace is the exponential of smooth waves,
// so that content time always runs on.
#include "gesture_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strut::generate::detail {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kMeanPeak = 8.0 / 15.0;    // of (4u(1 - u))^2 over [0, 1]
constexpr double kPace = 0.20;              // log of the pace that suddenness alone brings
constexpr double kBurst = 0.50;             // log of the pace that it adds at an accent's peak
constexpr double kLate = 0.45;              // how far strength shifts an accent's peak towards its end
constexpr double kRipple = 0.60;            // log of the pace by which bound strokes halt
constexpr double kRounding = 0.55;          // share of its speed that a free stroke carries through a key
constexpr double kLag = 0.07;               // by which a free forearm follows the upper arm [s]
constexpr double kTremor = 0.010;           // of bound arms [rad]
constexpr double kSway = 0.012;             // of everything [rad], with the natural variation
constexpr double kStrideVariation = 0.06;   // of the pace of a stroke
constexpr double kPostureVariation = 0.04;  // of every angle of a key [rad]
constexpr double kSink = 0.03;              // of the standing body, by strength [m]
constexpr double kSinkOfAccents = 0.03;     // more, at accents [m]
constexpr double kLeanOfAccents = 0.08;     // [rad]

/// A bump over u in [0, 1], 1 in the middle, flat to second order at its ends.
double bump(double u) {
  const double w = 4.0 * u * (1.0 - u);
  return w * w * w;
}

double peak(double u) {
  const double w = 4.0 * u * (1.0 - u);
  return w * w - kMeanPeak;
}

bool is_arm(std::size_t part) {
  return part >= kLeftFlexion;
}

/// By how many of kLag a part follows: forearms follow upper arms, hands follow forearms.
double lags(std::size_t part) {
  if (!is_arm(part)) return 0.0;
  const std::size_t of_arm = (part - kLeftFlexion) % (kRightFlexion - kLeftFlexion);
  if (of_arm == kLeftElbow - kLeftFlexion) return 1.0;
  return of_arm == kLeftWrist - kLeftFlexion ? 1.7 : 0.0;
}

/// How bound a movement is, from 0.
double restraint(double bound) {
  return std::max(0.0, 0.5 * (1.0 + bound));
}

/// Adds a random angle to every part but the feet, lengths in proportion.
void disturb(Posture& posture, double deviation, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (std::size_t part = 0; part < posture.size(); ++part) {
    const double length_share = part <= kPelvisSide ? 0.15 : is_arm(part) ? 1.0 : 0.5;
    const double change = deviation * length_share * normal(random);
    if (part != kRightFootForward) posture[part] += change;
  }
}

}  // namespace

double GesturePath::Wave::at(double t) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < frequency.size(); ++i) sum += std::sin(kTwoPi * frequency[i] * t + phase[i]);
  return sum / std::sqrt(1.5);  // a root mean square of 1
}

GesturePath::GesturePath(const GestureContent& content, const GestureStyle& style, const Performer& who)
    : sudden_(who.expression * style.suddenness),
      bound_(who.expression * style.boundness),
      strong_(who.expression * style.strength),
      tempo_(who.tempo),
      curvature_(style.curvature) {
  std::mt19937_64 random(style.seed);
  set_waves(style, random);
  tremor_ = who.tremor + kTremor * restraint(bound_) * restraint(bound_);
  set_keys(content, style, who);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < postures_.size(); ++k) {
    disturb(postures_[k], kPostureVariation * style.variation, random);
    jitter_.push_back(kStrideVariation * style.variation * normal(random));
  }
}

void GesturePath::set_keys(const GestureContent& content, const GestureStyle& style, const Performer& who) {
  const Posture rest = rest_posture();
  const double extent = style.extent * who.extent;
  std::mt19937_64 habits(who.seed);
  times_ = {0.0};
  postures_ = {rest};
  accents_ = {0.0};
  for (const GestureKey& key : content.keys) {
    Posture posture = key.posture;
    for (std::size_t part = 0; part < posture.size(); ++part) {
      posture[part] = rest[part] + extent * (posture[part] - rest[part]);
    }
    disturb(posture, &key == &content.keys.back() ? 0.0 : who.habit, habits);
    posture[kPelvisDrop] = posture[kPelvisDrop] * (1.0 + 0.3 * strong_) + kSinkOfAccents * strong_ * key.accent;
    posture[kSpineBend] += kLeanOfAccents * strong_ * key.accent;
    times_.push_back(times_.back() + key.duration);
    postures_.push_back(posture);
    accents_.push_back(key.accent);
  }
  for (Posture& posture : postures_) {
    posture[kPelvisDrop] += who.crouch + kSink * strong_;
    posture[kSpineBend] += who.hunch;
    for (const int arm : {kLeftFlexion, kRightFlexion}) {
      posture[static_cast<std::size_t>(arm) + 1] += who.arm_spread;
      posture[static_cast<std::size_t>(arm) + 3] += who.elbow_bend;
    }
  }
}

void GesturePath::set_waves(const GestureStyle& style, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ripple_frequency_ = 2.8 + unit(random);
  ripple_phase_ = kTwoPi * unit(random);
  sway_ = kSway * style.variation;
  for (std::size_t part = 0; part < trembling_.size(); ++part) {
    for (std::size_t i = 0; i < 3; ++i) {
      trembling_[part].frequency[i] = 4.5 + 3.5 * unit(random);
      trembling_[part].phase[i] = kTwoPi * unit(random);
      swaying_[part].frequency[i] = 0.3 + 0.9 * unit(random);
      swaying_[part].phase[i] = kTwoPi * unit(random);
    }
  }
}

StrokePlace GesturePath::place(double s) const {
  const double inside = std::clamp(s, 0.0, times_.back());
  std::size_t stroke = 0;
  while (stroke + 2 < times_.size() && inside > times_[stroke + 1]) ++stroke;
  return {stroke, (inside - times_[stroke]) / (times_[stroke + 1] - times_[stroke])};
}

double GesturePath::foot_way(std::size_t stroke) const {
  return std::abs(postures_[stroke + 1][kRightFootForward] - postures_[stroke][kRightFootForward]);
}

double GesturePath::pace(double s) const {
  const auto [stroke, u] = place(s);
  const double accent = accents_[stroke + 1];
  const double late = std::exp(std::clamp(kLate * strong_, -0.6, 0.6));
  double log_pace = sudden_ * (kPace + kBurst * accent * peak(std::pow(u, late))) + jitter_[stroke + 1] * bump(u);
  log_pace += 0.12 * strong_ * accent * peak(std::pow(u, late));
  log_pace += kRipple * std::pow(restraint(bound_), 1.5) * std::sin(kTwoPi * ripple_frequency_ * s + ripple_phase_);
  return tempo_ * std::exp(log_pace);
}

/// The speed kept through a key.
double GesturePath::slope(std::size_t part, std::size_t key) const {
  if (key == 0 || key + 1 == times_.size() || part == kRightFootForward) return 0.0;
  const double rounding = kRounding * std::clamp(0.5 * (1.0 - bound_), 0.0, 1.2);
  return rounding * (postures_[key + 1][part] - postures_[key - 1][part]) / (times_[key + 1] - times_[key - 1]);
}

double GesturePath::part_at(std::size_t part, double s) const {
  const auto [stroke, u] = place(s);
  const double length = times_[stroke + 1] - times_[stroke], from = postures_[stroke][part];
  const double v0 = length * slope(part, stroke), v1 = length * slope(part, stroke + 1);
  const double u3 = u * u * u;
  const double way = postures_[stroke + 1][part] - from;
  double value = from + v0 * u + way * u3 * (10.0 - 15.0 * u + 6.0 * u * u) - v0 * u3 * (6.0 - 8.0 * u + 3.0 * u * u) -
                 v1 * u3 * (4.0 - 7.0 * u + 3.0 * u * u);
  if (part == kLeftSpread || part == kRightSpread) {
    const double turned = postures_[stroke + 1][part - 1] - postures_[stroke][part - 1];
    const double bent = postures_[stroke + 1][part + 2] - postures_[stroke][part + 2];
    value += 0.3 * curvature_ * std::min(1.0, std::hypot(turned, bent)) * bump(u);
  }
  return value;
}

Posture GesturePath::at(double s, double t) const {
  Posture posture;
  const double lag = kLag * std::clamp(0.5 * (1.0 - bound_), 0.0, 1.2);
  for (std::size_t part = 0; part < posture.size(); ++part) {
    posture[part] = part_at(part, s - lag * lags(part));
    if (part == kRightFootForward) continue;
    const double share = part <= kPelvisSide ? 0.15 : 1.0;  // metres, not radians
    const double tremble = is_arm(part) ? 1.0 : 0.2;
    posture[part] += share * (sway_ * swaying_[part].at(t) + tremble * tremor_ * trembling_[part].at(t));
  }
  return posture;
}

}  // namespace strut::generate::detail
