// SPDX-License-Identifier: MIT
// From labelled fragments and blends to the numbers of a fitted f: postures reduced to principal components, repeated
// labels averaged, settings chosen per factor.
#include "effort/blend_inputs.h"
#include "effort/residual_process.h"
#include "effort/support_vector.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/effort_regression.h>
#include <strut/effort/fragment_features.h>
#include <strut/math/sampling.h>

namespace strut::effort {
namespace {

constexpr Eigen::Index kCurveDimensions = 12;  // main postures that curves run through
constexpr double kNoVariance = 1e-12;          // of a component, of the first's
constexpr int kSupportFolds = 3;               // of fragments, to choose the options of SVR by

std::string fragment_text(std::size_t i) {
  return "fragment " + std::to_string(i);
}

void check_label(const std::string& where, const EffortVector& effort) {
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    if (is_rated(effort[d]) && !(std::abs(effort[d]) <= 1.0)) {
      throw InvalidArgument(where, InvalidArgument(kFactorNames[static_cast<std::size_t>(d)], "a label from -1 to 1",
                                                   std::to_string(effort[d])));
    }
  }
}

void check(const std::vector<LabelledFragment>& fragments) {
  if (fragments.empty()) throw InvalidArgument("fragments", "at least one", "none");
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const FrameMatrix& features = fragments[i].features;
    if (features.size() == 0) throw InvalidArgument(fragment_text(i), "at least one frame", "none");
    if (features.cols() != fragments.front().features.cols()) {
      throw InvalidArgument(fragment_text(i), std::to_string(fragments.front().features.cols()) + " features",
                            std::to_string(features.cols()));
    }
    if (!features.allFinite()) throw InvalidArgument(fragment_text(i), "finite numbers", "NaN or infinity");
    check_label(fragment_text(i), fragments[i].effort);
  }
}

void check(const std::vector<LabelledBlend>& blends, const std::vector<LabelledFragment>& fragments) {
  const int count = static_cast<int>(fragments.size());
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const LabelledBlend& blend = blends[n];
    const std::string where = "blend " + std::to_string(n);
    for (const int i : {blend.first, blend.second}) {
      if (i < 0 || i >= count) {
        throw InvalidArgument(where, "fragments from 0 to " + std::to_string(count - 1), std::to_string(i));
      }
    }
    if (fragments[static_cast<std::size_t>(blend.first)].group !=
        fragments[static_cast<std::size_t>(blend.second)].group) {
      throw InvalidArgument(where, "fragments of one group",
                            std::to_string(blend.first) + " and " + std::to_string(blend.second));
    }
    if (!(blend.alpha >= kLeastAlpha && blend.alpha <= kLargestAlpha)) {
      throw InvalidArgument(where, "an alpha from -2 to 3", std::to_string(blend.alpha));
    }
    check_label(where, blend.effort);
  }
}

void check(const RegressionOptions& options) {
  if (options.num_components < 1) {
    throw InvalidArgument("num_components", "at least 1", std::to_string(options.num_components));
  }
  if (options.num_poses < 2) throw InvalidArgument("num_poses", "at least 2", std::to_string(options.num_poses));
}

/// `count` evenly spaced frames, first and last included, one after the other (frames x features).
FrameMatrix evenly(const FrameMatrix& features, int count) {
  const double last = static_cast<double>(features.rows() - 1);
  return math::sample_rows(features, Eigen::VectorXd::LinSpaced(count, 0.0, last));
}

Eigen::RowVectorXd in_a_row(const FrameMatrix& frames) {
  return Eigen::Map<const Eigen::RowVectorXd>(frames.data(), frames.size());
}

/// The rows' coordinates along their principal components, most variance first, all divided by the deviation of the
/// first (rows x at most `count`). By the Gram matrix: rows are few and long.
Eigen::MatrixXd principal_coordinates(Eigen::MatrixXd rows, int count) {
  const Eigen::RowVectorXd mean = rows.colwise().mean();
  rows.rowwise() -= mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rows * rows.transpose());
  const Eigen::Index found = std::min<Eigen::Index>(count, rows.rows());
  const double most = solver.eigenvalues()[rows.rows() - 1];
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows.rows(), count);
  if (!(most > 0.0)) return result;
  for (Eigen::Index k = 0; k < found; ++k) {
    const Eigen::Index column = rows.rows() - 1 - k;
    const double value = solver.eigenvalues()[column];
    if (value < kNoVariance * most) break;
    Eigen::VectorXd direction = solver.eigenvectors().col(column);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0.0) direction = -direction;  // an eigenvector's sign is no one's choice
    result.col(k) = direction * std::sqrt(value / most * static_cast<double>(rows.rows()));
  }
  return result;
}

Eigen::MatrixXd posture_of(const std::vector<LabelledFragment>& fragments, const RegressionOptions& options) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(fragments.size()),
                       options.num_poses * fragments.front().features.cols());
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = in_a_row(evenly(fragments[i].features, options.num_poses));
  }
  return principal_coordinates(std::move(rows), options.num_components);
}

