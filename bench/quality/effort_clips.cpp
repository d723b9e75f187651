// SPDX-License-Identifier: MIT
#include "effort_clips.h"

#include "effort_raters.h"

#include <cstdio>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/effort/fragment_cuts.h>
#include <strut/effort/fragment_features.h>
#include <strut/generate/gestures.h>
#include <strut/generate/walker.h>
#include <strut/io/bvh.h>
#include <strut/motion/gait_cycles.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::study {
namespace {

/// The same rotations on another body of the same shape; the travel in proportion to its height.
Motion on_body(const Motion& motion, const std::shared_ptr<const Skeleton>& body) {
  const double scale = body->joint(0).offset.y() / motion.skeleton().joint(0).offset.y();
  std::vector<Pose> frames = motion.frames();
  for (Pose& pose : frames) {
    const Eigen::Vector3d root = scale * pose.translations[0];
    pose.translations = rest_pose(*body).translations;
    pose.translations[0] = root;
  }
  return {body, motion.frame_rate(), std::move(frames)};
}

/// What the engine and the raters see.
void look_at(FragmentSet& set) {
  std::vector<Motion> motions;
  for (const StudyFragment& fragment : set.fragments) motions.push_back(fragment.motion);
  set.upright = motion::upright_reference(motions);
  set.features.resize(motions.size());
  set.cues.resize(motions.size());
  tbb::parallel_for(std::size_t{0}, motions.size(), [&](std::size_t i) {
    set.features[i] = effort::joint_features(motion::resample(motions[i], effort::kFeatureRate), set.upright);
    set.cues[i] = movement_cues(motions[i]);
  });
}

/// Two gait cycles from the middle of a walk, from a landing of the left foot on.
std::optional<motion::FrameRange> two_cycles(const Motion& clip) {
  const auto legs = motion::find_legs(clip);
  if (!legs) return std::nullopt;
  const auto cycles = motion::gait_cycles(clip, *legs, postprocess::detect_footplants(clip, *legs));
  std::vector<motion::FrameRange> pieces;
  for (const motion::GaitCycle& first : cycles) {
    for (const motion::GaitCycle& second : cycles) {
      const bool follows = first.foot == 0 && second.foot == 0 && second.frames.begin == first.frames.end;
      if (follows) pieces.push_back({first.frames.begin, second.frames.end});
    }
  }
  if (pieces.empty()) return std::nullopt;
  return pieces[pieces.size() / 2];
}

/// Of the units of movement that are suggested, the middle one.
std::optional<motion::FrameRange> middle_unit(const Motion& clip) {
  const auto cuts = effort::suggest_cuts(clip);
  if (cuts.empty()) return std::nullopt;
  return cuts[cuts.size() / 2];
}

std::optional<motion::FrameRange> fragment_of(const Motion& clip, const std::string& content) {
  if (content == "raise-up-right-hand") return motion::FrameRange{0, clip.num_frames()};
  return content.starts_with("wave") ? middle_unit(clip) : two_cycles(clip);
}

}  // namespace

std::vector<int> FragmentSet::group(int index) const {
  std::vector<int> members;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (fragments[i].group == index) members.push_back(static_cast<int>(i));
  }
  return members;
}

FragmentSet gesture_set(std::uint64_t seed) {
  FragmentSet set;
  const auto body = generate::walker_skeleton();
  for (int action = 0; action < generate::kNumGestureActions; ++action) {
    set.contents.push_back(generate::gesture_content(static_cast<generate::GestureAction>(action)).name);
  }
  for (const generate::StandardGesture& each : generate::standard_gestures(seed)) {
    set.fragments.push_back({on_body(each.gesture.motion, body), static_cast<int>(each.action), each.performer});
    set.num_performers = std::max(set.num_performers, each.performer + 1);
  }
  look_at(set);
  return set;
}

FragmentSet real_set(const std::string& folder) {
  FragmentSet set;
  set.contents = {"raise-up-right-hand", "wave-both-hands", "wave-left-hand", "walk", "run"};
  set.num_performers = 2;
  for (int group = 0; group < static_cast<int>(set.contents.size()); ++group) {
    const std::string& content = set.contents[static_cast<std::size_t>(group)];
    for (const char* style : {"normal", "active", "elderly", "feminine"}) {
      for (int take = 1; take <= 12; ++take) {
        char name[256];
        std::snprintf(name, sizeof name, "%s/dataset-2_%s_%s_%03d.bvh", folder.c_str(), content.c_str(), style, take);
        const Motion clip = read_bvh(name).motion;
        const auto frames = fragment_of(clip, content);
        if (frames) set.fragments.push_back({clip.slice(frames->begin, frames->end), group, take <= 8 ? 0 : 1});
      }
    }
  }
  look_at(set);
  return set;
}

}  // namespace strut::study
