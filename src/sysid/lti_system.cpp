// SPDX-License-Identifier: MIT
// Simulation of a linear time-invariant system. Paper symbols: A, B, C, D system matrices, u input, x state, y output.
#include <cassert>
#include <string>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {
namespace {

std::string shape(Eigen::Index rows, Eigen::Index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

void check_shape(const char* name, const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index cols) {
  if (matrix.rows() != rows || matrix.cols() != cols) {
    throw InvalidArgument(name, shape(rows, cols), shape(matrix.rows(), matrix.cols()));
  }
  if (!matrix.allFinite()) throw InvalidArgument(name, "finite numbers", "NaN or infinity");
}

}  // namespace

LtiSystem::LtiSystem(Eigen::MatrixXd a, Eigen::MatrixXd b, Eigen::MatrixXd c, Eigen::MatrixXd d)
    : a_(std::move(a)), b_(std::move(b)), c_(std::move(c)), d_(std::move(d)) {
  if (d_.size() == 0) throw InvalidArgument("d", "at least one output and one input", shape(d_.rows(), d_.cols()));
  check_shape("a", a_, a_.rows(), a_.rows());
  check_shape("b", b_, a_.rows(), d_.cols());
  check_shape("c", c_, d_.rows(), a_.rows());
  check_shape("d", d_, d_.rows(), d_.cols());
}

void LtiSystem::step(Eigen::Ref<Eigen::VectorXd> state, const Eigen::Ref<const Eigen::VectorXd>& input,
                     Eigen::Ref<Eigen::VectorXd> output, Eigen::Ref<Eigen::VectorXd> scratch) const {
  assert(state.size() == num_states() && input.size() == num_inputs());
  assert(output.size() == num_outputs() && scratch.size() == num_states());
  output.noalias() = d_.lazyProduct(input);
  if (num_states() == 0) return;
  output.noalias() += c_.lazyProduct(state);
  scratch.noalias() = a_.lazyProduct(state);
  scratch.noalias() += b_.lazyProduct(input);
  state = scratch;
}

Eigen::VectorXcd LtiSystem::poles() const {
  return num_states() == 0 ? Eigen::VectorXcd(0) : Eigen::VectorXcd(a_.eigenvalues());
}

double LtiSystem::spectral_radius() const {
  return num_states() == 0 ? 0.0 : poles().cwiseAbs().maxCoeff();
}

FrameMatrix simulate(const LtiSystem& system, const Eigen::Ref<const FrameMatrix>& input,
                     const Eigen::VectorXd& initial_state) {
  if (input.cols() != system.num_inputs()) {
    throw InvalidArgument("input", std::to_string(system.num_inputs()) + " columns", std::to_string(input.cols()));
  }
  if (initial_state.size() != 0 && initial_state.size() != system.num_states()) {
    throw InvalidArgument("initial_state", std::to_string(system.num_states()) + " elements",
                          std::to_string(initial_state.size()));
  }
  Eigen::VectorXd state = initial_state.size() != 0 ? initial_state : Eigen::VectorXd::Zero(system.num_states());
  Eigen::VectorXd scratch(system.num_states());
  Eigen::VectorXd u(system.num_inputs());
  Eigen::VectorXd y(system.num_outputs());
  FrameMatrix output(input.rows(), system.num_outputs());
  for (Eigen::Index t = 0; t < input.rows(); ++t) {
    u = input.row(t).transpose();
    system.step(state, u, y, scratch);
    output.row(t) = y.transpose();
  }
  return output;
}

}  // namespace strut::sysid
