// SPDX-License-Identifier: MIT
// Bilinear models of two factors, style and content (Tenenbaum, Freeman 2000, "Separating style and content with
// bilinear models", Neural Computation 12): from observations of some styles with some contents to what any style looks
// like with any content. Contents are given by coordinates: one-hot for contents that are just names, as in the paper,
// or functions of something continuous, such as polynomials of a speed; then no two styles need a content in common.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace strut::blend {

/// What one style looks like with one content.
struct BilinearObservation {
  int style = 0;            ///< from 0
  Eigen::VectorXd content;  ///< the content's coordinates (P)
  Eigen::VectorXd values;   ///< y (K)
  double weight = 1.0;      ///< of its squared error, > 0
};

/// How a model is fitted.
struct BilinearOptions {
  double ridge = 1e-6;       ///< pulls the way a style changes with content towards the mean style's: as strong as so
                             ///< many observations that the mean style has made; > 0 settles what few observations
                             ///< leave open. What sets a style apart whatever the content is hardly pulled
  int max_rounds = 500;      ///< of alternating least squares
  double tolerance = 1e-10;  ///< stop when a round lowers the objective by less than this share of it
};

/// A fitted model: style s with content coordinates p looks like coefficients[s] * p.
struct BilinearModel {
  std::vector<Eigen::MatrixXd> coefficients;  ///< per style (K x P); A^s B
  Eigen::MatrixXd contents;                   ///< B: content dimensions from coordinates (J x P)
  std::vector<double> objective;              ///< after each round, never rises
  bool converged = false;                     ///< whether the tolerance was reached within max_rounds
};

/// The asymmetric model y = A^s b (Equation 2 there): a matrix per style over `content_dims` (J) content dimensions,
/// b = B p. Over a complete grid of styles and contents this is the closed form, the singular value decomposition of
/// the styles' stacked coefficients; otherwise alternating least squares go on from there. Throws InvalidArgument if
/// there is no observation, a style has none, J is outside 1 ... P, sizes differ, or a number is not finite, a weight
/// or the ridge not positive. Cost per round O(styles (K J P + (J P)^2)) + O((J P)^3).
BilinearModel fit_asymmetric(const std::vector<BilinearObservation>& observations, int num_styles, int content_dims,
                             const BilinearOptions& options = {});

/// The symmetric model y = sum_ij w_ij a_i^s b_j (Equation 1 there): a vector of `style_dims` (I) per style on basis
/// functions that all styles share. Iterated singular value decomposition gives the start; alternating least squares
/// over weights, styles and contents go on. I = number of styles is the asymmetric model.
/// Throws as fit_asymmetric, and if I is outside 1 ... styles. Cost per round O(n K I J + (K I J) ...), small.
BilinearModel fit_symmetric(const std::vector<BilinearObservation>& observations, int num_styles, int style_dims,
                            int content_dims, const BilinearOptions& options = {});

}  // namespace strut::blend
