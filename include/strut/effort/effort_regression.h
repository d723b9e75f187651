// SPDX-License-Identifier: MIT
// Predicts how a blend of two labelled fragments would be labelled (Torresani, Hackney, Bregler 2006, Eq. 1):
// e = f(X_i, X_j, e_i, e_j, alpha), with an uncertainty.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort.h>
#include <strut/math/frame_matrix.h>

namespace strut::effort {

/// What regression knows of a fragment.
struct LabelledFragment {
  FrameMatrix features;  ///< joint positions, as matching sees them (frames x dims), frames at kFeatureRate
  EffortVector effort;   ///< its own label; kNotRated where a factor was left out
  int group = 0;         ///< of like content
};

/// A labelled blend: what a person saw and said.
struct LabelledBlend {
  int first = 0, second = 0;  ///< indices of fragments, of one group
  double alpha = 0.0;         ///< 0: the first, 1: the second
  EffortVector effort;        ///< kNotRated where a factor was left out
};

/// What is predicted of a blend.
struct EffortPrediction {
  EffortVector effort;     ///< mean
  EffortVector deviation;  ///< standard deviation of a label of it, >= 0; kNotRated where the method gives none
};

enum class RegressionMethod {
  kLinearLabels,         ///< (1 - alpha) e_i + alpha e_j: the baseline
  kNearestEnd,           ///< the label of the nearer end: the baseline
  kSupportVector,        ///< epsilon-SVR with a Gaussian kernel on everything, as the paper has it
  kLinearPlusResidual,   ///< linear labels plus a learnt residual with a variance: the default
};

struct RegressionOptions {
  RegressionMethod method = RegressionMethod::kLinearPlusResidual;
  int num_components = 8;  ///< principal components of posture per fragment
  int num_poses = 15;      ///< resampled poses per fragment
};

/// A fitted f. Immutable; const calls are thread-safe.
class EffortRegression;

}  // namespace strut::effort
