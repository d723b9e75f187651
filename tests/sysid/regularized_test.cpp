// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <algorithm>
#include <limits>
#include <string>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/regularized.h>

namespace strut::sysid {
namespace {

constexpr double kSameSolution = 1e-8;  // of taps of size one: two ways to solve the same equations
constexpr TruncationOptions kWhole{.max_order = 1000, .tolerance = 0.0};  // nothing is truncated

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

/// Every clip a group of its own.
LeaveOut leave_out_clips(const std::vector<Experiment>& clips, int num_folds = 4) {
  std::vector<int> groups, frames;
  for (const Experiment& clip : clips) {
    groups.push_back(static_cast<int>(groups.size()));
    frames.push_back(clip.num_fitted());
  }
  return leave_out_groups(groups, frames, num_folds);
}

/// Lagged inputs, input by input, of the rows that count.
Eigen::MatrixXd regressors(const std::vector<Experiment>& clips, int taps) {
  Eigen::MatrixXd all(0, clips.front().input.cols() * taps);
  for (const Experiment& clip : clips) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(clip.num_fitted(), all.cols());
    for (Eigen::Index t = 0; t < rows.rows(); ++t) {
      for (Eigen::Index i = 0; i < clip.input.cols(); ++i) {
        for (Eigen::Index a = 0; a < std::min<Eigen::Index>(taps, t + clip.lead_in + 1); ++a) {
          rows(t, i * taps + a) = clip.input(t + clip.lead_in - a, i);
        }
      }
    }
    all.conservativeResize(all.rows() + rows.rows(), Eigen::NoChange);
    all.bottomRows(rows.rows()) = rows;
  }
  return all;
}

Eigen::MatrixXd outputs(const std::vector<Experiment>& clips) {
  Eigen::MatrixXd all(0, clips.front().output.cols());
  for (const Experiment& clip : clips) {
    all.conservativeResize(all.rows() + clip.num_fitted(), Eigen::NoChange);
    all.bottomRows(clip.num_fitted()) = clip.output.bottomRows(clip.num_fitted());
  }
  return all;
}

/// The prior's covariance K of all taps, input by input.
Eigen::MatrixXd covariance_of(const PriorParameters& prior, const std::vector<int>& sets, int taps) {
  const Eigen::MatrixXd factor = kernel_factor(prior.shape, taps);
  const auto size = static_cast<Eigen::Index>(sets.size()) * taps;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(sets.size()); ++i) {
    const double scale = prior.scales[static_cast<std::size_t>(sets[static_cast<std::size_t>(i)])];
    covariance.block(i * taps, i * taps, taps, taps) = scale * factor * factor.transpose();
  }
  return covariance;
}

/// The estimate under a prior, by way of the covariance of the outputs: K R' (R K R' + I)^-1 y.
Eigen::MatrixXd brute_force(const std::vector<Experiment>& clips, const std::vector<int>& sets,
                            const PriorParameters& prior, int taps) {
  const Eigen::MatrixXd r = regressors(clips, taps);
  const Eigen::MatrixXd covariance = covariance_of(prior, sets, taps);
  Eigen::MatrixXd of_outputs = r * covariance * r.transpose();
  of_outputs.diagonal().array() += 1.0;
  return covariance * r.transpose() * of_outputs.llt().solve(outputs(clips));
}

/// Minus twice the logarithm of the probability of the outputs, of covariance R K R' + I times their noise's variance.
double unlikelihood(const std::vector<Experiment>& clips, const std::vector<int>& sets, const PriorParameters& prior,
                    int taps) {
  const Eigen::MatrixXd r = regressors(clips, taps), y = outputs(clips);
  Eigen::MatrixXd covariance = r * covariance_of(prior, sets, taps) * r.transpose();
  covariance.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  const Eigen::ArrayXd noise = y.cwiseProduct(llt.solve(y)).colwise().mean();
  const double determinant = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  return static_cast<double>(y.rows()) * noise.log().sum() + static_cast<double>(y.cols()) * determinant;
}

