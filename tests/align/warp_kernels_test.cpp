// SPDX-License-Identifier: MIT
// The kernels for this processor against those for every one; what both compute is held by the tests of their users.
#include "align/warp_kernels.h"

#include "align/packed_rows.h"
#include "align/signals_for_tests.h"

#include <random>

#include <gtest/gtest.h>

namespace strut::align::detail {
namespace {

constexpr double kRounding = 1e-13;  // fused or not, sums of some ten products of numbers of size one

using Numbers = Eigen::ArrayXd;

Numbers numbers(int count, unsigned seed) {
  return test::noise(count, 1, seed).col(0).array();
}

class WarpKernelsOfThisProcessor : public testing::Test {
 protected:
  void SetUp() override {
    if (avx2_warp_kernels() == nullptr || &warp_kernels() == &portable_warp_kernels()) GTEST_SKIP() << "has no AVX2";
  }
};

TEST_F(WarpKernelsOfThisProcessor, MeasureTheSameDistances) {
  constexpr int kDofs = 13, kTiles = 3, kFrames = kTiles * kTileFrames;
  const Numbers input = numbers(kGroupFrames * kDofs, 1), output = numbers(kFrames * kDofs, 2);
  const Numbers input_norms = numbers(kGroupFrames, 3).square() * 50.0,
                output_norms = numbers(kFrames, 4).square() * 50.0;
  Numbers here(kGroupFrames * kFrames), everywhere(kGroupFrames * kFrames);
  warp_kernels().squared_distances(kDofs, kTiles, input.data(), input_norms.data(), output.data(), output_norms.data(),
                                   here.data(), kFrames);
  portable_warp_kernels().squared_distances(kDofs, kTiles, input.data(), input_norms.data(), output.data(),
                                            output_norms.data(), everywhere.data(), kFrames);
  EXPECT_LT((here - everywhere).abs().maxCoeff(), 1000.0 * kRounding);
  EXPECT_GE(here.minCoeff(), 0.0);
}

TEST_F(WarpKernelsOfThisProcessor, ChooseTheSameCounts) {
  constexpr int kWidth = 41, kMost = 9, kSize = 48 + kMost;
  const Numbers before = numbers(kSize, 1), distance = numbers(kSize, 2).abs(), factor = numbers(kMost + 1, 3).abs();
  const Numbers uneven = numbers(kMost + 1, 4).abs();
  for (const auto& [least, most] : {std::pair(1, 4), std::pair(2, 9), std::pair(3, 3)}) {
    Numbers here(48), everywhere(48);
    std::vector<std::uint16_t> counts_here(48), counts_everywhere(48);
    warp_kernels().choose_counts(kWidth, least, most, factor.data(), uneven.data(), before.data() + kMost,
                                 distance.data() + kMost, here.data(), counts_here.data());
    portable_warp_kernels().choose_counts(kWidth, least, most, factor.data(), uneven.data(), before.data() + kMost,
                                          distance.data() + kMost, everywhere.data(), counts_everywhere.data());
    EXPECT_LT((here - everywhere).head(kWidth).abs().maxCoeff(), kRounding);
    for (std::size_t x = 0; x < kWidth; ++x) EXPECT_EQ(counts_here[x], counts_everywhere[x]);
  }
}

TEST_F(WarpKernelsOfThisProcessor, StepAndSolveAlike) {
  constexpr int kCount = 19, kSize = 40;
  const Numbers one = numbers(kSize, 1), two = numbers(kSize, 2), distance = numbers(kSize, 3).abs();
  const Numbers before = 0.1 * numbers(kCount * kEliminated, 4);
  const auto run = [&](const WarpKernels& kernels) {
    Numbers all = Numbers::Zero(4 * kSize + kCount * kEliminated);
    std::vector<std::uint16_t> steps(kSize);
    kernels.step_type_i(kCount, one.data() + 2, distance.data(), all.data(), steps.data());
    kernels.step_type_iii(kCount, one.data() + 2, two.data() + 2, distance.data(), all.data() + kSize, steps.data());
    kernels.add_scaled(kCount, 1.5, one.data(), all.data() + 2 * kSize);
    kernels.add_squared_differences(kCount, 1.5, one.data(), two.data(), all.data() + 2 * kSize);
    kernels.warp(kCount, one.data(), two.data(), distance.data(), all.data() + 3 * kSize);
    kernels.eliminate(kCount, {2.0, 5.0, 6.0, 2.0, 3.0, 1e-8}, one.data(), two.data(), before.data(), one.data(),
                      two.data(), all.data() + 4 * kSize, all.data() + 3 * kSize, all.data() + 2 * kSize);
    kernels.substitute(kCount, 2.0, 3.0, before.data(), one.data(), two.data(), all.data() + 3 * kSize,
                       all.data() + 2 * kSize);
    return all;
  };
  EXPECT_LT((run(warp_kernels()) - run(portable_warp_kernels())).abs().maxCoeff(), kRounding);
}

TEST(PackedRows, GiveBackWhatWasPutIn) {
  std::mt19937 generator(1);
  for (const int largest : {1, 3, 4, 15, 16, 255, 256, 65535}) {
    PackedRows rows;
    rows.reset(largest, 3, 60);
    std::uniform_int_distribution<int> any(0, largest);
    std::vector<std::vector<std::uint16_t>> kept;
    for (const int width : {1, 8, 51}) {
      std::vector<std::uint16_t> row(56);
      for (std::uint16_t& number : row) number = static_cast<std::uint16_t>(any(generator));
      rows.append(width, row.data());
      row.resize(static_cast<std::size_t>(width));
      kept.push_back(row);
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
      for (std::size_t j = 0; j < kept[i].size(); ++j) EXPECT_EQ(rows.at(i, j), kept[i][j]) << largest;
    }
  }
}

}  // namespace
}  // namespace strut::align::detail
