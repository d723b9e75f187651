// SPDX-License-Identifier: MIT
#include "align/signals_for_tests.h"

#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <strut/align/groupwise.h>
#include <strut/align/warp_curve.h>
#include <strut/core/error.h>
#include <strut/math/sampling.h>

namespace strut::align {
namespace {

constexpr int kDofs = 6;
constexpr double kRounding = 1e-9;
constexpr double kInterpolation = 0.02;  // of a cubic curve between frames [timeline frames]
// What smoothing and whole repetitions leave of a warp of 80 frames; an even stretch errs by 3.
constexpr double kMeanError = 0.35;

/// One content, done with a timing of its own: the content's moment at every frame.
struct Performance {
  Eigen::VectorXd moment;
  FrameMatrix signal;
};

/// Clips of `content`; clip k lasts 80 + 10 k frames and hurries and dwells in its own way, by up to `depth` of its
/// pace.
std::vector<Performance> performances(const FrameMatrix& content, int count, double depth = 0.35) {
  std::vector<Performance> all;
  for (int k = 0; k < count; ++k) {
    const int frames = 80 + 10 * k;
    Eigen::VectorXd passed(frames);
    double sum = 0.0;
    for (int t = 0; t < frames; ++t) {
      passed[t] = sum;
      sum += 1.0 + depth * std::sin(2.0 * M_PI * (1.5 * t / frames + 0.37 * k));
    }
    passed *= static_cast<double>(content.rows() - 1) / passed[frames - 1];
    all.push_back({passed, math::sample_rows(content, passed)});
  }
  return all;
}

std::vector<FrameMatrix> signals_of(const std::vector<Performance>& performances) {
  std::vector<FrameMatrix> signals;
  for (const Performance& performance : performances) signals.push_back(performance.signal);
  return signals;
}

double moment_at(const Performance& performance, double frame) {
  const FrameMatrix column = performance.moment;
  return math::sample_rows(column, Eigen::VectorXd::Constant(1, frame))(0, 0);
}

TEST(GroupAlignment, FindsTheSameMomentInEveryClip) {
  const FrameMatrix content = test::smooth_curves(100, kDofs, 4);
  const auto given = performances(content, 5);
  const GroupAlignment group = align_group(signals_of(given));
  double error = 0.0, worst_of_even = 0.0;
  int count = 0;
  for (Eigen::Index t = 0; t < group.mean.rows(); ++t) {
    std::vector<double> moments, of_even;
    for (std::size_t k = 0; k < given.size(); ++k) {
      moments.push_back(moment_at(given[k], group.clips[k].output_time()[t]));
      of_even.push_back(moment_at(given[k], static_cast<double>(t) / static_cast<double>(group.mean.rows() - 1) *
                                                static_cast<double>(given[k].signal.rows() - 1)));
    }
    for (std::size_t k = 1; k < given.size(); ++k) {
      error += std::abs(moments[k] - moments[0]);
      worst_of_even = std::max(worst_of_even, std::abs(of_even[k] - of_even[0]));
      ++count;
    }
  }
  EXPECT_LT(error / count, kMeanError);
  EXPECT_GT(worst_of_even, 3.0) << "the clips should differ in timing";
}

TEST(GroupAlignment, FavoursNoClipsTiming) {
  const auto given = performances(test::smooth_curves(100, kDofs, 4), 4);
  const GroupAlignment group = align_group(signals_of(given));
  const auto m = static_cast<double>(group.mean.rows());
  double passed = 0.0;
  for (Eigen::Index t = 0; t < group.mean.rows(); ++t) {
    for (const Correspondence& clip : group.clips) {
      passed += clip.differential_warp[t] / clip.differential_warp.sum() / static_cast<double>(group.clips.size());
    }
    EXPECT_NEAR(passed * m, static_cast<double>(t + 1), kInterpolation);
  }
}

TEST(GroupAlignment, OfOneClipManyTimesIsThatClip) {
  const FrameMatrix clip = test::smooth_curves(70, kDofs, 1);
  const GroupAlignment group = align_group({clip, clip, clip});
  EXPECT_TRUE(group.converged);
  EXPECT_NEAR(group.spread.back(), 0.0, kRounding);
  EXPECT_LT((group.mean - clip).cwiseAbs().maxCoeff(), kRounding);
}

TEST(GroupAlignment, GivesEveryClipItsFramesAndTheTimelineItsOwn) {
  const auto given = performances(test::smooth_curves(100, kDofs, 2), 3);
  GroupOptions options;
  options.num_frames = 64;
  const GroupAlignment group = align_group(signals_of(given), options);
  EXPECT_EQ(group.mean.rows(), 64);
  for (std::size_t k = 0; k < given.size(); ++k) {
    EXPECT_EQ(group.clips[k].differential_warp.size(), 64);
    EXPECT_NEAR(group.clips[k].differential_warp.sum(), static_cast<double>(given[k].signal.rows()), kRounding);
    EXPECT_GT(group.clips[k].differential_warp.minCoeff(), 0.0);
  }
}

TEST(GroupAlignment, DoesNotDependOnTheOrderOfTheClipsNorOnThreads) {
  std::vector<FrameMatrix> clips = signals_of(performances(test::smooth_curves(100, kDofs, 3), 4));
  const GroupAlignment group = align_group(clips);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(align_group(clips).mean, group.mean);
  std::swap(clips[0], clips[3]);
  EXPECT_LT((align_group(clips).mean - group.mean).cwiseAbs().maxCoeff(), kRounding);
}

TEST(GroupAlignment, UsesTheAlignerItIsGiven) {
  const auto given = performances(test::smooth_curves(100, kDofs, 5), 3);
  GroupOptions options;
  options.aligner = [](const auto& input, const auto& output) {
    return Correspondence{Eigen::VectorXd::Constant(
        input.rows(), static_cast<double>(output.rows()) / static_cast<double>(input.rows()))};
  };
  const GroupAlignment group = align_group(signals_of(given), options);
  EXPECT_TRUE(group.converged);
  EXPECT_EQ(group.spread.size(), 1U);
}

TEST(GroupAlignment, RefusesWhatIsNoGroup) {
  const FrameMatrix clip = test::smooth_curves(30, kDofs, 1);
  EXPECT_THROW(align_group({clip}), InvalidArgument);
  EXPECT_THROW(align_group({clip, test::smooth_curves(30, kDofs + 1, 1)}), InvalidArgument);
  GroupOptions options;
  options.max_rounds = 0;
  EXPECT_THROW(align_group({clip, clip}, options), InvalidArgument);
  options = {};
  options.num_frames = -1;
  EXPECT_THROW(align_group({clip, clip}, options), InvalidArgument);
}

TEST(AlignmentWithAReference, NamesTheClipThatCannotBe) {
  const FrameMatrix clip = test::smooth_curves(30, kDofs, 1);
  EXPECT_EQ(align_to_reference(clip, {clip, clip}).size(), 2U);
  try {
    align_to_reference(clip, {clip, clip, test::smooth_curves(200, kDofs, 1)});
    FAIL() << "a clip of seven times the reference's length was aligned";
  } catch (const InvalidArgument& error) {
    EXPECT_EQ(std::string(error.what()).find("clip 2: output: "), 0U) << error.what();
  }
}

}  // namespace
}  // namespace strut::align