/// The responses' taps as brute_force lays them out: (inputs x taps) x outputs.
Eigen::MatrixXd stacked(const ImpulseResponse& response) {
  const auto taps = static_cast<Eigen::Index>(response.size());
  Eigen::MatrixXd result(response.front().cols() * taps, response.front().rows());
  for (Eigen::Index i = 0; i < response.front().cols(); ++i) {
    for (Eigen::Index a = 0; a < taps; ++a) {
      result.row(i * taps + a) = response[static_cast<std::size_t>(a)].col(i).transpose();
    }
  }
  return result;
}

double distance(const ImpulseResponse& one, const ImpulseResponse& other) {
  return (stacked(one) - stacked(other)).norm();
}

TEST(Regularized, SolvesWhatBruteForceSolves) {
  constexpr int kTaps = 12;
  auto clips = test::clips_of(test::known_system(), {.count = 3, .frames = 25, .noise = 0.5});
  for (Experiment& clip : test::clips_of(test::known_system(), {.count = 2, .frames = 20, .lead_in = 17, .seed = 2})) {
    clip.output.topRows(clip.lead_in).setConstant(1e3);  // must not be looked at
    clips.push_back(clip);
  }
  for (Experiment& clip : test::clips_of(test::known_system(), {.count = 2, .frames = 5, .lead_in = 3, .seed = 3})) {
    clips.push_back(clip);  // shorter than the taps
  }
  clips.push_back(test::clips_of(test::known_system(), {.count = 1, .frames = 1, .seed = 4}).front());
  const std::vector<int> sets = {1, 0};
  const Regularized found =
      identify_regularized(clips, leave_out_clips(clips), sets, {.taps = kTaps, .truncation = kWhole});
  const Eigen::MatrixXd expected = brute_force(clips, sets, found.prior, kTaps);
  EXPECT_LT((stacked(impulse_response(found.system, kTaps)) - expected).norm(), kSameSolution);

  PriorParameters other = found.prior;
  std::swap(other.scales[0], other.scales[1]);
  EXPECT_GT((brute_force(clips, sets, other, kTaps) - expected).norm(), 100.0 * kSameSolution) << "the check can fail";
}

TEST(Regularized, SaysTheFitOfTheClipsLeftOut) {
  constexpr int kTaps = 10;
  const auto clips = test::clips_of(test::known_system(), {.count = 8, .frames = 30, .noise = 1.0});
  std::vector<int> groups = {0, 0, 1, 1, 2, 2, 3, 3}, other_groups = {0, 1, 0, 1, 2, 3, 2, 3};
  for (const LeaveOut& leave_out :
       {leave_out_clips(clips), leave_out_pairs(groups, other_groups, std::vector<int>(8, 30), 4)}) {
    const Regularized found = identify_regularized(clips, leave_out, {0, 0}, {.taps = kTaps});
    Eigen::MatrixXd wanted(0, 3), errors(0, 3);
    for (const std::vector<Role>& round : leave_out.rounds) {
      std::vector<Experiment> learn, test;
      for (std::size_t k = 0; k < clips.size(); ++k) {
        if (round[k] == Role::kLearn) learn.push_back(clips[k]);
        if (round[k] == Role::kTest) test.push_back(clips[k]);
      }
      const Eigen::MatrixXd y = outputs(test);
      const Eigen::MatrixXd e = y - regressors(test, kTaps) * brute_force(learn, {0, 0}, found.prior, kTaps);
      wanted.conservativeResize(wanted.rows() + y.rows(), Eigen::NoChange);
      errors.conservativeResize(wanted.rows(), Eigen::NoChange);
      wanted.bottomRows(y.rows()) = y;
      errors.bottomRows(y.rows()) = e;
    }
    const Eigen::RowVectorXd mean = wanted.colwise().mean();
    const Eigen::ArrayXd variation = (wanted.rowwise() - mean).colwise().norm();
    const Eigen::ArrayXd error = errors.colwise().norm();
    EXPECT_NEAR(found.fit, 100.0 * (1.0 - error / variation).mean(),
                1e-6);  // points; from sums, of which little is left
  }
}

