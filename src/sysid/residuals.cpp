// SPDX-License-Identifier: MIT
// Correlations over many clips. Symbols: r(k) correlation at lag k, N frames.
//   Ljung-Box  Q = N (N + 2) sum_k r(k)^2 / (N - k), chi-squared of as many degrees as lags if residuals are white
//   variance of a cross-correlation of independent signals: (1 / N) sum_k r_e(k) r_u(k), over all k of both signs
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/sysid/residuals.h>

namespace strut::sysid {
namespace {

constexpr double kNinetyNine = 2.5758;  // standard deviations that hold 99 of 100 normal numbers

std::string shape(const FrameMatrix& matrix) {
  return std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
}

void check(const std::vector<FrameMatrix>& residuals, const std::vector<FrameMatrix>& inputs, int num_lags) {
  if (residuals.empty()) throw InvalidArgument("residuals", "at least one clip", "none");
  if (inputs.size() != residuals.size()) {
    throw InvalidArgument("inputs", std::to_string(residuals.size()) + " clips", std::to_string(inputs.size()));
  }
  if (num_lags < 1) throw InvalidArgument("num_lags", "1 or more", std::to_string(num_lags));
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const bool fits = residuals[k].cols() == residuals[0].cols() && inputs[k].cols() == inputs[0].cols() &&
                      residuals[k].rows() == inputs[k].rows() && residuals[k].rows() > 0;
    if (!fits) throw InvalidArgument("inputs", "as many frames as residuals, one or more", shape(inputs[k]));
    if (!residuals[k].allFinite() || !inputs[k].allFinite()) {
      throw InvalidArgument("residuals", "finite numbers", "NaN or infinity");
    }
  }
}

/// The clips with the common mean taken off and scaled to unit variance; columns that do not vary become zero.
std::vector<FrameMatrix> standardized(const std::vector<FrameMatrix>& clips) {
  constexpr double kVaries = 1e-12;  // of its mean square, as in FitSum
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(clips.front().cols());
  double frames = 0.0;
  for (const FrameMatrix& clip : clips) {
    sum += clip.colwise().sum();
    frames += static_cast<double>(clip.rows());
  }
  const Eigen::RowVectorXd mean = sum / frames;
  Eigen::RowVectorXd variance = Eigen::RowVectorXd::Zero(mean.size());
  for (const FrameMatrix& clip : clips) variance += (clip.rowwise() - mean).colwise().squaredNorm() / frames;
  Eigen::RowVectorXd scale(mean.size());
  for (Eigen::Index k = 0; k < scale.size(); ++k) {
    scale[k] = variance[k] > kVaries * mean[k] * mean[k] ? 1.0 / std::sqrt(variance[k]) : 0.0;
  }
  std::vector<FrameMatrix> out;
  for (const FrameMatrix& clip : clips) out.push_back((clip.rowwise() - mean) * scale.asDiagonal());
  return out;
}

/// Correlations of columns of `later` with columns of `earlier`, `lag` frames before: (later x earlier).
Eigen::MatrixXd correlation(const std::vector<FrameMatrix>& later, const std::vector<FrameMatrix>& earlier,
                            Eigen::Index lag, double frames) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(later.front().cols(), earlier.front().cols());
  for (std::size_t k = 0; k < later.size(); ++k) {
    const Eigen::Index overlap = later[k].rows() - lag;
    if (overlap > 0) sum.noalias() += later[k].bottomRows(overlap).transpose() * earlier[k].topRows(overlap);
  }
  return sum / frames;
}

/// Autocorrelations of every column at lags 1 .. num_lags.
FrameMatrix autocorrelations(const std::vector<FrameMatrix>& clips, int num_lags, double frames) {
  FrameMatrix out(num_lags, clips.front().cols());
  for (int lag = 1; lag <= num_lags; ++lag) {
    out.row(lag - 1) = correlation(clips, clips, lag, frames).diagonal().transpose();
  }
  return out;
}

}  // namespace

int ResidualTests::num_beyond() const {
  return static_cast<int>((autocorrelation.array().abs() > autocorrelation_bound).count());
}

ResidualTests test_residuals(const std::vector<FrameMatrix>& residuals, const std::vector<FrameMatrix>& inputs,
                             int num_lags) {
  check(residuals, inputs, num_lags);
  const std::vector<FrameMatrix> e = standardized(residuals);
  const std::vector<FrameMatrix> u = standardized(inputs);
  double frames = 0.0;
  Eigen::Index longest = 1;
  for (const FrameMatrix& clip : e) {
    frames += static_cast<double>(clip.rows());
    longest = std::max(longest, clip.rows());
  }
  const int lags = static_cast<int>(std::min<Eigen::Index>(num_lags, longest - 1));
  ResidualTests tests;
  tests.autocorrelation = autocorrelations(e, lags, frames);
  tests.autocorrelation_bound = kNinetyNine / std::sqrt(frames);
  const Eigen::ArrayXd weight = frames * (frames + 2.0) / (frames - Eigen::ArrayXd::LinSpaced(lags, 1.0, lags));
  tests.ljung_box = (tests.autocorrelation.array().square().colwise() * weight).colwise().sum().transpose();
  tests.whiteness = tests.ljung_box.unaryExpr([lags](double q) { return chi_squared_tail(q, lags); });
  const FrameMatrix input_correlation = autocorrelations(u, lags, frames);
  tests.cross_correlation = Eigen::MatrixXd::Zero(e.front().cols(), u.front().cols());
  for (int lag = 0; lag <= lags; ++lag) {
    const Eigen::MatrixXd here = correlation(e, u, lag, frames);
    tests.cross_correlation =
        (here.array().abs() > tests.cross_correlation.array().abs()).select(here, tests.cross_correlation);
  }
  const Eigen::MatrixXd joint = tests.autocorrelation.transpose() * input_correlation;
  // The sum is a variance; the truncated one can come out negative.
  tests.cross_bound = (kNinetyNine / std::sqrt(frames)) * (1.0 + 2.0 * joint.array()).max(1.0).sqrt();
  return tests;
}

double chi_squared_tail(double value, double degrees) {
  if (!(degrees > 0.0)) return 1.0;
  const double a = 0.5 * degrees;
  const double x = 0.5 * value;
  if (!(x > 0.0)) return 1.0;
  constexpr int kMostTerms = 10000;
  constexpr double kSettled = 1e-15;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {  // the series of the lower incomplete gamma function
    double term = 1.0 / a;
    double sum = term;
    for (int k = 1; k < kMostTerms && term > kSettled * sum; ++k) sum += term *= x / (a + k);
    return std::clamp(1.0 - front * sum, 0.0, 1.0);
  }
  // The continued fraction of the upper one, x + 1 - a - 1 (1 - a) / (x + 3 - a - ...), by Lentz's algorithm.
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double fraction = d;
  for (int k = 1; k < kMostTerms; ++k) {
    const double an = -k * (k - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < kSettled) break;
  }
  return std::clamp(front * fraction, 0.0, 1.0);
}

}  // namespace strut::sysid
