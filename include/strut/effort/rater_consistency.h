// SPDX-License-Identifier: MIT
// How well a rater repeats: blind repeats against what the rater said of the same fragment or blend at first.
#pragma once

#include <string>
#include <vector>

#include <strut/effort/effort.h>
#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// How far a rater's repeats lie from the first labels, per factor where both rate it.
struct RaterConsistency {
  int num_labels = 0;   ///< repeats included
  int num_repeats = 0;  ///< whose first label there is
  bool is_synthetic = false;
  Eigen::Vector4i num_compared = Eigen::Vector4i::Zero();
  Rating mean_difference = Rating::Constant(kNotRated);  ///< mean absolute; kNotRated where none was compared
  Rating rms_difference = Rating::Constant(kNotRated);   ///< root mean square; as above
};

/// Of the labels that `rater` gave. Cost O(labels log labels).
RaterConsistency rater_consistency(const std::vector<LabelRecord>& labels, const std::string& rater);

}  // namespace strut::effort
