// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <strut/core/error.h>
#include <strut/representation/extrapolation.h>
#include <strut/representation/relative_root.h>

namespace strut::representation {

FrameMatrix extrapolate_back(const Eigen::Ref<const FrameMatrix>& rows, int count) {
  if (rows.rows() == 0) throw InvalidArgument("rows", "at least one frame", "none");
  if (count < 0) throw InvalidArgument("count", "at least 0 frames", std::to_string(count));
  FrameMatrix before(count, rows.cols());
  for (Eigen::Index k = 1; k <= count; ++k) {
    const Eigen::Index mirrored = std::min(k, rows.rows() - 1);
    before.row(count - k) = 2.0 * rows.row(0) - rows.row(mirrored);
    before.row(count - k).head<kHeight>() = rows.row(mirrored).head<kHeight>();
  }
  return before;
}

}  // namespace strut::representation
