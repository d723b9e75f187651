// SPDX-License-Identifier: MIT
// Both models are fitted on what the observations amount to per style, so that a round costs the same however many
// there are. Symbols:
//   phi      a content's coordinates (P)                  y    values, in a basis of all observations' span (R)
//   G_s      sum w phi phi^T of style s (P x P)           M_s  sum w y phi^T of it (R x P)
//   H        mean of w phi phi^T over all (P x P)         B    content dimensions from coordinates (J x P)
//   A^s      style s on content dimensions (R x J)        a^s  style vector (I), A^s = sum_i a^s_i W_i
// The ridge is lambda sum_s |(A^s - mean A) B|^2 in the metric of C, H with all but a trace of the mean content taken
// out: what sets a style apart whatever the content costs next to nothing, only that it changes in its own way does.
// It does not depend on how A and B are scaled.
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <strut/blend/bilinear.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTraceOfMean = 1e-3;  // of the mean content that the ridge sees, to settle what nothing else does

std::size_t at(Eigen::Index index) {
  return static_cast<std::size_t>(index);
}

void check_dims(const char* name, int value, Eigen::Index most) {
  if (value >= 1 && value <= most) return;
  throw InvalidArgument(name, "1 to " + std::to_string(most), std::to_string(value));
}

void check(const std::vector<BilinearObservation>& observations, int num_styles, const BilinearOptions& options) {
  if (observations.empty()) throw InvalidArgument("observations", "at least one", "none");
  if (!(options.ridge > 0.0) || !std::isfinite(options.ridge)) {
    throw InvalidArgument("ridge", "a positive number", std::to_string(options.ridge));
  }
  std::vector<bool> seen(at(std::max(num_styles, 0)), false);
  for (const BilinearObservation& o : observations) {
    if (o.style < 0 || o.style >= num_styles) {
      throw InvalidArgument("observations", "styles from 0 to " + std::to_string(num_styles - 1),
                            std::to_string(o.style));
    }
    seen[at(o.style)] = true;
    const bool fits = o.content.size() == observations.front().content.size() &&
                      o.values.size() == observations.front().values.size() && o.content.size() > 0;
    if (!fits) throw InvalidArgument("observations", "contents and values of one size", "several sizes");
    if (!o.content.allFinite() || !o.values.allFinite() || !(o.weight > 0.0) || !std::isfinite(o.weight)) {
      throw InvalidArgument("observations", "finite numbers and positive weights", "others");
    }
  }
  const auto missing = std::find(seen.begin(), seen.end(), false);
  if (missing != seen.end()) {
    throw InvalidArgument("observations", "one of every style", "none of " + std::to_string(missing - seen.begin()));
  }
}

/// What the observations amount to.
struct Sums {
  MatrixXd span;                        // orthonormal, K x R: values = span * y
  std::vector<BilinearObservation> of;  // with values y
  std::vector<MatrixXd> gram, moment;   // G_s, M_s
  MatrixXd mean_gram;                   // H
  MatrixXd change_gram;                 // C
  double lambda = 0.0;                  // the ridge
  [[nodiscard]] int num_styles() const { return static_cast<int>(gram.size()); }
};

MatrixXd span_of(const std::vector<BilinearObservation>& observations) {
  const Eigen::Index k = observations.front().values.size(), n = static_cast<Eigen::Index>(observations.size());
  if (k <= n) return MatrixXd::Identity(k, k);
  MatrixXd all(k, n);
  for (Eigen::Index i = 0; i < n; ++i) all.col(i) = observations[at(i)].values;
  return Eigen::HouseholderQR<MatrixXd>(all).householderQ() * MatrixXd::Identity(k, n);
}

Sums sums_of(const std::vector<BilinearObservation>& observations, int num_styles, double ridge) {
  const Eigen::Index p = observations.front().content.size();
  Sums sums;
  sums.span = span_of(observations);
  sums.of = observations;
  sums.gram.assign(at(num_styles), MatrixXd::Zero(p, p));
  sums.moment.assign(at(num_styles), MatrixXd::Zero(sums.span.cols(), p));
  sums.mean_gram = MatrixXd::Zero(p, p);
  sums.lambda = ridge;
  for (BilinearObservation& o : sums.of) {
    o.values = sums.span.transpose() * o.values;
    const MatrixXd gram = o.weight * o.content * o.content.transpose();
    sums.gram[at(o.style)] += gram;
    sums.moment[at(o.style)] += o.weight * o.values * o.content.transpose();
    sums.mean_gram += gram / static_cast<double>(observations.size());
  }
  VectorXd mean = VectorXd::Zero(p);
  double weight = 0.0;
  for (const BilinearObservation& o : sums.of) {
    mean += o.weight * o.content;
    weight += o.weight;
  }
  mean /= weight;
  const double all = weight / static_cast<double>(observations.size());
  sums.change_gram = sums.mean_gram - (1.0 - kTraceOfMean) * all * mean * mean.transpose();
  return sums;
}

