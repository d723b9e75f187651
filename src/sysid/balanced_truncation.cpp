// SPDX-License-Identifier: MIT
// The Hankel matrix H of a finite response is its own infinite one: with H = U S V', the states scaled by sqrt(S) are
// balanced, and A is what moves the rows of the observability matrix U sqrt(S) one block up.
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/sysid/balanced_truncation.h>

namespace strut::sysid {
namespace {

void check(const ImpulseResponse& response, const TruncationOptions& options) {
  if (response.empty() || response.front().size() == 0) throw InvalidArgument("response", "at least one tap", "none");
  for (const Eigen::MatrixXd& tap : response) {
    if (tap.rows() != response.front().rows() || tap.cols() != response.front().cols()) {
      throw InvalidArgument("response", "taps of one shape", "several");
    }
    if (!tap.allFinite()) throw InvalidArgument("response", "finite numbers", "NaN or infinity");
  }
  if (options.max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(options.max_order));
  if (!(options.tolerance >= 0.0)) throw InvalidArgument("tolerance", "0 or more", std::to_string(options.tolerance));
}

/// Block (i, j) is tap i + j + 1, zero beyond the last.
Eigen::MatrixXd hankel_matrix(const ImpulseResponse& response) {
  const auto blocks = static_cast<Eigen::Index>(response.size()) - 1;
  const Eigen::Index l = response.front().rows();
  const Eigen::Index m = response.front().cols();
  Eigen::MatrixXd hankel = Eigen::MatrixXd::Zero(blocks * l, blocks * m);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    for (Eigen::Index j = 0; i + j < blocks; ++j) {
      hankel.block(i * l, j * m, l, m) = response[static_cast<std::size_t>(i + j + 1)];
    }
  }
  return hankel;
}

double energy(const ImpulseResponse& response, std::size_t first) {
  double total = 0.0;
  for (std::size_t k = first; k < response.size(); ++k) total += response[k].squaredNorm();
  return total;
}

/// Root of the share of the response's energy that `system` misses within its taps.
double relative_error(const ImpulseResponse& response, const LtiSystem& system) {
  ImpulseResponse difference = impulse_response(system, static_cast<int>(response.size()));
  for (std::size_t k = 0; k < response.size(); ++k) difference[k] -= response[k];
  const double whole = energy(response, 0);
  return whole > 0.0 ? std::sqrt(energy(difference, 0) / whole) : 0.0;
}

class BalancedRealization {
 public:
  explicit BalancedRealization(const ImpulseResponse& response)
      : direct_(response.front()), hankel_(hankel_matrix(response)) {
    if (hankel_.size() == 0) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hankel_ * hankel_.transpose());
    values_ = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
    left_ = eigen.eigenvectors().rowwise().reverse();
  }

  [[nodiscard]] const Eigen::VectorXd& values() const { return values_; }

  /// States whose singular value is more than rounding (of the squared matrix that was decomposed).
  [[nodiscard]] int largest_order() const {
    constexpr double kSignificant = 1e-7;
    return values_.size() == 0 || values_[0] == 0.0
               ? 0
               : static_cast<int>((values_.array() > kSignificant * values_[0]).count());
  }

  [[nodiscard]] LtiSystem truncated(int order) const {
    const Eigen::Index l = direct_.rows();
    const Eigen::Index m = direct_.cols();
    const Eigen::VectorXd root = values_.head(order).cwiseSqrt();
    const Eigen::MatrixXd observability = left_.leftCols(order) * root.asDiagonal();
    const Eigen::MatrixXd inverse = root.cwiseInverse().asDiagonal() * left_.leftCols(order).transpose();
    Eigen::MatrixXd shifted = Eigen::MatrixXd::Zero(observability.rows(), order);
    if (order > 0) shifted.topRows(observability.rows() - l) = observability.bottomRows(observability.rows() - l);
    const Eigen::MatrixXd b = order > 0 ? Eigen::MatrixXd(inverse * hankel_.leftCols(m)) : Eigen::MatrixXd(0, m);
    const Eigen::MatrixXd c = order > 0 ? Eigen::MatrixXd(observability.topRows(l)) : Eigen::MatrixXd(l, 0);
    return {inverse * shifted, b, c, direct_};
  }

 private:
  Eigen::MatrixXd direct_, hankel_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd left_;
};

}  // namespace

TruncatedSystem balanced_truncation(const ImpulseResponse& response, const TruncationOptions& options) {
  check(response, options);
  const BalancedRealization balanced(response);
  const int largest = std::min(options.max_order, balanced.largest_order());
  const auto finish = [&](LtiSystem system, int order) {
    const double error = relative_error(response, system);
    const double bound = 2.0 * balanced.values().tail(balanced.values().size() - order).sum();
    return TruncatedSystem{std::move(system), balanced.values(), error, bound};
  };
  for (int order = 0; order < largest; ++order) {
    TruncatedSystem found = finish(balanced.truncated(order), order);
    if (found.error * found.error <= options.tolerance) return found;
  }
  return finish(balanced.truncated(largest), largest);
}

ImpulseResponse impulse_response(const LtiSystem& system, int taps) {
  if (taps < 1) throw InvalidArgument("taps", "1 or more", std::to_string(taps));
  ImpulseResponse response{system.d()};
  Eigen::MatrixXd state = system.b();
  for (int k = 1; k < taps; ++k) {
    response.emplace_back(system.c() * state);
    state = system.a() * state;
  }
  return response;
}

}  // namespace strut::sysid
