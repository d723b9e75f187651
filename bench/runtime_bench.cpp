// SPDX-License-Identifier: MIT
// What the runtime costs, with the floor beside it. Items are frames: the paper reports 10,000 frames/s for 98 states
// on a Pentium 4, the model step alone. `floor` is what a dense system and independent blocks cost with nothing around
// them.
#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>
#include <strut/math/rotation_arrays.h>
#include <strut/model/model_step.h>
#include <strut/sysid/lti_bank.h>
#include <strut/translate/translator.h>
#include <strut/translate/translator_batch.h>

namespace {

using strut::BasicTranslator;
using strut::FloatTranslator;
using strut::LearnMethod;
using strut::Motion;
using strut::Pose;
using strut::PoseView;
using strut::StyleModel;

constexpr double kRate = 60.0;
constexpr int kBlocks = 35;
constexpr int kStates = 3;  // of a block, and inputs, and outputs

/// The generator's body has 21 joints; a joint above the hips, as most files have one, makes it 22.
Motion with_a_root_above(const Motion& motion) {
  std::vector<strut::Joint> joints{{"root", -1, {0, 0, 0}}};
  for (strut::Joint joint : motion.skeleton().joints()) {
    ++joint.parent;
    joints.push_back(std::move(joint));
  }
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    pose.rotations.insert(pose.rotations.begin(), Eigen::Quaterniond::Identity());
    pose.translations.insert(pose.translations.begin(), Eigen::Vector3d::Zero());
  }
  return {std::make_shared<const strut::Skeleton>(std::move(joints)), motion.frame_rate(), std::move(frames)};
}

Motion walk(double limp, std::uint64_t seed) {
  const strut::generate::WalkContent content{.duration = 8.0, .speed = 1.2, .turn_rate = 0.1};
  return with_a_root_above(strut::generate::generate_walk(content, {.limp = limp, .seed = seed}, kRate).motion);
}

std::shared_ptr<const StyleModel> learn(LearnMethod method, int centres = 400) {
  std::vector<Motion> inputs, outputs;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    inputs.push_back(walk(0.0, seed));
    outputs.push_back(walk(0.8, seed + 100));
  }
  const auto pairs = strut::learn::find_pairs(inputs, outputs).pairs;
  return strut::learn_style(inputs, outputs, pairs, {.method = method, .radial = {.centres = centres}}).model;
}

Eigen::MatrixXd some(int rows, int cols, double size) {
  return size * Eigen::MatrixXd::Random(rows, cols);
}

/// The model with systems of the paper's size in the place of what was identified: 98 states on the same joints, of
/// which projections tell planted feet half of the time.
std::shared_ptr<const StyleModel> with_98_states(const StyleModel& learnt) {
  strut::StyleModelParts parts{learnt.frame_rate(),
                               learnt.input(),
                               learnt.output(),
                               learnt.input_scaling(),
                               learnt.output_scaling(),
                               {},
                               {},
                               {},
                               "{}"};
  int all = 0;
  for (const strut::StyleBlock& block : learnt.blocks()) {
    const auto inputs = static_cast<int>(block.input_dofs.size());
    const auto outputs = static_cast<int>(block.output_dofs.size());
    const int others = static_cast<int>(learnt.blocks().size()) - 1;
    const int states = block.name == "root" ? 98 - 5 * others : 5;
    all += states;
    parts.blocks.push_back({block.name,
                            block.input_dofs,
                            block.output_dofs,
                            {some(states, states, 0.1), some(states, inputs, 0.1), some(outputs, states, 0.1),
                             some(outputs, inputs, 0.1)}});
  }
  const Eigen::VectorXd projection = some(all, 1, 1.0);
  parts.footplants.emplace(
      std::array<strut::postprocess::FootplantBoundary, 2>{{{projection, 0.0, true}, {projection, 0.0, false}}});
  return std::make_shared<const StyleModel>(std::move(parts));
}

enum Kind { kLinear, kRadial, kSmallRadial };