/// The solution X of X * a = b with the least norm: a may be singular where the observations leave something open.
MatrixXd solve_right(const MatrixXd& b, const MatrixXd& a) {
  return a.transpose().completeOrthogonalDecomposition().solve(b.transpose()).transpose();
}

MatrixXd mean_of(const std::vector<MatrixXd>& all) {
  MatrixXd mean = MatrixXd::Zero(all.front().rows(), all.front().cols());
  for (const MatrixXd& one : all) mean += one / static_cast<double>(all.size());
  return mean;
}

double objective_of(const Sums& sums, const std::vector<MatrixXd>& coefficients) {
  double total = 0.0;
  for (const BilinearObservation& o : sums.of) {
    total += o.weight * (o.values - coefficients[at(o.style)] * o.content).squaredNorm();
  }
  const MatrixXd mean = mean_of(coefficients);
  for (const MatrixXd& c : coefficients) {
    const MatrixXd away = c - mean;
    total += sums.lambda * (away * sums.change_gram).cwiseProduct(away).sum();
  }
  return total;
}

/// The best A^s for given B, and their mean with them.
std::vector<MatrixXd> best_styles(const Sums& sums, const MatrixXd& b) {
  const MatrixXd pull = sums.lambda * b * sums.change_gram * b.transpose();
  MatrixXd of_mean = MatrixXd::Identity(b.rows(), b.rows());
  MatrixXd right = MatrixXd::Zero(sums.span.cols(), b.rows());
  for (int s = 0; s < sums.num_styles(); ++s) {
    const MatrixXd left = b * sums.gram[at(s)] * b.transpose() + pull;
    of_mean -= solve_right(pull, left) / sums.num_styles();
    right += solve_right(sums.moment[at(s)] * b.transpose(), left) / sums.num_styles();
  }
  const MatrixXd mean = solve_right(right, of_mean);
  std::vector<MatrixXd> styles;
  for (int s = 0; s < sums.num_styles(); ++s) {
    styles.push_back(
        solve_right(sums.moment[at(s)] * b.transpose() + mean * pull, b * sums.gram[at(s)] * b.transpose() + pull));
  }
  return styles;
}

/// The best B for given A^s: a linear system for its entries, row by row of B's transpose.
MatrixXd best_contents(const Sums& sums, const std::vector<MatrixXd>& styles) {
  const Eigen::Index j = styles.front().cols(), p = sums.mean_gram.rows();
  const MatrixXd mean = mean_of(styles);
  MatrixXd left = MatrixXd::Zero(j * p, j * p);
  MatrixXd right = MatrixXd::Zero(j, p);
  for (int s = 0; s < sums.num_styles(); ++s) {
    const MatrixXd& a = styles[at(s)];
    const MatrixXd own = a.transpose() * a;
    const MatrixXd away = (a - mean).transpose() * (a - mean);
    for (Eigen::Index q = 0; q < p; ++q) {
      for (Eigen::Index r = 0; r < p; ++r) {
        left.block(q * j, r * j, j, j) += sums.gram[at(s)](q, r) * own + sums.lambda * sums.change_gram(q, r) * away;
      }
    }
    right += a.transpose() * sums.moment[at(s)];
  }
  const VectorXd entries = left.completeOrthogonalDecomposition().solve(Eigen::Map<VectorXd>(right.data(), j * p));
  return Eigen::Map<const MatrixXd>(entries.data(), j, p);
}

std::vector<MatrixXd> times(const std::vector<MatrixXd>& styles, const MatrixXd& b) {
  std::vector<MatrixXd> products;
  for (const MatrixXd& a : styles) products.push_back(a * b);
  return products;
}

