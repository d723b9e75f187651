// SPDX-License-Identifier: MIT
#include "unfamiliar_cases.h"

#include "clip_variations.h"

#include <array>
#include <cstdio>
#include <numbers>
#include <utility>

#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/learn/clip_pair.h>
#include <strut/learn/learn_style.h>

namespace strut::quality {
namespace {

using generate::WalkContent;
using generate::WalkStyle;

constexpr double kRate = 30.0;
constexpr double kRaised = 140.0 * std::numbers::pi / 180.0;
constexpr double kDuck = 0.25;
constexpr double kStandstill = 2.0;
// Examples: joints of the two skeletons, none of which the library knows by name.
constexpr const char* kGeneratedArm = "RightArm";
constexpr const char* kRealArm = "UpperArm_R";
constexpr const char* kStyle = "elderly";

std::shared_ptr<const StyleModel> learnt(const std::vector<Motion>& inputs, const std::vector<Motion>& outputs) {
  return learn_style(inputs, outputs, learn::find_pairs(inputs, outputs).pairs).model;
}

Motion walk(const WalkContent& content, const WalkStyle& style) {
  return generate::generate_walk(content, style, kRate).motion;
}

std::shared_ptr<const StyleModel> generated_limp() {
  std::vector<Motion> inputs, outputs;
  std::uint64_t seed = 1;
  for (const auto& [speed, turning] : {std::pair(1.0, 0.0), std::pair(1.3, 0.0), std::pair(1.5, 0.0),
                                       std::pair(1.2, 0.4), std::pair(1.2, -0.4), std::pair(1.4, 0.2)}) {
    const WalkContent content{.duration = 8.0, .speed = speed, .turn_rate = turning};
    inputs.push_back(walk(content, {.seed = seed++}));
    outputs.push_back(
        walk(content, {.cadence_scale = 0.85, .crouch = 0.05, .torso_lean = 0.2, .limp = 0.8, .seed = seed++}));
  }
  return learnt(inputs, outputs);
}

motion::FrameRange all(const Motion& clip) {
  return {0, clip.num_frames()};
}

/// The frames in which the walker stands.
motion::FrameRange standing(const generate::Walk& walk) {
  motion::FrameRange range{0, 0};
  for (int t = 1; t < walk.motion.num_frames(); ++t) {
    const auto i = static_cast<std::size_t>(t);
    if (walk.gait_phase[i] > walk.gait_phase[i - 1]) continue;
    if (range.end == 0) range.begin = t;
    range.end = t + 1;
  }
  return range;
}

Motion read(const std::string& folder, const std::string& content, const std::string& style, int take) {
  char name[128];
  std::snprintf(name, sizeof name, "/dataset-2_%s_%s_%03d.bvh", content.c_str(), style.c_str(), take);
  return read_bvh(folder + name).motion;
}

std::vector<Motion> read_takes(const std::string& folder, const std::string& content, const std::string& style,
                               int first, int last) {
  std::vector<Motion> takes;
  for (int take = first; take <= last; ++take) takes.push_back(read(folder, content, style, take));
  return takes;
}

}  // namespace

std::vector<UnfamiliarCase> generated_cases() {
  const auto model = generated_limp();
  const WalkContent content{.duration = 9.0, .speed = 1.25};
  const WalkStyle style{.seed = 77};
  const Motion plain = walk(content, style);
  std::vector<UnfamiliarCase> cases;
  const auto add = [&](const char* name, const VariedClip& varied) {
    cases.push_back({name, varied.motion, varied.frames, plain, model});
  };
  add("stepping over: legs lifted high", replaced(plain, walk(content, {.foot_lift = 0.25, .seed = 77})));
  add("ducking: a crouch", replaced(plain, walk(content, {.crouch = 0.3, .seed = 77})));
  add("an arm raised by 140 degrees", raised(plain, plain.skeleton().find(kGeneratedArm), kRaised));
  const generate::Walk halting = generate::generate_walk(
      {.duration = 9.0, .speed = generate::Schedule({{3.0, 1.25}, {3.8, 0.0}, {6.0, 0.0}, {6.8, 1.25}})}, style, kRate);
  cases.push_back({"standing still for 2 s", halting.motion, standing(halting), std::nullopt, model});
  for (const auto& [name, varied] :
       {std::pair("sideways", walk({.duration = 9.0, .speed = 0.7, .travel_direction = 0.5 * std::numbers::pi}, style)),
        std::pair("0.8 times as tall", walk(content, {.body_height = 1.4, .seed = 77})),
        std::pair("1.1 times as tall", walk(content, {.body_height = 1.93, .seed = 77})),
        std::pair("another style: marching", walk(content, {.arm_swing = 0.7, .foot_lift = 0.2, .seed = 77}))}) {
    cases.push_back({name, varied, all(varied), std::nullopt, model});
  }
  return cases;
}

std::vector<FamiliarContent> familiar_contents(const std::string& folder) {
  std::vector<FamiliarContent> contents;
  for (const char* name : {"walk", "walk-turn-left", "walk-turn-right", "run", "wave-left-hand", "wave-both-hands",
                           "raise-up-right-hand"}) {
    contents.push_back({name, read_takes(folder, name, "normal", 9, 12),
                        learnt(read_takes(folder, name, "normal", 1, 8), read_takes(folder, name, kStyle, 1, 8))});
  }
  return contents;
}

std::vector<UnfamiliarCase> real_cases(const std::string& folder, const FamiliarContent& walk) {
  const Motion& plain = walk.takes.front();
  std::vector<UnfamiliarCase> cases;
  const auto add = [&](const char* name, const VariedClip& varied) {
    const bool is_same_length = varied.motion.num_frames() == plain.num_frames();
    cases.push_back(
        {name, varied.motion, varied.frames, is_same_length ? std::optional(plain) : std::nullopt, walk.model});
  };
  add("a duck by a quarter of the leg", ducked(plain, kDuck));
  add("an arm raised by 140 degrees", raised(plain, plain.skeleton().find(kRealArm), kRaised));
  add("an arm's swing three times as large", exaggerated(plain, plain.skeleton().find(kRealArm), 3.0));
  add("standing still for 2 s", halted(plain, kStandstill));
  add("0.8 times as tall", resized(plain, 0.8));
  add("1.25 times as tall", resized(plain, 1.25));
  for (const auto& [content, style] : std::vector<std::pair<const char*, const char*>>{
           {"run", "normal"}, {"wave-left-hand", "normal"}, {"walk", "active"}, {"walk", "feminine"}}) {
    const Motion other = read(folder, content, style, 9);
    cases.push_back(
        {std::string("another clip: ") + content + ", " + style, other, all(other), std::nullopt, walk.model});
  }
  return cases;
}

}  // namespace strut::quality
