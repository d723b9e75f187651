// SPDX-License-Identifier: MIT
// Derivatives of the simulated output. Changes dA, dB, dC, dD move it by
//   dy[t] = sum_s C Psi_s[t] (column of dA or dB that s drives) + dC x[t] + dD u[t],   Psi_s[t+1] = Psi_s[t] A + I s[t]
// for every scalar signal s among the states x (driving a column of dA) and inputs u (a column of dB): Psi_s is a
// polynomial in A, so a row c' Psi_s needs only itself, states^2 a frame. An output depends on its own rows of C and D
// only, which is why its derivatives are gathered apart.
#include "sysid/output_error.h"

#include "sysid/decompositions.h"

#include <strut/sysid/initial_state.h>

namespace strut::sysid::detail {
namespace {

/// Derivatives of every output of one clip; output o has rows [o frames, (o + 1) frames).
struct ClipDerivatives {
  Eigen::MatrixXd own;      ///< (outputs frames x (states + 1) (states + inputs)): by A, B, its row of C and of D
  Eigen::MatrixXd initial;  ///< (outputs frames x states): by the initial state; empty if it is not fitted
  Eigen::VectorXd error;    ///< (outputs frames)
};

/// The same signals in every role: (states + inputs) numbers that drive columns of A and B, and rows of C and D.
Eigen::MatrixXd states_and_inputs(const LtiSystem& system, const Experiment& clip, const Eigen::VectorXd& initial) {
  const Eigen::Index n = system.num_states();
  Eigen::MatrixXd signals(n + clip.input.cols(), clip.num_frames());
  Eigen::VectorXd state = initial.size() == 0 ? Eigen::VectorXd(Eigen::VectorXd::Zero(n)) : initial;
  for (Eigen::Index t = 0; t < signals.cols(); ++t) {
    signals.col(t) << state, clip.input.row(t).transpose();
    state = (system.a() * state + system.b() * clip.input.row(t).transpose()).eval();
  }
  return signals;
}

ClipDerivatives clip_derivatives(const LtiSystem& system, const Experiment& clip, const Eigen::VectorXd& initial,
                                 const Eigen::VectorXd& weights) {
  const Eigen::Index n = system.num_states();
  const Eigen::Index l = system.num_outputs();
  const Eigen::MatrixXd signals = states_and_inputs(system, clip, initial);
  const Eigen::Index drives = signals.rows();
  const Eigen::Index frames = clip.num_fitted();
  const bool fits_initial = initial.size() != 0;
  const Eigen::MatrixXd c = weights.asDiagonal() * system.c();
  Eigen::MatrixXd cd(l, drives);
  cd << c, weights.asDiagonal() * system.d();
  ClipDerivatives out{Eigen::MatrixXd(l * frames, (n + 1) * drives), Eigen::MatrixXd(fits_initial ? l * frames : 0, n),
                      Eigen::VectorXd(l * frames)};
  const Eigen::MatrixXd transposed = system.a().transpose();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, l * drives);  // (c_o' Psi_s)' in column s + o drives
  Eigen::MatrixXd next(n, l * drives);
  Eigen::MatrixXd decay = c.transpose();  // (c_o' A^t)' in column o
  for (Eigen::Index t = 0; t < clip.num_frames(); ++t) {
    const Eigen::Index row = t - clip.lead_in;
    for (Eigen::Index o = 0; o < l && row >= 0; ++o) {
      const Eigen::Index at = o * frames + row;
      out.own.row(at).head(n * drives) = rows.middleCols(o * drives, drives).reshaped().transpose();
      out.own.row(at).tail(drives) = weights[o] * signals.col(t).transpose();
      out.error[at] = weights[o] * clip.output(t, o) - cd.row(o).dot(signals.col(t));
      if (fits_initial) out.initial.row(at) = decay.col(o).transpose();
    }
    next.noalias() = transposed.lazyProduct(rows);
    for (Eigen::Index o = 0; o < l; ++o) {
      next.middleCols(o * drives, drives).noalias() += c.row(o).transpose() * signals.col(t).transpose();
    }
    rows.swap(next);
    if (fits_initial) decay = transposed.lazyProduct(decay).eval();
  }
  return out;
}

/// The parameters that one output depends on, in the order of ClipDerivatives::own.
std::vector<Eigen::Index> own_parameters(const ParameterLayout& at, Eigen::Index output) {
  std::vector<Eigen::Index> places;
  for (Eigen::Index k = 0; k < at.c(); ++k) places.push_back(k);
  for (Eigen::Index k = 0; k < at.n; ++k) places.push_back(at.c() + output * at.n + k);
  for (Eigen::Index k = 0; k < at.m; ++k) places.push_back(at.d() + output * at.m + k);
  return places;
}

/// Takes the initial state's directions out of the clip's part of the normal equations.
void eliminate_initial(const Eigen::MatrixXd& initial, const Eigen::MatrixXd& coupling, const Eigen::VectorXd& error,
                       OutputError::Derivatives& sum) {
  constexpr double kSeen = 1e-12;  // squared already: below, the output does not show that direction of the state
  const Eigen::MatrixXd gain = least_squares(initial.transpose() * initial, coupling, kSeen);
  sum.gram.noalias() -= coupling.transpose() * gain;
  sum.right.noalias() -= gain.transpose() * (initial.transpose() * error);
}

}  // namespace

