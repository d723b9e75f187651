// SPDX-License-Identifier: MIT
// One clip of paired signals as identification sees it, and the fit: how well a system's simulated output explains
// clips.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// One clip. A clip cut out of a longer recording carries the input that came before it as its lead-in: a simulation
/// starts there from rest, and the clip is fitted and judged only after it.
struct Experiment {
  FrameMatrix input;   ///< (frames x inputs), lead-in included
  FrameMatrix output;  ///< (frames x outputs); the lead-in's rows are ignored, but must be finite
  int lead_in = 0;     ///< rows at the start whose output is not known [frames]

  [[nodiscard]] int num_frames() const noexcept { return static_cast<int>(input.rows()); }
  /// Rows after the lead-in: those that count.
  [[nodiscard]] int num_fitted() const noexcept { return num_frames() - lead_in; }
};

/// Throws InvalidArgument unless there is an experiment, all have the same (positive) numbers of inputs and outputs, as
/// many rows of output as of input, at least one row after the lead-in, and finite numbers only.
void check_experiments(const std::vector<Experiment>& experiments);

/// Pools simulation errors over clips. The fit of one output is 100 (1 - |y - simulated| / |y - mean of y|) [%]: 100 is
/// perfect, 0 no better than the mean, and it may be negative.
class FitSum {
 public:
  explicit FitSum(int num_outputs);
  /// Adds the clip after its lead-in. `simulated` (frames x outputs) covers the lead-in too.
  void add(const Experiment& experiment, const FrameMatrix& simulated);
  /// The same of signals alone (frames x outputs).
  void add(const Eigen::Ref<const FrameMatrix>& wanted, const Eigen::Ref<const FrameMatrix>& simulated);
  /// The mean over outputs [%]; an output that does not vary counts only if none does: then 100 without error, else 0.
  [[nodiscard]] double fit() const;
  /// The fit of each output [%]; of one that does not vary 100 without error, else 0.
  [[nodiscard]] Eigen::VectorXd fit_per_output() const;

 private:
  [[nodiscard]] bool varies(Eigen::Index output) const;
  [[nodiscard]] double variation(Eigen::Index output) const;

  double frames_ = 0.0;
  Eigen::ArrayXd sum_, sum_squares_, sum_errors_;  // per output
};

/// The system's fit on all clips together, each simulated from rest [%].
double simulated_fit(const LtiSystem& system, const std::vector<Experiment>& experiments);

}  // namespace strut::sysid
