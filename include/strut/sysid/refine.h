// SPDX-License-Identifier: MIT
// Levenberg-Marquardt refinement of a system on its simulation error: all of A, B, C and D, from an identified start.
#pragma once

#include <vector>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

struct RefineOptions {
  int max_iterations = 30;    ///< steps tried at most, taken or not
  double max_radius = 0.999;  ///< A's eigenvalues stay within this modulus, above 0 and below 1
  double tolerance = 1e-6;    ///< stop when a step lowers the error by less than this share of it
  bool from_rest = false;     ///< every clip is simulated from rest, instead of with its initial state fitted along
};

struct Refined {
  LtiSystem system;
  double initial_error = 0.0;  ///< share of the outputs' power that the start leaves, mean over outputs
  double error = 0.0;          ///< the same of `system`; never larger
  int iterations = 0;          ///< steps tried
};

/// The system of the same order near `system` whose simulated output fits the clips best in the least squares sense,
/// outputs weighted by the inverse of their power: output-error estimation (Ljung 1999, section 7.3).
///
/// Steps are Levenberg-Marquardt's (damping as in Madsen, Nielsen and Tingleff 2004) in the directions that are no mere
/// change of the states' coordinates (data driven local coordinates: McKelvey, Helmersson and Ribarits 2004), with
/// analytic derivatives. A clip's initial state is fitted along (by variable projection) unless its lead-in forgets it
/// (forgets_initial_state) or `from_rest` is set. Eigenvalues that a step takes beyond `max_radius` are drawn back, and
/// a step is taken only if it lowers the error, so that every system on the way is stable. A local minimum: as good as
/// the start. A system without states gets D by the same steps.
///
/// Throws InvalidArgument as check_experiments does, for options out of range, or if the widths do not agree. Cost per
/// step frames x outputs x parameters^2, parameters = states^2 + (states + outputs) x inputs + outputs x states.
Refined refine_system(const LtiSystem& system, const std::vector<Experiment>& experiments,
                      const RefineOptions& options = {});

}  // namespace strut::sysid
