// SPDX-License-Identifier: MIT
// Clips seen through a filter that makes their error white: what generalized least squares does about noise that
// drifts.
#pragma once

#include <vector>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// The clips with s[t] - coefficient s[t-1] for every input and output s. A linear system answers filtered inputs with
/// filtered outputs, so that any method finds the same system in them, but with another weight on its errors: slow ones
/// count less (Ljung 1999, section 7.4; for the regression, Cochrane and Orcutt 1949). The first frame of a clip keeps
/// what the filter does not know and becomes part of its lead-in; a clip of one frame stays as it is.
/// `coefficient` in [0, 1); throws InvalidArgument as check_experiments does, or if it is out of range.
std::vector<Experiment> prefilter(const std::vector<Experiment>& experiments, double coefficient);

/// The correlation of the simulation's error (each clip from rest) with itself a frame later, over all outputs at their
/// own scale: 0 (also for negative ones) to 0.98, where a filter would leave nothing.
double error_correlation(const LtiSystem& system, const std::vector<Experiment>& experiments);

}  // namespace strut::sysid
