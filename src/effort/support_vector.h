// SPDX-License-Identifier: MIT
// Support vector regression with a Gaussian kernel, by LIBSVM (Drucker et al. 1997; Chang and Lin 2011): learnt there,
// evaluated here, so that what is stored is a few matrices.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/effort/effort_regression.h>

namespace strut::effort::detail {

/// How a support vector regression is learnt.
struct SupportVectorOptions {
  double cost = 1.0;   ///< C > 0
  double tube = 0.05;  ///< epsilon >= 0: errors below it count as none
  double gamma = 0.1;  ///< > 0: exp(-gamma |x - x'|^2)
};

/// `inputs` (examples x inputs), `targets` (examples): at least one, finite.
SupportVectors fit_support_vectors(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets,
                                   const SupportVectorOptions& options);

/// The best of a grid of options by the squared error of folds left out. `fold` (examples) from 0.
/// An example's `also_hidden` (-1: none) is a second fold that hides it from learning, though it is not judged there.
SupportVectorOptions choose_support_options(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets,
                                            const std::vector<int>& fold, const std::vector<int>& also_hidden);

/// (rows of inputs)
Eigen::VectorXd evaluate(const SupportVectors& support, const Eigen::MatrixXd& inputs);

/// What the paper's f sees of a blend: both ends' labels, alpha, postures and durations (blends x inputs).
Eigen::MatrixXd support_inputs(const EffortRegressionParts& parts, const std::vector<LabelledBlend>& blends);

}  // namespace strut::effort::detail
