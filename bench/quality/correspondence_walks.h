// SPDX-License-Identifier: MIT
// Walks of one content in two styles, made by generate/walker.h, which knows the true correspondence: the tables of
// docs/correspondence.md whose judge no method has seen.
#pragma once

#include "correspondence_methods.h"

#include <string>
#include <vector>

#include <strut/generate/walker.h>

namespace strut::study {

/// A walk and the same walk in a style.
struct WalkPair {
  std::string style;
  Motion input, output;
  std::vector<double> truth;  ///< the output frame of every input frame
};

/// Six styles of four contents, `seeds` times, at `frame_rate`; `noise` [rad] turns every joint in every frame anew.
std::vector<WalkPair> walk_pairs(int seeds, double frame_rate, double noise);

/// Figures of one method over all pairs, by style in the order of `styles`, and over all of them last.
std::vector<Figures> judge(const Method& method, const std::vector<WalkPair>& pairs);

/// The same where every degree of freedom that counts is aligned alone (with its own movement, where the method looks
/// at that): the paper's Figure 2. Figures over all of them.
Figures judge_single_dofs(const Method& method, const std::vector<WalkPair>& pairs);

/// A content walked plainly and in every style, the plain walk first.
std::vector<std::vector<generate::Walk>> walk_groups(int seeds, double frame_rate);

/// The names of the styles.
std::vector<std::string> walk_styles();

/// Of the true warps.
Figures true_figures(const std::vector<WalkPair>& pairs);

}  // namespace strut::study
