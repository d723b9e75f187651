// SPDX-License-Identifier: MIT
// A few generated walks of three styles at four speeds, and what is learnt from them; made once per program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/blend/gait_examples.h>
#include <strut/blend/learn_gaits.h>

namespace strut::test {

/// A straight walk of `seconds` at 60 frames/s; `style` is plain, crouch or march. `variation` 0 is exact.
blend::StyledClip styled_walk(const std::string& style, double speed, double variation, double seconds = 8.0);

/// plain, crouch and march at 0.6, 0.9, 1.2 and 1.5 m/s, then the exact walks of the same, as styles "exact ...".
const blend::GaitExamples& walks_and_truth();

/// The examples of walks_and_truth without the exact walks.
blend::GaitExamples small_examples();

/// Learnt from small_examples.
const blend::LearntGaits& small_gaits();

}  // namespace strut::test
