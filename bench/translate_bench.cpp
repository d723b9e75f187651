// SPDX-License-Identifier: MIT
// What learning and whole clips cost: a limp from generated walks (21 joints), as a radial map (the default: 400
// centres, 48 features) and as linear systems, put on a walk at the model's 30 frames/s. Items are frames.
// runtime_bench.cpp has what a frame costs.
#include <vector>

#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>
#include <strut/translate/translate_motion.h>

namespace {

using strut::LearnMethod;
using strut::LearntStyle;
using strut::Motion;

constexpr double kRate = 30.0;

Motion walk(double speed, double limp, std::uint64_t seed, double duration = 8.0) {
  const strut::generate::WalkContent content{.duration = duration, .speed = speed, .turn_rate = 0.1};
  return strut::generate::generate_walk(content, {.limp = limp, .seed = seed}, kRate).motion;
}

struct Examples {
  std::vector<Motion> inputs, outputs;
  std::vector<strut::learn::ClipPair> pairs;
};

const Examples& examples() {
  static const Examples made = [] {
    Examples all;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      all.inputs.push_back(walk(0.9 + 0.1 * static_cast<double>(seed), 0.0, seed));
      all.outputs.push_back(walk(0.9 + 0.1 * static_cast<double>(seed), 0.8, seed + 100));
    }
    all.pairs = strut::learn::find_pairs(all.inputs, all.outputs).pairs;
    return all;
  }();
  return made;
}

LearntStyle learn(LearnMethod method) {
  const Examples& all = examples();
  return strut::learn_style(all.inputs, all.outputs, all.pairs, {.method = method});
}

/// What is stepped: each learnt once.
const LearntStyle& learnt(LearnMethod method) {
  static const LearntStyle radial = learn(LearnMethod::kRadial);
  static const LearntStyle linear = learn(LearnMethod::kLinear);
  return method == LearnMethod::kRadial ? radial : linear;
}

void LearnStyle(benchmark::State& state, LearnMethod method) {
  const auto pairs = static_cast<double>(examples().pairs.size());
  for (auto _ : state) benchmark::DoNotOptimize(learn(method));
  state.counters["pairs"] = pairs;
}

void TranslateMotion(benchmark::State& state, LearnMethod method) {
  const Motion clip = walk(1.2, 0.0, 50, 10.0);
  for (auto _ : state) benchmark::DoNotOptimize(strut::translate_motion(learnt(method).model, clip));
  state.SetItemsProcessed(state.iterations() * clip.num_frames());
}

BENCHMARK_CAPTURE(LearnStyle, radial, LearnMethod::kRadial)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(LearnStyle, linear, LearnMethod::kLinear)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(LearnStyle, paper, LearnMethod::kPaper)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(TranslateMotion, radial, LearnMethod::kRadial);
BENCHMARK_CAPTURE(TranslateMotion, linear, LearnMethod::kLinear);

}  // namespace
