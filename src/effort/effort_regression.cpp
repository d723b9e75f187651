// SPDX-License-Identifier: MIT
#include "effort/blend_inputs.h"
#include "effort/residual_process.h"
#include "effort/support_vector.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/effort_regression.h>

namespace strut::effort {
namespace {

using detail::BlendInputs;
using detail::ResidualProcess;

constexpr Eigen::Index kPairsAtOnce = 64;  // their likeness to 2,000 blends stays in a core's cache

std::string text(Eigen::Index number) {
  return std::to_string(number);
}

void check_rows(const char* name, Eigen::Index rows, Eigen::Index expected) {
  if (rows != expected) throw InvalidArgument(name, text(expected) + " rows, one per fragment", text(rows));
}

void check_alpha(double alpha) {
  if (alpha >= kLeastAlpha && alpha <= kLargestAlpha) return;
  throw InvalidArgument("alpha", "a number from -2 to 3", std::to_string(alpha));
}

void check_index(const char* name, int index, Eigen::Index count) {
  if (index >= 0 && index < count) return;
  throw InvalidArgument(name, "a fragment from 0 to " + text(count - 1), std::to_string(index));
}

void check_labels(const char* name, const Eigen::MatrixXd& labels) {
  for (Eigen::Index n = 0; n < labels.size(); ++n) {
    const double label = labels.data()[n];
    if (is_rated(label) && std::abs(label) > 1.0) {
      throw InvalidArgument(name, "labels from -1 to 1", std::to_string(label));
    }
  }
}

void check_settings(const ResidualSettings& s) {
  for (const double size : {s.kinematics, s.labels, s.posture, s.misfit}) {
    if (!(size >= 0.0 && std::isfinite(size))) {
      throw InvalidArgument("residual", "deviations of 0 or more", std::to_string(size));
    }
  }
  for (const double size : {s.noise, s.label_reach, s.alpha_reach, s.posture_reach, s.calibration}) {
    if (!(size > 0.0 && std::isfinite(size))) {
      throw InvalidArgument("residual", "noise, reaches and calibration above 0", std::to_string(size));
    }
  }
}

void check_support(const EffortRegressionParts& parts) {
  const Eigen::Index inputs = detail::support_inputs(parts, {LabelledBlend{}}).cols();
  for (const SupportVectors& support : parts.support) {
    if (support.inputs.rows() != support.coefficients.size()) {
      throw InvalidArgument("support", text(support.inputs.rows()) + " coefficients",
                            text(support.coefficients.size()));
    }
    if (support.inputs.rows() > 0 && support.inputs.cols() != inputs) {
      throw InvalidArgument("support", text(inputs) + " inputs", text(support.inputs.cols()));
    }
    if (!support.inputs.allFinite() || !support.coefficients.allFinite() || !std::isfinite(support.offset)) {
      throw InvalidArgument("support", "finite numbers", "NaN or infinity");
    }
    if (!(support.gamma > 0.0)) throw InvalidArgument("support", "a gamma above 0", std::to_string(support.gamma));
  }
}

void check_fragments(const EffortRegressionParts& parts) {
  const Eigen::Index count = parts.effort.rows();
  if (count == 0) throw InvalidArgument("effort", "at least one fragment", "none");
  if (parts.effort.cols() != kNumPredictedFactors)
    throw InvalidArgument("effort", "3 columns", text(parts.effort.cols()));
  check_labels("effort", parts.effort);
  check_rows("group", parts.group.size(), count);
  check_rows("duration", parts.duration.size(), count);
  check_rows("posture", parts.posture.rows(), count);
  if (!parts.posture.allFinite()) throw InvalidArgument("posture", "finite numbers", "NaN or infinity");
  if (!parts.duration.allFinite() || parts.duration.minCoeff() <= 0.0) {
    throw InvalidArgument("duration", "seconds above 0", "one that is not");
  }
  if (parts.curves.cols() == 0) return;
  check_rows("curves", parts.curves.rows(), count);
  if (parts.curves.cols() % kCurvePoints != 0) {
    throw InvalidArgument("curves", "a multiple of " + std::to_string(kCurvePoints) + " columns",
                          text(parts.curves.cols()));
  }
  if (!parts.curves.allFinite()) throw InvalidArgument("curves", "finite numbers", "NaN or infinity");
}

void check_parts(const EffortRegressionParts& parts) {
  const auto method = static_cast<int>(parts.method);
  if (method < 0 || method >= kNumRegressionMethods)
    throw InvalidArgument("method", "a number from 0 to 3", std::to_string(method));
  check_fragments(parts);
  for (const LabelledBlend& blend : parts.blends) {
    check_index("first", blend.first, parts.effort.rows());
    check_index("second", blend.second, parts.effort.rows());
    check_alpha(blend.alpha);
    check_labels("blends", blend.effort);
  }
  for (const ResidualSettings& settings : parts.residual) check_settings(settings);
  if (parts.method == RegressionMethod::kSupportVector) check_support(parts);
}

}  // namespace

struct EffortRegression::Fitted {
  EffortRegressionParts parts;
  BlendInputs inputs;
  std::vector<ResidualProcess> processes;  // one per factor, of linear labels and of the residual