/// B whose rows are orthonormal in the metric of H and span what varies most over the stacked coefficients.
MatrixXd leading_contents(const Sums& sums, const std::vector<MatrixXd>& coefficients, int content_dims) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> h(sums.mean_gram);
  const double least = 1e-12 * h.eigenvalues().maxCoeff();
  const VectorXd root = h.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const VectorXd inverse = (h.eigenvalues().array() > least).select(root.cwiseMax(1e-150).cwiseInverse(), 0.0);
  const MatrixXd metric = h.eigenvectors() * root.asDiagonal() * h.eigenvectors().transpose();
  const MatrixXd back = h.eigenvectors() * inverse.asDiagonal() * h.eigenvectors().transpose();
  const Eigen::Index rows = sums.span.cols();
  MatrixXd stacked(rows * sums.num_styles(), sums.mean_gram.rows());
  for (int s = 0; s < sums.num_styles(); ++s) stacked.middleRows(s * rows, rows) = coefficients[at(s)] * metric;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> varies(stacked.transpose() * stacked);
  return (back * varies.eigenvectors().rightCols(content_dims)).transpose();
}

/// Repeats `round`, which lowers the objective, until it no longer does. `round` returns coefficients.
template <typename Round>
void alternate(const Sums& sums, const BilinearOptions& options, BilinearModel& model, Round round) {
  double scale = 0.0;
  for (const BilinearObservation& o : sums.of) scale += o.weight * o.values.squaredNorm();
  for (int i = 0; i < options.max_rounds && !model.converged; ++i) {
    const std::vector<MatrixXd> next = round();
    const double before = model.objective.back(), now = objective_of(sums, next);
    model.converged = !(now < before - options.tolerance * before) || now <= 1e-28 * scale;
    if (!(now < before)) break;  // rounding: the last round stays
    model.coefficients = next;
    model.objective.push_back(now);
  }
}

BilinearModel in_values(BilinearModel model, const Sums& sums) {
  for (MatrixXd& c : model.coefficients) c = sums.span * c;
  return model;
}

/// The symmetric model's parameters.
struct Shared {
  std::vector<MatrixXd> weights;  // W_i (R x J)
  MatrixXd styles;                // a^s in columns (I x S)
  MatrixXd contents;              // B

  [[nodiscard]] std::vector<MatrixXd> style_matrices() const {
    std::vector<MatrixXd> all;
    for (Eigen::Index s = 0; s < styles.cols(); ++s) {
      MatrixXd a = MatrixXd::Zero(weights.front().rows(), weights.front().cols());
      for (Eigen::Index i = 0; i < styles.rows(); ++i) a += styles(i, s) * weights[at(i)];
      all.push_back(std::move(a));
    }
    return all;
  }
};

/// Style vectors and weights from the styles' matrices, by singular value decomposition.
Shared factored(const std::vector<MatrixXd>& style_matrices, const MatrixXd& b, int style_dims) {
  const Eigen::Index rows = style_matrices.front().rows(), j = b.rows();
  MatrixXd stacked(rows * j, static_cast<Eigen::Index>(style_matrices.size()));
  for (Eigen::Index s = 0; s < stacked.cols(); ++s) {
    stacked.col(s) = Eigen::Map<const VectorXd>(style_matrices[at(s)].data(), rows * j);
  }
  const Eigen::JacobiSVD<MatrixXd> svd(stacked.transpose() * stacked, Eigen::ComputeFullU);
  Shared shared{{}, svd.matrixU().leftCols(style_dims).transpose(), b};
  const MatrixXd weights = stacked * shared.styles.transpose();
  for (int i = 0; i < style_dims; ++i) {
    shared.weights.emplace_back(Eigen::Map<const MatrixXd>(weights.col(i).data(), rows, j));
  }
  return shared;
}

/// The best style vectors for given weights and contents.
void improve_styles(const Sums& sums, Shared& shared) {
  const Eigen::Index i_dims = shared.styles.rows();
  std::vector<MatrixXd> over;  // W_i B
  for (const MatrixXd& w : shared.weights) over.emplace_back(w * shared.contents);
  const auto gram = [&](const MatrixXd& metric) {
    MatrixXd result(i_dims, i_dims);
    for (Eigen::Index i = 0; i < i_dims; ++i) {
      const MatrixXd turned = over[at(i)] * metric;
      for (Eigen::Index k = 0; k < i_dims; ++k) result(i, k) = turned.cwiseProduct(over[at(k)]).sum();
    }
    return result;
  };
  const MatrixXd pull = sums.lambda * gram(sums.change_gram);
  std::vector<MatrixXd> left, right;
  MatrixXd of_mean = MatrixXd::Identity(i_dims, i_dims), mean_right = MatrixXd::Zero(1, i_dims);
  for (int s = 0; s < sums.num_styles(); ++s) {
    left.emplace_back(gram(sums.gram[at(s)]) + pull);
    MatrixXd moments(1, i_dims);
    for (Eigen::Index i = 0; i < i_dims; ++i) moments(0, i) = sums.moment[at(s)].cwiseProduct(over[at(i)]).sum();
    right.push_back(moments);
    of_mean -= solve_right(pull, left.back()) / sums.num_styles();
    mean_right += solve_right(moments, left.back()) / sums.num_styles();
  }
  const MatrixXd mean = solve_right(mean_right, of_mean);
  for (int s = 0; s < sums.num_styles(); ++s) {
    shared.styles.col(s) = solve_right(right[at(s)] + mean * pull, left[at(s)]).transpose();
  }
}

