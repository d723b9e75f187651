// SPDX-License-Identifier: MIT
// Systems whose matrices are known, and clips simulated from them, for the tests of identification.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <strut/sysid/experiment.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid::test {

/// Four states (poles 0.8 exp(+-0.5i), 0.9 and -0.5), two inputs, three outputs.
inline LtiSystem known_system() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4);
  a.topLeftCorner(2, 2) << 0.8 * std::cos(0.5), -0.8 * std::sin(0.5), 0.8 * std::sin(0.5), 0.8 * std::cos(0.5);
  a(2, 2) = 0.9;
  a(3, 3) = -0.5;
  Eigen::MatrixXd b(4, 2);
  b << 1.0, 0.2, -0.4, 0.6, 0.3, -0.5, 0.7, 0.9;
  Eigen::MatrixXd c(3, 4);
  c << 1.0, 0.3, -0.6, 0.4, 0.2, -1.0, 0.5, 0.8, -0.3, 0.4, 0.9, -0.7;
  Eigen::MatrixXd d(3, 2);
  d << 0.5, -0.2, 0.0, 0.8, -0.6, 0.1;
  return {a, b, c, d};
}

inline FrameMatrix white_noise(Eigen::Index rows, Eigen::Index cols, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return FrameMatrix::NullaryExpr(rows, cols, [&] { return normal(random); });
}

struct ClipsOptions {
  int count = 20;
  int frames = 60;
  int lead_in = 0;             ///< frames of it before the clip
  double noise = 0.0;          ///< standard deviation of white noise on the output
  double initial_state = 0.0;  ///< standard deviation of the state at the first frame
  unsigned seed = 1;
};

/// The system's response to white noise.
inline std::vector<Experiment> clips_of(const LtiSystem& system, const ClipsOptions& options) {
  std::mt19937 random(options.seed);
  std::vector<Experiment> clips;
  for (int k = 0; k < options.count; ++k) {
    Experiment clip;
    clip.input = white_noise(options.lead_in + options.frames, system.num_inputs(), random);
    const Eigen::VectorXd state = options.initial_state * white_noise(system.num_states(), 1, random);
    clip.output = simulate(system, clip.input, state);
    clip.output += options.noise * white_noise(clip.output.rows(), clip.output.cols(), random);
    clip.lead_in = options.lead_in;
    clips.push_back(std::move(clip));
  }
  return clips;
}

/// The largest difference between the first 40 Markov parameters D, C B, C A B, ...
inline double markov_difference(const LtiSystem& one, const LtiSystem& other) {
  double largest = (one.d() - other.d()).cwiseAbs().maxCoeff();
  Eigen::MatrixXd one_state = one.b();
  Eigen::MatrixXd other_state = other.b();
  for (int k = 0; k < 40; ++k) {
    largest = std::max(largest, (one.c() * one_state - other.c() * other_state).cwiseAbs().maxCoeff());
    one_state = (one.a() * one_state).eval();
    other_state = (other.a() * other_state).eval();
  }
  return largest;
}

}  // namespace strut::sysid::test
