// SPDX-License-Identifier: MIT
// BVH text to a Motion and back, in bytes per second on one core: what `strut` spends on a file once the disk has
// given it. The generated clip has 24 joints as most files have them (three rotations, six channels on the root); set
// STRUT_DATA to measure a real one too (six channels on every joint).
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>

namespace strut {
namespace {

constexpr int kJoints = 24;
constexpr int kFrames = 40'000;  // about 30 MB of text

std::shared_ptr<const Skeleton> generated_skeleton() {
  std::vector<Joint> joints;
  for (int j = 0; j < kJoints; ++j) {
    Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.parent = j == 0 ? -1 : (j % 4 == 1 ? 0 : j - 1);
    joint.offset = {0.02 * (j % 3), 0.3, 0.01 * j};
    joints.push_back(joint);
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

const std::string& generated_text() {
  static const std::string text = [] {
    const auto skeleton = generated_skeleton();
    std::vector<Pose> frames(kFrames, rest_pose(*skeleton));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      for (std::size_t j = 0; j < kJoints; ++j) {
        const double phase = 0.01 * static_cast<double>(i) + static_cast<double>(j);
        frames[i].rotations[j] = math::exp_map({std::sin(phase), 0.5 * std::cos(phase), 0.3 * std::sin(2.0 * phase)});
      }
      frames[i].translations[0] = {0.0, 0.95, 0.01 * static_cast<double>(i)};
    }
    return format_bvh(Motion(skeleton, 120.0, std::move(frames)), default_layout(*skeleton));
  }();
  return text;
}

void read_text(benchmark::State& state, const std::string& text) {
  for (auto _ : state) benchmark::DoNotOptimize(parse_bvh(text, "bench.bvh"));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(text.size()));
}

void BM_ReadGeneratedBvh(benchmark::State& state) {
  read_text(state, generated_text());
}
BENCHMARK(BM_ReadGeneratedBvh)->Unit(benchmark::kMillisecond);

std::string real_clip() {
  const char* folder = std::getenv("STRUT_DATA");
  if (folder == nullptr) return {};
  const std::string path = std::string(folder) + "/bandai-namco/dataset-2_walk_elderly_004.bvh";
  return std::filesystem::exists(path) ? read_file(path) : std::string();
}

void BM_ReadRealBvh(benchmark::State& state) {
  const std::string text = real_clip();
  if (text.empty()) return state.SkipWithError("set STRUT_DATA to the folder that has bandai-namco/ in it");
  read_text(state, text);
}
BENCHMARK(BM_ReadRealBvh)->Unit(benchmark::kMillisecond);

void BM_WriteGeneratedBvh(benchmark::State& state) {
  const BvhClip clip = parse_bvh(generated_text(), "bench.bvh");
  std::size_t bytes = 0;
  for (auto _ : state) bytes += format_bvh(clip.motion, clip.layout).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}
BENCHMARK(BM_WriteGeneratedBvh)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strut