TEST(Regularized, IsNearerTheTruthThanLeastSquares) {
  constexpr int kTaps = 30;
  const LtiSystem truth = test::known_system();
  const ImpulseResponse expected = impulse_response(truth, kTaps);
  const auto clips = test::clips_of(truth, {.count = 6, .frames = 40, .noise = 1.0});
  const Eigen::MatrixXd r = regressors(clips, kTaps);
  const Eigen::MatrixXd plain = (r.transpose() * r).ldlt().solve(r.transpose() * outputs(clips));
  const double plain_distance = (plain - stacked(expected)).norm();
  for (const Kernel kernel : {Kernel::kTc, Kernel::kDc, Kernel::kSs}) {
    for (const Selection selection : {Selection::kLeftOut, Selection::kMarginalLikelihood}) {
      const Regularized found =
          identify_regularized(clips, leave_out_clips(clips), {0, 0}, {.kernel = kernel, .selection = selection});
      EXPECT_LT(distance(impulse_response(found.system, kTaps), expected), 0.5 * plain_distance);
      EXPECT_LT(found.system.spectral_radius(), 1.0);
      EXPECT_GT(found.fit, 45.0) << "the noise leaves 53.5 at most";
    }
  }
}

TEST(Regularized, RecoversASystemFromExactData) {
  const LtiSystem truth = test::known_system();
  const auto clips = test::clips_of(truth, {.count = 20, .frames = 100});
  const Regularized found = identify_regularized(clips, leave_out_clips(clips), {0, 0}, {.taps = 60});
  EXPECT_GT(found.fit, 95.0);
  EXPECT_LT(found.truncation_error, 0.05);
  EXPECT_GT(simulated_fit(found.system, test::clips_of(truth, {.seed = 9})), 95.0);
}

TEST(Regularized, ShrinksASetThatCarriesNothing) {
  std::mt19937 random(6);
  auto clips = test::clips_of(test::known_system(), {.count = 8, .frames = 40, .noise = 1.0});
  for (Experiment& clip : clips) {
    clip.input.conservativeResize(Eigen::NoChange, 8);
    clip.input.rightCols(6) = test::white_noise(clip.num_frames(), 6, random);
  }
  const std::vector<int> apart = {0, 0, 1, 1, 1, 1, 1, 1};
  for (const Selection selection : {Selection::kLeftOut, Selection::kMarginalLikelihood}) {
    const RegularizedOptions options{.taps = 20, .selection = selection};
    const Regularized found = identify_regularized(clips, leave_out_clips(clips), apart, options);
    const Regularized together = identify_regularized(clips, leave_out_clips(clips), std::vector<int>(8, 0), options);
    EXPECT_LT(found.prior.scales[1], 0.05 * found.prior.scales[0]);
    EXPECT_GT(found.fit, together.fit);
  }
}

TEST(Regularized, JudgesByLikelihoodWhereNoClipCanBeLeftOut) {
  const auto clips = test::clips_of(test::known_system(), {.count = 1, .frames = 200, .noise = 0.5});
  const Regularized likely = identify_regularized(clips, {}, {0, 0}, {.selection = Selection::kMarginalLikelihood});
  for (const LeaveOut& leave_out : {LeaveOut{}, leave_out_clips(clips), LeaveOut{{{Role::kUnused}, {Role::kLearn}}}}) {
    const Regularized found = identify_regularized(clips, leave_out, {0, 0});
    EXPECT_EQ(found.prior.scales, likely.prior.scales);
    EXPECT_EQ(found.prior.shape.decay, likely.prior.shape.decay);
    EXPECT_EQ(found.fit, 0.0);
  }
  EXPECT_GT(simulated_fit(likely.system, test::clips_of(test::known_system(), {.seed = 9})), 75.0);
}

