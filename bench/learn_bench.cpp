// SPDX-License-Identifier: MIT
// What learning costs at the size of the paper's data: two minutes of a generated walk in each style at 120 frames/s
// (eight recordings of 15 s, 14,400 frames), every gait cycle paired with six of the other style as by default. Once
// with the walker's whole body (21 joints, 66 degrees of freedom), once with one of 36 as the paper's had 35: the
// pelvis, legs of three joints and arms of two.
#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include <strut/generate/walker.h>
#include <strut/learn/learn_style.h>

namespace {

using strut::LearnMethod;
using strut::Motion;
using strut::Pose;
using strut::Skeleton;

constexpr double kRate = 120.0, kDuration = 15.1;
constexpr int kRecordings = 8, kFrames = 1800;  // of input: 120 s in all

constexpr std::array<std::string_view, 11> kPaperSizedBody = {"Hips",         "LeftArm",   "LeftForeArm", "RightArm",
                                                              "RightForeArm", "LeftUpLeg", "LeftLeg",     "LeftFoot",
                                                              "RightUpLeg",   "RightLeg",  "RightFoot"};

/// Joints taken out of a skeleton: those below them hang from the nearest joint kept and keep their orientation in the
/// world.
class Reduction {
 public:
  explicit Reduction(const Skeleton& whole) : place_(static_cast<std::size_t>(whole.num_joints()), -1) {
    std::vector<strut::Joint> joints;
    for (int j = 0; j < whole.num_joints(); ++j) {
      strut::Joint joint = whole.joint(j);
      if (std::find(kPaperSizedBody.begin(), kPaperSizedBody.end(), joint.name) == kPaperSizedBody.end()) continue;
      for (; joint.parent >= 0 && place(joint.parent) < 0; joint.parent = whole.joint(joint.parent).parent) {
        joint.offset += whole.joint(joint.parent).offset;
      }
      if (joint.parent >= 0) joint.parent = place(joint.parent);
      place_[static_cast<std::size_t>(j)] = static_cast<int>(joints.size());
      kept_.push_back(j);
      joints.push_back(std::move(joint));
    }
    skeleton_ = std::make_shared<const Skeleton>(std::move(joints));
  }

  [[nodiscard]] Motion apply(const Motion& motion) const {
    std::vector<Pose> poses;
    for (const Pose& pose : motion.frames()) poses.push_back(apply(motion.skeleton(), pose));
    return {skeleton_, motion.frame_rate(), std::move(poses)};
  }

 private:
  [[nodiscard]] int place(int joint) const { return place_[static_cast<std::size_t>(joint)]; }

  [[nodiscard]] Pose apply(const Skeleton& whole, const Pose& pose) const {
    Pose reduced = strut::rest_pose(*skeleton_);
    reduced.translations.front() = pose.translations.front();
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      Eigen::Quaterniond& rotation = reduced.rotations[k] = pose.rotations[static_cast<std::size_t>(kept_[k])];
      for (int above = whole.joint(kept_[k]).parent; above >= 0 && place(above) < 0;
           above = whole.joint(above).parent) {
        rotation = pose.rotations[static_cast<std::size_t>(above)] * rotation;
      }
    }
    return reduced;
  }

  std::vector<int> place_;  // of the whole skeleton's joints, -1 where taken out
  std::vector<int> kept_;
  std::shared_ptr<const Skeleton> skeleton_;
};

Motion walk(double speed, double limp, std::uint64_t seed) {
  const strut::generate::WalkContent content{.duration = kDuration, .speed = speed, .turn_rate = 0.1};
  return strut::generate::generate_walk(content, {.limp = limp, .seed = seed}, kRate).motion;
}

struct Examples {
  std::vector<Motion> inputs, outputs;
  std::vector<strut::learn::ClipPair> pairs;
};

Examples whole_body() {
  Examples all;
  for (std::uint64_t seed = 1; seed <= kRecordings; ++seed) {
    const double speed = 0.9 + 0.1 * static_cast<double>(seed);
    all.inputs.push_back(walk(speed, 0.0, seed).slice(0, kFrames));
    all.outputs.push_back(walk(speed, 0.8, seed + 100));
  }
  all.pairs = strut::learn::find_pairs(all.inputs, all.outputs).pairs;
  return all;
}

Examples paper_sized_body() {
  Examples all = whole_body();
  const Reduction reduction(all.inputs.front().skeleton());
  for (Motion& motion : all.inputs) motion = reduction.apply(motion);
  for (Motion& motion : all.outputs) motion = reduction.apply(motion);
  all.pairs = strut::learn::find_pairs(all.inputs, all.outputs).pairs;
  return all;
}

void LearnTwoMinutes(benchmark::State& state, Examples (*make)(), LearnMethod method) {
  const Examples all = make();
  int frames = 0;
  for (const Motion& motion : all.inputs) frames += motion.num_frames();
  for (auto _ : state) {
    const strut::LearntStyle learnt = strut::learn_style(all.inputs, all.outputs, all.pairs, {.method = method});
    state.counters["dofs"] = learnt.model->num_dofs();
    state.counters["centres"] = learnt.report.num_centres;
  }
  state.counters["frames"] = frames;
  state.counters["pairs"] = static_cast<double>(all.pairs.size());
}

BENCHMARK_CAPTURE(LearnTwoMinutes, radial_36_dofs, paper_sized_body, LearnMethod::kRadial)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(LearnTwoMinutes, radial_66_dofs, whole_body, LearnMethod::kRadial)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
