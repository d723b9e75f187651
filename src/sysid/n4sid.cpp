// SPDX-License-Identifier: MIT
// Subspace identification. Symbols of Van Overschee and De Moor (1996), "Subspace Identification for Linear Systems":
//   Uf Yf      block Hankel matrices of the future inputs, outputs       Wp  of the past ones, inputs above outputs
//   L = R'     the lower triangular factor of (Uf; Wp; Yf), 1, 2, 3 its block rows: L32 is Yf seen from Wp without Uf
//   Gamma      the extended observability matrix (C; CA; CA^2; ...)
#include <algorithm>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <strut/core/error.h>
#include <strut/sysid/n4sid.h>

namespace strut::sysid {
namespace {

constexpr int kRowsPerWidth = 5;  // the buffer holds so many times the factor: a fifth of the work goes on what is done

void check_positive(const char* name, int value) {
  if (value < 1) throw InvalidArgument(name, "1 or more", std::to_string(value));
}

/// The blocks of the triangular factor, named as in the table above (upper triangular, so L32 is r23').
struct Blocks {
  Eigen::MatrixXd r12, r22, r23, r33;
};

Blocks split(const HankelFactor& factor) {
  const Eigen::MatrixXd r = factor.triangle();
  const Eigen::Index i = factor.block_rows();
  const Eigen::Index future_in = i * factor.num_inputs();
  const Eigen::Index future_out = i * factor.num_outputs();
  const Eigen::Index past = future_in + future_out;
  return {r.block(0, future_in, future_in, past), r.block(future_in, future_in, past, past),
          r.block(future_in, future_in + past, past, future_out), r.bottomRightCorner(future_out, future_out)};
}

/// The oblique projection of the future outputs along the future inputs onto the past: L32 pinv(L22) (L21 L22).
Eigen::MatrixXd oblique_projection(const Blocks& blocks) {
  constexpr double kIndependent = 1e-10;  // past data nearer than this to a combination of the rest tell nothing new
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> past(blocks.r22.rows(), blocks.r22.cols());
  past.setThreshold(kIndependent);
  past.compute(blocks.r22);
  const Eigen::MatrixXd gain = past.solve(blocks.r23);  // (pinv(L22') L32')
  Eigen::MatrixXd projection(blocks.r23.cols(), blocks.r12.rows() + blocks.r22.rows());
  projection << gain.transpose() * blocks.r12.transpose(), gain.transpose() * blocks.r22.transpose();
  return projection;
}

/// A square root of the covariance of the future outputs without the future inputs; a trace of the mean variance is
/// added, for noise-free data leave it singular.
Eigen::MatrixXd output_covariance_root(const Blocks& blocks) {
  constexpr double kTrace = 1e-10;
  Eigen::MatrixXd covariance = blocks.r23.transpose() * blocks.r23 + blocks.r33.transpose() * blocks.r33;
  covariance.diagonal().array() += kTrace * covariance.diagonal().mean();
  return covariance.llt().matrixL();
}

}  // namespace

HankelFactor::HankelFactor(int num_inputs, int num_outputs, int block_rows)
    : num_inputs_(num_inputs), num_outputs_(num_outputs), block_rows_(block_rows) {
  check_positive("num_inputs", num_inputs);
  check_positive("num_outputs", num_outputs);
  check_positive("block_rows", block_rows);
}

void HankelFactor::add(const Experiment& experiment) {
  const Eigen::Index i = block_rows_;
  const Eigen::Index inputs = i * num_inputs_;
  const Eigen::Index outputs = i * num_outputs_;
  for (Eigen::Index t = experiment.lead_in; t + 2 * i <= experiment.num_frames(); ++t) {
    if (filled_ == rows_.rows()) compress();
    auto row = rows_.row(filled_++);
    row.segment(0, inputs) = experiment.input.middleRows(t + i, i).reshaped<Eigen::RowMajor>().transpose();
    row.segment(inputs, inputs) = experiment.input.middleRows(t, i).reshaped<Eigen::RowMajor>().transpose();
    row.segment(2 * inputs, outputs) = experiment.output.middleRows(t, i).reshaped<Eigen::RowMajor>().transpose();
    row.tail(outputs) = experiment.output.middleRows(t + i, i).reshaped<Eigen::RowMajor>().transpose();
    ++num_columns_;
  }
}

void HankelFactor::add(const HankelFactor& other) {
  for (Eigen::Index from = 0; from < other.filled_;) {
    if (filled_ == rows_.rows()) compress();
    const Eigen::Index count = std::min(other.filled_ - from, rows_.rows() - filled_);
    rows_.middleRows(filled_, count) = other.rows_.middleRows(from, count);
    filled_ += count;
    from += count;
  }
  num_columns_ += other.num_columns_;
}

void HankelFactor::compress() {
  if (rows_.size() == 0) rows_.resize(kRowsPerWidth * width(), width());
  if (filled_ <= width()) return;
  auto used = rows_.topRows(filled_);
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> in_place(used);
  rows_.topRows(width()).triangularView<Eigen::StrictlyLower>().setZero();
  filled_ = width();
}

Eigen::MatrixXd HankelFactor::triangle() const {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(width(), width());
  if (filled_ == 0) return r;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows_.topRows(filled_));
  const Eigen::Index height = std::min<Eigen::Index>(filled_, width());
  r.topRows(height) = qr.matrixQR().topRows(height).triangularView<Eigen::Upper>();
  return r;
}

