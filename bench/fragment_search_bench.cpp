// SPDX-License-Identifier: MIT
// Searching one fragment in long recordings of 24 dimensions: at the size of the goal, 120 frames in a million, on one
// thread and on all, in an hour of motion, and what making the index costs. Items are frames of the recording.
#include <cmath>
#include <random>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <strut/effort/fragment_search.h>

namespace {

using namespace strut;

constexpr int kDimensions = 24, kQueryFrames = 120;

/// A smooth random path, as postures over time are.
FrameMatrix recording(int frames) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0.0, 0.02);
  FrameMatrix path(frames, kDimensions);
  Eigen::RowVectorXd at = Eigen::RowVectorXd::Zero(kDimensions);
  for (int t = 0; t < frames; ++t) {
    for (double& number : at) number = 0.99 * number + normal(generator);
    path.row(t) = at;
  }
  return path;
}

void subsequence_costs(benchmark::State& state) {
  const auto frames = static_cast<int>(state.range(0));
  const auto threads = static_cast<std::size_t>(state.range(1));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const FrameMatrix path = recording(frames);
  const effort::SearchIndex index(path);
  const FrameMatrix query = path.middleRows(frames / 2, kQueryFrames);
  for (auto _ : state) benchmark::DoNotOptimize(effort::subsequence_costs(query, index));
  state.SetItemsProcessed(state.iterations() * frames);
}
BENCHMARK(subsequence_costs)
    ->ArgNames({"frames", "threads"})
    ->Args({108000, 1})
    ->Args({1000000, 1})
    ->Args({1000000, 64})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void search_index(benchmark::State& state) {
  const auto frames = static_cast<int>(state.range(0));
  const std::vector<FrameMatrix> clips{recording(frames)};
  for (auto _ : state) benchmark::DoNotOptimize(effort::SearchIndex(clips));
  state.SetItemsProcessed(state.iterations() * frames);
}
BENCHMARK(search_index)->ArgName("frames")->Arg(1000000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
