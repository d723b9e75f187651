// SPDX-License-Identifier: MIT
// Symbols of the paper's section 3 and what they are here:
//   u, y    input and output          W   time_warp                 a, b   space_warp
//   p       U a + b, the input as the spatial warp leaves it        E      objective, Equation 1
#include "align/signals.h"
#include "align/space_warp_solver.h"
#include "align/time_warp_search.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

using Signals = Eigen::Ref<const FrameMatrix>;

void check_options(const IterativeMotionWarpingOptions& options) {
  detail::check_space_warp(options.space);
  if (options.max_rounds < 1) throw InvalidArgument("max_rounds", "at least 1", std::to_string(options.max_rounds));
  if (!(options.tolerance >= 0.0)) {
    throw InvalidArgument("tolerance", "a number that is not negative", std::to_string(options.tolerance));
  }
}

/// The degrees of freedom that are not zero throughout both signals. The others add nothing to E: a = 1, b = 0 fits.
std::vector<Eigen::Index> moving_dofs(const Signals& input, const Signals& output) {
  std::vector<Eigen::Index> moving;
  const Eigen::RowVectorXd size =
      input.cwiseAbs().colwise().maxCoeff().cwiseMax(output.cwiseAbs().colwise().maxCoeff());
  for (Eigen::Index d = 0; d < size.size(); ++d) {
    if (size[d] > 0.0) moving.push_back(d);
  }
  return moving;
}

/// The two stages in turn.
class Alternation {
 public:
  Alternation(const Signals& input, const Signals& output, const IterativeMotionWarpingOptions& options)
      : options_(options),
        time_(static_cast<int>(input.rows()), output, options),
        space_(input, output, options.space),
        warped_(input) {}

  IterativeMotionWarpingResult solve() {
    for (int round = 0; round < options_.max_rounds; ++round) {
      if (!improve(time_warp())) break;
    }
    return std::move(result_);
  }

  /// One round of the most even time warp.
  IterativeMotionWarpingResult solve_evenly() {
    improve(time_.even());
    result_.is_determined = false;
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_first() const { return result_.objective.empty(); }

  /// The time-warp stage. Coarse to fine it may miss the last round's warp; it is then sought around that one.
  TimeWarp time_warp() {
    TimeWarp found = time_.find(warped_);
    if (is_first() || time_.is_exact()) return found;
    const auto distance = [&](const TimeWarp& warp) { return space_.distance(warp, warped_, options_.weights); };
    return distance(found) <= distance(result_.time_warp) ? found : time_.find_near(result_.time_warp);
  }

  /// The space-warp stage, and whether a further round may help.
  bool improve(TimeWarp time_warp) {
    // The same time warp has the same best space warp.
    if (!is_first() && time_warp.begin == result_.time_warp.begin &&
        time_warp.repetitions == result_.time_warp.repetitions) {
      return false;
    }
    space_.solve(time_warp, space_warp_);
    space_.apply(space_warp_, warped_);
    const double after = space_.objective(time_warp, space_warp_, warped_, options_.weights);
    const double before = is_first() ? 0.0 : result_.objective.back();
    if (!std::isfinite(after)) {
      throw NumericalError("iterative motion warping", "objective", after, std::numeric_limits<double>::max());
    }
    if (!is_first() && after >= before) return false;
    const bool goes_on = is_first() || before - after > options_.tolerance * before;
    result_.objective.push_back(after);
    result_.time_warp = std::move(time_warp);
    std::swap(result_.space_warp, space_warp_);
    return goes_on;
  }

  const IterativeMotionWarpingOptions& options_;
  detail::TimeWarpSearch time_;
  detail::SpaceWarpSolver space_;
  FrameMatrix warped_;  // p; a = 1, b = 0 at first
  SpaceWarp space_warp_;
  IterativeMotionWarpingResult result_;
};

/// With the degrees of freedom that move alone: a body has many that do not.
IterativeMotionWarpingResult solve(const Signals& input, const Signals& output,
                                   const IterativeMotionWarpingOptions& options) {
  const std::vector<Eigen::Index> moving = moving_dofs(input, output);
  if (static_cast<Eigen::Index>(moving.size()) == input.cols()) return Alternation(input, output, options).solve();
  IterativeMotionWarpingOptions of_moving = options;
  if (options.weights.size() != 0) of_moving.weights = options.weights(moving);
  const FrameMatrix moving_input = input(Eigen::all, moving), moving_output = output(Eigen::all, moving);
  IterativeMotionWarpingResult result = Alternation(moving_input, moving_output, of_moving).solve();
  SpaceWarp of_all{FrameMatrix::Ones(input.rows(), input.cols()), FrameMatrix::Zero(input.rows(), input.cols())};
  of_all.scale(Eigen::all, moving) = result.space_warp.scale;
  of_all.offset(Eigen::all, moving) = result.space_warp.offset;
  result.space_warp = std::move(of_all);
  return result;
}

}  // namespace

IterativeMotionWarpingResult iterative_motion_warping(const Eigen::Ref<const FrameMatrix>& input,
                                                      const Eigen::Ref<const FrameMatrix>& output,
                                                      const IterativeMotionWarpingOptions& options) {
  detail::check_time_warp(input, output, options);
  check_options(options);
  const bool is_determined =
      !detail::is_constant(input, options.weights) && !detail::is_constant(output, options.weights);
  IterativeMotionWarpingResult result =
      is_determined ? solve(input, output, options) : Alternation(input, output, options).solve_evenly();
  result.correspondence = result.time_warp.correspondence();
  return result;
}

}  // namespace strut::align
