// SPDX-License-Identifier: MIT
// How much of a style is applied: the difference between translated and input motion, scaled.
#pragma once

#include <Eigen/Core>

#include <strut/model/style_model.h>

namespace strut::translate {

/// `output` (num_dofs + 1) moved towards (strength < 1) or beyond (> 1) what `input` (num_dofs) is, in place: rotations
/// along the arc between them, the root and the logarithm of the time warp linearly. 0 gives the input itself, 1 leaves
/// `output` as it is.
void apply_strength(const StyleModel& model, const Eigen::Ref<const Eigen::RowVectorXd>& input, double strength,
                    Eigen::Ref<Eigen::RowVectorXd> output);

}  // namespace strut::translate
