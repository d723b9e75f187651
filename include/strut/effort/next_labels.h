// SPDX-License-Identifier: MIT
// Which blends a person should look at next: those whose labels would lower the expected error of all blends the most
// (A-optimal design; Krause, Singh and Guestrin 2008; Settles 2009).
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort_regression.h>

namespace strut::effort {

/// Which blends are asked about, and how many.
struct NextLabelOptions {
  int count = 10;                                               ///< >= 1
  EffortVector weights = EffortVector::Ones();                  ///< what an error in each factor counts, >= 0
  std::vector<double> alphas = {-0.25, 0.25, 0.5, 0.75, 1.25};  ///< that candidate_blends offers
  int max_candidates = 1200;                                    ///< evenly taken from all, >= 1
};

/// A blend worth labelling.
struct SuggestedBlend {
  int first = 0, second = 0;
  double alpha = 0.0;
  EffortPrediction expected;  ///< of its label, before it is labelled
  /// By how much its label lowers the expected mean squared error over all candidates, given the labels of those
  /// suggested before it, weighted over factors [label^2].
  double gain = 0.0;
};

/// All pairs at all alphas, or options.max_candidates spread evenly over them. Pairs of fragments that are rated in no
/// common factor are left out, and blends that `regression` has learnt from.
std::vector<LabelledBlend> candidate_blends(const EffortRegression& regression, const std::vector<FragmentPair>& pairs,
                                            const NextLabelOptions& options = {});

/// Up to options.count of `candidates`, best first: one after another the one that, with those before it, leaves least
/// variance in all of them. What a label is does not matter to that, only where it is. No pair twice, and no group
/// more than twice its share. Fewer where candidates run out; none if the regression has no variance.
/// Throws InvalidArgument if an index, an alpha or an option is out of range. Deterministic; equal gains go to the
/// earlier candidate. Cost O(candidates^2 (labelled blends + count)).
std::vector<SuggestedBlend> next_labels(const EffortRegression& regression,
                                        const std::vector<LabelledBlend>& candidates,
                                        const NextLabelOptions& options = {});

}  // namespace strut::effort
