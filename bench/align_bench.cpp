// SPDX-License-Identifier: MIT
// Alignment of two clips with 66 degrees of freedom, slope limit 2: at the size of the goal, 600 frames (5 s at 120
// Hz), at that of a gait cycle, and up to eleven minutes at 30 Hz. Items are input frames.
#include <cmath>

#include <benchmark/benchmark.h>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>

namespace {

using namespace strut;

constexpr int kFrames = 600, kDofs = 66;

/// Gait-like curves of unit variance; `style` changes pose, amplitude and timing.
FrameMatrix gait(double style, int frames = kFrames) {
  FrameMatrix signal(frames, kDofs);
  for (int t = 0; t < frames; ++t) {
    const double phase = 0.05 * t + 0.6 * style * std::sin(0.02 * t);
    for (int d = 0; d < kDofs; ++d) {
      signal(t, d) = 1.4 * std::sin((1 + d % 3) * phase + d * (1.0 + 0.05 * style)) + 0.5 * style * std::cos(d);
    }
  }
  return signal;
}

void time_warp(benchmark::State& state) {
  const FrameMatrix input = gait(0.0), output = gait(1.0);
  for (auto _ : state)
    benchmark::DoNotOptimize(align::time_warp(input, output, {.slope_limit = static_cast<double>(state.range(0))}));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(time_warp)->ArgName("slope_limit")->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

void space_warp(benchmark::State& state) {
  const FrameMatrix input = gait(0.0), output = gait(1.0);
  const align::TimeWarp even{std::vector<int>(kFrames, 2), 2};
  for (auto _ : state) benchmark::DoNotOptimize(align::space_warp(input, output, even));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(space_warp)->Unit(benchmark::kMillisecond);

/// Ten rounds; counter `rounds`, for the search may end before the tenth.
void iterative_motion_warping(benchmark::State& state) {
  const auto frames = static_cast<int>(state.range(0));
  const FrameMatrix input = gait(0.0, frames), output = gait(1.0, frames);
  align::IterativeMotionWarpingOptions options;
  options.tolerance = 0.0;
  std::size_t rounds = 0;
  for (auto _ : state) rounds = align::iterative_motion_warping(input, output, options).objective.size();
  state.SetItemsProcessed(state.iterations() * frames);
  state.counters["rounds"] = static_cast<double>(rounds);
}
BENCHMARK(iterative_motion_warping)
    ->ArgName("frames")
    ->Arg(40)
    ->Arg(300)
    ->Arg(600)
    ->Arg(1200)
    ->Arg(2500)
    ->Arg(5000)
    ->Arg(10000)
    ->Arg(20000)
    ->Unit(benchmark::kMillisecond);

/// A clip of 100 frames is looked for in ones of this many.
void time_warp_open(benchmark::State& state) {
  const FrameMatrix input = gait(0.0, 100), output = gait(1.0, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(align::time_warp(input, output, {.ends = align::Ends::kOpen}));
  state.SetItemsProcessed(state.iterations() * 100);
}
BENCHMARK(time_warp_open)->ArgName("frames")->Arg(600)->Arg(20000)->Unit(benchmark::kMillisecond);

void dynamic_time_warping(benchmark::State& state) {
  const FrameMatrix input = gait(0.0), output = gait(1.0);
  const auto constraint = state.range(0) == 1 ? align::LocalConstraint::kTypeI : align::LocalConstraint::kTypeIII;
  for (auto _ : state) benchmark::DoNotOptimize(align::dynamic_time_warping(input, output, constraint));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(dynamic_time_warping)->ArgName("type")->Arg(1)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
