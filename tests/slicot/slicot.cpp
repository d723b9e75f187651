// SPDX-License-Identifier: MIT
// The Fortran interface of SLICOT 5.0: everything by address, matrices column by column, lengths of character arguments
// at the end (gfortran).
#include "slicot/slicot.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" {
// NOLINTBEGIN(readability-identifier-naming): the library's own names
void ib01ad_(const char* meth, const char* alg, const char* jobd, const char* batch, const char* conct,
             const char* ctrl, const int* nobr, const int* m, const int* l, const int* nsmp, const double* u,
             const int* ldu, const double* y, const int* ldy, int* n, double* r, const int* ldr, double* sv,
             const double* rcond, const double* tol, int* iwork, double* dwork, const int* ldwork, int* iwarn,
             int* info, std::size_t, std::size_t, std::size_t, std::size_t, std::size_t, std::size_t);
void ib01bd_(const char* meth, const char* job, const char* jobck, const int* nobr, const int* n, const int* m,
             const int* l, const int* nsmpl, double* r, const int* ldr, double* a, const int* lda, double* c,
             const int* ldc, double* b, const int* ldb, double* d, const int* ldd, double* q, const int* ldq,
             double* ry, const int* ldry, double* s, const int* lds, double* k, const int* ldk, const double* tol,
             int* iwork, double* dwork, const int* ldwork, int* bwork, int* iwarn, int* info, std::size_t, std::size_t,
             std::size_t);
// NOLINTEND(readability-identifier-naming)
}

namespace strut::test {
namespace {

struct Factor {
  Eigen::MatrixXd r;
  int order = 0;
};

void check(const char* routine, int info) {
  if (info != 0) throw std::runtime_error(std::string(routine) + ": INFO = " + std::to_string(info));
}

Factor factor(SlicotMethod method, const sysid::Experiment& clip, int block_rows) {
  const int m = static_cast<int>(clip.input.cols());
  const int l = static_cast<int>(clip.output.cols());
  const int frames = clip.num_frames();
  const Eigen::MatrixXd u = clip.input;
  const Eigen::MatrixXd y = clip.output;
  const int height = std::max(2 * (m + l), 3 * m) * block_rows;
  const int work_size = 2 * (m + l) * block_rows * (frames + 4);
  Factor out{Eigen::MatrixXd::Zero(height, 2 * (m + l) * block_rows)};
  Eigen::VectorXd singular_values(l * block_rows);
  std::vector<double> work(work_size);
  std::vector<int> integers((m + l) * block_rows);
  const char meth = method == SlicotMethod::kN4sid ? 'N' : 'M';
  const double rank_tolerance = 0.0, order_tolerance = -1.0;
  int warning = 0, info = 0;
  // clang-format off
  ib01ad_(&meth, "Q", "M", "O", "N", "N", &block_rows, &m, &l, &frames, u.data(), &frames, y.data(), &frames,
          &out.order, out.r.data(), &height, singular_values.data(), &rank_tolerance, &order_tolerance,
          integers.data(), work.data(), &work_size, &warning, &info, 1, 1, 1, 1, 1, 1);
  // clang-format on
  check("IB01AD", info);
  return out;
}

/// More than IB01BD asks for in any mode.
int work_size(int s, int n, int m, int l) {
  const int states_and_outputs = n + l;
  return 4 * (l * s * (n + 8) + n * n * 16 + n * 24 + (2 * m + l) * s * 8 + l * l + n * l + 64) +
         m * s * states_and_outputs * (m * states_and_outputs + 1) +
         std::max(states_and_outputs * states_and_outputs, 4 * m * states_and_outputs + 1) + 3 * l * s * n;
}

}  // namespace

int slicot_order(SlicotMethod method, const sysid::Experiment& clip, int block_rows) {
  return factor(method, clip, block_rows).order;
}

SlicotResult slicot_identify(SlicotMethod method, const sysid::Experiment& clip, int block_rows, int order) {
  Factor data = factor(method, clip, block_rows);
  const int n = order;
  const int m = static_cast<int>(clip.input.cols());
  const int l = static_cast<int>(clip.output.cols());
  const int frames = clip.num_frames();
  const int height = static_cast<int>(data.r.rows());
  const int size = work_size(block_rows, n, m, l);
  Eigen::MatrixXd a(n, n), b(n, m), c(l, n), d(l, m), q(n, n), r(l, l), s(n, l), k(n, l);
  std::vector<double> work(size);
  std::vector<int> integers(std::max({l * block_rows, m * block_rows + n, m * (n + l), n * n}));
  std::vector<int> logicals(2 * n);
  const char meth = static_cast<char>(method);
  const double tolerance = 0.0;
  int warning = 0, info = 0;
  // clang-format off
  ib01bd_(&meth, "A", "K", &block_rows, &n, &m, &l, &frames, data.r.data(), &height, a.data(), &n, c.data(), &l,
          b.data(), &n, d.data(), &l, q.data(), &n, r.data(), &l, s.data(), &n, k.data(), &n, &tolerance,
          integers.data(), work.data(), &size, logicals.data(), &warning, &info, 1, 1, 1);
  // clang-format on
  check("IB01BD", info);
  return {{a, b, c, d}, k};
}

}  // namespace strut::test
