// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/prefilter.h>

namespace strut::sysid {
namespace {

FrameMatrix filtered(const FrameMatrix& signal, double coefficient) {
  FrameMatrix out = signal;
  out.bottomRows(signal.rows() - 1) -= coefficient * signal.topRows(signal.rows() - 1);
  return out;
}

}  // namespace

std::vector<Experiment> prefilter(const std::vector<Experiment>& experiments, double coefficient) {
  check_experiments(experiments);
  if (!(coefficient >= 0.0 && coefficient < 1.0)) {
    throw InvalidArgument("coefficient", "0 or more and below 1", std::to_string(coefficient));
  }
  std::vector<Experiment> out;
  out.reserve(experiments.size());
  for (const Experiment& clip : experiments) {
    // Behind a lead-in the filter reads the output of the frame before, which is not known: one frame more is lost.
    const int lead_in = clip.lead_in + 1;
    const bool is_too_short = clip.num_frames() <= lead_in;
    if (is_too_short || coefficient == 0.0) {
      out.push_back(clip);
    } else {
      out.push_back({filtered(clip.input, coefficient), filtered(clip.output, coefficient), lead_in});
    }
  }
  return out;
}

double error_correlation(const LtiSystem& system, const std::vector<Experiment>& experiments) {
  constexpr double kMost = 0.98;
  Eigen::ArrayXd lagged = Eigen::ArrayXd::Zero(system.num_outputs());
  Eigen::ArrayXd power = lagged;
  for (const Experiment& clip : experiments) {
    const FrameMatrix error = (clip.output - simulate(system, clip.input)).bottomRows(clip.num_fitted());
    const Eigen::Index pairs = error.rows() - 1;
    lagged += (error.topRows(pairs).array() * error.bottomRows(pairs).array()).colwise().sum().transpose();
    power += error.colwise().squaredNorm().transpose().array();
  }
  const Eigen::ArrayXd each = (power > 0.0).select(lagged / power.max(1e-300), 0.0);
  return std::clamp(each.mean(), 0.0, kMost);
}

}  // namespace strut::sysid
