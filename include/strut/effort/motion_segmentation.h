// SPDX-License-Identifier: MIT
// Which known movements a motion is made of: from a motion and labelled fragments to snippets that follow one another,
// each like the fragments of one group, and stretches in between that are like none (Torresani, Hackney, Bregler 2006:
// "we use dynamic-time warping to segment the input sequence into snippets").
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>
#include <strut/motion/annotation.h>

namespace strut::effort {

/// What group an unmatched stretch is of.
inline constexpr int kNoMatch = -1;

/// A fragment to be looked for.
struct KnownFragment {
  FrameMatrix features;  ///< as matching sees it, at kFeatureRate (frames x dims)
  int group = 0;         ///< of like content, from 0
};

/// A stretch of the motion and what it is like.
struct Snippet {
  motion::FrameRange frames;  ///< of the motion
  int group = kNoMatch;       ///< whose content it has
  int fragment = kNoMatch;    ///< the fragment that it is most like
  double cost = 0.0;          ///< mean distance along the path to that fragment [m]; of an unmatched stretch: 0

  friend bool operator==(const Snippet&, const Snippet&) = default;
};

/// How a motion is cut.
struct SegmentationOptions {
  double threshold = 0.0;        ///< what a frame that matches nothing costs: a snippet is worth it below this mean
                                 ///< distance [m], > 0; from the data: what accepts pairs of fragments
  double boundary_frames = 3.0;  ///< what a snippet costs once, in frames that match nothing, >= 0
};

/// A stretch that could be a snippet.
struct SnippetCandidate {
  motion::FrameRange frames;
  int fragment = 0;
  double cost = 0.0;  ///< mean distance [m]
};

/// The cheapest way to cut `num_frames` frames into candidates that do not overlap and unmatched frames: minimizes
///   sum over candidates of (cost * frames + boundary) + unmatched * (frames of no candidate)
/// by dynamic programming over the last frame. Ties go to fewer snippets, then to the candidate given first. Returns
/// indices of candidates, in order of time. `candidates` in any order, inside the frames.
/// Throws InvalidArgument if a candidate is not, is empty or costs less than nothing. Cost O(frames + candidates).
std::vector<int> cheapest_cut(const std::vector<SnippetCandidate>& candidates, int num_frames, double boundary,
                              double unmatched);

/// Cuts `recording` (frames x dims, at kFeatureRate) into snippets: cheapest_cut over, for every fragment and every
/// frame, the fragment's best match that ends there (fragment_search.h). The snippets cover all frames, in order;
/// unmatched stretches are snippets of group kNoMatch, and never follow one another. A recording shorter than half of
/// any fragment matches nothing. Throws InvalidArgument if there is no fragment, widths differ, the threshold is not
/// positive and finite, or an option is out of range. Cost O(frames x frames of all fragments x dims).
std::vector<Snippet> segment_motion(const std::vector<KnownFragment>& fragments,
                                    const Eigen::Ref<const FrameMatrix>& recording, const SegmentationOptions& options);

/// The share of frames that belong to a snippet of a group, 0 ... 1; 0 of nothing.
double coverage(const std::vector<Snippet>& snippets);

}  // namespace strut::effort
