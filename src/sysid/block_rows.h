// SPDX-License-Identifier: MIT
// Private to identification: how many block rows clips of given lengths can carry.
#pragma once

#include <vector>

#include <strut/sysid/experiment.h>

namespace strut::sysid::detail {

constexpr int kLeastBlockRows = 2;  // one to see the states, one to see them move

/// The most block rows, at most `wanted`, for which the clips give twice as many Hankel columns as the projections
/// have regressors; 0 if even the fewest do not.
int usable_block_rows(const std::vector<Experiment>& clips, int wanted);

}  // namespace strut::sysid::detail
