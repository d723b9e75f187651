// SPDX-License-Identifier: MIT
// When feet come down and leave in a real clip, by two definitions, and pieces of two gait cycles between them: what
// judges an alignment of real clips in docs/correspondence.md.
#pragma once

#include <optional>
#include <vector>

#include <strut/motion/motion.h>

namespace strut::study {

/// How landings and lift-offs are told.
enum class EventKind {
  kThresholds,  ///< when the toe's speed passes the footplant detector's thresholds, between the frames
  kRounded,     ///< the same, to the first frame after it
  kDetected,    ///< postprocess::detect_footplants, to the frame
};

/// When one foot stood. Nothing where the clip's end cuts it off. [frames, with fraction]
struct Plant {
  std::optional<double> landing, leaving;
};

/// The footplants of both feet (0 left, 1 right), in order. Empty without legs.
std::vector<std::vector<Plant>> foot_events(const Motion& motion, EventKind kind);

/// A landing or lift-off inside a piece, named by its place in the order of the gait, which is the same in any piece.
struct Event {
  int name = 0;
  bool is_landing = true;
  double time = 0.0;  ///< [frames of the clip, with fraction]
};

/// Two gait cycles.
struct Piece {
  int clip = 0;
  int foot = 0;            ///< whose landings begin and end it
  int begin = 0, end = 0;  ///< frames of the clip
  double speed = 0.0;      ///< of the pelvis [m/s]
  double turning = 0.0;    ///< [rad]
  std::vector<Event> events;
};

/// The pieces of `motion`, clip number `clip`: from each landing to the next but one of the same foot.
std::vector<Piece> pieces_of(const Motion& motion, int clip, EventKind kind);

/// Which piece of another style belongs to which: the nearest of the same foot by turning and by speed relative to each
/// style's own, as learn::find_pairs matches cycles. Indices of input and output piece.
std::vector<std::pair<int, int>> match(const std::vector<Piece>& inputs, const std::vector<Piece>& outputs);

/// The least mean distance [frames] from the events of `output` that any warp of `input` with slopes inside the limit
/// can have: events that are out of reach are nobody's error.
double least_mean_error(const Piece& input, const Piece& output, double slope_limit, bool landings_alone);

}  // namespace strut::study
