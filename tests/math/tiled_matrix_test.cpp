// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/math/tiled_matrix.h>

namespace strut::math {
namespace {

template <typename Scalar>
class TiledMatrixOf : public testing::Test {
 protected:
  static constexpr double kRounding = sizeof(Scalar) == 4 ? 1e-5 : 1e-13;  // of sums of a few dozen numbers up to 1
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TiledMatrixOf, Scalars);

TYPED_TEST(TiledMatrixOf, MultipliesAndMeasuresAsEigenDoes) {
  for (const auto& size : {std::pair(1, 1), std::pair(32, 3), std::pair(33, 20), std::pair(70, 7)}) {
    const int rows = size.first;
    const int cols = size.second;
    const Eigen::MatrixXd dense = Eigen::MatrixXd::Random(rows, cols);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(cols);
    const TiledMatrix<TypeParam> matrix(dense);
    ASSERT_EQ(matrix.num_rows(), padded(rows, kTileRows));
    ASSERT_EQ(matrix.num_cols(), cols);
    AlignedVector<TypeParam> from(static_cast<std::size_t>(cols)), to(static_cast<std::size_t>(matrix.num_rows()));
    for (int i = 0; i < cols; ++i) from[static_cast<std::size_t>(i)] = static_cast<TypeParam>(x[i]);
    const auto expect = [&](const Eigen::VectorXd& expected) {
      for (int i = 0; i < rows; ++i) EXPECT_NEAR(to[static_cast<std::size_t>(i)], expected[i], this->kRounding);
    };
    matrix.multiply(from.data(), to.data());
    expect(dense * x);
    for (int i = rows; i < matrix.num_rows(); ++i) EXPECT_EQ(to[static_cast<std::size_t>(i)], TypeParam(0));
    const Eigen::VectorXd distances = (dense.rowwise() - x.transpose()).rowwise().squaredNorm();
    matrix.squared_distances(from.data(), false, to.data());
    expect(distances);
    matrix.squared_distances(from.data(), true, to.data());
    expect(2.0 * distances);
  }
}

TYPED_TEST(TiledMatrixOf, KeepsFilledUpRowsFarAwayIfToldSo) {
  const TiledMatrix<TypeParam> matrix(Eigen::MatrixXd::Zero(1, 2), 1e9);
  const AlignedVector<TypeParam> origin(2);
  AlignedVector<TypeParam> distances(kTileRows);
  matrix.squared_distances(origin.data(), false, distances.data());
  EXPECT_EQ(distances[0], TypeParam(0));
  EXPECT_GT(distances[1], TypeParam(1e18));
}

}  // namespace
}  // namespace strut::math
