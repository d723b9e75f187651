// SPDX-License-Identifier: MIT
// Everything that putting an Effort on a motion needs: the labelled fragments, which of them can be blended, and how
// their labels carry over to blends. Made by learn_effort, kept in a .struteffort file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// A fragment as a model holds it.
struct ModelFragment {
  std::string name;     ///< clip and frames it is from, for reports
  int group = 0;        ///< of like content, from 0
  Motion motion;        ///< on the model's skeleton, at the model's frame rate
  EffortVector effort;  ///< mean of the raters' labels
};

}  // namespace strut::effort
