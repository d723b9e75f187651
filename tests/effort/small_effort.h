// SPDX-License-Identifier: MIT
// A small effort model: one generated performer reaches and lifts in eight ways each, labelled by what the gestures
// were made from; made once per program.
#pragma once

#include <memory>

#include <strut/effort/effort_model.h>
#include <strut/effort/learn_effort.h>
#include <strut/generate/gestures.h>
#include <strut/motion/motion.h>

namespace strut::test {

/// The groups of the model.
inline constexpr int kReaches = 0, kLifts = 1;

/// A gesture of a group with the Effort `effort`, that the model has not seen, at `frame_rate`.
Motion gesture(int group, const effort::EffortVector& effort, double frame_rate = 30.0,
               const generate::Performer& who = {});

/// What the model is learnt from.
const effort::EffortExamples& small_examples();

const std::shared_ptr<const effort::EffortModel>& small_effort_model();

}  // namespace strut::test
