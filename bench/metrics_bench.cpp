// SPDX-License-Identifier: MIT
// The metrics on two generated walks of ten seconds at 30 frames/s. Items are frames measured; for the distance, pairs
// of clips.
#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/metrics/clip_distance.h>
#include <strut/metrics/foot_slide.h>
#include <strut/metrics/gait.h>
#include <strut/metrics/smoothness.h>

namespace {

using namespace strut;

constexpr double kSeconds = 10.0;

Motion walk(double limp) {
  generate::WalkContent content;
  content.duration = kSeconds;
  generate::WalkStyle style;
  style.limp = limp;
  return generate::generate_walk(content, style, metrics::kComparisonRate).motion;
}

void BodyTrack(benchmark::State& state) {
  const Motion motion = walk(0.0);
  for (auto _ : state) benchmark::DoNotOptimize(metrics::body_track(motion, metrics::kComparisonRate));
  state.SetItemsProcessed(state.iterations() * motion.num_frames());
}
BENCHMARK(BodyTrack);

void ClipDistance(benchmark::State& state) {
  const auto plain = metrics::body_track(walk(0.0), metrics::kComparisonRate);
  const auto limping = metrics::body_track(walk(0.8), metrics::kComparisonRate);
  for (auto _ : state) benchmark::DoNotOptimize(metrics::clip_distance(plain, limping));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ClipDistance)->Unit(benchmark::kMillisecond);

void FootSlide(benchmark::State& state) {
  const auto track = metrics::body_track(walk(0.0), metrics::kComparisonRate);
  for (auto _ : state) benchmark::DoNotOptimize(metrics::foot_slide(track));
  state.SetItemsProcessed(state.iterations() * track.num_frames());
}
BENCHMARK(FootSlide);

void Smoothness(benchmark::State& state) {
  const Motion motion = walk(0.0);
  for (auto _ : state) benchmark::DoNotOptimize(metrics::smoothness(motion));
  state.SetItemsProcessed(state.iterations() * motion.num_frames());
}
BENCHMARK(Smoothness);

void Gait(benchmark::State& state) {
  const auto track = metrics::body_track(walk(0.0), metrics::kComparisonRate);
  for (auto _ : state) benchmark::DoNotOptimize(metrics::gait(track));
  state.SetItemsProcessed(state.iterations() * track.num_frames());
}
BENCHMARK(Gait);

}  // namespace
