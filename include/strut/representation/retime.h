// SPDX-License-Identifier: MIT
// Puts translated signals on their own timeline (Hsu et al. 2005, 4.4): every input frame takes as long in the output
// as the differential time warp says; the output is then resampled at the frame rate.
#pragma once

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::representation {

/// Twenty times slower or faster is beyond any style; a model that asks for it is out of its depth, and gets no more.
inline constexpr double kLargestLogTimeWarp = 3.0;

/// `rows` (frames x dofs), frame i lasting exp(log_time_warp[i]) output frames -> rows at whole output frames, the
/// first and last input frame's centres at the ends. Throws InvalidArgument if sizes differ, there is no frame, or a
/// warp is not finite. Cost O((frames + output frames) x dofs).
FrameMatrix retime(const Eigen::Ref<const FrameMatrix>& rows, const Eigen::Ref<const Eigen::VectorXd>& log_time_warp);

/// When each input frame comes in what `retime` gives [output frames]: the first at 0, each later than the one before.
/// Throws InvalidArgument as `retime` does. Cost O(frames).
Eigen::VectorXd retimed_moments(const Eigen::Ref<const Eigen::VectorXd>& log_time_warp);

}  // namespace strut::representation
