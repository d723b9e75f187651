// SPDX-License-Identifier: MIT
#include "effort/support_vector.h"

#include <algorithm>
#include <cmath>
#include <libsvm/svm.h>
#include <limits>
#include <memory>

#include <strut/core/error.h>

namespace strut::effort::detail {
namespace {

constexpr double kCacheMegabytes = 64.0;
constexpr double kStop = 1e-3;  // LIBSVM's own tolerance
// The grid: the gammas are per input, so that it fits any number of components.
constexpr double kCosts[] = {0.3, 1.0, 3.0, 10.0};
constexpr double kTubes[] = {0.05, 0.1};
constexpr double kGammas[] = {0.1, 0.3, 1.0};
// Components of posture are in deviations, labels and alpha not: this puts them on one scale.
constexpr double kLabelScale = 3.0, kAlphaScale = 3.0;

/// LIBSVM's rows of (index, value), ended by index -1.
class Nodes {
 public:
  explicit Nodes(const Eigen::MatrixXd& inputs) : width_(static_cast<std::size_t>(inputs.cols()) + 1) {
    for (Eigen::Index n = 0; n < inputs.rows(); ++n) {
      for (Eigen::Index k = 0; k < inputs.cols(); ++k) nodes_.push_back({static_cast<int>(k) + 1, inputs(n, k)});
      nodes_.push_back({-1, 0.0});
    }
    for (std::size_t n = 0; n < static_cast<std::size_t>(inputs.rows()); ++n) rows_.push_back(&nodes_[n * width_]);
  }
  [[nodiscard]] svm_node** rows() { return rows_.data(); }

 private:
  std::size_t width_;
  std::vector<svm_node> nodes_;
  std::vector<svm_node*> rows_;
};

svm_parameter parameters(const SupportVectorOptions& options) {
  svm_parameter result{};
  result.svm_type = EPSILON_SVR;
  result.kernel_type = RBF;
  result.gamma = options.gamma;
  result.C = options.cost;
  result.p = options.tube;
  result.eps = kStop;
  result.cache_size = kCacheMegabytes;
  result.shrinking = 1;
  return result;
}

void print_nothing(const char* /*text*/) {}

double squared_error(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets, const std::vector<int>& fold,
                     const std::vector<int>& also_hidden, const SupportVectorOptions& options) {
  const int folds = *std::max_element(fold.begin(), fold.end()) + 1;
  double sum = 0.0;
  for (int held = 0; held < folds; ++held) {
    std::vector<int> seen, judged;
    for (std::size_t n = 0; n < fold.size(); ++n) {
      if (fold[n] == held) judged.push_back(static_cast<int>(n));
      if (fold[n] != held && also_hidden[n] != held) seen.push_back(static_cast<int>(n));
    }
    if (judged.empty()) continue;
    Eigen::VectorXd found = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(judged.size()));
    if (!seen.empty()) {
      found =
          evaluate(fit_support_vectors(inputs(seen, Eigen::all), targets(seen), options), inputs(judged, Eigen::all));
    }
    sum += (found - targets(judged)).squaredNorm();
  }
  return sum;
}

}  // namespace

SupportVectors fit_support_vectors(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets,
                                   const SupportVectorOptions& options) {
  Nodes nodes(inputs);
  Eigen::VectorXd values = targets;
  svm_problem problem{static_cast<int>(inputs.rows()), values.data(), nodes.rows()};
  const svm_parameter settings = parameters(options);
  if (const char* wrong = svm_check_parameter(&problem, &settings))
    throw InvalidArgument("options", "those of LIBSVM", wrong);
  svm_set_print_string_function(&print_nothing);
  const auto destroy = [](svm_model* model) { svm_free_and_destroy_model(&model); };
  const std::unique_ptr<svm_model, decltype(destroy)> model(svm_train(&problem, &settings), destroy);
  SupportVectors result;
  result.gamma = options.gamma;
  result.offset = -model->rho[0];
  result.inputs.resize(model->l, inputs.cols());
  result.coefficients.resize(model->l);
  for (int m = 0; m < model->l; ++m) {
    result.coefficients[m] = model->sv_coef[0][m];
    result.inputs.row(m) = inputs.row(model->sv_indices[m] - 1);
  }
  return result;
}

SupportVectorOptions choose_support_options(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets,
                                            const std::vector<int>& fold, const std::vector<int>& also_hidden) {
  SupportVectorOptions best;
  double least = std::numeric_limits<double>::infinity();
  for (const double cost : kCosts) {
    for (const double tube : kTubes) {
      for (const double gamma : kGammas) {
        const SupportVectorOptions tried{cost, tube, gamma / static_cast<double>(inputs.cols())};
        const double error = squared_error(inputs, targets, fold, also_hidden, tried);
        if (!(error < least)) continue;
        least = error;
        best = tried;
      }
    }
  }
  return best;
}

Eigen::VectorXd evaluate(const SupportVectors& support, const Eigen::MatrixXd& inputs) {
  if (support.coefficients.size() == 0) return Eigen::VectorXd::Constant(inputs.rows(), support.offset);
  Eigen::MatrixXd squares = -2.0 * inputs * support.inputs.transpose();
  squares.colwise() += inputs.rowwise().squaredNorm();
  squares.rowwise() += support.inputs.rowwise().squaredNorm().transpose();
  const Eigen::MatrixXd kernel = (-support.gamma * squares.array().max(0.0)).exp().matrix();
  return (kernel * support.coefficients).array() + support.offset;
}

Eigen::MatrixXd support_inputs(const EffortRegressionParts& parts, const std::vector<LabelledBlend>& blends) {
  const Eigen::Index components = parts.posture.cols();
  Eigen::MatrixXd result(static_cast<Eigen::Index>(blends.size()), 2 * (components + kNumPredictedFactors + 1) + 1);
  const auto filled = [&](int i) -> Eigen::RowVectorXd {
    return parts.effort.row(i).unaryExpr([](double e) { return is_rated(e) ? kLabelScale * e : 0.0; });
  };
  for (std::size_t n = 0; n < blends.size(); ++n) {
    const int i = blends[n].first, j = blends[n].second;
    result.row(static_cast<Eigen::Index>(n)) << filled(i), filled(j), kAlphaScale * blends[n].alpha,
        parts.posture.row(i), parts.posture.row(j), std::log(parts.duration[i]), std::log(parts.duration[j]);
  }
  return result;
}

}  // namespace strut::effort::detail
