// SPDX-License-Identifier: MIT
// What the runtime costs per frame: a limp learnt from generated walks (21 joints, about 70 states), put on a walk at
// the model's 30 frames/s. Items are frames: the paper reports 10,000 frames/s for 98 states, the model step alone.
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>
#include <strut/translate/translate_motion.h>
#include <strut/translate/translator.h>

namespace {

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

Examples examples() {
  Examples all;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    all.inputs.push_back(walk(0.9 + 0.1 * static_cast<double>(seed), 0.0, seed));
    all.outputs.push_back(walk(0.9 + 0.1 * static_cast<double>(seed), 0.8, seed + 100));
  }
  all.pairs = strut::learn::find_pairs(all.inputs, all.outputs).pairs;
  return all;
}

const std::shared_ptr<const strut::StyleModel>& model() {
  static const auto learnt = [] {
    const Examples all = examples();
    return strut::learn_style(all.inputs, all.outputs, all.pairs).model;
  }();
  return learnt;
}

void LearnStyle(benchmark::State& state) {
  const Examples all = examples();
  for (auto _ : state) benchmark::DoNotOptimize(strut::learn_style(all.inputs, all.outputs, all.pairs));
  state.counters["pairs"] = static_cast<double>(all.pairs.size());
}
BENCHMARK(LearnStyle)->Unit(benchmark::kMillisecond)->UseRealTime();

void ModelStep(benchmark::State& state) {
  strut::translate::SignalTranslator translator(model());
  const strut::FrameMatrix rows = strut::representation::encode(model()->input(), walk(1.2, 0.0, 50));
  Eigen::RowVectorXd output(model()->num_dofs() + 1);
  for (auto _ : state) {
    for (Eigen::Index t = 0; t < rows.rows(); ++t) translator.step(rows.row(t), output);
    benchmark::DoNotOptimize(output.data());
  }
  state.SetItemsProcessed(state.iterations() * rows.rows());
  state.counters["states"] = model()->num_states();
}
BENCHMARK(ModelStep);

void TranslatorPush(benchmark::State& state) {
  strut::Translator translator(model());
  const Motion clip = walk(1.2, 0.0, 50);
  strut::Pose output;
  for (auto _ : state) {
    for (const strut::Pose& pose : clip.frames()) translator.push(pose, output);
    benchmark::DoNotOptimize(output.rotations.data());
  }
  state.SetItemsProcessed(state.iterations() * clip.num_frames());
}
BENCHMARK(TranslatorPush);

void TranslateMotion(benchmark::State& state) {
  const Motion clip = walk(1.2, 0.0, 50, 10.0);
  for (auto _ : state) benchmark::DoNotOptimize(strut::translate_motion(model(), clip));
  state.SetItemsProcessed(state.iterations() * clip.num_frames());
}
BENCHMARK(TranslateMotion);

}  // namespace
