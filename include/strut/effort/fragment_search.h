// SPDX-License-Identifier: MIT
// Finds where in long recordings a fragment's movement occurs, at whatever pace: subsequence dynamic time warping with
// slopes between 1/2 and 2 (Sakoe and Chiba 1978, symmetric form, P = 1). Results are exact, the same for any number of
// threads and any processor: float, every operation in a fixed order.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include <strut/math/aligned.h>
#include <strut/math/frame_matrix.h>
#include <strut/motion/annotation.h>

namespace strut::effort {

/// The longest query [frames].
inline constexpr int kMostQueryFrames = 4096;

/// Recordings, kept as the search reads them: in float, tiles of 16 frames, dimension by dimension. Made once for any
/// number of queries, from several threads at a time. Takes 4 bytes per number.
class SearchIndex {
 public:
  /// Of clips (each frames x dims) of one width, one after the other: frames are numbered through, and no match reaches
  /// from one clip into the next. Clips without frames are kept as such. Throws InvalidArgument if there is no frame or
  /// no column, the widths differ, or a number is not finite or too large for float. Cost: one copy, about 0.1 s for a
  /// million frames of 24.
  explicit SearchIndex(const std::vector<FrameMatrix>& clips);
  /// Of one recording.
  explicit SearchIndex(const FrameMatrix& recording);

  [[nodiscard]] int num_frames() const noexcept { return clip_begins_.back(); }
  [[nodiscard]] int num_clips() const noexcept { return static_cast<int>(clip_begins_.size()) - 1; }
  [[nodiscard]] int dimensions() const noexcept { return dimensions_; }
  /// A clip's frames, numbered through.
  [[nodiscard]] motion::FrameRange clip(int index) const;
  /// The clip that a frame belongs to. Cost O(log clips).
  [[nodiscard]] int clip_of(int frame) const;

  /// Inside, a column that nothing resembles stands after each clip's frames.
  [[nodiscard]] int num_columns() const noexcept { return num_frames() + num_clips(); }
  /// num_columns(), filled up to whole tiles, tile by tile.
  [[nodiscard]] const math::AlignedVector<float>& tiles() const noexcept { return tiles_; }

 private:
  int dimensions_ = 0;
  std::vector<int> clip_begins_;  // and the end of the last
  math::AlignedVector<float> tiles_;
};

/// What ends at every frame of the recordings.
struct SubsequenceCosts {
  Eigen::VectorXf cost;   ///< of the best match that ends with this frame, mean per step [m]; infinite where none can
  Eigen::VectorXi begin;  ///< that match's first frame; -1 where there is none
  Eigen::VectorXf share_at_limit;  ///< as FragmentMatch::share_at_limit; 0 where there is none
};

/// For every frame of the recordings the best match of the whole `query` (m x dims) that ends there:
///   g(i,j) = min{ g(i-1,j-1) + 2c(i,j), g(i-1,j-2) + 2c(i,j-1) + c(i,j), g(i-2,j-1) + 2c(i-1,j) + c(i,j) }
/// from g(0,j) = 2c(0,j) for every j, with c the Euclidean distance; of equals, the first of the three. The cost is
/// g(m-1,j) divided by the path's weight, m + the frames covered. Best is least g: of two matches that end at one
/// frame, that with the smaller sum, not mean. Throws InvalidArgument if the query is empty, longer than
/// kMostQueryFrames or as wide as another space, or a number is not finite. Cost O(m frames dims), on several threads
/// over blocks of frames.
SubsequenceCosts subsequence_costs(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings);

/// The same in one recording (frames x dims) that is searched once.
SubsequenceCosts subsequence_costs(const Eigen::Ref<const FrameMatrix>& query,
                                   const Eigen::Ref<const FrameMatrix>& recording);

/// One place where the query occurs.
struct FragmentMatch {
  motion::FrameRange frames;    ///< of the recordings, numbered through
  double cost = 0.0;            ///< mean distance along the path, each step counted by what it covers [m]
  double share_at_limit = 0.0;  ///< share of the path's length that runs along a slope limit, 1/2 or 2: steps that
                                ///< follow three of their own kind, for fewer only round to whole frames. 0 ... 1
};

/// What counts as a match.
struct MatchOptions {
  double max_cost = std::numeric_limits<double>::infinity();  ///< [m], >= 0
  double max_share_at_limit = 1.0;                            ///< 0 ... 1
};

/// All disjoint matches of `query`, in the order of frames. Of everything that subsequence_costs finds and the options
/// admit, the cheapest is a match (of equals, that which ends first); then, again and again, the cheapest of what
/// shares no frame with a match before, until nothing is left. With no limit on cost that fills the recordings. Throws
/// as subsequence_costs, and InvalidArgument if a limit is negative or not a number. Cost: that, and sorting the
/// candidates.
std::vector<FragmentMatch> find_matches(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings,
                                        const MatchOptions& options = {});

/// The same from costs that are there already.
std::vector<FragmentMatch> disjoint_matches(const SubsequenceCosts& costs, const MatchOptions& options = {});

/// The whole `query` against each whole clip of `recordings` from clip `first` to before clip `last`: first frame on
/// first frame and last on last, but for up to `slack` >= 0 frames at either end of the clip that may be left out. The
/// least mean cost of those; one match per clip, of infinite cost and no frames where the durations' ratio is above 2.
/// The path's recurrence and errors are those of subsequence_costs. Cost O(m frames dims) of the clips.
std::vector<FragmentMatch> whole_matches(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings,
                                         int first, int last, int slack = 0);

/// The same of one clip: a whole fragment against a whole fragment.
FragmentMatch whole_match(const Eigen::Ref<const FrameMatrix>& query, const Eigen::Ref<const FrameMatrix>& clip,
                          int slack = 0);

}  // namespace strut::effort
