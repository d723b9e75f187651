// SPDX-License-Identifier: MIT
// Poles, Markov parameters and predictions beside SLICOT's on systems that are known.
#include "slicot/slicot.h"
#include "sysid/known_system.h"

#include <algorithm>
#include <complex>

#include <gtest/gtest.h>

#include <strut/sysid/identify.h>
#include <strut/sysid/n4sid.h>
#include <strut/sysid/noise_model.h>

namespace strut::test {
namespace {

using sysid::Experiment;
using sysid::LtiSystem;
using sysid::Weighting;

constexpr double kSame = 1e-6;  // of poles and Markov parameters of size one, without noise
constexpr int kBlockRows = 10;

Experiment long_clip(const LtiSystem& system, double noise) {
  return sysid::test::clips_of(system, {.count = 1, .frames = 600, .noise = noise})[0];
}

/// Eigenvalues of A, in an order that does not depend on the coordinates.
std::vector<std::complex<double>> poles(const LtiSystem& system) {
  const Eigen::VectorXcd values = system.poles();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& one, const auto& other) {
    return std::abs(one.real() - other.real()) > kSame ? one.real() < other.real() : one.imag() < other.imag();
  });
  return sorted;
}

double pole_difference(const LtiSystem& one, const LtiSystem& other) {
  const auto left = poles(one);
  const auto right = poles(other);
  if (left.size() != right.size()) return 1e300;
  double largest = 0.0;
  for (std::size_t k = 0; k < left.size(); ++k) largest = std::max(largest, std::abs(left[k] - right[k]));
  return largest;
}

/// A stable system of random matrices with distinct poles.
LtiSystem random_system(int states, int inputs, int outputs, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(states, states);
  for (int k = 0; k < states; ++k) {
    a(k, k) = 0.9 - 1.6 * k / states;
    if (k > 0) a(k - 1, k) = 0.3;
  }
  return {a, sysid::test::white_noise(states, inputs, random), sysid::test::white_noise(outputs, states, random),
          sysid::test::white_noise(outputs, inputs, random)};
}

std::vector<LtiSystem> known_systems() {
  return {sysid::test::known_system(), random_system(1, 1, 1, 2), random_system(3, 1, 2, 3), random_system(5, 3, 2, 4),
          random_system(6, 2, 3, 5)};
}

TEST(Slicot, AndWeFindTheSameSystemsWithoutNoise) {
  for (const LtiSystem& truth : known_systems()) {
    const Experiment clip = long_clip(truth, 0.0);
    for (const SlicotMethod method : {SlicotMethod::kMoesp, SlicotMethod::kN4sid, SlicotMethod::kCombined}) {
      const LtiSystem theirs = slicot_identify(method, clip, kBlockRows, truth.num_states()).system;
      for (const Weighting weighting : {Weighting::kN4sid, Weighting::kMoesp, Weighting::kCva}) {
        for (const auto way : {sysid::InputMatrices::kSimulation, sysid::InputMatrices::kStates}) {
          const LtiSystem ours =
              sysid::identify_order({clip}, truth.num_states(), {.weighting = weighting, .input_matrices = way});
          EXPECT_LT(pole_difference(ours, theirs), kSame) << truth.num_states() << " states";
          EXPECT_LT(sysid::test::markov_difference(ours, theirs), kSame) << truth.num_states() << " states";
        }
      }
    }
  }
}

TEST(Slicot, AndWeSeeTheSameOrderInTheSingularValues) {
  for (const LtiSystem& truth : known_systems()) {
    const Experiment clip = long_clip(truth, 1e-3);
    EXPECT_EQ(slicot_order(SlicotMethod::kMoesp, clip, kBlockRows), truth.num_states());
    const sysid::Identified ours =
        sysid::identify({clip}, {0}, {.weighting = Weighting::kMoesp, .order_rule = sysid::OrderRule::kGap});
    EXPECT_EQ(ours.system.num_states(), truth.num_states());
  }
}

/// A clip with noise that the innovation form explains: x' = A x + B u + K e, y = C x + D u + e.
Experiment innovation_clip(const LtiSystem& system, const Eigen::MatrixXd& gain, double noise) {
  std::mt19937 random(9);
  Experiment clip{sysid::test::white_noise(3000, system.num_inputs(), random), FrameMatrix(3000, system.num_outputs())};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.num_states());
  for (int t = 0; t < clip.num_frames(); ++t) {
    const Eigen::VectorXd e = noise * sysid::test::white_noise(system.num_outputs(), 1, random);
    const Eigen::VectorXd u = clip.input.row(t).transpose();
    clip.output.row(t) = (system.c() * x + system.d() * u + e).transpose();
    x = (system.a() * x + system.b() * u + gain * e).eval();
  }
  return clip;
}

TEST(Slicot, PredictsNoBetterThanWeDo) {
  constexpr double kNoise = 0.5;
  constexpr double kAsGood = 0.2;  // % fit; the innovation's own standard error over 3000 frames is larger
  const LtiSystem truth = sysid::test::known_system();
  Eigen::MatrixXd gain(4, 3);
  gain << 0.3, 0.1, 0.0, 0.0, -0.3, 0.1, -0.2, 0.2, 0.4, 0.1, 0.0, 0.2;
  const Experiment clip = innovation_clip(truth, gain, kNoise);
  const double best = sysid::predicted_fit(truth, gain, {clip});
  const SlicotResult theirs = slicot_identify(SlicotMethod::kN4sid, clip, 15, 4);
  const LtiSystem ours = sysid::identify_order({clip}, 4, {.block_rows = 15, .weighting = Weighting::kN4sid});
  const sysid::NoiseModel noise = sysid::fit_noise_model(ours, {clip}, 15);
  ASSERT_TRUE(noise.is_filter);
  EXPECT_GT(sysid::predicted_fit(ours, noise.gain, {clip}),
            sysid::predicted_fit(theirs.system, theirs.gain, {clip}) - kAsGood);
  EXPECT_GT(sysid::predicted_fit(ours, noise.gain, {clip}), best - 2.0 * kAsGood);
}

}  // namespace
}  // namespace strut::test
