// SPDX-License-Identifier: MIT
#include "math/vector_kernels.h"

#include <strut/math/tiled_matrix.h>

namespace strut::math {

template <typename Scalar>
TiledMatrix<Scalar>::TiledMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix, double filler)
    : rows_(padded(static_cast<int>(matrix.rows()), kTileRows)),
      cols_(static_cast<int>(matrix.cols())),
      values_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_), static_cast<Scalar>(filler)) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index col = 0; col < cols_; ++col) {
      const Eigen::Index place = row / kTileRows * kTileRows * cols_ + col * kTileRows + row % kTileRows;
      values_[static_cast<std::size_t>(place)] = static_cast<Scalar>(matrix(row, col));
    }
  }
}

template <typename Scalar>
void TiledMatrix<Scalar>::multiply(const Scalar* x, Scalar* y) const {
  vector_kernels<Scalar>().multiply(rows_, cols_, values_.data(), x, y);
}

template <typename Scalar>
void TiledMatrix<Scalar>::squared_distances(const Scalar* x, bool add, Scalar* y) const {
  vector_kernels<Scalar>().squared_distances(rows_, cols_, values_.data(), x, add, y);
}

template class TiledMatrix<float>;
template class TiledMatrix<double>;

}  // namespace strut::math
