// SPDX-License-Identifier: MIT
// Checking clips before they are identified from, and pooling the errors of simulations over clips.
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/experiment.h>

namespace strut::sysid {
namespace {

constexpr double kVaries = 1e-12;  // of its mean square: less is the rounding of a constant

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
  add(experiment.output.bottomRows(experiment.num_fitted()), simulated.bottomRows(experiment.num_fitted()));
}

void FitSum::add(const Eigen::Ref<const FrameMatrix>& wanted, const Eigen::Ref<const FrameMatrix>& simulated) {
  const auto error = wanted - simulated;
  frames_ += static_cast<double>(wanted.rows());
  sum_ += wanted.colwise().sum().transpose().array();
  sum_squares_ += wanted.colwise().squaredNorm().transpose().array();
  sum_errors_ += error.colwise().squaredNorm().transpose().array();
}

double FitSum::variation(Eigen::Index output) const {
  return sum_squares_[output] - sum_[output] * sum_[output] / frames_;
}

bool FitSum::varies(Eigen::Index output) const {
  return variation(output) > kVaries * sum_squares_[output];
}

Eigen::VectorXd FitSum::fit_per_output() const {
  return Eigen::VectorXd::NullaryExpr(sum_.size(), [this](Eigen::Index k) {
    if (varies(k)) return 100.0 * (1.0 - std::sqrt(sum_errors_[k] / variation(k)));
    return sum_errors_[k] <= kVaries * sum_squares_[k] ? 100.0 : 0.0;
  });
}

double FitSum::fit() const {
  const Eigen::VectorXd fits = fit_per_output();
  double total = 0.0;
  int counted = 0;
  for (Eigen::Index k = 0; k < fits.size(); ++k) {
    if (!varies(k)) continue;
    total += fits[k];
    ++counted;
  }
  return counted > 0 ? total / counted : fits.minCoeff();
}

double simulated_fit(const LtiSystem& system, const std::vector<Experiment>& experiments) {
  FitSum sum(system.num_outputs());
  for (const Experiment& experiment : experiments) sum.add(experiment, simulate(system, experiment.input));
  return sum.fit();
}

}  // namespace strut::sysid