const std::shared_ptr<const StyleModel>& model(Kind kind) {
  static const auto linear = with_98_states(*learn(LearnMethod::kPaper));
  static const auto radial = learn(LearnMethod::kRadial);
  static const auto small = learn(LearnMethod::kRadial, 100);
  return kind == kLinear ? linear : kind == kRadial ? radial : small;
}

/// The frames of a clip as plain numbers.
template <typename Scalar>
struct Frames {
  explicit Frames(const Motion& motion) : joints(motion.skeleton().num_joints()), count(motion.num_frames()) {
    for (const Pose& pose : motion.frames()) {
      const auto from = strut::view(pose);
      rotations.insert(rotations.end(), from.rotations, from.rotations + 4 * joints);
      translations.insert(translations.end(), from.translations, from.translations + 3 * joints);
    }
  }
  PoseView<const Scalar> operator[](int frame) const {
    const auto first = static_cast<std::ptrdiff_t>(frame % count) * joints;
    return {rotations.data() + 4 * first, translations.data() + 3 * first, joints};
  }
  int joints, count;
  std::vector<Scalar> rotations, translations;
};

template <typename Scalar>
struct OnePose {
  explicit OnePose(int num_joints) : rotations(4 * num_joints), translations(3 * num_joints), joints(num_joints) {}
  operator PoseView<Scalar>() { return {rotations.data(), translations.data(), joints}; }
  std::vector<Scalar> rotations, translations;
  int joints;
};

/// 105 states in one dense system, in Eigen.
void ModelStepDense(benchmark::State& state) {
  constexpr int kAll = kBlocks * kStates;
  const Eigen::MatrixXf matrix = some(2 * kAll, 2 * kAll, 0.01).cast<float>();
  Eigen::VectorXf now = Eigen::VectorXf::Ones(2 * kAll), next(2 * kAll);
  for (auto _ : state) {
    next.noalias() = matrix * now;
    now.head<kAll>() = next.head<kAll>();
    benchmark::DoNotOptimize(next.data());
  }
  state.SetItemsProcessed(state.iterations());
}

template <typename Scalar>
void ModelStepBlocks(benchmark::State& state) {
  std::vector<strut::sysid::LtiSystem> systems;
  std::vector<strut::sysid::BankedSystem> banked;
  for (int b = 0; b < kBlocks; ++b) {
    systems.emplace_back(some(kStates, kStates, 0.2), some(kStates, kStates, 0.5), some(kStates, kStates, 0.5),
                         some(kStates, kStates, 0.5));
  }
  constexpr int kPlane = strut::math::padded(kBlocks);
  for (int b = 0; b < kBlocks; ++b) {
    const std::vector<int> dofs = {b, b + kPlane, b + 2 * kPlane};
    banked.push_back({&systems[static_cast<std::size_t>(b)], dofs, dofs});
  }
  const strut::sysid::LtiBank<Scalar> bank(banked, kStates * kPlane, kStates * kPlane);
  strut::math::AlignedVector<Scalar> input(kStates * kPlane, Scalar(0.3)), output(input.size());
  strut::math::AlignedVector<Scalar> states(static_cast<std::size_t>(bank.state_size()));
  strut::math::AlignedVector<Scalar> scratch(static_cast<std::size_t>(bank.scratch_size()));
  for (auto _ : state) {
    bank.step(input.data(), states.data(), scratch.data(), output.data());
    benchmark::DoNotOptimize(output.data());
  }
  state.SetItemsProcessed(state.iterations());
}

template <typename Scalar>
void RotationMaps(benchmark::State& state) {
  constexpr int kJoints = 24;
  strut::math::AlignedVector<Scalar> vectors(3 * kJoints, Scalar(0.4)), rotations(4 * kJoints);
  for (auto _ : state) {
    strut::math::exp_maps(kJoints, kJoints, vectors.data(), rotations.data());
    strut::math::log_maps_near(kJoints, kJoints, rotations.data(), vectors.data());
    benchmark::DoNotOptimize(vectors.data());
  }
  state.SetItemsProcessed(state.iterations());
}

