// SPDX-License-Identifier: MIT
// The product sum of lags (a + 1, b + 1) is that of (a, b) moved by one frame: it gains the row before the first and
// loses the last. So only lag 0 against all lags is summed over frames, and the rest follows from it, once for all
// clips.
#include "sysid/lag_sums.h"

namespace strut::sysid::detail {
namespace {

/// Inputs at every lag: row r, for r = 0 .. frames, holds u at frame begin - 1 + r and the taps - 1 frames before it,
/// input by input.
Eigen::MatrixXd lagged_rows(const FrameMatrix& u, Eigen::Index begin, int taps) {
  const Eigen::Index rows = u.rows() - begin + 1;
  Eigen::MatrixXd lagged = Eigen::MatrixXd::Zero(rows, u.cols() * taps);
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    for (Eigen::Index a = 0; a < taps; ++a) {
      const Eigen::Index first = begin - 1 - a;  // frame that row 0 holds
      const Eigen::Index skip = std::max<Eigen::Index>(0, -first);
      if (skip >= rows) continue;
      lagged.col(i * taps + a).tail(rows - skip) = u.col(i).segment(first + skip, rows - skip);
    }
  }
  return lagged;
}

}  // namespace

LagSums::LagSums(int num_inputs, int num_outputs, int taps)
    : uu(Eigen::MatrixXd::Zero(num_inputs * taps, num_inputs * taps)),
      uy(Eigen::MatrixXd::Zero(num_inputs * taps, num_outputs)),
      yy(Eigen::VectorXd::Zero(num_outputs)),
      y(yy) {}

void LagSums::add(const std::vector<const Experiment*>& clips, int taps) {
  const Eigen::Index size = uu.rows(), inputs = size / taps, count = static_cast<Eigen::Index>(clips.size());
  Eigen::MatrixXd lag_zero = Eigen::MatrixXd::Zero(inputs, size);
  Eigen::MatrixXd before(size, count), last(size, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Experiment& clip = *clips[static_cast<std::size_t>(k)];
    const Eigen::MatrixXd lagged = lagged_rows(clip.input, clip.lead_in, taps);
    const Eigen::Index rows = lagged.rows() - 1;
    const auto fitted = clip.output.bottomRows(rows);
    uy.noalias() += lagged.bottomRows(rows).transpose() * fitted;
    yy += fitted.colwise().squaredNorm().transpose();
    y += fitted.colwise().sum().transpose();
    frames += static_cast<double>(rows);
    const Eigen::MatrixXd newest = lagged(Eigen::lastN(rows), Eigen::seqN(0, inputs, taps));
    lag_zero.noalias() += newest.transpose() * lagged.bottomRows(rows);
    before.col(k) = lagged.row(0).transpose();
    last.col(k) = lagged.row(rows).transpose();
  }
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(size, size);
  moved.selfadjointView<Eigen::Lower>().rankUpdate(before);
  moved.selfadjointView<Eigen::Lower>().rankUpdate(last, -1.0);
  add_products(lag_zero, moved.selfadjointView<Eigen::Lower>());
}

/// `lag_zero` (inputs x inputs taps): products with the newest lag; `moved` (inputs taps squared): what one more frame
/// of lag adds. The block of inputs (i, j) is swept column by column from the one on its left; the one of (j, i) is its
/// transpose.
void LagSums::add_products(const Eigen::MatrixXd& lag_zero, const Eigen::MatrixXd& moved) {
  const Eigen::Index m = lag_zero.rows();
  const Eigen::Index n = lag_zero.cols() / m;
  Eigen::MatrixXd block(n, n);
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      block.row(0) = lag_zero.block(i, j * n, 1, n);
      block.col(0) = lag_zero.block(j, i * n, 1, n).transpose();
      for (Eigen::Index b = 1; b < n; ++b) {
        block.col(b).tail(n - 1) = block.col(b - 1).head(n - 1) + moved.col(j * n + b - 1).segment(i * n, n - 1);
      }
      uu.block(i * n, j * n, n, n) += block;
      if (j < i) uu.block(j * n, i * n, n, n) += block.transpose();
    }
  }
}

LagSums& LagSums::operator+=(const LagSums& other) {
  uu += other.uu;
  uy += other.uy;
  yy += other.yy;
  y += other.y;
  frames += other.frames;
  return *this;
}

}  // namespace strut::sysid::detail
