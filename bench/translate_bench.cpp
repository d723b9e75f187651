// SPDX-License-Identifier: MIT
// What learning and the runtime cost: a limp from generated walks (21 joints), as a radial map (the default: 400
// centres, 48 features) and as linear systems, put on a walk at the model's 30 frames/s. Items are frames: the paper
// reports 10,000 frames/s for 98 states, the model step alone.
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>
#include <strut/model/model_step.h>
#include <strut/translate/translate_motion.h>
#include <strut/translate/translator.h>

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

void set_size(benchmark::State& state, const LearntStyle& style) {
  state.counters["centres"] = style.report.num_centres;
  state.counters["states"] = style.model->num_states();
}

void LearnStyle(benchmark::State& state, LearnMethod method) {
  const auto pairs = static_cast<double>(examples().pairs.size());
  for (auto _ : state) benchmark::DoNotOptimize(learn(method));
  state.counters["pairs"] = pairs;
}

void StepModel(benchmark::State& state, LearnMethod method) {
  const LearntStyle& style = learnt(method);
  strut::ModelStep<double> step(style.model);
  const strut::FrameMatrix rows = strut::representation::encode(style.model->input(), walk(1.2, 0.0, 50));
  Eigen::RowVectorXd output(style.model->num_dofs() + 1);
  for (auto _ : state) {
    for (Eigen::Index t = 0; t < rows.rows(); ++t) step.step(rows.row(t), output);
    benchmark::DoNotOptimize(output.data());
  }
  state.SetItemsProcessed(state.iterations() * rows.rows());
  set_size(state, style);
}

void TranslatorPush(benchmark::State& state, LearnMethod method) {
  strut::Translator translator(learnt(method).model);
  const Motion clip = walk(1.2, 0.0, 50);
  strut::Pose output;
  for (auto _ : state) {
    for (const strut::Pose& pose : clip.frames()) translator.push(pose, output);
    benchmark::DoNotOptimize(output.rotations.data());
  }
  state.SetItemsProcessed(state.iterations() * clip.num_frames());
}

void TranslateMotion(benchmark::State& state, LearnMethod method) {
  const Motion clip = walk(1.2, 0.0, 50, 10.0);
  for (auto _ : state) benchmark::DoNotOptimize(strut::translate_motion(learnt(method).model, clip));
  state.SetItemsProcessed(state.iterations() * clip.num_frames());
}

BENCHMARK_CAPTURE(LearnStyle, radial, LearnMethod::kRadial)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(LearnStyle, linear, LearnMethod::kLinear)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(LearnStyle, paper, LearnMethod::kPaper)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(StepModel, radial, LearnMethod::kRadial);
BENCHMARK_CAPTURE(StepModel, linear, LearnMethod::kLinear);
BENCHMARK_CAPTURE(TranslatorPush, radial, LearnMethod::kRadial);
BENCHMARK_CAPTURE(TranslatorPush, linear, LearnMethod::kLinear);
BENCHMARK_CAPTURE(TranslateMotion, radial, LearnMethod::kRadial);
BENCHMARK_CAPTURE(TranslateMotion, linear, LearnMethod::kLinear);

}  // namespace