template <typename Scalar>
void Push(benchmark::State& state, Kind kind, bool clean_feet) {
  BasicTranslator<Scalar> translator(model(kind), {.clean_feet = clean_feet});
  const Frames<Scalar> frames(walk(0.0, 50));
  OnePose<Scalar> output(frames.joints);
  for (auto _ : state) {
    for (int t = 0; t < frames.count; ++t) translator.push(frames[t], output);
    benchmark::DoNotOptimize(output.rotations.data());
  }
  state.SetItemsProcessed(state.iterations() * frames.count);
  state.counters["states"] = model(kind)->num_states();
}

void PushFloat(benchmark::State& state, Kind kind, bool clean_feet) {
  Push<float>(state, kind, clean_feet);
}
void PushDouble(benchmark::State& state, Kind kind, bool clean_feet) {
  Push<double>(state, kind, clean_feet);
}

/// The slowest pushes: each timed alone, so that the clock's own cost (some 20 ns) is in every figure.
void PushTail(benchmark::State& state, Kind kind, bool clean_feet) {
  FloatTranslator translator(model(kind), {.clean_feet = clean_feet});
  const Frames<float> frames(walk(0.0, 50));
  OnePose<float> output(frames.joints);
  std::vector<double> times;
  int t = 0;
  for (auto _ : state) {
    const auto before = std::chrono::steady_clock::now();
    translator.push(frames[t++], output);
    times.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - before).count());
  }
  std::sort(times.begin(), times.end());
  const auto at = [&times](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  state.counters["median_ns"] = at(0.5);
  state.counters["p99.9_ns"] = at(0.999);
  state.counters["ratio"] = at(0.999) / at(0.5);
}

/// So many characters, a frame each: items are characters' frames, 60 of which a character needs each second.
void PushBatch(benchmark::State& state, Kind kind) {
  const auto characters = static_cast<int>(state.range(0));
  strut::TranslatorBatch<float> batch(model(kind), characters);
  const Frames<float> frames(walk(0.0, 50));
  std::vector<float> rotations, translations;
  for (int c = 0; c < characters; ++c) {
    const auto pose = frames[c];
    rotations.insert(rotations.end(), pose.rotations, pose.rotations + 4 * pose.num_joints);
    translations.insert(translations.end(), pose.translations, pose.translations + 3 * pose.num_joints);
  }
  std::vector<float> to_rotations(rotations), to_translations(translations);
  for (auto _ : state) {
    batch.push({rotations.data(), translations.data(), frames.joints},
               {to_rotations.data(), to_translations.data(), frames.joints});
    benchmark::DoNotOptimize(to_rotations.data());
  }
  state.SetItemsProcessed(state.iterations() * characters);
  state.counters["bytes_each"] = static_cast<double>(batch.bytes_per_character());
  state.counters["at_60_frames/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * characters / 60.0, benchmark::Counter::kIsRate);
}

BENCHMARK(ModelStepDense);
BENCHMARK(ModelStepBlocks<float>);
BENCHMARK(ModelStepBlocks<double>);
BENCHMARK(RotationMaps<float>);
BENCHMARK(RotationMaps<double>);
BENCHMARK_CAPTURE(PushFloat, linear, kLinear, false);
BENCHMARK_CAPTURE(PushFloat, linear_feet, kLinear, true);
BENCHMARK_CAPTURE(PushDouble, linear, kLinear, false);
BENCHMARK_CAPTURE(PushFloat, radial, kRadial, false);
BENCHMARK_CAPTURE(PushFloat, radial_feet, kRadial, true);
BENCHMARK_CAPTURE(PushDouble, radial, kRadial, false);
BENCHMARK_CAPTURE(PushFloat, radial_100_centres, kSmallRadial, false);
BENCHMARK_CAPTURE(PushTail, linear, kLinear, false);
BENCHMARK_CAPTURE(PushTail, linear_feet, kLinear, true);
BENCHMARK_CAPTURE(PushTail, radial, kRadial, false);
BENCHMARK_CAPTURE(PushTail, radial_feet, kRadial, true);
BENCHMARK_CAPTURE(PushBatch, linear, kLinear)->Arg(100)->Arg(10000);
BENCHMARK_CAPTURE(PushBatch, radial, kRadial)->Arg(100)->Arg(10000);

}  // namespace
