// SPDX-License-Identifier: MIT
// Predicts how a blend of two labelled fragments would be labelled (Torresani, Hackney, Bregler 2006, Eq. 1):
// e = f(X_i, X_j, e_i, e_j, alpha), with an uncertainty. A fitted f is a plain struct of numbers
// (EffortRegressionParts), for files, and the class that predicts from it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/core/diagnostics.h>
#include <strut/effort/effort.h>
#include <strut/math/frame_matrix.h>

namespace strut::effort {

/// What regression knows of a fragment.
struct LabelledFragment {
  FrameMatrix features;  ///< joint positions, as matching sees them (frames x dims), frames at kFeatureRate
  EffortVector effort = EffortVector::Constant(kNotRated);  ///< its own label; kNotRated where a factor was left out
  int group = 0;                                            ///< of like content, from 0
};

/// A labelled blend: what a person saw and said.
struct LabelledBlend {
  int first = 0, second = 0;  ///< indices of fragments, of one group
  double alpha = 0.0;         ///< 0: the first, 1: the second; within [kLeastAlpha, kLargestAlpha]
  EffortVector effort = EffortVector::Constant(kNotRated);  ///< kNotRated where a factor was left out
};

/// Two fragments to blend.
struct FragmentPair {
  int first = 0, second = 0;
  friend bool operator==(const FragmentPair&, const FragmentPair&) = default;
};

/// What is predicted of a blend.
struct EffortPrediction {
  EffortVector effort;     ///< mean; kNotRated where one of the fragments is not rated
  EffortVector deviation;  ///< standard deviation of a label of it, >= 0; kNotRated where the method gives none
};

enum class RegressionMethod {
  kLinearLabels,        ///< (1 - alpha) e_i + alpha e_j: the baseline
  kNearestEnd,          ///< the label of the nearer end: the baseline
  kSupportVector,       ///< epsilon-SVR with a Gaussian kernel on everything, as the paper has it; no deviation
  kLinearPlusResidual,  ///< linear labels plus a learnt residual with a variance: the default
};
inline constexpr int kNumRegressionMethods = 4;
/// "linear", "nearest", "svr", "residual": as reports and options call them, in the order of RegressionMethod.
inline constexpr std::array<const char*, kNumRegressionMethods> kRegressionMethodNames = {"linear", "nearest", "svr",
                                                                                          "residual"};

struct RegressionOptions {
  RegressionMethod method = RegressionMethod::kLinearPlusResidual;
  int num_components = 8;       ///< principal components of posture per fragment, >= 1
  int num_poses = 15;           ///< resampled poses per fragment, >= 2
  bool uses_kinematics = true;  ///< whether the residual sees how fast blends of the curves would move
};

/// Of the residual of one factor: standard deviations of its parts as they were before any blend was seen, and how far
/// each part reaches. The defaults are what holds with few labels.
struct ResidualSettings {
  double kinematics = 0.5;     ///< deviation of the weights of the kinematic terms
  double labels = 0.15;        ///< deviation of what depends on the ends' labels and alpha
  double posture = 0.05;       ///< deviation of what depends on posture too, and does not carry over to other content
  double noise = 0.1;          ///< deviation of a label of the same movement, > 0
  double misfit = 0.08;        ///< deviation at alpha = 1/2 of what nothing here explains
  double label_reach = 0.8;    ///< difference of labels that makes blends unlike, > 0
  double alpha_reach = 0.7;    ///< difference of alpha that does, > 0
  double posture_reach = 3.0;  ///< distance in posture that does [deviations], > 0
  double calibration = 1.0;    ///< what deviations are multiplied by to cover what was left out, > 0
};

/// A support vector regression of one factor: offset + sum_m coefficient_m exp(-gamma |x - x_m|^2).
struct SupportVectors {
  Eigen::MatrixXd inputs;        ///< (vectors x inputs), scaled
  Eigen::VectorXd coefficients;  ///< (vectors)
  double offset = 0.0;
  double gamma = 1.0;  ///< > 0
};

/// A fitted f as numbers: what was seen of the fragments and the blends, and what was chosen for every factor.
struct EffortRegressionParts {
  RegressionMethod method = RegressionMethod::kLinearPlusResidual;
  Eigen::MatrixXd effort;    ///< of fragments; NaN where not rated (fragments x 3)
  Eigen::VectorXi group;     ///< (fragments)
  Eigen::VectorXd duration;  ///< > 0 [s] (fragments)
  Eigen::MatrixXd posture;   ///< components of resampled poses, in deviations (fragments x components)
  Eigen::MatrixXd curves;    ///< paths through the main postures, evenly resampled, a point's coordinates together [m]
                             ///< (fragments x kCurvePoints dimensions); no columns: no kinematics
  std::vector<LabelledBlend> blends;                            ///< what residuals are learnt from
  std::array<ResidualSettings, kNumPredictedFactors> residual;  ///< kLinearPlusResidual, kLinearLabels
  std::array<SupportVectors, kNumPredictedFactors> support;     ///< kSupportVector
};

inline constexpr int kCurvePoints = 32;  ///< points of EffortRegressionParts::curves

/// A fitted f. Immutable; const calls are thread-safe; copies share.
class EffortRegression {
 public:
  /// From its numbers. Throws InvalidArgument if a size, an index or a number is out of range. Cost: with n blends
  /// and m = min(n, 400), O(n m^2).
  explicit EffortRegression(EffortRegressionParts parts);