ParameterLayout layout_of(const LtiSystem& system) {
  return {system.num_states(), system.num_inputs(), system.num_outputs()};
}

Eigen::VectorXd parameters_of(const LtiSystem& system) {
  const ParameterLayout at = layout_of(system);
  Eigen::VectorXd parameters(at.count());
  parameters << system.a().reshaped(), system.b().reshaped(), system.c().reshaped<Eigen::RowMajor>(),
      system.d().reshaped<Eigen::RowMajor>();
  return parameters;
}

LtiSystem system_of(const ParameterLayout& at, const Eigen::VectorXd& parameters) {
  return {parameters.head(at.b()).reshaped(at.n, at.n), parameters.segment(at.b(), at.n * at.m).reshaped(at.n, at.m),
          parameters.segment(at.c(), at.l * at.n).reshaped<Eigen::RowMajor>(at.l, at.n),
          parameters.tail(at.l * at.m).reshaped<Eigen::RowMajor>(at.l, at.m)};
}

OutputError::OutputError(const std::vector<Experiment>& clips, Eigen::VectorXd weights, bool from_rest)
    : clips_(clips), weights_(std::move(weights)), from_rest_(from_rest) {}

std::vector<Eigen::VectorXd> OutputError::initial_states(const LtiSystem& system) const {
  std::vector<Eigen::VectorXd> states(clips_.size());
  if (from_rest_ || system.num_states() == 0) return states;
  const double radius = system.spectral_radius();
  for (std::size_t k = 0; k < clips_.size(); ++k) {
    if (!forgets_initial_state(radius, clips_[k].lead_in)) {
      states[k] = estimate_initial_state(system, clips_[k], weights_);
    }
  }
  return states;
}

double OutputError::value(const LtiSystem& system, const std::vector<Eigen::VectorXd>& initial_states) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < clips_.size(); ++k) {
    const FrameMatrix error = clips_[k].output - simulate(system, clips_[k].input, initial_states[k]);
    sum += (error.bottomRows(clips_[k].num_fitted()) * weights_.asDiagonal()).squaredNorm();
  }
  return sum;
}

OutputError::Derivatives OutputError::derivatives(const LtiSystem& system,
                                                  const std::vector<Eigen::VectorXd>& initial_states) const {
  const ParameterLayout at = layout_of(system);
  Derivatives sum{Eigen::MatrixXd::Zero(at.count(), at.count()), Eigen::VectorXd::Zero(at.count())};
  std::vector<std::vector<Eigen::Index>> places;
  for (Eigen::Index o = 0; o < at.l; ++o) places.push_back(own_parameters(at, o));
  for (std::size_t k = 0; k < clips_.size(); ++k) {
    const ClipDerivatives clip = clip_derivatives(system, clips_[k], initial_states[k], weights_);
    const Eigen::Index frames = clips_[k].num_fitted();
    const bool fits_initial = clip.initial.rows() != 0;
    Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(at.n, fits_initial ? at.count() : 0);
    for (Eigen::Index o = 0; o < at.l; ++o) {
      const auto own = clip.own.middleRows(o * frames, frames);
      Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(own.cols(), own.cols());
      gram.selfadjointView<Eigen::Lower>().rankUpdate(own.transpose());
      sum.gram(places[o], places[o]) += gram.selfadjointView<Eigen::Lower>().toDenseMatrix();
      sum.right(places[o]) += own.transpose() * clip.error.segment(o * frames, frames);
      if (fits_initial)
        coupling(Eigen::all, places[o]) += clip.initial.middleRows(o * frames, frames).transpose() * own;
    }
    if (fits_initial) eliminate_initial(clip.initial, coupling, clip.error, sum);
  }
  return sum;
}

}  // namespace strut::sysid::detail
