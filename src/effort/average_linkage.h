// SPDX-License-Identifier: MIT
// Hierarchical clustering by average linkage (Sokal and Michener 1958) along chains of nearest neighbours (Murtagh
// 1983): from distances of things to groups of them.
#pragma once

#include <cstddef>
#include <vector>

namespace strut::effort::detail {

class AverageLinkage {
 public:
  /// `count` things, at first each `far` from each. Takes 2 count^2 bytes.
  AverageLinkage(int count, float far);

  /// The distance of two things, i != j.
  void set(int i, int j, float distance) { distances_[at(i, j)] = distance; }

  /// Joins groups as long as their mean distance is at most `height`, the nearest first. Returns the index of a member
  /// for every thing, the same for all of a group. Uses the distances up. Cost O(count^2).
  std::vector<int> groups(double height);

 private:
  [[nodiscard]] std::size_t at(int i, int j) const;
  [[nodiscard]] int nearest(int to, int previous) const;
  void join(int into, int from);

  int count_;
  std::vector<float> distances_;  // of i > j, row by row
  std::vector<int> sizes_;        // of groups, by a member; 0 for those joined to others
};

}  // namespace strut::effort::detail