  [[nodiscard]] const EffortRegressionParts& parts() const noexcept;
  [[nodiscard]] int num_fragments() const noexcept;

  /// Of the blends of one pair at all `alphas`: exact at 0 and 1 but for SVR, and the same for (i, j, a) as for
  /// (j, i, 1 - a). Predictions may lie a little outside [-1, 1].
  /// Throws InvalidArgument if an index or an alpha is out of range.
  [[nodiscard]] std::vector<EffortPrediction> predict(int first, int second,
                                                      const Eigen::Ref<const Eigen::VectorXd>& alphas) const;

  /// The means alone, for many pairs: a matrix per factor (pairs x alphas), what Eq. 2 searches. Several threads.
  /// Throws as the above. Cost O(pairs blends (inputs + alphas)).
  [[nodiscard]] std::array<Eigen::MatrixXd, kNumPredictedFactors> predict(
      const std::vector<FragmentPair>& pairs, const Eigen::Ref<const Eigen::VectorXd>& alphas) const;

  /// What is still unknown of blends, before a rater's noise: covariance (blends x blends) of their residuals in one
  /// factor. Only `first`, `second` and `alpha` are read. Zero unless the method is kLinearPlusResidual.
  [[nodiscard]] Eigen::MatrixXd covariance(const std::vector<LabelledBlend>& blends, Factor factor) const;

  /// Variance of a label of each of the blends around what is learnt: the raters' noise and what nothing explains.
  [[nodiscard]] Eigen::VectorXd label_variance(const std::vector<LabelledBlend>& blends, Factor factor) const;

 private:
  struct Fitted;
  std::shared_ptr<const Fitted> fitted_;
};

/// Mean of several raters' labels, factor by factor; kNotRated where none rated one.
EffortVector mean_rating(const std::vector<EffortVector>& ratings);

/// Learns f, every factor by itself from the blends that are rated in it and whose fragments are. Blends that occur
/// several times (several raters) count once, with the mean of their labels. Works with no labelled blend: then f is
/// linear labels with the deviation of the defaults, and a note says so.
/// Throws InvalidArgument if there is no fragment, one has no frame or other columns than the first, a number is not
/// finite, a label is outside [-1, 1], an index or alpha is out of range, or the fragments of a blend are not of one
/// group. Cost for 2,000 blends: seconds.
EffortRegression fit_effort_regression(const std::vector<LabelledFragment>& fragments,
                                       const std::vector<LabelledBlend>& blends, const RegressionOptions& options = {},
                                       Diagnostics* diagnostics = nullptr);

}  // namespace strut::effort
