// SPDX-License-Identifier: MIT
#include "sysid/block_rows.h"

#include <algorithm>

namespace strut::sysid::detail {
namespace {

long hankel_columns(const std::vector<Experiment>& clips, int block_rows) {
  long columns = 0;
  for (const Experiment& clip : clips) columns += std::max(0, clip.num_fitted() - 2 * block_rows + 1);
  return columns;
}

}  // namespace

int usable_block_rows(const std::vector<Experiment>& clips, int wanted) {
  constexpr long kColumnsPerRegressor = 2;
  const Eigen::Index regressors = 2 * clips.front().input.cols() + clips.front().output.cols();
  for (int i = wanted; i >= kLeastBlockRows; --i) {
    if (hankel_columns(clips, i) >= kColumnsPerRegressor * i * regressors) return i;
  }
  return 0;
}

}  // namespace strut::sysid::detail
