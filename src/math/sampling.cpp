// SPDX-License-Identifier: MIT
// Catmull-Rom interpolation; at the ends the missing neighbour is extrapolated straight.
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/math/sampling.h>

namespace strut::math {
namespace {

using Row = Eigen::RowVectorXd;

Row row_or_extrapolated(const Eigen::Ref<const FrameMatrix>& signal, Eigen::Index index) {
  const Eigen::Index last = signal.rows() - 1;
  if (index < 0) return 2.0 * signal.row(0) - signal.row(1);
  if (index > last) return 2.0 * signal.row(last) - signal.row(last - 1);
  return signal.row(index);
}

Row sample_row(const Eigen::Ref<const FrameMatrix>& signal, double position) {
  const double last = static_cast<double>(signal.rows() - 1);
  const double clamped = std::clamp(position, 0.0, last);
  const auto before = static_cast<Eigen::Index>(std::min(std::floor(clamped), std::max(0.0, last - 1.0)));
  const double s = clamped - static_cast<double>(before);
  if (s == 0.0) return signal.row(before);
  const Row a = row_or_extrapolated(signal, before - 1);
  const Row b = signal.row(before);
  const Row c = signal.row(before + 1);
  const Row d = row_or_extrapolated(signal, before + 2);
  return b + 0.5 * s * (c - a + s * (2.0 * a - 5.0 * b + 4.0 * c - d + s * (3.0 * (b - c) + d - a)));
}

}  // namespace

FrameMatrix sample_rows(const Eigen::Ref<const FrameMatrix>& signal,
                        const Eigen::Ref<const Eigen::VectorXd>& positions) {
  if (signal.rows() == 0) throw InvalidArgument("signal", "at least one frame", "none");
  if (!positions.allFinite()) throw InvalidArgument("positions", "finite numbers", "NaN or infinity");
  FrameMatrix result(positions.size(), signal.cols());
  for (Eigen::Index i = 0; i < positions.size(); ++i) result.row(i) = sample_row(signal, positions[i]);
  return result;
}

}  // namespace strut::math
