// SPDX-License-Identifier: MIT
// The postures that the eight actions pass through.
#include <initializer_list>
#include <utility>

#include <strut/generate/gestures.h>

namespace strut::generate {
namespace {

using Parts = std::initializer_list<std::pair<PosturePart, double>>;

/// At rest but for `parts`.
Posture posture(const Parts& parts) {
  Posture result = rest_posture();
  for (const auto& [part, value] : parts) result[part] = value;
  return result;
}

GestureKey key(double duration, double accent, const Parts& parts) {
  return {duration, accent, posture(parts)};
}

/// Both arms alike, beside `parts`.
GestureKey both_arms(double duration, double accent, const std::array<double, 5>& arm, const Parts& parts) {
  GestureKey result = key(duration, accent, parts);
  for (std::size_t i = 0; i < arm.size(); ++i) {
    result.posture[kLeftFlexion + i] = result.posture[kRightFlexion + i] = arm[i];
  }
  return result;
}

GestureContent reach() {
  return {"reach",
          {key(0.55, 1.0,
               {{kRightFlexion, 1.55},
                {kRightSpread, 0.10},
                {kRightElbow, 0.15},
                {kRightWrist, 0.0},
                {kSpineTurn, 0.35},
                {kPelvisForward, 0.05},
                {kSpineBend, 0.15},
                {kNod, 0.1}}),
           key(0.45, 0.6, {{kRightFlexion, 0.7}, {kRightElbow, 1.6}, {kSpineTurn, 0.05}, {kNod, 0.25}}),
           key(0.50, 0.2, {})}};
}

GestureContent wave() {
  const auto up = [](double duration, double accent, double elbow) {
    return key(duration, accent,
               {{kRightSpread, 1.35},
                {kRightTwist, -1.5},
                {kRightElbow, elbow},
                {kSpineSide, 0.05},
                {kRightWrist, 0.3 - 0.25 * elbow},
                {kLook, -0.1}});
  };
  return {"wave",
          {up(0.5, 0.5, 1.5), up(0.22, 1.0, 0.9), up(0.3, 1.0, 1.8), up(0.3, 1.0, 0.9), up(0.3, 1.0, 1.7),
           key(0.55, 0.2, {})}};
}

GestureContent punch() {
  return {"punch",
          {key(0.42, 0.2,
               {{kRightFlexion, -0.3},
                {kRightSpread, 0.25},
                {kRightElbow, 1.9},
                {kSpineTurn, -0.4},
                {kPelvisTurn, -0.2},
                {kLeftFlexion, 0.8},
                {kLeftElbow, 1.6},
                {kPelvisDrop, 0.04}}),
           key(0.32, 1.0,
               {{kRightFlexion, 1.45},
                {kRightSpread, 0.05},
                {kRightElbow, 0.12},
                {kSpineTurn, 0.5},
                {kPelvisTurn, 0.25},
                {kLeftFlexion, 0.35},
                {kLeftElbow, 1.7},
                {kPelvisDrop, 0.06},
                {kPelvisForward, 0.08},
                {kSpineBend, 0.12}}),
           key(0.36, 0.4,
               {{kRightFlexion, 0.6}, {kRightElbow, 1.8}, {kLeftFlexion, 0.6}, {kLeftElbow, 1.7}, {kPelvisDrop, 0.03}}),
           key(0.45, 0.2, {})}};
}

GestureContent throwing() {
  return {"throw",
          {key(0.50, 0.2,
               {{kRightFlexion, -0.2},
                {kRightSpread, 1.4},
                {kRightTwist, -1.3},
                {kRightElbow, 1.6},
                {kSpineTurn, -0.6},
                {kPelvisTurn, -0.2},
                {kPelvisForward, -0.05},
                {kLeftFlexion, 1.1}}),
           key(0.36, 1.0,
               {{kRightFlexion, 1.9},
                {kRightSpread, 0.4},
                {kRightTwist, -0.3},
                {kRightElbow, 0.3},
                {kSpineTurn, 0.5},
                {kPelvisTurn, 0.2},
                {kPelvisForward, 0.07},
                {kLeftFlexion, 0.2},
                {kSpineBend, 0.1},
                {kRightWrist, 0.4}}),
           key(0.36, 0.6,
               {{kRightFlexion, 0.5},
                {kRightSpread, -0.15},
                {kRightElbow, 0.4},
                {kSpineTurn, 0.6},
                {kSpineBend, 0.5},
                {kPelvisForward, 0.06},
                {kPelvisDrop, 0.05}}),
           key(0.55, 0.2, {})}};
}

GestureContent lift() {
  return {"lift",
          {both_arms(0.60, 0.4, {1.25, 0.1, 0.0, 0.35, 0.1},
                     {{kPelvisDrop, 0.26}, {kPelvisForward, -0.10}, {kPelvisLean, 0.35}, {kSpineBend, 0.6}}),
           both_arms(0.52, 1.0, {0.5, 0.15, 0.0, 1.6, 0.1}, {{kPelvisDrop, 0.02}, {kSpineBend, -0.05}}),
           both_arms(0.48, 0.7, {2.5, 0.2, 0.0, 0.5, -0.2}, {{kSpineBend, -0.15}, {kNod, -0.2}}), key(0.55, 0.2, {})}};
}

GestureContent press() {
  return {"press",
          {both_arms(0.55, 0.3, {1.25, 0.35, 0.2, 1.7, -0.3}, {{kSpineBend, -0.1}, {kNod, -0.05}}),
           both_arms(0.50, 1.0, {0.35, 0.25, 0.2, 0.3, -0.7},
                     {{kPelvisDrop, 0.10}, {kPelvisForward, -0.03}, {kSpineBend, 0.35}, {kNod, 0.2}}),
           key(0.55, 0.2, {})}};
}

GestureContent bow() {
  return {"bow",
          {key(0.65, 1.0,
               {{kPelvisForward, -0.12},
                {kPelvisLean, 0.5},
                {kSpineBend, 0.6},
                {kNod, 0.3},
                {kLeftFlexion, 0.35},
                {kRightFlexion, 0.8},
                {kRightElbow, 1.5},
                {kPelvisDrop, 0.03}}),
           key(0.30, 0.3,
               {{kPelvisForward, -0.13},
                {kPelvisLean, 0.55},
                {kSpineBend, 0.65},
                {kNod, 0.35},
                {kLeftFlexion, 0.4},
                {kRightFlexion, 0.85},
                {kRightElbow, 1.5},
                {kPelvisDrop, 0.03}}),
           key(0.70, 0.5, {})}};
}

GestureContent lunge() {
  return {"lunge",
          {both_arms(0.60, 1.0, {0.3, 0.7, 0.0, 0.3, 0.1},
                     {{kRightFootForward, 0.5}, {kPelvisForward, 0.26}, {kPelvisDrop, 0.12}, {kSpineBend, 0.1}}),
           both_arms(0.40, 0.6, {0.4, 1.35, 0.0, 0.2, -0.1},
                     {{kRightFootForward, 0.5}, {kPelvisForward, 0.30}, {kPelvisDrop, 0.20}, {kSpineBend, 0.15}}),
           key(0.70, 0.4, {})}};
}

}  // namespace

Posture rest_posture() {
  Posture rest{};
  for (const int arm : {kLeftFlexion, kRightFlexion}) {
    const auto i = static_cast<std::size_t>(arm);
    rest[i] = 0.05, rest[i + 1] = 0.12, rest[i + 3] = 0.25, rest[i + 4] = 0.1;
  }
  return rest;
}

GestureContent gesture_content(GestureAction action) {
  switch (action) {
    case GestureAction::kReach:
      return reach();
    case GestureAction::kWave:
      return wave();
    case GestureAction::kPunch:
      return punch();
    case GestureAction::kThrow:
      return throwing();
    case GestureAction::kLift:
      return lift();
    case GestureAction::kPress:
      return press();
    case GestureAction::kBow:
      return bow();
    case GestureAction::kLunge:
      return lunge();
  }
  return {};
}

}  // namespace strut::generate
