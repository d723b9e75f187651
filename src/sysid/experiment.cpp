// SPDX-License-Identifier: MIT
// Checking clips before they are identified from, and pooling the errors of simulations over clips.
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/experiment.h>

namespace strut::sysid {
namespace {

std::string shape(const FrameMatrix& matrix) {
  return std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
}

void check_experiment(const Experiment& experiment, const Experiment& first, const std::string& name) {
  const auto rows = std::to_string(experiment.input.rows()) + " x ";
  if (experiment.input.cols() != first.input.cols()) {
    throw InvalidArgument(name + ".input", rows + std::to_string(first.input.cols()), shape(experiment.input));
  }
  if (experiment.output.rows() != experiment.input.rows() || experiment.output.cols() != first.output.cols()) {
    throw InvalidArgument(name + ".output", rows + std::to_string(first.output.cols()), shape(experiment.output));
  }
  if (experiment.lead_in < 0 || experiment.num_fitted() < 1) {
    throw InvalidArgument(name + ".lead_in",
                          "0 or more, and fewer than the clip's " + std::to_string(experiment.num_frames()) + " frames",
                          std::to_string(experiment.lead_in));
  }
  if (!experiment.input.allFinite()) throw InvalidArgument(name + ".input", "finite numbers", "NaN or infinity");
  if (!experiment.output.allFinite()) throw InvalidArgument(name + ".output", "finite numbers", "NaN or infinity");
}

}  // namespace

void check_experiments(const std::vector<Experiment>& experiments) {
  if (experiments.empty()) throw InvalidArgument("experiments", "at least one clip", "none");
  const Experiment& first = experiments.front();
  if (first.input.cols() == 0) throw InvalidArgument("experiments[0].input", "at least one column", "none");
  if (first.output.cols() == 0) throw InvalidArgument("experiments[0].output", "at least one column", "none");
  for (std::size_t k = 0; k < experiments.size(); ++k) {
    check_experiment(experiments[k], first, "experiments[" + std::to_string(k) + "]");
  }
}

FitSum::FitSum(int num_outputs) : sum_(Eigen::ArrayXd::Zero(num_outputs)), sum_squares_(sum_), sum_errors_(sum_) {}

void FitSum::add(const Experiment& experiment, const FrameMatrix& simulated) {
  const auto wanted = experiment.output.bottomRows(experiment.num_fitted());
  const auto error = wanted - simulated.bottomRows(experiment.num_fitted());
  frames_ += experiment.num_fitted();
  sum_ += wanted.colwise().sum().transpose().array();
  sum_squares_ += wanted.colwise().squaredNorm().transpose().array();
  sum_errors_ += error.colwise().squaredNorm().transpose().array();
}

double FitSum::fit() const {
  constexpr double kVaries = 1e-12;  // of its mean square: less is the rounding of a constant
  double total = 0.0;
  int counted = 0;
  for (Eigen::Index k = 0; k < sum_.size(); ++k) {
    const double variation = sum_squares_[k] - sum_[k] * sum_[k] / frames_;
    if (!(variation > kVaries * sum_squares_[k])) continue;
    total += 100.0 * (1.0 - std::sqrt(sum_errors_[k] / variation));
    ++counted;
  }
  if (counted > 0) return total / counted;
  return (sum_errors_ <= kVaries * sum_squares_).all() ? 100.0 : 0.0;
}

double simulated_fit(const LtiSystem& system, const std::vector<Experiment>& experiments) {
  FitSum sum(system.num_outputs());
  for (const Experiment& experiment : experiments) sum.add(experiment, simulate(system, experiment.input));
  return sum.fit();
}

}  // namespace strut::sysid
