// SPDX-License-Identifier: MIT
// Gait cycles put on one phase: from cycles as they were cut to a smooth periodic warp of each, so that the same phase
// is the same moment of the gait in all.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::blend {

/// A cycle cut from a clip.
struct CutCycle {
  int style = 0;
  int clip = 0;         ///< index of the clip
  double begin = 0.0;   ///< [frames of the clip]
  double length = 0.0;  ///< [frames of the clip]
  double speed = 0.0;   ///< [m/s]
};

/// Where in its cycle a moment of the gait is: position = phase + a Fourier series of it.
class CycleWarp {
 public:
  CycleWarp();
  /// [cycles from the cut cycle's begin]
  [[nodiscard]] double position(double phase) const;
  /// Derivative of the position, > 0.
  [[nodiscard]] double pace(double phase) const;
  /// The phase of a position. Cost: some tens of evaluations.
  [[nodiscard]] double phase(double position) const;

  [[nodiscard]] const Eigen::VectorXd& series() const noexcept { return series_; }
  /// A series that would stop time is drawn towards none until it runs forward everywhere.
  void set_series(const Eigen::VectorXd& series);

 private:
  Eigen::VectorXd series_;
};

/// The positions [frames of the clip] of the phases (k + 1/2) / count in a cycle.
Eigen::VectorXd frames_of(const CutCycle& cycle, const CycleWarp& warp, int count);

/// Warps of all `cycles` to a common phase. `rows`: per clip, frames x dofs of representation.h.
std::vector<CycleWarp> align_cycles(const std::vector<CutCycle>& cycles, const std::vector<FrameMatrix>& rows,
                                    int num_styles, int rounds);

}  // namespace strut::blend