  explicit Fitted(EffortRegressionParts given) : parts((check_parts(given), std::move(given))), inputs(parts) {
    const bool is_linear = parts.method == RegressionMethod::kLinearLabels;
    if (!is_linear && parts.method != RegressionMethod::kLinearPlusResidual) return;
    const std::vector<LabelledBlend> none;
    for (int d = 0; d < kNumPredictedFactors; ++d) {
      const ResidualSettings& settings = parts.residual[static_cast<std::size_t>(d)];
      processes.emplace_back(inputs, d, settings, is_linear ? none : parts.blends);
    }
  }

  [[nodiscard]] const ResidualProcess& process(int factor) const { return processes[static_cast<std::size_t>(factor)]; }

  void check(const FragmentPair& pair) const {
    check_index("first", pair.first, parts.effort.rows());
    check_index("second", pair.second, parts.effort.rows());
  }

  void check(const std::vector<LabelledBlend>& blends) const {
    for (const LabelledBlend& blend : blends) {
      check({blend.first, blend.second});
      check_alpha(blend.alpha);
    }
  }

  /// Means of `count` pairs in one factor (count x alphas).
  [[nodiscard]] Eigen::MatrixXd means(const FragmentPair* pairs, Eigen::Index count,
                                      const Eigen::Ref<const Eigen::VectorXd>& alphas, int factor) const {
    Eigen::MatrixXd result(count, alphas.size());
    if (!processes.empty()) result = process(factor).mean(pairs, count, alphas);
    for (Eigen::Index p = 0; p < count; ++p) {
      const auto [first, second] = pairs[p];
      const bool is_known = inputs.is_rated(first, second, factor);
      if (parts.method == RegressionMethod::kSupportVector && is_known) {
        result.row(p) = support_means(first, second, alphas, factor).transpose();
        continue;
      }
      for (Eigen::Index q = 0; q < alphas.size(); ++q) {
        if (!is_known) {
          result(p, q) = kNotRated;
        } else if (processes.empty()) {
          result(p, q) = parts.effort(alphas[q] < 0.5 ? first : second, factor);
          if (alphas[q] == 0.5) result(p, q) = inputs.linear(first, second, 0.5, factor);  // either end is as near
        } else {
          result(p, q) += inputs.linear(first, second, alphas[q], factor);
        }
      }
    }
    return result;
  }

  [[nodiscard]] Eigen::VectorXd support_means(int first, int second, const Eigen::Ref<const Eigen::VectorXd>& alphas,
                                              int factor) const {
    return detail::evaluate(parts.support[static_cast<std::size_t>(factor)],
                            detail::support_inputs(parts, blends_of(first, second, alphas)));
  }

