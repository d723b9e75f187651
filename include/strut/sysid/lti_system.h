// SPDX-License-Identifier: MIT
// A discrete linear time-invariant system and its simulation: the whole of what a translation model does at run time.
#pragma once

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::sysid {

/// x[t+1] = A x[t] + B u[t],  y[t] = C x[t] + D u[t]   (Hsu et al. 2005, Eq. 5-6, without noise)
///
///   A  states  x states     B  states  x inputs
///   C  outputs x states     D  outputs x inputs
///
/// Zero states make a static map. Immutable; the state belongs to the caller.
class LtiSystem {
 public:
  /// Throws InvalidArgument if the shapes do not agree, there is no input or output, or a number is not finite.
  LtiSystem(Eigen::MatrixXd a, Eigen::MatrixXd b, Eigen::MatrixXd c, Eigen::MatrixXd d);

  [[nodiscard]] int num_states() const noexcept { return static_cast<int>(a_.rows()); }
  [[nodiscard]] int num_inputs() const noexcept { return static_cast<int>(d_.cols()); }
  [[nodiscard]] int num_outputs() const noexcept { return static_cast<int>(d_.rows()); }
  [[nodiscard]] const Eigen::MatrixXd& a() const noexcept { return a_; }
  [[nodiscard]] const Eigen::MatrixXd& b() const noexcept { return b_; }
  [[nodiscard]] const Eigen::MatrixXd& c() const noexcept { return c_; }
  [[nodiscard]] const Eigen::MatrixXd& d() const noexcept { return d_; }

  /// One frame: writes y[t] to `output` and moves `state` to x[t+1]. `scratch` has num_states() elements. No
  /// allocation; sizes are the caller's duty (asserted in debug builds). Cost (states + outputs) x (states + inputs).
  void step(Eigen::Ref<Eigen::VectorXd> state, const Eigen::Ref<const Eigen::VectorXd>& input,
            Eigen::Ref<Eigen::VectorXd> output, Eigen::Ref<Eigen::VectorXd> scratch) const;

  /// The eigenvalues of A (states), in no particular order.
  [[nodiscard]] Eigen::VectorXcd poles() const;
  /// The largest modulus of an eigenvalue of A; 0 without states. Below 1 the system is stable.
  [[nodiscard]] double spectral_radius() const;

 private:
  Eigen::MatrixXd a_, b_, c_, d_;
};

/// The response to `input` (frames x inputs) from `initial_state` (states; zero if empty): frames x outputs.
/// Throws InvalidArgument if the widths do not agree.
FrameMatrix simulate(const LtiSystem& system, const Eigen::Ref<const FrameMatrix>& input,
                     const Eigen::VectorXd& initial_state = {});

}  // namespace strut::sysid
