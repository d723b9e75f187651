// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/experiment.h>

namespace strut::sysid {
namespace {

Experiment ramp(int lead_in) {
  Experiment clip{FrameMatrix::Zero(4, 1), FrameMatrix(4, 1), lead_in};
  clip.output << 7.0, 1.0, 2.0, 3.0;
  return clip;
}

TEST(FitSum, IsHundredForNoErrorAndZeroForTheMean) {
  const Experiment clip = ramp(1);
  FitSum perfect(1), mean(1);
  perfect.add(clip, clip.output);
  mean.add(clip, FrameMatrix::Constant(4, 1, 2.0));
  EXPECT_DOUBLE_EQ(perfect.fit(), 100.0);
  EXPECT_NEAR(mean.fit(), 0.0, 1e-12);
}

TEST(FitSum, PoolsClips) {
  FitSum sum(1);
  sum.add(ramp(1), ramp(1).output);
  sum.add(ramp(1), FrameMatrix::Constant(4, 1, 2.0));
  EXPECT_NEAR(sum.fit(), 100.0 * (1.0 - std::sqrt(2.0 / 4.0)), 1e-12);  // errors 2, variation 4
}

TEST(FitSum, LeavesOutOutputsThatDoNotVary) {
  Experiment clip{FrameMatrix::Zero(3, 1), FrameMatrix(3, 2)};
  clip.output << 1.0, 5.0, 2.0, 5.0, 3.0, 5.0;
  FitSum sum(2);
  sum.add(clip, FrameMatrix(clip.output.array() * Eigen::RowVector2d(1.0, 0.0).replicate(3, 1).array()));
  EXPECT_DOUBLE_EQ(sum.fit(), 100.0);
}

TEST(FitSum, TellsOutputsApart) {
  Experiment clip{FrameMatrix::Zero(3, 1), FrameMatrix(3, 3)};
  clip.output << 1.0, 5.0, 0.0, 2.0, 5.0, 0.0, 3.0, 5.0, 0.0;
  FitSum sum(3);
  sum.add(clip, FrameMatrix(clip.output.array() * Eigen::RowVector3d(1.0, 0.5, 1.0).replicate(3, 1).array()));
  EXPECT_EQ(sum.fit_per_output(), Eigen::Vector3d(100.0, 0.0, 100.0));
  EXPECT_EQ(sum.fit(), 100.0);
}

TEST(CheckExperiments, NamesWhatIsWrong) {
  Experiment clip = ramp(1);
  clip.output(2, 0) = std::nan("");
  try {
    check_experiments({ramp(1), clip});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_EQ(error.argument(), "experiments[1].output");
  }
  EXPECT_THROW(check_experiments({}), InvalidArgument);
  EXPECT_THROW(check_experiments({ramp(4)}), InvalidArgument);
  EXPECT_THROW(check_experiments({ramp(-1)}), InvalidArgument);
  EXPECT_THROW(check_experiments({{FrameMatrix::Zero(4, 1), FrameMatrix::Zero(3, 1)}}), InvalidArgument);
  EXPECT_THROW(check_experiments({ramp(0), {FrameMatrix::Zero(4, 2), FrameMatrix::Zero(4, 1)}}), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