  static std::vector<LabelledBlend> blends_of(int first, int second, const Eigen::Ref<const Eigen::VectorXd>& alphas) {
    std::vector<LabelledBlend> blends;
    for (const double alpha : alphas) blends.push_back({first, second, alpha, EffortVector::Constant(kNotRated)});
    return blends;
  }
};

EffortRegression::EffortRegression(EffortRegressionParts parts)
    : fitted_(std::make_shared<const Fitted>(std::move(parts))) {}

const EffortRegressionParts& EffortRegression::parts() const noexcept {
  return fitted_->parts;
}

int EffortRegression::num_fragments() const noexcept {
  return static_cast<int>(fitted_->parts.effort.rows());
}

std::vector<EffortPrediction> EffortRegression::predict(int first, int second,
                                                        const Eigen::Ref<const Eigen::VectorXd>& alphas) const {
  const FragmentPair pair{first, second};
  fitted_->check(pair);
  for (const double alpha : alphas) check_alpha(alpha);
  std::vector<EffortPrediction> result(static_cast<std::size_t>(alphas.size()),
                                       {EffortVector::Constant(kNotRated), EffortVector::Constant(kNotRated)});
  const std::vector<LabelledBlend> blends = Fitted::blends_of(first, second, alphas);
  for (int d = 0; d < kNumPredictedFactors; ++d) {
    if (!fitted_->inputs.is_rated(first, second, d)) continue;
    const Eigen::MatrixXd means = fitted_->means(&pair, 1, alphas, d);
    for (Eigen::Index q = 0; q < alphas.size(); ++q) result[static_cast<std::size_t>(q)].effort[d] = means(0, q);
    if (fitted_->processes.empty()) continue;
    const double scale = fitted_->parts.residual[static_cast<std::size_t>(d)].calibration;
    const Eigen::VectorXd deviations =
        scale * (fitted_->process(d).variance(blends) + fitted_->process(d).label_variance(blends)).cwiseSqrt();
    for (Eigen::Index q = 0; q < alphas.size(); ++q) result[static_cast<std::size_t>(q)].deviation[d] = deviations[q];
  }
  return result;
}

std::array<Eigen::MatrixXd, kNumPredictedFactors> EffortRegression::predict(
    const std::vector<FragmentPair>& pairs, const Eigen::Ref<const Eigen::VectorXd>& alphas) const {
  for (const FragmentPair& pair : pairs) fitted_->check(pair);
  for (const double alpha : alphas) check_alpha(alpha);
  std::array<Eigen::MatrixXd, kNumPredictedFactors> result;
  for (Eigen::MatrixXd& table : result) table.resize(static_cast<Eigen::Index>(pairs.size()), alphas.size());
  const auto count = static_cast<Eigen::Index>(pairs.size());
  // Blocks of one size, so that no result depends on the number of threads.
  const Eigen::Index blocks = (count + kPairsAtOnce - 1) / kPairsAtOnce;
  tbb::parallel_for(Eigen::Index{0}, blocks, [&](Eigen::Index block) {
    const Eigen::Index begin = block * kPairsAtOnce, size = std::min(kPairsAtOnce, count - begin);
    for (int d = 0; d < kNumPredictedFactors; ++d) {
      result[static_cast<std::size_t>(d)].middleRows(begin, size) =
          fitted_->means(&pairs[static_cast<std::size_t>(begin)], size, alphas, d);
    }
  });
  return result;
}

Eigen::MatrixXd EffortRegression::covariance(const std::vector<LabelledBlend>& blends, Factor factor) const {
  fitted_->check(blends);
  const auto count = static_cast<Eigen::Index>(blends.size());
  if (parts().method != RegressionMethod::kLinearPlusResidual || factor >= kNumPredictedFactors) {
    return Eigen::MatrixXd::Zero(count, count);
  }
  return fitted_->process(factor).covariance(blends);
}

Eigen::VectorXd EffortRegression::label_variance(const std::vector<LabelledBlend>& blends, Factor factor) const {
  fitted_->check(blends);
  if (fitted_->processes.empty() || factor >= kNumPredictedFactors) {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blends.size()));
  }
  return fitted_->process(factor).label_variance(blends);
}

}  // namespace strut::effort
