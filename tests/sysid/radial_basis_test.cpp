// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/radial_basis.h>

namespace strut::sysid {
namespace {

constexpr double kRounding = 1e-12;  // of numbers of size one
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal(const Eigen::MatrixXd& centres, double width) {
  try {
    const RadialBasis basis(centres, width);
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

Eigen::VectorXd activated(const RadialBasis& basis, const Eigen::VectorXd& features) {
  Eigen::VectorXd result(basis.num_centres());
  basis.activate(features, result);
  return result;
}

/// Centres at 0, 1 and 3 on the first axis.
RadialBasis on_a_line(double width) {
  Eigen::MatrixXd centres = Eigen::MatrixXd::Zero(2, 3);
  centres.row(0) << 0.0, 1.0, 3.0;
  return {centres, width};
}

TEST(RadialBasis, FollowsItsEquation) {
  const Eigen::Vector3d square_distances(0.25 + 4.0, 0.25 + 4.0, 6.25 + 4.0);  // of (0.5, 2)
  const double square_width = 0.49 + RadialBasis::kWidening * 4.25;
  const Eigen::Vector3d bells = (-square_distances / (2.0 * square_width)).array().exp();
  EXPECT_LT((activated(on_a_line(0.7), Eigen::Vector2d(0.5, 2.0)) - bells / bells.sum()).norm(), kRounding);
}

TEST(RadialBasis, SumsToOneWithNothingBelowZeroWhereverItIsAsked) {
  const RadialBasis basis = on_a_line(0.3);
  for (const double x : {-1e150, -7.0, 0.0, 0.5, 2.0, 41.0, 1e9}) {
    const Eigen::VectorXd phi = activated(basis, Eigen::Vector2d(x, 1.0));
    EXPECT_NEAR(phi.sum(), 1.0, kRounding) << x;
    EXPECT_GE(phi.minCoeff(), 0.0) << x;
  }
}

TEST(RadialBasis, TakesTheMeanOfAllFarFromAll) {
  // At a million, the centres' squared distances differ by 6e-6 of themselves: over 2 kWidening, 1e-4.
  EXPECT_LT((activated(on_a_line(0.5), Eigen::Vector2d(1e6, 0.0)) - Eigen::Vector3d::Constant(1.0 / 3.0)).norm(), 1e-4);
}

TEST(RadialBasis, DoesNotSwitchBetweenCentresFarFromAll) {
  // Half way between two centres and far off the line, a step of a width tips a basis of fixed width over.
  const Eigen::VectorXd here = activated(on_a_line(0.1), Eigen::Vector2d(0.45, 10.0));
  const Eigen::VectorXd there = activated(on_a_line(0.1), Eigen::Vector2d(0.55, 10.0));
  EXPECT_LT((here - there).norm(), 0.05);
  EXPECT_GT(
      (activated(on_a_line(0.1), Eigen::Vector2d(0.45, 0.0)) - activated(on_a_line(0.1), Eigen::Vector2d(0.55, 0.0)))
          .norm(),
      0.5);
}

TEST(RadialBasis, OfOneCentreIsOne) {
  const RadialBasis basis(Eigen::MatrixXd::Zero(4, 1), 1e-3);
  EXPECT_EQ(activated(basis, Eigen::VectorXd::Constant(4, 5.0)), Eigen::VectorXd::Ones(1));
}

TEST(RadialBasis, RefusesWhatIsNoBasis) {
  EXPECT_EQ(refusal(Eigen::MatrixXd(2, 0), 1.0), "centres: expected at least one of at least one feature, got none");
  EXPECT_EQ(refusal(Eigen::MatrixXd(0, 3), 1.0), "centres: expected at least one of at least one feature, got none");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Constant(1, 1, NAN), 1.0),
            "centres: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(1, 1), 0.0), "width: expected a positive number, got 0.000000");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(1, 1), NAN), "width: expected a positive number, got nan");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(1, 1), kInfinity), "width: expected a positive number, got inf");
}

}  // namespace
}  // namespace strut::sysid
