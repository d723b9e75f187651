// SPDX-License-Identifier: MIT
#include "effort/average_linkage.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace strut::effort::detail {

AverageLinkage::AverageLinkage(int count, float far) : count_(count), sizes_(static_cast<std::size_t>(count), 1) {
  const auto things = static_cast<std::size_t>(count);
  distances_.assign(things * (things - std::min<std::size_t>(things, 1)) / 2, far);
}

std::size_t AverageLinkage::at(int i, int j) const {
  const auto high = static_cast<std::size_t>(std::max(i, j)), low = static_cast<std::size_t>(std::min(i, j));
  return high * (high - 1) / 2 + low;
}

/// Of equals, `previous`, or a chain would never end; else the first.
int AverageLinkage::nearest(int to, int previous) const {
  float least = previous < 0 ? std::numeric_limits<float>::infinity() : distances_[at(to, previous)];
  int found = previous;
  for (int other = 0; other < count_; ++other) {
    if (other == to || sizes_[static_cast<std::size_t>(other)] == 0) continue;
    const float distance = distances_[at(to, other)];
    if (distance < least || found < 0) {
      least = distance;
      found = other;
    }
  }
  return found;
}

void AverageLinkage::join(int into, int from) {
  int& size = sizes_[static_cast<std::size_t>(into)];
  int& gone = sizes_[static_cast<std::size_t>(from)];
  const float share = static_cast<float>(gone) / static_cast<float>(size + gone);
  for (int other = 0; other < count_; ++other) {
    if (other == into || other == from || sizes_[static_cast<std::size_t>(other)] == 0) continue;
    float& distance = distances_[at(into, other)];
    distance += share * (distances_[at(from, other)] - distance);
  }
  size += gone;
  gone = 0;
}

std::vector<int> AverageLinkage::groups(double height) {
  std::vector<int> member(static_cast<std::size_t>(count_));
  std::iota(member.begin(), member.end(), 0);
  std::vector<int> chain;
  std::vector<std::pair<int, int>> joined;
  int first = 0;
  for (int left = count_; left > 1; --left) {
    if (chain.empty()) {
      while (sizes_[static_cast<std::size_t>(first)] == 0) ++first;
      chain.push_back(first);
    }
    for (;;) {
      const int last = chain.back(), previous = chain.size() > 1 ? chain[chain.size() - 2] : -1;
      const int next = nearest(last, previous);
      if (next == previous) break;
      chain.push_back(next);
    }
    const int from = chain.back(), into = chain[chain.size() - 2];
    chain.resize(chain.size() - 2);
    // Heights never fall from a group to what it is joined to, so what is above the limit stays apart.
    if (distances_[at(into, from)] <= height) joined.emplace_back(into, from);
    join(into, from);
  }
  for (auto pair = joined.rbegin(); pair != joined.rend(); ++pair) {
    member[static_cast<std::size_t>(pair->second)] = member[static_cast<std::size_t>(pair->first)];
  }
  return member;
}

}  // namespace strut::effort::detail
