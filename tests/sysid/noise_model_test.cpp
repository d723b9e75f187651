// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/noise_model.h>

namespace strut::sysid {
namespace {

/// Clips of an innovation-form system x' = A x + B u + K e, y = C x + D u + e with white e.
std::vector<Experiment> innovation_clips(const LtiSystem& system, const Eigen::MatrixXd& gain, double noise) {
  std::mt19937 random(4);
  std::vector<Experiment> clips;
  for (int k = 0; k < 10; ++k) {
    Experiment clip{test::white_noise(400, system.num_inputs(), random), FrameMatrix(400, system.num_outputs())};
    Eigen::VectorXd x = Eigen::VectorXd::Zero(system.num_states());
    for (int t = 0; t < clip.num_frames(); ++t) {
      const Eigen::VectorXd e = noise * test::white_noise(system.num_outputs(), 1, random);
      const Eigen::VectorXd u = clip.input.row(t).transpose();
      clip.output.row(t) = (system.c() * x + system.d() * u + e).transpose();
      x = (system.a() * x + system.b() * u + gain * e).eval();
    }
    clips.push_back(std::move(clip));
  }
  return clips;
}

Eigen::MatrixXd known_gain() {
  Eigen::MatrixXd gain(4, 3);
  gain << 0.3, 0.1, 0.0, 0.0, -0.3, 0.1, -0.2, 0.2, 0.4, 0.1, 0.0, 0.2;
  return gain;
}

TEST(NoiseModel, FindsTheKalmanGain) {
  const LtiSystem truth = test::known_system();
  const double deviation = 0.5;
  const auto clips = innovation_clips(truth, known_gain(), deviation);
  const NoiseModel found = fit_noise_model(truth, clips, 15);
  ASSERT_TRUE(found.is_filter);
  EXPECT_LT((found.gain - known_gain()).cwiseAbs().maxCoeff(), 0.1);  // 4000 frames: a few hundredths, thrice over
  EXPECT_LT((found.innovation / (deviation * deviation) - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 0.15);
  const double simulated = simulated_fit(truth, clips);
  const double predicted = predicted_fit(truth, found.gain, clips);
  EXPECT_GT(predicted, simulated);
  EXPECT_NEAR(predicted, predicted_fit(truth, known_gain(), clips), 0.5);
}

TEST(NoiseModel, IsInTheDatasUnits) {
  const LtiSystem truth = test::known_system();
  auto clips = innovation_clips(truth, known_gain(), 0.5);
  const NoiseModel one = fit_noise_model(truth, clips);
  const Eigen::Vector3d units(1e4, 1.0, 1e-3);
  for (Experiment& clip : clips) clip.output *= units.asDiagonal();
  const LtiSystem scaled(truth.a(), truth.b(), units.asDiagonal() * truth.c(), units.asDiagonal() * truth.d());
  const NoiseModel other = fit_noise_model(scaled, clips);
  constexpr double kSame = 1e-6;
  EXPECT_LT((other.gain * units.asDiagonal() - one.gain).norm(), kSame);
  const auto back = units.cwiseInverse().asDiagonal();
  EXPECT_LT((back * other.covariances.output * back - one.covariances.output).norm(), kSame);
  EXPECT_LT((other.covariances.cross * back - one.covariances.cross).norm(), kSame);
}

TEST(NoiseModel, HasNoGainWithoutNoiseOrFramesAndSaysSo) {
  const LtiSystem truth = test::known_system();
  Diagnostics diagnostics;
  const NoiseModel exact = fit_noise_model(truth, test::clips_of(truth, {}), 10, &diagnostics);
  EXPECT_FALSE(exact.is_filter);
  EXPECT_EQ(exact.gain, Eigen::MatrixXd::Zero(4, 3));
  const NoiseModel brief = fit_noise_model(truth, test::clips_of(truth, {.count = 2, .frames = 3}), 10, &diagnostics);
  EXPECT_EQ(brief.gain, Eigen::MatrixXd::Zero(4, 3));
  auto silent = test::clips_of(truth, {.noise = 1.0});
  for (Experiment& clip : silent) clip.input.setZero();
  EXPECT_FALSE(fit_noise_model(truth, silent, 10, &diagnostics).is_filter);
  ASSERT_EQ(diagnostics.entries().size(), 3u);
  EXPECT_EQ(diagnostics.entries()[0].message,
            "the system leaves no error: no Kalman filter, predictions are simulations");
}

TEST(NoiseModel, OfAStaticMapIsTheErrorsCovariance) {
  std::mt19937 random(3);
  const LtiSystem map(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0), Eigen::MatrixXd::Ones(1, 1));
  Experiment clip{test::white_noise(2000, 1, random), {}};
  clip.output = clip.input + 0.5 * test::white_noise(2000, 1, random);
  const NoiseModel found = fit_noise_model(map, {clip});
  EXPECT_NEAR(found.innovation(0, 0), 0.25, 0.03);  // 2000 frames, thrice over
}

TEST(Prediction, SimulatesThroughTheLeadIn) {
  const LtiSystem truth = test::known_system();
  Experiment clip = test::clips_of(truth, {.count = 1, .lead_in = 10, .noise = 1.0})[0];
  const FrameMatrix simulated = simulate(truth, clip.input);
  const FrameMatrix predicted = predict(truth, known_gain(), clip);
  EXPECT_EQ(predicted.topRows(11), simulated.topRows(11));
  EXPECT_NE(predicted.row(11), simulated.row(11));
  EXPECT_EQ(predict(truth, Eigen::MatrixXd::Zero(4, 3), clip), simulated);
}

TEST(NoiseModel, RefusesWhatDoesNotFit) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 2});
  EXPECT_THROW(fit_noise_model(truth, {}), InvalidArgument);
  EXPECT_THROW(fit_noise_model(truth, clips, 1), InvalidArgument);
  EXPECT_THROW(predict(truth, Eigen::MatrixXd::Zero(3, 3), clips[0]), InvalidArgument);
  EXPECT_THROW(predict(truth, known_gain(), clips[0], Eigen::VectorXd::Zero(3)), InvalidArgument);
  const LtiSystem other(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0),
                        Eigen::MatrixXd::Ones(1, 1));
  EXPECT_THROW(fit_noise_model(other, clips), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
