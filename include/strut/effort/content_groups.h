// SPDX-License-Identifier: MIT
// Which fragments show the same movement, whatever its style, and which pairs of them can be blended: from the features
// of fragments to groups of like content (Torresani, Hackney, Bregler 2006: "motion matching"). How far like fragments
// may differ is read off the fragments themselves.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <strut/math/frame_matrix.h>

namespace strut::effort {

/// What counts as like.
struct GroupOptions {
  double median_share = 0.5;         ///< of the median cost of pairs out of step: up to this, a pair is like, > 0
  double max_in_step = 0.9;          ///< share of its own cost out of step that a like pair costs at most, (0, 1]
  double max_share_at_limit = 0.15;  ///< of the path's length (FragmentMatch::share_at_limit), 0 ... 1
  double max_cost = std::numeric_limits<double>::quiet_NaN();  ///< the threshold [m], >= 0; NaN: from the fragments
  /// What every fragment shows, where a person has said so; "" where not. Empty, or one per fragment.
  std::vector<std::string> contents = {};
  /// Told how many of how many fragments are compared. Called from several threads, one at a time.
  std::function<void(int done, int total)> progress = {};
};

/// Why two fragments can be blended or cannot.
enum class PairVerdict {
  kAccepted,
  kUnlike,      ///< their cost is above the threshold, though their groups are one
  kOutOfStep,   ///< put out of step they fit as well: what they share is posture, not movement
  kSlopeLimit,  ///< one is so much faster, or so uneven, that their alignment runs along its limit
  kOtherGroup,  ///< they are like, their groups are not
};

/// "accepted", "unlike", "out of step", "slope limit", "other group".
const char* name_of(PairVerdict verdict) noexcept;

/// Two fragments that are of one group or like.
struct MatchedPair {
  int first = 0, second = 0;    ///< indices of the fragments, first < second
  double cost = 0.0;            ///< of the whole of one on the whole of the other (whole_matches) [m]; of two of one
                                ///< named content, of their movements
  double share_at_limit = 0.0;  ///< of their path
  PairVerdict verdict = PairVerdict::kAccepted;
};

/// How fragments fall into groups.
struct ContentGroups {
  std::vector<int> group;  ///< of every fragment, from 0 in the order of their first fragments; one that is
                           ///< like no other is a group of its own
  int num_groups = 0;
  double threshold = 0.0;          ///< the cost below which pairs count as like [m], but those of one named content
  std::vector<MatchedPair> pairs;  ///< by first, then second
};

/// Groups `fragments` (each frames x dims, in one space and at one rate: project).
///
/// Every pair is aligned, whole on whole, in step and three times out of step: with the second's time rotated by a
/// quarter, a half and three quarters of it. The threshold is `median_share` of the median of the costs out of step:
/// those are of the same bodies, postures and styles, and of unlike movement even where all fragments show the same. A
/// low quantile of them would be that of the one style which moves least. A pair is like if
/// it costs at most the threshold, and at most max_in_step of what it costs out of step. Groups are joined by average
/// linkage up to the threshold, so that no chain of likenesses joins unlike movements; a pair that is not in step, or
/// of durations that differ by more than a factor of two, counts there as twice the threshold, at least. Pairs are
/// accepted that are like, of one group, and at the slope limit for at most max_share_at_limit.
///
/// Fragments of one named content need no threshold to be told from others, so that styles join whose postures differ
/// as much as contents do. Of them the movements are compared, each fragment less its mean posture, and a pair is like
/// if it costs at most max_in_step of what it costs out of step; linkage goes by that share. A fragment of a named
/// content never joins one of another content or of none; those of none are grouped among themselves as above.
///
/// Without fragments there are no groups. Throws InvalidArgument if a fragment has no frame or more than
/// kMostQueryFrames, there are contents but not as many as fragments, the widths differ, a number is not finite, an
/// option is out of range, or there are more than 20000. Cost O(n^2) alignments and 4 n^2 bytes, on several threads;
/// the result does not depend on their number.
ContentGroups group_fragments(const std::vector<FrameMatrix>& fragments, const GroupOptions& options = {});

/// The threshold that group_fragments finds where no content is named [m], of at most 400 of the fragments, evenly
/// picked; 0 if no two can be aligned. What looks for fragments in recordings goes by it. Throws as group_fragments.
/// Cost: of 80,000 pairs at most.
double like_threshold(const std::vector<FrameMatrix>& fragments);

}  // namespace strut::effort
