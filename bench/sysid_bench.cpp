// SPDX-License-Identifier: MIT
// What learning one joint costs: 200 clips of 45 frames after 15 of lead-in, three inputs and three outputs, the order
// chosen over 4 folds. Items are fitted frames. A body is about 22 such joints, learnt in parallel.
#include <random>

#include <benchmark/benchmark.h>

#include <strut/sysid/identify.h>

namespace {

using strut::FrameMatrix;
using strut::sysid::Experiment;

constexpr int kClips = 200, kFrames = 45, kLeadIn = 15, kWidth = 3;

/// Smooth noise through a slow filter: something to find, with all the poles of motion.
std::vector<Experiment> clips() {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const strut::sysid::LtiSystem truth(0.85 * Eigen::MatrixXd::Identity(kWidth, kWidth),
                                      Eigen::MatrixXd::Random(kWidth, kWidth), Eigen::MatrixXd::Random(kWidth, kWidth),
                                      Eigen::MatrixXd::Random(kWidth, kWidth));
  std::vector<Experiment> clips;
  for (int k = 0; k < kClips; ++k) {
    FrameMatrix input = FrameMatrix::NullaryExpr(kLeadIn + kFrames, kWidth, [&] { return normal(random); });
    for (Eigen::Index t = 1; t < input.rows(); ++t) input.row(t) += 0.9 * input.row(t - 1);
    FrameMatrix output = strut::sysid::simulate(truth, input);
    output += 0.3 * FrameMatrix::NullaryExpr(output.rows(), output.cols(), [&] { return normal(random); });
    clips.push_back({std::move(input), std::move(output), kLeadIn});
  }
  return clips;
}

std::vector<int> groups_of_ten() {
  std::vector<int> groups;
  for (int k = 0; k < kClips; ++k) groups.push_back(k / 10);
  return groups;
}

void Identify(benchmark::State& state) {
  const auto experiments = clips();
  const auto groups = groups_of_ten();
  for (auto _ : state) benchmark::DoNotOptimize(strut::sysid::identify(experiments, groups));
  state.SetItemsProcessed(state.iterations() * kClips * kFrames);
}
BENCHMARK(Identify)->Unit(benchmark::kMillisecond);

void HankelFactorOfAllClips(benchmark::State& state) {
  const auto experiments = clips();
  for (auto _ : state) {
    strut::sysid::HankelFactor factor(kWidth, kWidth, 10);
    for (const Experiment& clip : experiments) factor.add(clip);
    benchmark::DoNotOptimize(strut::sysid::Subspace(factor, strut::sysid::Weighting::kCva));
  }
  state.SetItemsProcessed(state.iterations() * kClips * kFrames);
}
BENCHMARK(HankelFactorOfAllClips)->Unit(benchmark::kMillisecond);

}  // namespace
