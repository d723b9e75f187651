// SPDX-License-Identifier: MIT
// The parts of blend_study: what it is made of, and what each prints.
#pragma once

#include "walker_styles.h"

#include <string>
#include <vector>

#include <strut/blend/gait_examples.h>
#include <strut/blend/gait_model.h>
#include <strut/generate/walker.h>

namespace strut::study {

/// Speeds asked of the walker before a style scales them [m/s].
const std::vector<double>& walker_speeds();

/// A straight walk of a style: `variation` 0 is exact.
blend::StyledClip walk_of(const std::string& name, generate::WalkStyle style, double speed, double variation,
                          std::uint64_t seed, double frame_rate);

/// How far a cycle is from another on the same phase.
struct CycleError {
  double angle = 0.0;     ///< root mean square over cycle and joints [deg]
  double position = 0.0;  ///< of the joints from the point on the ground below the pelvis, heading taken out [cm]
  double duration = 0.0;  ///< of the cycle [%]
};
CycleError cycle_error(const representation::Representation& representation, const blend::GaitLoop& a,
                       const blend::GaitLoop& b);

/// The pose of a cycle at `phase`, standing at the origin, facing +Z.
Pose pose_at(const representation::Representation& representation, const blend::GaitLoop& loop, double phase);

void judge_generated();
void judge_recorded(const std::string& folder);
void judge_synthesis();
void draw_cycles(const std::string& path);

}  // namespace strut::study
