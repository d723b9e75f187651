// SPDX-License-Identifier: MIT
// The maps of many joints against those of one (rotation.h), both precisions.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <strut/math/aligned.h>
#include <strut/math/rotation.h>
#include <strut/math/rotation_arrays.h>

namespace strut::math {
namespace {

constexpr int kCount = 64;

template <typename Scalar>
class RotationArrays : public testing::Test {
 protected:
  using Array = AlignedVector<Scalar>;

  static Eigen::Vector3d vector(const Array& planes, int i) {
    const auto at = [&](int plane) {
      return static_cast<double>(planes[static_cast<std::size_t>(plane * kCount + i)]);
    };
    return {at(0), at(1), at(2)};
  }
  static Eigen::Quaterniond rotation(const Array& planes, int i) {
    const Eigen::Vector3d xyz = vector(planes, i);
    return {static_cast<double>(planes[static_cast<std::size_t>(3 * kCount + i)]), xyz.x(), xyz.y(), xyz.z()};
  }
  static void put(Array& planes, int i, const Eigen::VectorXd& numbers) {
    for (int plane = 0; plane < numbers.size(); ++plane)
      planes[static_cast<std::size_t>(plane * kCount + i)] = static_cast<Scalar>(numbers[plane]);
  }
  /// A vector of `angle` about some axis.
  Eigen::Vector3d about_some_axis(double angle) {
    std::normal_distribution<double> normal;
    return angle * Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
  }

  static constexpr double kError = static_cast<double>(kRotationArrayError<Scalar>);
  std::mt19937 random_{7};
  Array vectors_ = Array(3 * kCount), rotations_ = Array(4 * kCount);
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RotationArrays, Scalars);

// Angles of every size, those at which a map could lose digits among them.
std::vector<double> angles() {
  std::vector<double> all;
  for (int i = 0; i <= 44; ++i) all.push_back(2.0 * std::numbers::pi * i / 44.0);
  for (const double around : {0.0, 0.5 * std::numbers::pi, std::numbers::pi, 2.0 * std::numbers::pi}) {
    for (const double off : {1e-12, 1e-7, 1e-4, 1e-2}) all.push_back(around + off);
  }
  all.resize(kCount, 0.0);
  return all;
}

TYPED_TEST(RotationArrays, ExponentialMapsAreThoseOfOne) {
  for (int trial = 0; trial < 20; ++trial) {
    for (int i = 0; i < kCount; ++i)
      this->put(this->vectors_, i, this->about_some_axis(angles()[static_cast<std::size_t>(i)]));
    exp_maps(kCount, kCount, this->vectors_.data(), this->rotations_.data());
    for (int i = 0; i < kCount; ++i) {
      const Eigen::Quaterniond expected = exp_map(this->vector(this->vectors_, i));
      EXPECT_LT((this->rotation(this->rotations_, i).coeffs() - expected.coeffs()).cwiseAbs().maxCoeff(), this->kError)
          << angles()[static_cast<std::size_t>(i)];
    }
  }
}

TYPED_TEST(RotationArrays, LogarithmMapsAreThoseOfOne) {
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Eigen::Quaterniond> given;
    for (int i = 0; i < kCount; ++i) {
      given.push_back(exp_map(this->about_some_axis(angles()[static_cast<std::size_t>(i)])));
      this->put(this->rotations_, i, given.back().coeffs());
      given.back() = this->rotation(this->rotations_, i);  // as rounded
    }
    std::fill(this->vectors_.begin(), this->vectors_.end(), TypeParam(0));
    log_maps_near(kCount, kCount, this->rotations_.data(), this->vectors_.data());
    for (int i = 0; i < kCount; ++i) {
      const Eigen::Vector3d expected = log_map(given[static_cast<std::size_t>(i)]);
      const double error = (this->vector(this->vectors_, i) - expected).norm();
      const double other = (this->vector(this->vectors_, i) + expected).norm();  // half a turn has two
      EXPECT_LT(expected.norm() > 3.14 ? std::min(error, other) : error, this->kError) << expected.norm();
    }
  }
}

TYPED_TEST(RotationArrays, LogarithmMapsFollowACurvePastHalfATurnAndBackButNotAroundForEver) {
  const Eigen::Vector3d axis = this->about_some_axis(1.0);
  std::fill(this->vectors_.begin(), this->vectors_.end(), TypeParam(0));
  const auto follow = [&](double angle) {
    for (int i = 0; i < kCount; ++i) this->put(this->rotations_, i, exp_map(angle * axis).coeffs());
    log_maps_near(kCount, kCount, this->rotations_.data(), this->vectors_.data());
    return this->vector(this->vectors_, kCount - 1).dot(axis);
  };
  const double tolerance = 10.0 * this->kError;  // angles of more than a turn's half
  for (double angle = 0.0; angle < 4.7; angle += 0.1) EXPECT_NEAR(follow(angle), angle, tolerance);
  for (double angle = 4.6; angle > -4.7; angle -= 0.1) EXPECT_NEAR(follow(angle), angle, tolerance);
  EXPECT_NEAR(follow(-4.8), 2.0 * std::numbers::pi - 4.8, tolerance);  // farther than kFarthestAngle: the shortest
}

TYPED_TEST(RotationArrays, ProductsAndTurnsAreEigens) {
  typename TestFixture::Array a(4 * kCount), b(4 * kCount), product(4 * kCount), matrices(9 * kCount),
      turned(3 * kCount);
  for (int i = 0; i < kCount; ++i) {
    this->put(a, i, exp_map(this->about_some_axis(1.0)).coeffs());
    this->put(b, i, exp_map(this->about_some_axis(2.0)).coeffs());
    this->put(this->vectors_, i, this->about_some_axis(3.0));
    const Eigen::Matrix3d rows = this->rotation(a, i).toRotationMatrix().transpose();  // columns are the rows
    this->put(matrices, i, Eigen::Map<const Eigen::VectorXd>(rows.data(), 9));
  }
  multiply_rotations(kCount, kCount, a.data(), b.data(), product.data());
  turn_vectors(kCount, kCount, matrices.data(), this->vectors_.data(), turned.data());
  for (int i = 0; i < kCount; ++i) {
    EXPECT_LT((this->rotation(product, i).coeffs() - (this->rotation(a, i) * this->rotation(b, i)).coeffs()).norm(),
              this->kError);
    EXPECT_LT((this->vector(turned, i) - this->rotation(a, i) * this->vector(this->vectors_, i)).norm(), this->kError);
  }
}

TYPED_TEST(RotationArrays, PlanesAreFilledUpWithNoRotation) {
  const std::vector<TypeParam> quaternions = {TypeParam(0.1), TypeParam(0.2), TypeParam(0.3), TypeParam(0.9)};
  std::vector<TypeParam> planes(16, TypeParam(7));
  to_planes(1, 4, quaternions.data(), planes.data());
  EXPECT_EQ(planes, (std::vector<TypeParam>{TypeParam(0.1), 0, 0, 0, TypeParam(0.2), 0, 0, 0, TypeParam(0.3), 0, 0, 0,
                                            TypeParam(0.9), 1, 1, 1}));
}

}  // namespace
}  // namespace strut::math