TEST(Regularized, IsWhereTheOutputsAreMostProbable) {
  constexpr int kTaps = 15;
  constexpr double kNotWorthAStep = 0.02;  // of the search
  const std::vector<int> sets = {0, 1};
  const auto clips = test::clips_of(test::known_system(), {.count = 2, .frames = 50, .noise = 1.0});
  const PriorParameters found = identify_regularized(clips, {}, sets, {.taps = kTaps}).prior;
  const double best = unlikelihood(clips, sets, found, kTaps);
  for (const double step : {-0.5, 0.5}) {  // half a factor of e
    std::vector<PriorParameters> neighbours(3, found);
    neighbours[0].scales[0] *= std::exp(step);
    neighbours[1].scales[1] *= std::exp(step);
    neighbours[2].shape.decay = std::pow(found.shape.decay, std::exp(0.5 * step));
    for (const PriorParameters& neighbour : neighbours) {
      EXPECT_GT(unlikelihood(clips, sets, neighbour, kTaps), best - kNotWorthAStep);
    }
  }
}

TEST(Regularized, IgnoresRoundsThatCannotJudge) {
  const auto clips = test::clips_of(test::known_system(), {.count = 4, .frames = 30, .noise = 0.5});
  LeaveOut leave_out = leave_out_clips(clips);
  const Regularized plain = identify_regularized(clips, leave_out, {0, 0});
  leave_out.rounds.emplace_back(4, Role::kTest);
  leave_out.rounds.emplace_back(4, Role::kLearn);
  const Regularized found = identify_regularized(clips, leave_out, {0, 0});
  EXPECT_EQ(found.fit, plain.fit);
  EXPECT_EQ(found.prior.scales, plain.prior.scales);
}

TEST(Regularized, DoesNotCareForUnits) {
  auto clips = test::clips_of(test::known_system(), {.count = 6, .frames = 40, .noise = 0.5});
  const Regularized plain = identify_regularized(clips, leave_out_clips(clips), {0, 1});
  for (const double input_unit : {1e-6, 1e6}) {
    for (const double output_unit : {1e-6, 1e6}) {
      auto scaled = clips;
      for (Experiment& clip : scaled) {
        clip.input.col(1) *= input_unit;
        clip.output *= output_unit;
      }
      const Regularized found = identify_regularized(scaled, leave_out_clips(clips), {0, 1});
      EXPECT_NEAR(found.fit, plain.fit, 1e-6);
      EXPECT_EQ(found.prior.shape.decay, plain.prior.shape.decay);
      EXPECT_NEAR(found.system.d()(0, 1) * input_unit / output_unit, plain.system.d()(0, 1), kSameSolution);
      EXPECT_NEAR(found.system.d()(0, 0) / output_unit, plain.system.d()(0, 0), kSameSolution);
    }
  }
}

TEST(Regularized, SharesAResponseAmongInputsThatAreTheSame) {
  auto clips = test::clips_of(test::known_system(), {.count = 6, .frames = 40, .noise = 0.1});
  for (Experiment& clip : clips) {
    clip.input.conservativeResize(Eigen::NoChange, 3);
    clip.input.col(2) = clip.input.col(1);
  }
  const Regularized found =
      identify_regularized(clips, leave_out_clips(clips), {0, 0, 0}, {.taps = 30, .truncation = kWhole});
  for (const Eigen::MatrixXd& tap : impulse_response(found.system, 30)) {
    EXPECT_LT((tap.col(1) - tap.col(2)).norm(), kSameSolution);
  }
  EXPECT_GT(found.fit, 80.0);
}

