// SPDX-License-Identifier: MIT
#include "support/allocations.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/postprocess/footplant_classifier.h>

namespace strut::postprocess {
namespace {

/// States that turn in a circle once a second, at 30 frames/s, with noise; the left foot is planted in one half of it,
/// the right one in the other.
LabelledStates circling(int frames, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.05);
  LabelledStates made{FrameMatrix(frames, 3), {}};
  for (int t = 0; t < frames; ++t) {
    const double phase = 2.0 * std::acos(-1.0) * t / 30.0;
    made.states.row(t) << std::sin(phase) + noise(random), std::cos(phase) + noise(random), noise(random);
    made.planted[0].push_back(std::sin(phase) > 0.0);
    made.planted[1].push_back(std::sin(phase) <= 0.0);
  }
  return made;
}

TEST(FootplantClassifier, LearnsWhereOnItsCycleAFootIsPlanted) {
  const FootplantClassifier classifier = train_footplant_classifier({circling(90, 1), circling(90, 2)});
  EXPECT_EQ(classifier.num_states(), 3);
  EXPECT_GE(agreement(classifier, {circling(300, 3)}), 0.93);  // a frame in thirty lies on the boundary, twice
  EXPECT_TRUE(classifier.is_planted(0, Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_FALSE(classifier.is_planted(1, Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_TRUE(classifier.is_planted(1, Eigen::Vector3d(-1.0, 0.0, 0.0)));
}

TEST(FootplantClassifier, OfAFootThatNeverLeavesSaysPlantedAlways) {
  LabelledStates clip = circling(60, 1);
  clip.planted[0].assign(60, true);
  clip.planted[1].assign(60, false);
  const FootplantClassifier classifier = train_footplant_classifier({clip});
  for (const double x : {-100.0, 0.0, 100.0}) {
    EXPECT_TRUE(classifier.is_planted(0, Eigen::Vector3d(x, x, x)));
    EXPECT_FALSE(classifier.is_planted(1, Eigen::Vector3d(x, x, x)));
  }
  EXPECT_EQ(agreement(classifier, {clip}), 1.0);
}

TEST(FootplantClassifier, KnowsOnWhichSideTheFootIsPlanted) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  const FootplantClassifier classifier({FootplantBoundary{one, 0.5, true}, FootplantBoundary{one, 0.5, false}});
  EXPECT_TRUE(classifier.is_planted(0, one));
  EXPECT_FALSE(classifier.is_planted(1, one));
  EXPECT_TRUE(classifier.is_planted(1, Eigen::VectorXd::Zero(1)));
}

TEST(FootplantClassifier, AllocatesNothingWhenAsked) {
  const FootplantClassifier classifier = train_footplant_classifier({circling(90, 1)});
  const Eigen::VectorXd state = Eigen::Vector3d(0.3, 0.1, 0.2);
  bool planted = false;
  EXPECT_EQ(test::count_allocations([&] { planted = classifier.is_planted(0, state); }), 0);
  EXPECT_TRUE(planted);
}

TEST(FootplantClassifier, RefusesWhatDoesNotFit) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1), two = Eigen::VectorXd::Ones(2);
  EXPECT_THROW(FootplantClassifier({FootplantBoundary{one, 0.0}, FootplantBoundary{two, 0.0}}), InvalidArgument);
  EXPECT_THROW(FootplantClassifier({FootplantBoundary{one, 0.0}, FootplantBoundary{one, std::nan("")}}),
               InvalidArgument);
  EXPECT_THROW(train_footplant_classifier({}), InvalidArgument);
  LabelledStates clip = circling(30, 1);
  clip.planted[1].pop_back();
  EXPECT_THROW(train_footplant_classifier({clip}), InvalidArgument);
  LabelledStates other{FrameMatrix::Zero(1, 2), {std::vector<bool>(1), std::vector<bool>(1)}};
  EXPECT_THROW(train_footplant_classifier({circling(30, 1), other}), InvalidArgument);
}

}  // namespace
}  // namespace strut::postprocess
