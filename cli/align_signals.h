// SPDX-License-Identifier: MIT
// What an alignment looks at, as a person asks for it: signals of the clips, what each of them counts, and what they
// are called.
#pragma once

#include "alignment.h"

#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/representation/representation.h>

namespace strut::cli {

/// Signals of clips of one hierarchy and frame rate.
struct AlignSignals {
  std::vector<FrameMatrix> clips;  ///< of every clip (frames x signals)
  Eigen::VectorXd weights;         ///< what each counts (signals); empty: all the same
};

/// The signals of `clips`, each in its own units, or in shared ones if the options say so (two clips only), weighted as
/// the options say. Throws InvalidArgument for options that do not fit, and BadInput, naming a clip, if nothing moves
/// in it.
AlignSignals signals_of(const std::vector<const AlignClip*>& clips, SignalSet set, const AlignOptions& options);

/// As on the command line.
const char* signals_name(SignalSet set);

/// "57 degrees of freedom", or how many signals of what.
std::string signals_in_words(SignalSet set, int num_compared);

/// The degree of freedom called `name`: its own name or its joint's; then of the joint's the one for which `rank`
/// (dofs) is highest. Throws InvalidArgument for `option`, with all names, if there is none.
int find_dof(const std::string& option, const representation::Representation& shape, const std::string& name,
             const Eigen::VectorXd& rank);

}  // namespace strut::cli