/// Every fragment's path through the main postures of all (fragments x kCurvePoints dimensions).
Eigen::MatrixXd curves_of(const std::vector<LabelledFragment>& fragments) {
  std::vector<FrameMatrix> paths;
  for (const LabelledFragment& fragment : fragments) paths.push_back(evenly(fragment.features, kCurvePoints));
  const Eigen::Index width = paths.front().cols();
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(width, width);
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(width);
  for (const FrameMatrix& path : paths) mean += path.colwise().mean() / static_cast<double>(paths.size());
  for (const FrameMatrix& path : paths) scatter += (path.rowwise() - mean).transpose() * (path.rowwise() - mean);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scatter);
  const Eigen::MatrixXd components = solver.eigenvectors().rightCols(std::min(kCurveDimensions, width));
  Eigen::MatrixXd result(static_cast<Eigen::Index>(paths.size()), kCurvePoints * components.cols());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    result.row(static_cast<Eigen::Index>(i)) = in_a_row((paths[i].rowwise() - mean) * components);
  }
  return result;
}

/// A blend once, with the mean of its labels; (j, i, 1 - a) counts as (i, j, a). In order of first occurrence.
std::vector<LabelledBlend> merged(const std::vector<LabelledBlend>& blends) {
  std::map<std::tuple<int, int, double>, std::size_t> places;
  std::vector<LabelledBlend> result;
  std::vector<std::vector<EffortVector>> ratings;
  for (const LabelledBlend& blend : blends) {
    const bool is_turned = blend.first > blend.second;
    const auto key = is_turned ? std::tuple{blend.second, blend.first, 1.0 - blend.alpha}
                               : std::tuple{blend.first, blend.second, blend.alpha};
    const auto [place, is_new] = places.try_emplace(key, result.size());
    if (is_new) {
      result.push_back(blend);
      ratings.emplace_back();
    }
    ratings[place->second].push_back(blend.effort);
  }
  for (std::size_t n = 0; n < result.size(); ++n) result[n].effort = mean_rating(ratings[n]);
  return result;
}

SupportVectors fit_support(const EffortRegressionParts& parts, int factor) {
  const detail::BlendInputs inputs(parts);
  std::vector<LabelledBlend> rated = detail::rated_blends(inputs, factor, parts.blends);
  if (rated.empty()) return {};
  Eigen::VectorXd targets(static_cast<Eigen::Index>(rated.size()));
  std::vector<int> fold, other;
  for (std::size_t n = 0; n < rated.size(); ++n) {
    targets[static_cast<Eigen::Index>(n)] = rated[n].effort[factor];
    fold.push_back(rated[n].first % kSupportFolds);
    other.push_back(rated[n].second % kSupportFolds);
  }
  const Eigen::MatrixXd seen = detail::support_inputs(parts, rated);
  return detail::fit_support_vectors(seen, targets, detail::choose_support_options(seen, targets, fold, other));
}

void report(const EffortRegressionParts& parts, Diagnostics* diagnostics) {
  const bool learns =
      parts.method == RegressionMethod::kLinearPlusResidual || parts.method == RegressionMethod::kSupportVector;
  if (diagnostics == nullptr || !learns) return;
  const detail::BlendInputs inputs(parts);
  std::string factors;
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    if (!detail::rated_blends(inputs, d, parts.blends).empty()) continue;
    factors += (factors.empty() ? "" : ", ") + std::string(kFactorNames[static_cast<std::size_t>(d)]);
  }
  if (factors.empty()) return;
  diagnostics->note("regression",
                    "no labelled blend of " + factors +
                        (parts.method == RegressionMethod::kSupportVector
                             ? ": the prediction is 0"
                             : ": labels carry over linearly, with a deviation that is assumed"),
                    "label some blends: strut effort next names those that help most");
}

}  // namespace

EffortVector mean_rating(const std::vector<EffortVector>& ratings) {
  EffortVector result = EffortVector::Constant(kNotRated);
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    double sum = 0.0;
    int count = 0;
    for (const EffortVector& rating : ratings) {
      if (!is_rated(rating[d])) continue;
      sum += rating[d];
      ++count;
    }
    if (count > 0) result[d] = sum / count;
  }
  return result;
}

EffortRegression fit_effort_regression(const std::vector<LabelledFragment>& fragments,
                                       const std::vector<LabelledBlend>& blends, const RegressionOptions& options,
                                       Diagnostics* diagnostics) {
  check(fragments);
  check(blends, fragments);
  check(options);
  const auto count = static_cast<Eigen::Index>(fragments.size());
  EffortRegressionParts parts;
  parts.method = options.method;
  parts.effort.resize(count, kNumPredictedFactors);
  parts.group.resize(count);
  parts.duration.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const LabelledFragment& fragment = fragments[static_cast<std::size_t>(i)];
    parts.effort.row(i) = fragment.effort.transpose();
    parts.group[i] = fragment.group;
    parts.duration[i] = static_cast<double>(fragment.features.rows()) / kFeatureRate;
  }
  parts.posture = posture_of(fragments, options);
  const bool is_residual = options.method == RegressionMethod::kLinearPlusResidual;
  if (is_residual && options.uses_kinematics) parts.curves = curves_of(fragments);
  parts.blends = merged(blends);
  const bool is_linear = options.method == RegressionMethod::kLinearLabels;
  if (is_residual || is_linear) {
    const detail::BlendInputs inputs(parts);
    tbb::parallel_for(0, kNumPredictedFactors, [&](int d) {
      parts.residual[static_cast<std::size_t>(d)] = detail::choose_settings(inputs, d, parts.blends, is_linear);
    });
  } else if (options.method == RegressionMethod::kSupportVector) {
    tbb::parallel_for(0, kNumPredictedFactors,
                      [&](int d) { parts.support[static_cast<std::size_t>(d)] = fit_support(parts, d); });
  }
  report(parts, diagnostics);
  return EffortRegression(std::move(parts));
}

}  // namespace strut::effort
