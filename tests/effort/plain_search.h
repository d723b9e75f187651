// SPDX-License-Identifier: MIT
// The recurrence of the search as it is written, cell by cell, in float: what the fast one must agree with to the bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <strut/effort/fragment_search.h>

namespace strut::effort::test {

/// A cell of the plain program.
struct PlainCell {
  float cost = std::numeric_limits<float>::infinity();
  int begin = -1;    ///< the path's first column
  int kind = 0;      ///< of the last step: 0 diagonal, 1 two columns, 2 two query frames
  int run = 0;       ///< steps of that kind on end, 0 for diagonal ones
  int at_limit = 0;  ///< steps that follow three of their own kind, not diagonal
};

/// g / (m + n) of the last row, and its begins and shares. `may_begin`: at which columns.
inline SubsequenceCosts plain_costs(
    const FrameMatrix& query, const FrameMatrix& recording,
    const std::function<bool(int)>& may_begin = [](int) { return true; }) {
  const auto m = static_cast<int>(query.rows()), n = static_cast<int>(recording.rows());
  const auto c = [&](int i, int j) {
    float sum = 0.0F;
    for (Eigen::Index d = 0; d < query.cols(); ++d) {
      const float apart = static_cast<float>(recording(j, d)) - static_cast<float>(query(i, d));
      const float square = apart * apart;
      sum += square;
    }
    return std::sqrt(sum);
  };
  std::vector<std::vector<PlainCell>> cells(static_cast<std::size_t>(m),
                                            std::vector<PlainCell>(static_cast<std::size_t>(n)));
  const auto cell = [&](int i, int j) -> PlainCell& {
    return cells[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  };
  for (int j = 0; j < n; ++j) {
    if (may_begin(j)) cell(0, j) = {2.0F * c(0, j), j};
  }
  for (int i = 1; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto offer = [&](const PlainCell& from, float cost, int kind) {
        if (!(cost < cell(i, j).cost)) return;
        const int run = kind == 0 ? 0 : from.kind == kind ? from.run + 1 : 1;
        cell(i, j) = {cost, from.begin, kind, run, from.at_limit + (run > 3 ? 1 : 0)};
      };
      if (j >= 1) offer(cell(i - 1, j - 1), cell(i - 1, j - 1).cost + 2.0F * c(i, j), 0);
      if (j >= 2) offer(cell(i - 1, j - 2), cell(i - 1, j - 2).cost + 2.0F * c(i, j - 1) + c(i, j), 1);
      if (i >= 2 && j >= 1) offer(cell(i - 2, j - 1), cell(i - 2, j - 1).cost + 2.0F * c(i - 1, j) + c(i, j), 2);
    }
  }
  SubsequenceCosts costs{Eigen::VectorXf(n), Eigen::VectorXi(n), Eigen::VectorXf(n)};
  for (int j = 0; j < n; ++j) {
    const PlainCell& end = cell(m - 1, j);
    const auto weight = static_cast<float>(m + j + 1 - end.begin);
    costs.cost[j] = end.begin < 0 ? end.cost : end.cost / weight;
    costs.begin[j] = end.begin;
    costs.share_at_limit[j] = end.begin < 0 ? 0.0F : static_cast<float>(3 * end.at_limit) / weight;
  }
  return costs;
}

}  // namespace strut::effort::test
