// SPDX-License-Identifier: MIT
// Endless locomotion from a gait model: the phase of the gait advances at the pace of the style mixture and speed asked
// for now, the body is posed at that phase and carried on, turning as asked. Style and speed may change at any time; as
// what is changed are numbers of one smooth cycle, there is no seam.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <strut/blend/gait_model.h>
#include <strut/core/diagnostics.h>
#include <strut/math/aligned.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>
#include <strut/postprocess/footskate.h>
#include <strut/representation/pose_encoder.h>

namespace strut::blend {

/// What is asked of the walker at a moment.
struct GaitControls {
  Eigen::VectorXd weights;  ///< of the model's styles, sum 1
  double speed = 1.2;       ///< [m/s], > 0
  double turn_rate = 0.0;   ///< of the direction faced, positive to the left [rad/s], |.| <= 2
};

/// Controls at a time. Between keys they change smoothly and never leave the range of two neighbours.
struct GaitKey {
  double time = 0.0;  ///< [s]
  GaitControls controls;
};

/// A pose and which feet stand in it.
struct GaitFrame {
  Pose pose;
  std::array<bool, 2> planted{};  ///< left, right
};

/// Frame by frame. Its feet are as the cycle moves them; a FootskateCleaner holds them (synthesize does).
class Walker {
 public:
  /// Starts at `phase` [cycles] (0: the left foot comes down), standing at the origin, facing +Z.
  /// Throws InvalidArgument if the model is null, the rate not positive, or the phase not finite.
  Walker(std::shared_ptr<const GaitModel> model, double frame_rate, double phase = 0.0);

  /// The next frame under `controls`. Throws as GaitModel::loop, and if the turn rate is out of range; then nothing has
  /// happened. Cost: some tens of microseconds.
  GaitFrame next(const GaitControls& controls);

  /// Gait phase of the latest frame, never wrapped [cycles].
  [[nodiscard]] double phase() const noexcept { return phase_; }

 private:
  std::shared_ptr<const GaitModel> model_;
  double frame_time_, phase_;
  bool started_ = false;
  Pose bones_;
  representation::RowLayout layout_;
  representation::PoseDecoder<double> decoder_;
  math::AlignedVector<double> slots_;
  GaitControls latest_;
  std::vector<GaitLoop> loop_;  // of latest_: one, or none before the first frame
};

/// How a clip is made.
struct SynthesisOptions {
  double frame_rate = 0.0;  ///< [frames/s]; 0: the examples'
  bool clean_feet = true;   ///< hold planted feet
  postprocess::FootskateOptions footskate{};
};

/// A clip, and when its feet are planted.
struct SynthesizedGait {
  Motion motion;
  std::vector<motion::Footplant> footplants;  ///< foot 0 left, 1 right, in frames of the motion
};

/// A clip of `seconds` under `keys` (times ascending, one or more; before the first and after the last key its controls
/// hold). Reports as warnings how far speeds or style weights leave the examples. Throws InvalidArgument if there is no
/// key, their times do not ascend, the duration is outside (0, 36000], the rate is outside 0 or 5 to 1000, or as
/// Walker::next; the message tells the time. Cost: some tens of microseconds a frame.
SynthesizedGait synthesize(const std::shared_ptr<const GaitModel>& model, const std::vector<GaitKey>& keys,
                           double seconds, const SynthesisOptions& options = {}, Diagnostics* diagnostics = nullptr);

/// One cycle that loops: its last frame is one frame before its first, a cycle on. The duration is rounded to whole
/// frames. Feet are held; as what holds them does not repeat itself exactly from cycle to cycle, two cycles of a walk
/// are blended into each other, so that the end meets the beginning in pose and velocity. Throws as synthesize; the
/// turn rate must be 0.
SynthesizedGait synthesize_cycle(const std::shared_ptr<const GaitModel>& model, const GaitControls& controls,
                                 const SynthesisOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut::blend
