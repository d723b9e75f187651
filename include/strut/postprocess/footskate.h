// SPDX-License-Identifier: MIT
// Footskate cleanup (Kovar, Schreiner, Gleicher 2002): planted feet are held where they stand. From poses and which
// feet are planted to poses whose planted feet do not move: the body is shifted and lowered a little so that the legs
// reach, legs are solved in closed form, stretch slightly rather than snap the knee, and corrections are blended in and
// out over a fixed look-ahead, so that it runs on streams with constant latency. docs/footskate.md tells how, and how
// well.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <strut/core/diagnostics.h>
#include <strut/motion/annotation.h>
#include <strut/motion/legs.h>
#include <strut/motion/motion.h>

namespace strut::postprocess {

/// How feet are held.
struct FootskateOptions {
  double look_ahead = 0.3;  ///< latency, over which corrections are blended in and out [s], (0, 2], 3 frames or more
  double shortest_plant = 0.05;  ///< shorter footplants are ignored; one frame always [s], [0, 0.5]
  double shortest_gap = 0.13;    ///< shorter gaps in footplants are closed; one frame always [s], [0, 0.5]
  double max_stretch = 0.02;     ///< of a leg's bones, instead of a straight knee [share of their length], [0, 0.1]
  double reach = 0.99;           ///< the body is lowered until a held foot's leg is at most this long, or as long as it
                                 ///< was in the input [share of the straight leg], [0.5, 1]
  double body_follows = 0.1;     ///< time in which the body is shifted after the feet it stands on [s], [0, 10]
  double max_drag = 0.15;  ///< a foot that is dragged farther than this from the body's shift is let go, to be held
                           ///< anew [leg lengths], (0, 1]
};

/// Holds the planted feet of a stream of poses. One per character; copies are snapshots.
class FootskateCleaner {
 public:
  /// `skeleton`: of the poses. `legs`: its legs (motion::find_legs). `frame_rate` in frames/s.
  /// Throws InvalidArgument if the skeleton is null, a leg's joints do not hang below the pelvis of it, the rate is not
  /// positive and finite, or an option is out of range.
  FootskateCleaner(std::shared_ptr<const Skeleton> skeleton, const motion::Legs& legs, double frame_rate,
                   const FootskateOptions& options = {});

  /// The latency [frames], constant.
  [[nodiscard]] int look_ahead() const noexcept { return latency_; }

  /// Takes the next pose and which feet (0 left, 1 right) are planted in it; writes the cleaned pose of look_ahead()
  /// frames ago to `output`. Returns false, leaving `output` alone, while the first look_ahead() poses come in.
  /// `pose` has one finite translation and one unit rotation per joint (not checked). Of it, the hips, knees and ankles
  /// turn, knees and ankles may move along their bones (stretch), and the pelvis moves; all else stays as it is.
  /// Allocates nothing once `output` has its size. Cost: about a microsecond. A push after flush begins a new stream.
  bool push(const Pose& pose, std::array<bool, 2> planted, Pose& output);

  /// After the last pose: the next of the remaining ones; false when there are no more.
  bool flush(Pose& output);

  /// Forgets everything pushed.
  void reset();

  /// Frames decided so far (look_ahead() ahead of the output at most) in which a planted foot was let go
  /// (FootskateOptions::max_drag), left and right.
  [[nodiscard]] const std::array<int, 2>& frames_let_go() const noexcept { return let_go_; }

 private:
  /// What is done to a foot: how its toe moves [m], how it turns [rad].
  struct Correction {
    Eigen::Vector3d move = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  };
  /// Where a leg is in the world.
  struct LegFrame {
    Eigen::Vector3d hip, knee, ankle, toe;
    Eigen::Quaterniond above, foot;  // rotations of the hip's parent and of the ankle joint
  };
  struct Frame {
    Pose pose;
    Eigen::Quaterniond above_pelvis;
    std::array<LegFrame, 2> legs;
    std::array<bool, 2> given{};         // planted, as pushed
    std::array<bool, 2> planted{};       // cleared of flicker, then of what was let go
    std::array<Correction, 2> wanted{};  // where planted
  };
  /// A foot at the end of the window where footplants are decided.
  struct Hold {
    bool planted = false;
    int not_before = 0;  // no footplant begins before this frame
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    double rise = 0.0;  // of the ankle above the toe, as held
  };
  /// What was last done to a foot.
  struct Blend {
    Correction correction, velocity;                      // and its change per frame
    int since_planted = 0;                                // [frames]
    Eigen::Vector3d bend_axis = Eigen::Vector3d::Zero();  // of the knee, in the thigh's frame
  };

