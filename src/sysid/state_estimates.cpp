// SPDX-License-Identifier: MIT
// States from a Hankel factor. Its columns are, frame by frame within each: future inputs Uf, past inputs Up, past
// outputs Yp, future outputs Yf. Moving the first future frame into the past gives the data of one frame later.
#include "sysid/decompositions.h"

#include <algorithm>
#include <string>

#include <Eigen/QR>

#include <strut/core/error.h>
#include <strut/sysid/state_estimates.h>

namespace strut::sysid {
namespace {

constexpr double kSeen = 1e-12;         // of the best seen state: less of it shows as rounding
constexpr double kIndependent = 1e-10;  // as in the subspace step: nearer to a combination of the rest is nothing new

/// Hankel data whose columns are ordered (future inputs, past, future outputs).
struct Ordered {
  Eigen::MatrixXd rows;
  Eigen::Index future_inputs, past, future_outputs;
};

/// (C; C A; C A^2; ...) pseudo-inverted: states from free responses of `block_rows` frames.
Eigen::MatrixXd observer(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c, Eigen::Index block_rows) {
  Eigen::MatrixXd gamma(block_rows * c.rows(), a.rows());
  Eigen::MatrixXd power = c;
  for (Eigen::Index k = 0; k < block_rows; ++k) {
    gamma.middleRows(k * c.rows(), c.rows()) = power;
    power = (power * a).eval();
  }
  return detail::least_squares(gamma, Eigen::MatrixXd::Identity(gamma.rows(), gamma.rows()), kSeen);
}

/// The states at the border of past and future: (rows x states).
Eigen::MatrixXd states_of(const Ordered& data, const Eigen::MatrixXd& observer) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(data.rows);
  const Eigen::MatrixXd r = qr.matrixQR().triangularView<Eigen::Upper>();
  const Eigen::Index f = data.future_inputs;
  const Eigen::Index p = data.past;
  const Eigen::MatrixXd gain =
      detail::least_squares(r.block(f, f, p, p), r.block(f, f + p, p, data.future_outputs), kIndependent);
  return data.rows.middleCols(f, p) * (gain * observer.transpose());
}

/// The same data with the border of past and future a frame later.
Ordered shifted(const Eigen::MatrixXd& rows, Eigen::Index m, Eigen::Index l, Eigen::Index i) {
  Ordered out{Eigen::MatrixXd(rows.rows(), rows.cols()), (i - 1) * m, (i + 1) * (m + l), (i - 1) * l};
  out.rows << rows.middleCols(m, (i - 1) * m),  // future inputs
      rows.middleCols(i * m, i * m),            // past inputs
      rows.leftCols(m),                         // the input of this frame
      rows.middleCols(2 * i * m, (i + 1) * l),  // past outputs and that of this frame
      rows.rightCols((i - 1) * l);              // future outputs
  return out;
}

void check(const HankelFactor& factor, const Eigen::MatrixXd& a, const Eigen::MatrixXd& c) {
  if (a.rows() != a.cols() || c.cols() != a.rows()) {
    throw InvalidArgument("a", "square, as wide as c", std::to_string(a.rows()) + " x " + std::to_string(a.cols()));
  }
  if (c.rows() != factor.num_outputs()) {
    throw InvalidArgument("c", std::to_string(factor.num_outputs()) + " rows", std::to_string(c.rows()));
  }
  if (factor.block_rows() < 2 || (factor.block_rows() - 1) * factor.num_outputs() < a.rows()) {
    throw InvalidArgument("factor", "2 or more block rows, enough for the states", std::to_string(factor.block_rows()));
  }
}

}  // namespace

StateEstimates estimate_states(const HankelFactor& factor, const Eigen::MatrixXd& a, const Eigen::MatrixXd& c) {
  check(factor, a, c);
  const Eigen::Index m = factor.num_inputs();
  const Eigen::Index l = factor.num_outputs();
  const Eigen::Index i = factor.block_rows();
  const Eigen::MatrixXd rows = factor.triangle();
  StateEstimates estimates{Eigen::MatrixXd(rows.rows(), a.rows()), Eigen::MatrixXd(rows.rows(), a.rows()),
                           rows.leftCols(m), rows.middleCols(i * (2 * m + l), l), factor.num_columns()};
  if (a.rows() == 0) return estimates;
  estimates.state = states_of({rows, i * m, i * (m + l), i * l}, observer(a, c, i));
  estimates.next_state = states_of(shifted(rows, m, l, i), observer(a, c, i - 1));
  return estimates;
}

LtiSystem input_matrices_from_states(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                     const StateEstimates& estimates) {
  if (estimates.state.cols() != a.rows() || estimates.output.cols() != c.rows()) {
    throw InvalidArgument("estimates", "those of this A and C", "other widths");
  }
  const auto regressed = [&](const Eigen::MatrixXd& rest) -> Eigen::MatrixXd {
    return detail::least_squares(estimates.input, rest, kIndependent).transpose();
  };
  return {a, regressed(estimates.next_state - estimates.state * a.transpose()), c,
          regressed(estimates.output - estimates.state * c.transpose())};
}

NoiseCovariances noise_covariances(const LtiSystem& system, const StateEstimates& estimates) {
  if (estimates.state.cols() != system.num_states() || estimates.output.cols() != system.num_outputs() ||
      estimates.input.cols() != system.num_inputs()) {
    throw InvalidArgument("estimates", "those of this system", "other widths");
  }
  const Eigen::MatrixXd state_noise =
      estimates.next_state - estimates.state * system.a().transpose() - estimates.input * system.b().transpose();
  const Eigen::MatrixXd output_noise =
      estimates.output - estimates.state * system.c().transpose() - estimates.input * system.d().transpose();
  const double frames = static_cast<double>(std::max(1L, estimates.num_columns));
  return {state_noise.transpose() * state_noise / frames, state_noise.transpose() * output_noise / frames,
          output_noise.transpose() * output_noise / frames};
}

}  // namespace strut::sysid
