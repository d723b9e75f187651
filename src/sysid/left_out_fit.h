// SPDX-License-Identifier: MIT
// Private to identification: how well a system does on clips it was not learnt from.
#pragma once

#include <vector>

#include <strut/sysid/experiment.h>
#include <strut/sysid/identify.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid::detail {

/// The system's answers to a clip, one per start that `starts` asks for, without the lead-in: (fitted frames x
/// outputs).
std::vector<FrameMatrix> responses(const LtiSystem& system, const Experiment& clip, Starts starts);

/// Pools answers over clips; the fit is the mean over starts.
class LeftOutFit {
 public:
  LeftOutFit(int num_outputs, Starts starts);
  void add(const Experiment& clip, const std::vector<FrameMatrix>& answers);
  void add(const Experiment& clip, const LtiSystem& system) { add(clip, responses(system, clip, starts_)); }
  [[nodiscard]] double fit() const;

 private:
  Starts starts_;
  std::vector<FitSum> sums_;
};

}  // namespace strut::sysid::detail
