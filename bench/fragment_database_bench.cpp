// SPDX-License-Identifier: MIT
// A fragment database of a million frames of 22 joints and 10,000 fragments: how long it takes to open, to read one
// fragment of 120 frames, and to list all fragments. The file is made once, in a temporary folder.
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>

#include <benchmark/benchmark.h>

#include <strut/effort/fragment_database.h>
#include <strut/math/rotation.h>

namespace strut::effort {
namespace {

constexpr int kClips = 100, kFramesPerClip = 10'000, kFragmentsPerClip = 100, kJoints = 22;

Motion one_clip() {
  std::vector<Joint> joints;
  for (int j = 0; j < kJoints; ++j) joints.push_back({"joint" + std::to_string(j), j - 1, {0.0, 0.1, 0.0}});
  const auto skeleton = std::make_shared<const Skeleton>(std::move(joints));
  std::vector<Pose> frames(kFramesPerClip, rest_pose(*skeleton));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t j = 0; j < kJoints; ++j) {
      frames[i].rotations[j] = math::exp_map({0.01 * static_cast<double>(i % 100), 0.1 * static_cast<double>(j), 0.2});
    }
    frames[i].translations[0] = {0.0, 1.0, 0.01 * static_cast<double>(i)};
  }
  return {skeleton, 30.0, std::move(frames)};
}

/// Removes its folder at the end of the program.
struct LongDatabase {
  LongDatabase()
      : folder(std::filesystem::temp_directory_path() / ("strut_bench_" + std::to_string(::getpid()))),
        path(folder / "moves.db") {
    std::filesystem::create_directory(folder);
    const Motion clip = one_clip();
    FragmentDatabase database = FragmentDatabase::create(path, clip.shared_skeleton(), clip.frame_rate());
    std::vector<motion::FrameRange> cuts;
    for (int k = 0; k < kFragmentsPerClip; ++k) cuts.push_back({100 * k, 100 * k + 100});
    for (int k = 0; k < kClips; ++k) database.add_clip({std::to_string(k), "", ""}, clip, cuts);
  }
  LongDatabase(const LongDatabase&) = delete;
  LongDatabase& operator=(const LongDatabase&) = delete;
  ~LongDatabase() { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
  std::string path;
};

const std::string& path_of_long_database() {
  static const LongDatabase database;
  return database.path;
}

void BM_OpenAMillionFrames(benchmark::State& state) {
  const std::string& path = path_of_long_database();
  for (auto _ : state) benchmark::DoNotOptimize(FragmentDatabase::open(path).frame_rate());
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
}
BENCHMARK(BM_OpenAMillionFrames)->Unit(benchmark::kMillisecond);

void BM_ReadOneFragment(benchmark::State& state) {
  const FragmentDatabase database = FragmentDatabase::open(path_of_long_database());
  for (auto _ : state) benchmark::DoNotOptimize(database.motion(50, {5000, 5120}));
}
BENCHMARK(BM_ReadOneFragment)->Unit(benchmark::kMillisecond);

void BM_ListTenThousandFragments(benchmark::State& state) {
  const FragmentDatabase database = FragmentDatabase::open(path_of_long_database());
  for (auto _ : state) benchmark::DoNotOptimize(database.fragments());
}
BENCHMARK(BM_ListTenThousandFragments)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strut::effort
