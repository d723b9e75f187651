// SPDX-License-Identifier: MIT
#include <algorithm>

#include <strut/learn/learn_report.h>

namespace strut::learn {
namespace {

double lost(const BlockReport& block) {
  return block.fit - block.left_out_fit;
}

template <typename Chosen, typename Before>
std::vector<BlockReport> choose(const LearnReport& report, Chosen chosen, Before before) {
  std::vector<BlockReport> blocks;
  if (report.num_left_out == 0) return blocks;
  std::copy_if(report.blocks.begin(), report.blocks.end(), std::back_inserter(blocks), chosen);
  std::stable_sort(blocks.begin(), blocks.end(), before);
  return blocks;
}

}  // namespace

std::vector<BlockReport> poorly_predicted(const LearnReport& report) {
  return choose(
      report, [](const BlockReport& block) { return block.left_out_fit < kPoorFit; },
      [](const BlockReport& a, const BlockReport& b) { return a.left_out_fit < b.left_out_fit; });
}

std::vector<BlockReport> short_of_takes(const LearnReport& report) {
  return choose(
      report, [](const BlockReport& block) { return lost(block) > kFitLostToNews; },
      [](const BlockReport& a, const BlockReport& b) { return lost(a) > lost(b); });
}

}  // namespace strut::learn
