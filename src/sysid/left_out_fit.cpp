// SPDX-License-Identifier: MIT
#include "sysid/left_out_fit.h"

#include <cmath>

#include <strut/sysid/initial_state.h>

namespace strut::sysid::detail {
namespace {

/// The answer from the state that fits the clip best, its error made larger by as much as fitting `states` numbers made
/// it smaller than it would be on data that they were not fitted to: Akaike's (1969) final prediction error.
FrameMatrix best_started(const LtiSystem& system, const Experiment& clip) {
  const FrameMatrix answer = simulate(system, clip.input, estimate_initial_state(system, clip));
  const auto numbers = static_cast<double>(clip.output.size());
  const double fitted = system.num_states();
  if (numbers <= fitted) return simulate(system, clip.input);
  return clip.output - std::sqrt((numbers + fitted) / (numbers - fitted)) * (clip.output - answer);
}

}  // namespace

std::vector<FrameMatrix> responses(const LtiSystem& system, const Experiment& clip, Starts starts) {
  std::vector<FrameMatrix> answers;
  answers.emplace_back(simulate(system, clip.input).bottomRows(clip.num_fitted()));
  if (starts == Starts::kLeadIn) return answers;
  const Experiment bare{clip.input.bottomRows(clip.num_fitted()), clip.output.bottomRows(clip.num_fitted())};
  answers.push_back(clip.lead_in == 0 ? answers.front() : simulate(system, bare.input));
  answers.push_back(best_started(system, bare));
  return answers;
}

LeftOutFit::LeftOutFit(int num_outputs, Starts starts)
    : starts_(starts), sums_(starts == Starts::kLeadIn ? 1 : 3, FitSum(num_outputs)) {}

void LeftOutFit::add(const Experiment& clip, const std::vector<FrameMatrix>& answers) {
  for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k].add(clip, answers[k]);
}

double LeftOutFit::fit() const {
  double total = 0.0;
  for (const FitSum& sum : sums_) total += sum.fit();
  return total / static_cast<double>(sums_.size());
}

}  // namespace strut::sysid::detail