  void take();
  bool produce(Pose& output);
  void locate(Frame& frame) const;
  void settle_flags(int index);
  [[nodiscard]] bool begins_plant(int foot, int index) const;
  void decide(int index);
  void let_go(int foot, int index);
  void begin_plant(int foot, int index);
  [[nodiscard]] Correction wanted(int foot, int index) const;
  [[nodiscard]] double drop_to_reach(int foot, int index) const;
  [[nodiscard]] double toe_weight(int foot, int index, bool whole_foot) const;
  void follow(int index);
  [[nodiscard]] Eigen::Vector3d shift_at(int index) const;
  [[nodiscard]] Correction change_after(int foot, int index) const;
  void hold(int foot, int index);
  void blend(int foot, int index, const Eigen::Vector3d& shift);
  [[nodiscard]] int next_landing(int foot, int index) const;
  Eigen::Vector3d knee_axis(Blend& blend, const Eigen::Quaterniond& thigh_rotation, const Eigen::Vector3d& thigh,
                            const Eigen::Vector3d& shin) const;
  void pose_leg(int foot, const Frame& frame, const Eigen::Vector3d& shift, Pose& output);

  [[nodiscard]] Frame& frame(int index) { return frames_[static_cast<std::size_t>(index) % frames_.size()]; }
  [[nodiscard]] const Frame& frame(int index) const {
    return frames_[static_cast<std::size_t>(index) % frames_.size()];
  }
  /// The place of frame `index` in a ring; frames before the first are like the first.
  template <typename Ring>
  static auto& slot(Ring& ring, int index) {
    return ring[static_cast<std::size_t>(std::max(0, index)) % ring.size()];
  }

  motion::Legs legs_;
  FootskateOptions options_;
  double frame_rate_;
  int pelvis_;
  std::vector<int> to_pelvis_;              // joints from the root to the pelvis
  std::array<std::vector<int>, 2> to_hip_;  // joints below the pelvis down to the hip, without it
  int latency_;                             // [frames], of which
  int decision_, ramp_;                     // to see where a foot stands, and for how long; for blending
  int window_;                              // of decision_, what its place is taken from
  int shortest_plant_, shortest_gap_;       // [frames]
  int release_;                             // for a foot to come back to its path [frames]
  int least_reach_;                         // half width of the filter that keeps the body low enough [frames]
  std::vector<double> kernel_;              // of smoothing the body's shift
  double follow_gain_, axis_gain_;

  std::vector<Frame> frames_;            // ring: from the next output to the newest input
  std::vector<Eigen::Vector3d> shift_;   // ring: of the body, horizontally after its feet, vertically to reach
  std::vector<Eigen::Vector3d> lowest_;  // ring: the same, held low long enough
  std::array<Hold, 2> holds_;
  std::array<Blend, 2> blends_;
  std::array<int, 2> let_go_{};
  std::array<bool, 2> steady_flags_{};
  Eigen::Vector3d last_shift_ = Eigen::Vector3d::Zero();
  int newest_ = -1, next_output_ = 0;
  int end_ = -1;  // frames of the stream once it is flushed
};

/// A whole clip with its planted feet held: `plants` in its frames, foot 0 left, 1 right, e.g. of detect_footplants.
/// Warns of footplants that could not be held throughout. Throws InvalidArgument as FootskateCleaner, and if a plant
/// names another foot or lies outside the clip. Cost: about a microsecond a frame.
Motion clean_footskate(const Motion& motion, const motion::Legs& legs, const std::vector<motion::Footplant>& plants,
                       const FootskateOptions& options = {}, Diagnostics* diagnostics = nullptr);

}  // namespace strut::postprocess
