// SPDX-License-Identifier: MIT
// Choosing by leaving clips out: folds of groups, who learns and who tests in a round, and the rules that pick an
// order.
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

/// What a clip does while some clips are left out.
enum class Role { kLearn, kTest, kUnused };

/// Rounds of leaving clips out: in every round the test clips are predicted from the clips to learn from, to which they
/// are not related.
struct LeaveOut {
  std::vector<std::vector<Role>> rounds;  ///< (rounds x clips)
};

/// Clips of one group are left out together, a fold of groups a round; every clip is tested once. A single group makes
/// one round without clips to learn from, no clip none. Arguments and exceptions as of assign_folds. Cost clips x
/// folds.
LeaveOut leave_out_groups(const std::vector<int>& groups, const std::vector<int>& weights, int num_folds);

/// Clips made of an input and an output that belong to groups of their own, such as the recordings both were cut from.
/// A round tests the clips that have both in a fold of inputs and its fold of outputs, and learns from those that have
/// neither; the others are unused. Otherwise an output that is paired with several inputs would be known while it is
/// judged. Folds of inputs and of outputs that share most weight are tested together; a clip is tested once or never,
/// and a round may have no clip to learn from. Arguments and exceptions as of assign_folds. Cost clips x folds.
LeaveOut leave_out_pairs(const std::vector<int>& input_groups, const std::vector<int>& output_groups,
                         const std::vector<int>& weights, int num_folds);

}  // namespace strut::sysid
