// SPDX-License-Identifier: MIT
// From content and style to a plan of steps: when and where each foot comes down, and the smooth curves of time, gait
// phase, distance and heading through those moments. Everything runs over content time s.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <strut/generate/walker.h>

namespace strut::generate::detail {

inline constexpr double kUsualStepLength = 0.71;  // at 1.3 m/s [m]; amplitudes are stated for it
inline constexpr double kDoubleSupport = 0.11;    // from a landing to the other foot's toes leaving [cycles]
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// One foot's time on the ground, in gait phase: heel down, flat, heel up, toes up.
struct Plant {
  double land = 0.0, flat = 0.0, heel_off = kNever, toe_off = kNever;  ///< [cycles], ascending
  double strike = 0.0;                                                 ///< toes up at `land` [rad]
  double push = 0.0;                                                   ///< heel up at `toe_off` [rad]
  double lift = 0.0;                                                   ///< of the swing that leads here [m]
  double swing_out = 0.0;                            ///< sideways detour of that swing, away from the body [m]
  Eigen::Vector3d ground = Eigen::Vector3d::Zero();  ///< the point below the ankle while flat, y = 0 [m]
  double yaw = 0.0;                                  ///< of the foot [rad]
};

/// The path on the ground as a function of content time, integrated once on a fixed grid.
class GroundPath {
 public:
  GroundPath(const math::SmoothCurve& distance, const math::SmoothCurve& heading, const Schedule& direction);
  [[nodiscard]] Eigen::Vector3d at(double s) const;

 private:
  double begin_;
  std::vector<Eigen::Vector3d> points_, velocities_;
};

struct WalkPlan {
  math::SmoothCurve time;        ///< the style's time [s]
  math::SmoothCurve phase;       ///< [cycles]
  math::SmoothCurve distance;    ///< of the body along the path [m]
  math::SmoothCurve heading;     ///< [rad]
  math::SmoothCurve reach;       ///< step length against the usual; 0 while standing
  math::SmoothCurve gait;        ///< 1 walking, 0 standing
  math::SmoothCurve liveliness;  ///< of the upper body: 1 with some variation
  GroundPath path;
  std::array<std::vector<Plant>, 2> plants;  ///< by foot, ascending
};

WalkPlan plan_walk(const WalkContent& content, const WalkStyle& style);

}  // namespace strut::generate::detail
