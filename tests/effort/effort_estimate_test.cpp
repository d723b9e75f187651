// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_estimate.h>

namespace strut::effort {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-9;

/// So many fragments of one content whose descriptors are independent.
MatrixXd random_rows(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd rows(count, static_cast<int>(kNumDescriptors));
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < kNumDescriptors; ++k) rows(i, k) = 2.0 + 0.5 * normal(random);
  }
  return rows;
}

/// A person who goes by what the starting formula does not look at.
EffortVector by_other_cues(const VectorXd& z) {
  return {std::tanh(0.6 * z[kExtent]), std::tanh(0.6 * z[kCurvature]), std::tanh(0.3 * (z[kHeight] - z[kLogJerk]))};
}

std::vector<LabelledDescriptors> labels_of(const MatrixXd& rows, const DescriptorScale& scale) {
  std::vector<LabelledDescriptors> labels;
  for (int i = 0; i < rows.rows(); ++i) {
    labels.push_back({0, rows.row(i).transpose(), by_other_cues(standardized(scale, rows.row(i).transpose()))});
  }
  return labels;
}

double error_of(const KinematicEstimator& estimator, const MatrixXd& rows, const DescriptorScale& scale) {
  double sum = 0.0;
  for (const LabelledDescriptors& label : labels_of(rows, scale)) {
    sum += (estimator.estimate(0, label.descriptors).effort - label.effort).squaredNorm();
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(rows.rows())));
}

TEST(KinematicEstimator, StartsFromTheFormula) {
  const MatrixXd rows = random_rows(12, 1);
  const DescriptorScale scale = descriptor_scale(rows);
  const KinematicEstimator estimator({scale});
  const VectorXd z = standardized(scale, rows.row(3).transpose());
  const EffortVector effort = estimator.estimate(0, rows.row(3).transpose()).effort;
  EXPECT_NEAR(effort[kFlow], std::tanh(-0.6 * z[kHandSmoothness]), kRounding);
  EXPECT_NEAR(effort[kWeight], 0.5 * (std::tanh(0.6 * z[kLogPeakDeceleration]) - std::tanh(0.6 * z[kHeight])),
              kRounding);
  EXPECT_NEAR(effort[kTime], std::tanh(0.6 * z[kLogAcceleration]), kRounding);
  EXPECT_FALSE(estimator.is_fitted(kFlow));
}

TEST(KinematicEstimator, HasNoConfidenceInAFragmentAlone) {
  const MatrixXd rows = random_rows(12, 2);
  const KinematicEstimator alone({descriptor_scale(rows.topRows(1))}), many({descriptor_scale(rows)});
  EXPECT_EQ(alone.estimate(0, rows.row(0).transpose()).confidence, EffortVector::Zero());
  EXPECT_EQ(alone.estimate(0, rows.row(0).transpose()).effort, EffortVector::Zero());
  EXPECT_GT(many.estimate(0, rows.row(0).transpose()).confidence.minCoeff(), 0.0);
}

TEST(KinematicEstimator, LearnsHowAPersonLabels) {
  const MatrixXd seen = random_rows(60, 3), unseen = random_rows(60, 4);
  const DescriptorScale scale = descriptor_scale(seen);
  const KinematicEstimator start({scale}), fitted = KinematicEstimator::fit({scale}, labels_of(seen, scale));
  EXPECT_LT(error_of(fitted, unseen, scale), 0.3 * error_of(start, unseen, scale));
  EXPECT_TRUE(fitted.is_fitted(kTime));
  EXPECT_GT(fitted.estimate(0, seen.row(0).transpose()).confidence.minCoeff(), 0.5);
}

TEST(KinematicEstimator, KnowsItsLeftOutError) {
  const MatrixXd rows = random_rows(30, 5);
  const DescriptorScale scale = descriptor_scale(rows);
  std::vector<LabelledDescriptors> labels = labels_of(rows, scale);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (LabelledDescriptors& label : labels) label.effort[kTime] = noise(random);
  const KinematicEstimator fitted = KinematicEstimator::fit({scale}, labels);
  const EstimatorNumbers& numbers = fitted.numbers();
  EXPECT_LT(numbers.left_out_error[kFlow], 0.6 * numbers.label_deviation[kFlow]);
  EXPECT_GT(numbers.left_out_error[kTime], 0.9 * numbers.label_deviation[kTime]);  // nothing to learn
  EXPECT_LT(fitted.estimate(0, rows.row(0).transpose()).confidence[kTime], 0.1);
}

TEST(KinematicEstimator, KeepsTheFormulaForAFactorWithFewLabels) {
  const MatrixXd rows = random_rows(30, 7);
  const DescriptorScale scale = descriptor_scale(rows);
  std::vector<LabelledDescriptors> labels = labels_of(rows, scale);
  for (std::size_t i = 0; i < 11; ++i) labels[i].effort[kWeight] = kNotRated;
  const KinematicEstimator start({scale}), fitted = KinematicEstimator::fit({scale}, labels);
  EXPECT_TRUE(fitted.is_fitted(kFlow));
  EXPECT_FALSE(fitted.is_fitted(kWeight));
  EXPECT_EQ(fitted.numbers().num_labels[kWeight], 19);
  EXPECT_EQ(fitted.estimate(0, rows.row(0).transpose()).effort[kWeight],
            start.estimate(0, rows.row(0).transpose()).effort[kWeight]);
}

TEST(KinematicEstimator, StaysWithinThePoles) {
  const MatrixXd rows = random_rows(30, 8);
  const DescriptorScale scale = descriptor_scale(rows);
  const KinematicEstimator fitted = KinematicEstimator::fit({scale}, labels_of(rows, scale));
  const VectorXd extreme = VectorXd::Constant(kNumDescriptors, 100.0);
  EXPECT_LE(fitted.estimate(0, extreme).effort.cwiseAbs().maxCoeff(), 1.0);
}

TEST(KinematicEstimator, IsItsNumbers) {
  const MatrixXd rows = random_rows(30, 9);
  const DescriptorScale scale = descriptor_scale(rows);
  const KinematicEstimator fitted = KinematicEstimator::fit({scale}, labels_of(rows, scale));
  const KinematicEstimator again(fitted.numbers());
  EXPECT_EQ(fitted.estimate(0, rows.row(1).transpose()).effort, again.estimate(0, rows.row(1).transpose()).effort);
  EXPECT_EQ(fitted.estimate(0, rows.row(1).transpose()).confidence,
            again.estimate(0, rows.row(1).transpose()).confidence);
}

TEST(KinematicEstimator, RefusesWhatItCannotTake) {
  const MatrixXd rows = random_rows(30, 10);
  const DescriptorScale scale = descriptor_scale(rows);
  const KinematicEstimator estimator({scale});
  EXPECT_THROW((void)estimator.estimate(1, rows.row(0).transpose()), InvalidArgument);
  EXPECT_THROW((void)estimator.estimate(0, VectorXd::Zero(3)), InvalidArgument);
  EXPECT_THROW(KinematicEstimator::fit({scale}, {{0, rows.row(0).transpose(), {2.0, 0.0, 0.0}}}), InvalidArgument);
  EXPECT_THROW(KinematicEstimator::fit({scale}, {{3, rows.row(0).transpose(), {0.0, 0.0, 0.0}}}), InvalidArgument);
  EstimatorNumbers numbers = estimator.numbers();
  numbers.weights(0, 0) = kNotRated;
  EXPECT_THROW(KinematicEstimator{numbers}, InvalidArgument);
}

}  // namespace
}  // namespace strut::effort
