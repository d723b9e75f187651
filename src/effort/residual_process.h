// SPDX-License-Identifier: MIT
// The residual of linear labels in one factor as a Gaussian process over blends: a linear part in the kinematic terms
// and two Gaussian kernels, one on the ends' labels (which carries over to other content) and one on posture too (which
// does not). All are 0 at alpha = 0 and 1, symmetric in (i, j, a) = (j, i, 1 - a), and have mean 0 before any blend is
// seen, so that an unfamiliar blend gets linear labels (Rasmussen and Williams 2006, chapters 2 and 5).
#pragma once

#include "effort/blend_inputs.h"

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace strut::effort::detail {

/// The prior's covariance between blends.
class ResidualKernel {
 public:
  ResidualKernel(const BlendInputs& inputs, int factor, const ResidualSettings& settings);

  /// (rows x columns)
  [[nodiscard]] Eigen::MatrixXd between(const std::vector<LabelledBlend>& rows, const Eigen::MatrixXd& row_terms,
                                        const std::vector<LabelledBlend>& columns,
                                        const Eigen::MatrixXd& column_terms) const;
  /// Variance of a label around the residual: the raters' noise, of the blend's own label and of its ends', and misfit.
  [[nodiscard]] Eigen::VectorXd label_variance(const std::vector<LabelledBlend>& blends) const;

  [[nodiscard]] const BlendInputs& inputs() const noexcept { return inputs_; }
  [[nodiscard]] const ResidualSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] int factor() const noexcept { return factor_; }

 private:
  const BlendInputs& inputs_;
  int factor_;
  ResidualSettings settings_;
};

/// The process given labelled blends.
class ResidualProcess {
 public:
  /// `inputs` outlives this. Uses the blends that are rated in `factor` and whose fragments are.
  ResidualProcess(const BlendInputs& inputs, int factor, const ResidualSettings& settings,
                  const std::vector<LabelledBlend>& blends);

  [[nodiscard]] Eigen::VectorXd mean(const std::vector<LabelledBlend>& blends) const;
  /// Posterior covariance of the residuals (blends x blends).
  [[nodiscard]] Eigen::MatrixXd covariance(const std::vector<LabelledBlend>& blends) const;
  /// Its diagonal (blends).
  [[nodiscard]] Eigen::VectorXd variance(const std::vector<LabelledBlend>& blends) const;
  [[nodiscard]] Eigen::VectorXd label_variance(const std::vector<LabelledBlend>& blends) const {
    return kernel_.label_variance(blends);
  }
  /// Means of all blends of pairs at alphas (pairs x alphas): as mean(), by matrix products.
  [[nodiscard]] Eigen::MatrixXd mean(const FragmentPair* pairs, Eigen::Index count,
                                     const Eigen::Ref<const Eigen::VectorXd>& alphas) const;

 private:
  ResidualKernel kernel_;
  std::vector<LabelledBlend> blends_;
  Eigen::MatrixXd terms_;            // (blends x terms)
  Eigen::LLT<Eigen::MatrixXd> llt_;  // of the labels' covariance
  Eigen::VectorXd weights_;          // its inverse times the residuals
  Eigen::VectorXd term_weights_;     // what the kinematic terms are multiplied by
};

/// The blends rated in `factor`, whose fragments are rated too.
std::vector<LabelledBlend> rated_blends(const BlendInputs& inputs, int factor,
                                        const std::vector<LabelledBlend>& blends);

/// Label minus linear labels (blends).
Eigen::VectorXd residuals(const BlendInputs& inputs, int factor, const std::vector<LabelledBlend>& blends);

/// Chooses a factor's settings: marginal likelihood plus the predictive density of fragments and of groups left out.
/// `is_linear`: for linear labels alone, whose residual is all noise and misfit. Deterministic.
ResidualSettings choose_settings(const BlendInputs& inputs, int factor, const std::vector<LabelledBlend>& blends,
                                 bool is_linear);

}  // namespace strut::effort::detail
