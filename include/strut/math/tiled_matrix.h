// SPDX-License-Identifier: MIT
// A matrix laid out for a fast product with a vector: kTileRows rows stand together, column by column.
#pragma once

#include <Eigen/Core>

#include <strut/math/aligned.h>

namespace strut::math {

/// rows x cols, the rows filled up to whole tiles with `filler`.
template <typename Scalar>
class TiledMatrix {
 public:
  TiledMatrix() = default;
  explicit TiledMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix, double filler = 0.0);

  /// Rows, filled up.
  [[nodiscard]] int num_rows() const noexcept { return rows_; }
  [[nodiscard]] int num_cols() const noexcept { return cols_; }

  /// y (num_rows()) = this x (num_cols()). No allocation.
  void multiply(const Scalar* x, Scalar* y) const;

  /// y = (or +=, if `add`) squared distances of x (num_cols()) to every row. No allocation.
  void squared_distances(const Scalar* x, bool add, Scalar* y) const;

 private:
  int rows_ = 0, cols_ = 0;
  AlignedVector<Scalar> values_;
};

}  // namespace strut::math
