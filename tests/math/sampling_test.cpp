// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/math/sampling.h>

namespace strut::math {
namespace {

TEST(SampleRows, PassesThroughTheRowsAndKeepsStraightLines) {
  FrameMatrix line(5, 2);
  for (int t = 0; t < 5; ++t) line.row(t) << 3.0 * t, 1.0 - t;
  const Eigen::VectorXd positions = (Eigen::VectorXd(6) << 0.0, 0.25, 1.0, 2.5, 3.9, 4.0).finished();
  const FrameMatrix sampled = sample_rows(line, positions);
  for (Eigen::Index i = 0; i < positions.size(); ++i) {
    EXPECT_NEAR(sampled(i, 0), 3.0 * positions[i], 1e-12);
    EXPECT_NEAR(sampled(i, 1), 1.0 - positions[i], 1e-12);
  }
}

TEST(SampleRows, IsExactForParabolasInside) {
  FrameMatrix parabola(6, 1);
  for (int t = 0; t < 6; ++t) parabola(t, 0) = t * t;
  EXPECT_NEAR(sample_rows(parabola, Eigen::VectorXd::Constant(1, 2.3))(0, 0), 2.3 * 2.3, 1e-12);
}

TEST(SampleRows, HoldsTheEnds) {
  const FrameMatrix one = FrameMatrix::Constant(1, 3, 7.0);
  EXPECT_EQ(sample_rows(one, Eigen::VectorXd::Constant(1, -2.0))(0, 1), 7.0);
  EXPECT_EQ(sample_rows(one, Eigen::VectorXd::Constant(1, 9.0))(0, 2), 7.0);
}

TEST(SampleRows, RefusesEmptySignalsAndBadPositions) {
  EXPECT_THROW(sample_rows(FrameMatrix(0, 3), Eigen::VectorXd::Zero(1)), InvalidArgument);
  EXPECT_THROW(sample_rows(FrameMatrix::Zero(2, 3), Eigen::VectorXd::Constant(1, NAN)), InvalidArgument);
}

}  // namespace
}  // namespace strut::math
