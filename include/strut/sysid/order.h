// SPDX-License-Identifier: MIT
// Choosing the number of states by leaving clips out: folds of groups, and the rule that picks the order.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace strut::sysid {

/// The fold (0 .. folds-1) of each clip: clips of one group share a fold, folds get nearly equal weights (largest
/// groups first, each to the lightest fold), and the result depends on nothing else. No more folds are used than there
/// are groups. `groups` and `weights` (e.g. frames) have an element per clip; throws InvalidArgument if they differ in
/// length or `num_folds` < 1.
std::vector<int> assign_folds(const std::vector<int>& groups, const std::vector<int>& weights, int num_folds);

/// The smallest order whose fit is within `tolerance` of the best; `fits` holds a fit [%] per order from 0.
/// Throws InvalidArgument if `fits` is empty.
int smallest_good_order(const std::vector<double>& fits, double tolerance);

/// The order, from 1 to `max_order`, after which the singular values fall most: the largest ratio of one to the next.
/// Values below 1e-12 of the first count as that, so that rounding has no gaps. `singular_values` fall; 0 if there are
/// none or they are zero. Throws InvalidArgument if `max_order` is negative.
int largest_gap(const Eigen::VectorXd& singular_values, int max_order);

}  // namespace strut::sysid