TEST(Regularized, StandsInputsAndOutputsThatDoNotMove) {
  auto clips = test::clips_of(test::known_system(), {.count = 6, .frames = 40, .noise = 0.1});
  for (Experiment& clip : clips) {
    clip.input.conservativeResize(Eigen::NoChange, 4);
    clip.input.col(2).setConstant(3.0);
    clip.input.col(3).setZero();
    clip.output.col(0).array() += 2.0;
    clip.output.col(1).setConstant(1.0);
    clip.output.col(2).setZero();
  }
  for (const Selection selection : {Selection::kLeftOut, Selection::kMarginalLikelihood}) {
    const Regularized found =
        identify_regularized(clips, leave_out_clips(clips), {0, 0, 1, 2}, {.selection = selection});
    EXPECT_GT(found.fit, 80.0) << "of the output that moves, its offset by the constant input";
    EXPECT_EQ(found.system.d().col(3).norm(), 0.0);
    EXPECT_EQ(found.system.b().col(3).norm(), 0.0);
    EXPECT_EQ(found.system.d().row(2).norm(), 0.0);
  }
}

TEST(Regularized, OfNothingIsNothing) {
  for (const double input : {0.0, 1.0}) {
    const std::vector<Experiment> clips(3, {FrameMatrix::Constant(20, 2, input), FrameMatrix::Zero(20, 1)});
    const Regularized found = identify_regularized(clips, leave_out_clips(clips), {0, 1});
    EXPECT_EQ(found.system.num_states(), 0);
    EXPECT_EQ(found.system.d().norm(), 0.0);
    EXPECT_EQ(found.fit, 0.0);
  }
}

TEST(Regularized, StandsShortClipsAndFewTaps) {
  for (const int frames : {1, 2, 7}) {
    for (const int taps : {1, 2, 30}) {
      const auto clips = test::clips_of(test::known_system(), {.count = 3, .frames = frames});
      const Regularized found =
          identify_regularized({clips.front()}, leave_out_clips({clips.front()}), {0, 0}, {.taps = taps});
      EXPECT_LE(found.system.spectral_radius(), 1.0);
      EXPECT_LT(identify_regularized(clips, leave_out_clips(clips), {0, 0}, {.taps = taps}).system.num_states(),
                taps * 3);
    }
  }
}

TEST(Regularized, OfOneTapIsAStaticMap) {
  const Eigen::MatrixXd d = test::known_system().d();
  const LtiSystem map(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), Eigen::MatrixXd(3, 0), d);
  const auto clips = test::clips_of(map, {.count = 6, .noise = 1e-3});
  for (const int taps : {1, 2, 20}) {
    const Regularized found = identify_regularized(clips, leave_out_clips(clips), {0, 0}, {.taps = taps});
    EXPECT_EQ(found.system.num_states(), 0) << taps;
    EXPECT_LT((found.system.d() - d).norm(), 1e-2) << "shrunk a little";
  }
}

TEST(Regularized, RefusesWhatCannotBeMeant) {
  auto clips = test::clips_of(test::known_system(), {.count = 2, .frames = 10});
  const auto of = [&](const LeaveOut& leave_out, const std::vector<int>& sets, const RegularizedOptions& options) {
    return message_of([&] { identify_regularized(clips, leave_out, sets, options); });
  };
  EXPECT_EQ(of({}, {0, 0}, {}), "(nothing thrown)");
  EXPECT_EQ(of({{{Role::kLearn}}}, {0, 0}, {}), "leave_out: expected 2 clips, got 1");
  EXPECT_EQ(of({}, {0}, {}), "input_sets: expected 2 elements, got 1");
  EXPECT_EQ(of({}, {0, -1}, {}), "input_sets: expected sets from 0 to 1, got -1");
  EXPECT_EQ(of({}, {0, 2}, {}), "input_sets: expected sets from 0 to 1, got 2");
  EXPECT_EQ(of({}, {0, 0}, {.taps = 0}), "taps: expected 1 or more, got 0");
  EXPECT_EQ(of({}, {0, 0}, {.truncation = {.max_order = -1}}), "max_order: expected 0 or more, got -1");
  clips[1].input(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of({}, {0, 0}, {}), "experiments[1].input: expected finite numbers, got NaN or infinity");
  clips.clear();
  EXPECT_EQ(of({}, {0, 0}, {}), "experiments: expected at least one clip, got none");
}

}  // namespace
}  // namespace strut::sysid
