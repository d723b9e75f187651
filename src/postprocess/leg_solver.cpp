// SPDX-License-Identifier: MIT
#include "postprocess/leg_solver.h"

#include <algorithm>
#include <cmath>

namespace strut::postprocess::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kShortest = 1e-6;       // bones shorter than this have no direction [m]
constexpr double kDampedFrom = 0.92;     // share of the straight leg from which extension is damped
constexpr double kStraightest = 0.9999;  // of the straight leg: closer than this the knee's angle is all rounding

/// A share of the straight leg that never reaches 1: `share` up to `from`, beyond it ever less, with a smooth join.
double damped(double share, double from) {
  if (share <= from) return share;
  return 1.0 - (1.0 - from) * std::exp(-(share - from) / (1.0 - from));
}

/// By how much more the knee bends so that thigh and shin span `length`; the shin turns about `axis`.
/// |thigh + R shin|^2 is a + b cos + c sin of the turn: solved exactly, for knees that are no perfect hinges too.
double knee_turn(const Vector3d& thigh, const Vector3d& shin, const Vector3d& axis, double length) {
  const Vector3d along = axis * axis.dot(shin);
  const Vector3d across = shin - along;
  const double b = thigh.dot(across), c = thigh.dot(axis.cross(across));
  const double amplitude = std::hypot(b, c);
  if (amplitude < kShortest * kShortest) return 0.0;
  const double a = 0.5 * (length * length - thigh.squaredNorm() - shin.squaredNorm()) - thigh.dot(along);
  const double bend = -std::atan2(c, b);  // as it is, negative where the knee is bent the wrong way
  const double wanted = std::acos(std::clamp(a / amplitude, -1.0, 1.0));
  if (bend >= 0.0) return wanted - bend;
  // A knee that is bent a little the wrong way stays so while it need not bend much more, and passes smoothly.
  const double more = std::clamp(0.5 * (wanted / -bend - 1.0), 0.0, 1.0);
  const double right_way = more * more * (3.0 - 2.0 * more);
  return (2.0 * right_way - 1.0) * wanted - bend;
}

}  // namespace

LegSolution solve_leg(const Vector3d& thigh, const Vector3d& shin, const Vector3d& wanted, const Vector3d& bend_axis,
                      double max_stretch) {
  const double straight = thigh.norm() + shin.norm();
  const double distance = wanted.norm();
  if (thigh.norm() < kShortest || shin.norm() < kShortest || distance < kShortest) return {};
  LegSolution solution;
  const double as_it_is = (thigh + shin).norm() / straight;
  const double share = damped(distance / straight, std::min(std::max(kDampedFrom, as_it_is), kStraightest));
  const Quaterniond bend(Eigen::AngleAxisd(knee_turn(thigh, shin, bend_axis, share * straight), bend_axis));
  const Vector3d reached = thigh + bend * shin;
  solution.thigh_turn = Quaterniond::FromTwoVectors(reached, wanted);
  solution.shin_turn = solution.thigh_turn * bend;
  solution.stretch = std::clamp(distance / std::max(reached.norm(), kShortest), 1.0, 1.0 + max_stretch);
  solution.changed = true;
  return solution;
}

}  // namespace strut::postprocess::detail
