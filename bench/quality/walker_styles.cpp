// SPDX-License-Identifier: MIT
#include "walker_styles.h"

namespace strut::study {

std::vector<std::pair<std::string, generate::WalkStyle>> walker_styles() {
  generate::WalkStyle crouch, limp, march, old, swagger, hurry;
  crouch.crouch = 0.25;
  crouch.cadence_scale = 0.8;
  crouch.torso_lean = 0.5;
  crouch.arm_swing = 0.1;
  crouch.elbow_bend = 1.0;
  limp.limp = 1.0;
  limp.cadence_scale = 0.85;
  limp.step_length_scale = 0.8;
  march.foot_lift = 0.25;
  march.arm_swing = 0.9;
  march.cadence_scale = 1.1;
  march.heel_strike = 0.0;
  old.step_length_scale = 0.55;
  old.cadence_scale = 0.75;
  old.torso_lean = 0.35;
  old.arm_swing = 0.12;
  old.elbow_bend = 0.7;
  old.push_off = 0.45;
  swagger.hip_sway = 2.2;
  swagger.hip_twist = 2.0;
  swagger.arm_spread = 0.35;
  swagger.arm_swing = 0.6;
  swagger.cadence_scale = 0.9;
  swagger.bounce = 1.6;
  hurry.cadence_scale = 1.5;
  hurry.torso_lean = 0.2;
  hurry.elbow_bend = 1.4;
  hurry.arm_swing = 0.7;
  return {{"crouch", crouch}, {"limp", limp}, {"march", march}, {"old", old}, {"swagger", swagger}, {"hurry", hurry}};
}

}  // namespace strut::study
