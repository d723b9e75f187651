// SPDX-License-Identifier: MIT
// Subspace identification of A and C from many clips: a triangular factor of the block Hankel data, compressed clip by
// clip and added over sets of clips, then one decomposition from which A and C of any order are cheap to take.
#pragma once

#include <Eigen/Core>

#include <strut/sysid/experiment.h>

namespace strut::sysid {

/// How the future outputs are weighted before the subspace of the states is taken from them (Van Overschee and De Moor
/// 1996, table 4.1).
enum class Weighting {
  kN4sid,  ///< none: the oblique projection itself
  kMoesp,  ///< what future inputs explain is taken out
  kCva,    ///< that, and outputs are whitened: canonical correlations between past and future
};

/// The triangular factor of the block Hankel data of a set of clips. One column of that data is `block_rows` frames of
/// past and as many of future, inputs and outputs, of one clip; a clip shorter than both adds nothing. Memory is
/// bounded by 2 block_rows (inputs + outputs) squared, times six, whatever the number of clips.
class HankelFactor {
 public:
  /// Throws InvalidArgument unless every number is positive.
  HankelFactor(int num_inputs, int num_outputs, int block_rows);

  /// Adds a clip after its lead-in; its widths are the caller's duty. Cost columns x width()^2.
  void add(const Experiment& experiment);
  /// Adds every clip of another factor of the same shape. Cost width()^3.
  void add(const HankelFactor& other);

  [[nodiscard]] int num_inputs() const noexcept { return num_inputs_; }
  [[nodiscard]] int num_outputs() const noexcept { return num_outputs_; }
  [[nodiscard]] int block_rows() const noexcept { return block_rows_; }
  /// Hankel columns added so far.
  [[nodiscard]] long num_columns() const noexcept { return num_columns_; }
  /// Numbers in one Hankel column.
  [[nodiscard]] int width() const noexcept { return 2 * block_rows_ * (num_inputs_ + num_outputs_); }
  /// The upper triangular R with R' R = sum of h h' over the columns h = (future inputs, past inputs, past outputs,
  /// future outputs): (width x width).
  [[nodiscard]] Eigen::MatrixXd triangle() const;

 private:
  void compress();

  int num_inputs_, num_outputs_, block_rows_;
  long num_columns_ = 0;
  Eigen::Index filled_ = 0;  // rows of rows_ in use
  Eigen::MatrixXd rows_;     // the factor so far, then columns not yet compressed, each as a row
};

/// The states' subspace of a Hankel factor (Hsu et al. 2005, section 4.3; Van Overschee and De Moor 1996, chapter 4).
class Subspace {
 public:
  /// Decomposes. Never fails: data that say nothing give max_order() 0. Cost width^3.
  Subspace(const HankelFactor& factor, Weighting weighting);

  /// What the paper reads the order from, falling: (block_rows x outputs).
  [[nodiscard]] const Eigen::VectorXd& singular_values() const noexcept { return singular_values_; }
  /// The largest order that can be taken.
  [[nodiscard]] int max_order() const noexcept { return max_order_; }

  struct AandC {
    Eigen::MatrixXd a;  ///< (states x states), stable or not
    Eigen::MatrixXd c;  ///< (outputs x states)
  };
  /// A and C of a system of `order` states, by the shift invariance of the observability matrix. Throws
  /// InvalidArgument unless 0 <= order <= max_order(). Cost block_rows x outputs x order^2.
  [[nodiscard]] AandC a_and_c(int order) const;

 private:
  int num_outputs_;
  int max_order_ = 0;
  Eigen::VectorXd singular_values_;
  Eigen::MatrixXd observability_;  // columns in the order of the singular values
};

}  // namespace strut::sysid