namespace {

/// L (square) of W = L Q' for a W that is at least as wide as high.
Eigen::MatrixXd lower_factor(const Eigen::MatrixXd& wide) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(wide.transpose());
  const Eigen::MatrixXd r = qr.matrixQR().topRows(wide.rows()).triangularView<Eigen::Upper>();
  return r.transpose();
}

}  // namespace

Subspace::Subspace(const HankelFactor& factor, Weighting weighting) : num_outputs_(factor.num_outputs()) {
  constexpr double kSignificant = 1e-13;  // of the largest singular value: smaller ones are rounding
  const Blocks blocks = split(factor);
  singular_values_ = Eigen::VectorXd::Zero(blocks.r23.cols());
  if (blocks.r23.isZero(0.0)) return;
  Eigen::MatrixXd weighted =
      weighting == Weighting::kN4sid ? oblique_projection(blocks) : Eigen::MatrixXd(blocks.r23.transpose());
  const Eigen::MatrixXd root = weighting == Weighting::kCva ? output_covariance_root(blocks) : Eigen::MatrixXd();
  if (weighting == Weighting::kCva) root.triangularView<Eigen::Lower>().solveInPlace(weighted);
  // Square by a QR decomposition first: the left singular vectors stay, and Jacobi needs no preconditioner of its own.
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(lower_factor(weighted), Eigen::ComputeFullU);
  singular_values_ = svd.singularValues();
  observability_ = svd.matrixU();
  if (weighting == Weighting::kCva) observability_ = root.triangularView<Eigen::Lower>() * observability_;
  const auto significant = (singular_values_.array() > kSignificant * singular_values_[0]).count();
  const Eigen::Index shifted_rows = observability_.rows() - num_outputs_;
  max_order_ = static_cast<int>(std::min<Eigen::Index>(significant, shifted_rows));
}

Subspace::AandC Subspace::a_and_c(int order) const {
  if (order < 0 || order > max_order_) {
    throw InvalidArgument("order", "0 to " + std::to_string(max_order_), std::to_string(order));
  }
  if (order == 0) return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(num_outputs_, 0)};
  const Eigen::MatrixXd gamma = observability_.leftCols(order);
  const Eigen::Index shifted_rows = gamma.rows() - num_outputs_;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> upper(gamma.topRows(shifted_rows));
  return {upper.solve(gamma.bottomRows(shifted_rows)), gamma.topRows(num_outputs_)};
}

}  // namespace strut::sysid
