// SPDX-License-Identifier: MIT
#include "small_gaits.h"

#include <strut/generate/walker.h>

namespace strut::test {
namespace {

constexpr double kSpeeds[] = {0.6, 0.9, 1.2, 1.5};
constexpr int kStyles = 3;

}  // namespace

blend::StyledClip styled_walk(const std::string& style, double speed, double variation, double seconds) {
  generate::WalkContent content;
  content.duration = seconds;
  content.speed = speed;
  generate::WalkStyle how;
  how.variation = variation;
  how.seed = static_cast<std::uint64_t>(1000.0 * speed) + style.size();
  if (style.find("crouch") != std::string::npos) {
    how.crouch = 0.25;
    how.torso_lean = 0.5;
    how.arm_swing = 0.1;
    how.cadence_scale = 0.8;
  } else if (style.find("march") != std::string::npos) {
    how.foot_lift = 0.25;
    how.arm_swing = 0.9;
    how.cadence_scale = 1.1;
    how.heel_strike = 0.0;
  }
  return {style, generate::generate_walk(content, how, 60.0).motion, style};
}

const blend::GaitExamples& walks_and_truth() {
  static const blend::GaitExamples examples = [] {
    std::vector<blend::StyledClip> clips;
    for (const double variation : {1.0, 0.0}) {
      for (const char* style : {"plain", "crouch", "march"}) {
        for (const double speed : kSpeeds) {
          clips.push_back(styled_walk((variation == 0.0 ? "exact " : "") + std::string(style), speed, variation));
        }
      }
    }
    return blend::gait_examples(clips);
  }();
  return examples;
}

blend::GaitExamples small_examples() {
  blend::GaitExamples examples = walks_and_truth();
  examples.styles.resize(kStyles);
  std::erase_if(examples.cells, [](const blend::GaitCell& cell) { return cell.style >= kStyles; });
  return examples;
}

const blend::LearntGaits& small_gaits() {
  static const blend::LearntGaits learnt = blend::learn_gaits(small_examples());
  return learnt;
}

}  // namespace strut::test
