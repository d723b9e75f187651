// SPDX-License-Identifier: MIT
// The Hankel matrix H of a finite response is its own infinite one, so nothing is approximated before the truncation:
//
//   H = U S V'                                  block (i, j) is tap i + j + 1, zero beyond the last
//   C = first block of U sqrt(S)                B = sqrt(S)^-1 U' (first block column of H)
//   A = sqrt(S)^-1 U' Z U sqrt(S)               Z moves rows one block up
//
// U'Z U is a corner of a nilpotent shift whatever columns U has, so its eigenvalues are of modulus cos(pi / taps) at
// most.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/QR>
#include <Eigen/SVD>

#include <strut/core/error.h>
#include <strut/sysid/balanced_truncation.h>

namespace strut::sysid {
namespace {

std::string shape(const Eigen::MatrixXd& tap) {
  return std::to_string(tap.rows()) + " x " + std::to_string(tap.cols());
}

void check(const ImpulseResponse& response) {
  if (response.empty()) throw InvalidArgument("response", "at least one tap", "none");
  const std::string wanted = shape(response.front());
  if (response.front().size() == 0) throw InvalidArgument("response", "at least one output and one input", wanted);
  for (const Eigen::MatrixXd& tap : response) {
    if (shape(tap) != wanted) throw InvalidArgument("response", "taps of " + wanted, shape(tap));
    if (!tap.allFinite()) throw InvalidArgument("response", "finite numbers", "NaN or infinity");
  }
}

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

LtiSystem static_map(const Eigen::MatrixXd& direct) {
  return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, direct.cols()), Eigen::MatrixXd(direct.rows(), 0), direct};
}

double energy(const ImpulseResponse& response) {
  double total = 0.0;
  for (const Eigen::MatrixXd& tap : response) total += tap.squaredNorm();
  return total;
}

/// W = sum over k of A'^k C'C A^k, by doubling the sum's length until A^k has faded.
Eigen::MatrixXd observability_gramian(const LtiSystem& system) {
  constexpr int kMostDoublings = 40;
  constexpr double kFaded = 1e-12;
  Eigen::MatrixXd gramian = system.c().transpose() * system.c();
  Eigen::MatrixXd power = system.a();
  for (int k = 0; k < kMostDoublings && power.norm() > kFaded; ++k) {
    gramian += (power.transpose() * gramian * power).eval();
    power = (power * power).eval();
  }
  return gramian;
}

/// The energy of the system's response from tap `taps` on.
double energy_beyond(const LtiSystem& system, std::size_t taps) {
  Eigen::MatrixXd state = system.b();
  for (std::size_t k = 1; k < taps; ++k) state = (system.a() * state).eval();
  return std::max(0.0, state.cwiseProduct(observability_gramian(system) * state).sum());
}

/// Root of the energy by which the responses differ, per energy of the finite one.
double relative_error(const ImpulseResponse& response, const LtiSystem& system) {
  const double whole = energy(response);
  if (whole == 0.0) return 0.0;
  ImpulseResponse difference = impulse_response(system, static_cast<int>(response.size()));
  for (std::size_t k = 0; k < response.size(); ++k) difference[k] -= response[k];
  return std::sqrt((energy(difference) + energy_beyond(system, response.size())) / whole);
}

/// The singular values of H, falling, and what belongs to them on the left. From H' = Q R and R' = U S W', without
/// squaring: small singular values matter.
std::pair<Eigen::VectorXd, Eigen::MatrixXd> decompose(const Eigen::MatrixXd& hankel) {
  if (hankel.size() == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(hankel.rows(), 0)};
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(hankel.transpose());
  const Eigen::Index rank = std::min(hankel.rows(), hankel.cols());
  const Eigen::MatrixXd r = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(r.transpose(), Eigen::ComputeThinU);
  return {svd.singularValues(), svd.matrixU()};
}

/// States whose singular value is more than rounding, at most `max_order`.
Eigen::Index largest_order(const Eigen::VectorXd& values, int max_order) {
  constexpr double kRounding = 1e-12;
  if (values.size() == 0 || values[0] == 0.0) return 0;
  return std::min<Eigen::Index>(max_order, (values.array() > kRounding * values[0]).count());
}

/// The balanced states that belong to the given singular values (which are not zero).
LtiSystem realize(const Eigen::MatrixXd& hankel, const Eigen::VectorXd& values, const Eigen::MatrixXd& left,
                  const Eigen::MatrixXd& direct) {
  const Eigen::Index l = direct.rows();
  const Eigen::Index rows = hankel.rows();
  const Eigen::VectorXd root = values.cwiseSqrt();
  const Eigen::MatrixXd observability = left * root.asDiagonal();
  const Eigen::MatrixXd inverse = root.cwiseInverse().asDiagonal() * left.transpose();
  return {inverse.leftCols(rows - l) * observability.bottomRows(rows - l), inverse * hankel.leftCols(direct.cols()),
          observability.topRows(l), direct};
}

/// The first `order` states without the others: of a balanced system, its truncation.
LtiSystem leading_states(const LtiSystem& system, Eigen::Index order) {
  return {system.a().topLeftCorner(order, order), system.b().topRows(order), system.c().leftCols(order), system.d()};
}

}  // namespace

void check_truncation_options(const TruncationOptions& options) {
  if (options.max_order < 0) throw InvalidArgument("max_order", "0 or more", std::to_string(options.max_order));
  if (!(options.tolerance >= 0.0)) throw InvalidArgument("tolerance", "0 or more", std::to_string(options.tolerance));
}

TruncatedSystem balanced_truncation(const ImpulseResponse& response, const TruncationOptions& options) {
  check(response);
  check_truncation_options(options);
  const Eigen::MatrixXd hankel = hankel_matrix(response);
  const auto [values, left] = decompose(hankel);
  const Eigen::Index largest = largest_order(values, options.max_order);
  const LtiSystem whole = largest == 0
                              ? static_map(response.front())
                              : realize(hankel, values.head(largest), left.leftCols(largest), response.front());
  for (Eigen::Index order = 0;; ++order) {
    LtiSystem system = leading_states(whole, order);
    const double error = relative_error(response, system);
    if (order < largest && error * error > options.tolerance) continue;
    return {std::move(system), values, error, 2.0 * values.tail(values.size() - order).sum()};
  }
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
