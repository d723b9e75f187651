// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

using Signals = Eigen::Ref<const FrameMatrix>;

void check_options(const IterativeMotionWarpingOptions& options) {
  if (options.max_rounds < 1) throw InvalidArgument("max_rounds", "at least 1", std::to_string(options.max_rounds));
  if (!(options.tolerance >= 0.0)) {
    throw InvalidArgument("tolerance", "a number that is not negative", std::to_string(options.tolerance));
  }
}

/// The sum over frames of squared first differences, per degree of freedom.
Eigen::VectorXd roughness(const FrameMatrix& curves) {
  const Eigen::Index steps = curves.rows() - 1;
  return (curves.bottomRows(steps) - curves.topRows(steps)).colwise().squaredNorm().transpose();
}

/// Equation 1, summed over the weighted degrees of freedom.
double objective(const FrameMatrix& warped, const Signals& output, const std::vector<int>& repetitions,
                 const SpaceWarp& space, const IterativeMotionWarpingOptions& options) {
  Eigen::VectorXd error = options.space.scale_smoothness * roughness(space.scale) +
                          options.space.offset_smoothness * roughness(space.offset);
  int slot = 0;
  for (Eigen::Index t = 0; t < warped.rows(); ++t) {
    const int end = slot + repetitions[static_cast<std::size_t>(t)];
    for (; slot < end; ++slot)
      error += (warped.row(t) - output.row(slot / options.slope_limit)).cwiseAbs2().transpose();
  }
  return options.weights.size() == 0 ? error.sum() : error.dot(options.weights);
}

}  // namespace

IterativeMotionWarpingResult iterative_motion_warping(const Eigen::Ref<const FrameMatrix>& input,
                                                      const Eigen::Ref<const FrameMatrix>& output,
                                                      const IterativeMotionWarpingOptions& options) {
  check_options(options);
  IterativeMotionWarpingResult result;
  FrameMatrix warped = input;  // a = 1, b = 0
  for (int round = 0; round < options.max_rounds; ++round) {
    std::vector<int> repetitions = time_warp(warped, output, options.slope_limit, options.weights);
    if (repetitions == result.repetitions) break;  // the same time warp has the same best space warp
    SpaceWarp space = space_warp(input, output, repetitions, options.slope_limit, options.space);
    warped = space.apply(input);
    const double after = objective(warped, output, repetitions, space, options);
    const double before = round == 0 ? 0.0 : result.objective.back();
    if (round > 0 && after >= before) break;
    result.objective.push_back(after);
    result.repetitions = std::move(repetitions);
    result.space_warp = std::move(space);
    if (round > 0 && before - after <= options.tolerance * before) break;
  }
  result.correspondence = from_repetitions(result.repetitions, options.slope_limit);
  return result;
}

}  // namespace strut::align
