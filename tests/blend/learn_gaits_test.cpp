// SPDX-License-Identifier: MIT
// Combinations of style and speed that were left out are predicted; the exact walks are the judge.
#include "small_gaits.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>

namespace strut::blend {
namespace {

using test::small_examples;
using test::small_gaits;
using test::walks_and_truth;

/// Root mean square distance of two cycles in all angles [rad].
double distance(const GaitLoop& a, const GaitLoop& b) {
  const auto rows = a.num_signals() - 1 - representation::kNumRootDofs;
  return (a.series() - b.series()).middleRows(representation::kNumRootDofs, rows).norm();
}

GaitLoop predicted(std::size_t left_out, BilinearKind kind) {
  GaitExamples others = small_examples();
  const GaitCell at = others.cells[left_out];
  others.cells.erase(others.cells.begin() + static_cast<std::ptrdiff_t>(left_out));
  const auto model = learn_gaits(others, {.kind = kind}).model;
  return model->loop(Eigen::VectorXd::Unit(3, at.style), at.speed);
}

/// Mean over the best that one factor alone can do.
double single_factor_error(const GaitExamples& all, std::size_t i, const GaitLoop& truth) {
  const GaitCell& at = all.cells[i];
  Eigen::VectorXd style = Eigen::VectorXd::Zero(truth.packed().size()), speed = style;
  double nearest = 1e300, away = 1e300, others = 0.0, peers = 0.0;
  for (std::size_t k = 0; k < all.cells.size(); ++k) {
    if (k == i) continue;
    const GaitCell& cell = all.cells[k];
    if (cell.style == at.style) {
      style += cell.loop.packed();
      others += 1.0;
      const double apart = std::abs(std::log(cell.speed / at.speed));
      if (apart < away) nearest = distance(cell.loop, truth);
      away = std::min(away, apart);
    } else if (k % 4 == i % 4) {
      speed += cell.loop.packed();
      peers += 1.0;
    }
  }
  return std::min({nearest, distance(GaitLoop::unpacked(style / others, truth.num_signals()), truth),
                   distance(GaitLoop::unpacked(speed / peers, truth.num_signals()), truth)});
}

TEST(LearntGaits, PredictLeftOutCombinationsThreeTimesBetterThanOneFactor) {
  const GaitExamples all = small_examples();
  double bilinear = 0.0, single = 0.0;
  for (std::size_t i = 0; i < all.cells.size(); i += 5) {  // 0, 5, 10: the slowest plain, a crouch, a march
    const GaitLoop& truth = walks_and_truth().cells[12 + i].loop;
    bilinear += distance(predicted(i, BilinearKind::kAsymmetric), truth);
    single += single_factor_error(all, i, truth);
  }
  EXPECT_GT(single, 3.0 * bilinear);
}

TEST(LearntGaits, ReportsWhatWasLeftOut) {
  const GaitReport& report = small_gaits().report;
  EXPECT_EQ(report.num_cells, 12);
  EXPECT_EQ(report.left_out.size(), 12U);
  EXPECT_GT(report.mean.bilinear, 0.0);
  EXPECT_GT(std::min({report.mean.style_only, report.mean.speed_only, report.mean.nearest}),
            2.0 * report.mean.bilinear);
  EXPECT_TRUE(report.converged);
}

TEST(LearntGaits, KnowTheirSpeeds) {
  const GaitStyle& plain = small_gaits().model->styles()[0];
  EXPECT_NEAR(plain.slowest, 0.6, 0.03);
  EXPECT_NEAR(plain.fastest, 1.5, 0.06);
}

TEST(LearntGaits, SayThatAStyleHasOneSpeed) {
  GaitExamples few = small_examples();
  std::erase_if(few.cells, [](const GaitCell& cell) { return cell.style == 1 && cell.speed > 0.6; });
  Diagnostics told;
  const auto learnt = learn_gaits(few, {}, {}, &told);
  ASSERT_EQ(told.entries().size(), 1U);
  EXPECT_THAT(told.entries()[0].message, testing::HasSubstr("'crouch'"));
  const GaitLoop slow = learnt.model->loop(Eigen::Vector3d(0, 1, 0), 0.5);
  const GaitLoop fast = learnt.model->loop(Eigen::Vector3d(0, 1, 0), 0.8);
  EXPECT_LT(fast.duration(), slow.duration()) << "it quickens as the others do";
}

TEST(LearntGaits, NeedTwoStyles) {
  GaitExamples one = small_examples();
  one.styles.resize(1);
  std::erase_if(one.cells, [](const GaitCell& cell) { return cell.style > 0; });
  EXPECT_THROW(learn_gaits(one), InvalidArgument);
  EXPECT_THROW(learn_gaits(small_examples(), {.ridge = -1.0}), InvalidArgument);
  EXPECT_THROW(learn_gaits(small_examples(), {.content_dims = 3, .speed_functions = 2}), InvalidArgument);
}

TEST(GaitModel, TravelsAtTheSpeedAskedFor) {
  const auto& model = *small_gaits().model;
  for (const double speed : {0.5, 1.0, 1.6}) {
    EXPECT_NEAR(model.loop(Eigen::Vector3d(0.3, 0.3, 0.4), speed).velocity().norm(), speed, 1e-9);
  }
}

TEST(GaitModel, RefusesWhatIsNoGait) {
  const auto& model = *small_gaits().model;
  const Eigen::Vector3d plain(1, 0, 0);
  EXPECT_THROW(static_cast<void>(model.loop(plain, 0.0)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(plain, -1.0)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(plain, std::nan(""))), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(plain, 1000.0)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(plain, 1e-3)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(Eigen::Vector3d(0.5, 0, 0), 1.0)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(Eigen::Vector3d(std::nan(""), 0, 1), 1.0)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(model.loop(Eigen::Vector2d(1, 0), 1.0)), InvalidArgument);
}

}  // namespace
}  // namespace strut::blend