/// The best weights for given style vectors and contents.
void improve_weights(const Sums& sums, Shared& shared) {
  const MatrixXd& b = shared.contents;
  const Eigen::Index i_dims = shared.styles.rows(), j = b.rows();
  const VectorXd mean = shared.styles.rowwise().mean();
  MatrixXd left = MatrixXd::Zero(i_dims * j, i_dims * j);
  MatrixXd right = MatrixXd::Zero(sums.span.cols(), i_dims * j);
  for (int s = 0; s < sums.num_styles(); ++s) {
    const VectorXd a = shared.styles.col(s), away = a - mean;
    const MatrixXd gram = b * sums.gram[at(s)] * b.transpose();
    const MatrixXd pull = sums.lambda * b * sums.change_gram * b.transpose();
    const MatrixXd moment = sums.moment[at(s)] * b.transpose();
    for (Eigen::Index i = 0; i < i_dims; ++i) {
      for (Eigen::Index k = 0; k < i_dims; ++k) {
        left.block(i * j, k * j, j, j) += a[i] * a[k] * gram + away[i] * away[k] * pull;
      }
      right.middleCols(i * j, j) += a[i] * moment;
    }
  }
  const MatrixXd weights = solve_right(right, left);
  for (Eigen::Index i = 0; i < i_dims; ++i) shared.weights[at(i)] = weights.middleCols(i * j, j);
}

}  // namespace

BilinearModel fit_asymmetric(const std::vector<BilinearObservation>& observations, int num_styles, int content_dims,
                             const BilinearOptions& options) {
  check(observations, num_styles, options);
  const Eigen::Index p = observations.front().content.size();
  check_dims("content_dims", content_dims, p);
  const Sums sums = sums_of(observations, num_styles, options.ridge);
  BilinearModel model;
  model.coefficients = best_styles(sums, MatrixXd::Identity(p, p));
  model.objective = {objective_of(sums, model.coefficients)};
  if (content_dims < p) {
    MatrixXd b = leading_contents(sums, model.coefficients, content_dims);
    std::vector<MatrixXd> styles = best_styles(sums, b);
    model.coefficients = times(styles, b);
    model.objective = {objective_of(sums, model.coefficients)};
    alternate(sums, options, model, [&] {
      b = best_contents(sums, styles);
      styles = best_styles(sums, b);
      return times(styles, b);
    });
    model.contents = b;
  } else {
    model.contents = MatrixXd::Identity(p, p);
    model.converged = true;
  }
  return in_values(std::move(model), sums);
}

BilinearModel fit_symmetric(const std::vector<BilinearObservation>& observations, int num_styles, int style_dims,
                            int content_dims, const BilinearOptions& options) {
  check(observations, num_styles, options);
  const Eigen::Index p = observations.front().content.size();
  check_dims("style_dims", style_dims, num_styles);
  check_dims("content_dims", content_dims, p);
  const Sums sums = sums_of(observations, num_styles, options.ridge);
  const std::vector<MatrixXd> full = best_styles(sums, MatrixXd::Identity(p, p));
  const MatrixXd b = leading_contents(sums, full, content_dims);
  Shared shared = factored(best_styles(sums, b), b, style_dims);
  BilinearModel model;
  model.coefficients = times(shared.style_matrices(), shared.contents);
  model.objective = {objective_of(sums, model.coefficients)};
  alternate(sums, options, model, [&] {
    improve_weights(sums, shared);
    improve_styles(sums, shared);
    shared.contents = best_contents(sums, shared.style_matrices());
    return times(shared.style_matrices(), shared.contents);
  });
  model.contents = shared.contents;
  return in_values(std::move(model), sums);
}

}  // namespace strut::blend
