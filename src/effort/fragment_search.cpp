// SPDX-License-Identifier: MIT
#include "effort/column_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include <strut/core/error.h>
#include <strut/effort/fragment_search.h>

namespace strut::effort {
namespace {

using detail::EndCells;
using detail::kTileColumns;
using detail::SearchQuery;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void check(const std::vector<FrameMatrix>& clips) {
  Eigen::Index frames = 0;
  for (const FrameMatrix& clip : clips) frames += clip.rows();
  if (frames == 0) throw InvalidArgument("recordings", "at least one frame", "none");
  const Eigen::Index columns = frames + static_cast<Eigen::Index>(clips.size()) + kTileColumns;
  if (columns > std::numeric_limits<int>::max()) {
    throw InvalidArgument("recordings", "fewer than 2^31 frames", std::to_string(frames));
  }
  for (const FrameMatrix& clip : clips) {
    if (clip.cols() == 0 || clip.cols() != clips.front().cols()) {
      throw InvalidArgument("recordings", "one number of columns, at least 1", std::to_string(clip.cols()));
    }
  }
}

void check(const MatchOptions& options) {
  if (!(options.max_cost >= 0.0)) {
    throw InvalidArgument("max_cost", "a number that is not negative", std::to_string(options.max_cost));
  }
  if (!(options.max_share_at_limit >= 0.0)) {
    throw InvalidArgument("max_share_at_limit", "0 to 1", std::to_string(options.max_share_at_limit));
  }
}

/// 0 where a match may begin, the first frames of each clip of [first, last), else infinite, by column.
std::vector<float> clip_starts(const SearchIndex& index, int first, int last, int slack) {
  std::vector<float> start(static_cast<std::size_t>(math::padded(index.num_columns(), kTileColumns)), kInfinity);
  for (int k = first; k < last; ++k) {
    const motion::FrameRange frames = index.clip(k);
    std::fill_n(start.begin() + frames.begin + k, std::min(slack + 1, frames.num_frames()), 0.0F);
  }
  return start;
}

/// The best match of a whole clip that leaves out at most `slack` frames at its end. `columns` begin at the clip.
FragmentMatch whole_match_of(int query_frames, const motion::FrameRange& clip, const float* cost,
                             const std::int32_t* trace, int slack) {
  FragmentMatch match{{clip.begin, clip.begin}, std::numeric_limits<double>::infinity(), 0.0};
  for (int j = std::max(0, clip.num_frames() - 1 - slack); j < clip.num_frames(); ++j) {
    const double mean = cost[j] / detail::path_weight(query_frames, trace[j]);
    if (!(mean < match.cost)) continue;
    const int end = clip.begin + j + 1;
    match = {{end - (trace[j] & detail::kSpan), end}, mean, detail::share_at_limit(query_frames, trace[j])};
  }
  return match;
}

}  // namespace

SearchIndex::SearchIndex(const std::vector<FrameMatrix>& clips) {
  check(clips);
  dimensions_ = static_cast<int>(clips.front().cols());
  clip_begins_.push_back(0);
  for (const FrameMatrix& clip : clips) clip_begins_.push_back(clip_begins_.back() + static_cast<int>(clip.rows()));
  const auto padded = static_cast<std::size_t>(math::padded(num_columns(), kTileColumns));
  tiles_.assign(padded * static_cast<std::size_t>(dimensions_), kInfinity);
  std::ptrdiff_t column = 0;
  for (const FrameMatrix& clip : clips) {
    for (Eigen::Index t = 0; t < clip.rows(); ++t, ++column) {
      float* to = tiles_.data() + column / kTileColumns * kTileColumns * dimensions_ + column % kTileColumns;
      for (int d = 0; d < dimensions_; ++d) {
        const auto number = static_cast<float>(clip(t, d));
        if (!std::isfinite(number)) throw InvalidArgument("recordings", "finite numbers", "one that is not");
        to[static_cast<std::ptrdiff_t>(d) * kTileColumns] = number;
      }
    }
    ++column;  // stays infinite
  }
}

SearchIndex::SearchIndex(const FrameMatrix& recording) : SearchIndex(std::vector<FrameMatrix>{recording}) {}

motion::FrameRange SearchIndex::clip(int index) const {
  return {clip_begins_.at(static_cast<std::size_t>(index)), clip_begins_.at(static_cast<std::size_t>(index) + 1)};
}

int SearchIndex::clip_of(int frame) const {
  if (frame < 0 || frame >= num_frames()) {
    throw InvalidArgument("frame", "0 to " + std::to_string(num_frames() - 1), std::to_string(frame));
  }
  return static_cast<int>(std::upper_bound(clip_begins_.begin(), clip_begins_.end(), frame) - clip_begins_.begin()) - 1;
}

SubsequenceCosts subsequence_costs(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings) {
  const SearchQuery rows(query, recordings.dimensions());
  const EndCells ends =
      detail::search_columns(detail::search_kernels(), rows, recordings, 0, recordings.num_columns(), nullptr);
  const int frames = recordings.num_frames();
  SubsequenceCosts costs{Eigen::VectorXf(frames), Eigen::VectorXi(frames), Eigen::VectorXf(frames)};
  for (int k = 0; k < recordings.num_clips(); ++k) {
    const motion::FrameRange clip = recordings.clip(k);
    for (int t = clip.begin; t < clip.end; ++t) {
      const auto column = static_cast<std::size_t>(t + k);
      const std::int32_t trace = ends.trace[column];
      const bool is_match = ends.cost[column] < kInfinity;
      costs.cost[t] = ends.cost[column] / detail::path_weight(rows.num_frames(), trace);
      costs.begin[t] = is_match ? t + 1 - (trace & detail::kSpan) : -1;
      costs.share_at_limit[t] = is_match ? detail::share_at_limit(rows.num_frames(), trace) : 0.0F;
    }
  }
  return costs;
}

SubsequenceCosts subsequence_costs(const Eigen::Ref<const FrameMatrix>& query,
                                   const Eigen::Ref<const FrameMatrix>& recording) {
  return subsequence_costs(query, SearchIndex(recording));
}

std::vector<FragmentMatch> disjoint_matches(const SubsequenceCosts& costs, const MatchOptions& options) {
  check(options);
  std::vector<int> ends;
  for (int t = 0; t < static_cast<int>(costs.cost.size()); ++t) {
    const bool is_match = costs.begin[t] >= 0 && costs.cost[t] <= options.max_cost;
    if (is_match && costs.share_at_limit[t] <= options.max_share_at_limit) ends.push_back(t);
  }
  std::stable_sort(ends.begin(), ends.end(), [&](int a, int b) { return costs.cost[a] < costs.cost[b]; });
  std::map<int, FragmentMatch> taken;  // by the last frame
  for (const int t : ends) {
    const auto next = taken.lower_bound(costs.begin[t]);  // the first that ends within or behind
    if (next != taken.end() && next->second.frames.begin <= t) continue;
    taken[t] = {{costs.begin[t], t + 1}, costs.cost[t], costs.share_at_limit[t]};
  }
  std::vector<FragmentMatch> matches;
  matches.reserve(taken.size());
  for (const auto& [last, match] : taken) matches.push_back(match);
  return matches;
}

std::vector<FragmentMatch> find_matches(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings,
                                        const MatchOptions& options) {
  check(options);
  return disjoint_matches(subsequence_costs(query, recordings), options);
}

std::vector<FragmentMatch> whole_matches(const Eigen::Ref<const FrameMatrix>& query, const SearchIndex& recordings,
                                         int first, int last, int slack) {
  if (first < 0 || last < first || last > recordings.num_clips()) {
    throw InvalidArgument("clips", "a range within 0 to " + std::to_string(recordings.num_clips()),
                          std::to_string(first) + " to " + std::to_string(last));
  }
  if (slack < 0) throw InvalidArgument("slack", "at least 0", std::to_string(slack));
  const SearchQuery rows(query, recordings.dimensions());
  if (first == last) return {};
  const std::vector<float> start = clip_starts(recordings, first, last, slack);
  const int begin = recordings.clip(first).begin + first, end = recordings.clip(last - 1).end + last;
  const EndCells ends = detail::search_columns(detail::search_kernels(), rows, recordings, begin, end, start.data());
  std::vector<FragmentMatch> matches;
  for (int k = first; k < last; ++k) {
    const motion::FrameRange clip = recordings.clip(k);
    const std::ptrdiff_t at = clip.begin + k - begin;
    matches.push_back(whole_match_of(rows.num_frames(), clip, ends.cost.data() + at, ends.trace.data() + at, slack));
  }
  return matches;
}

FragmentMatch whole_match(const Eigen::Ref<const FrameMatrix>& query, const Eigen::Ref<const FrameMatrix>& clip,
                          int slack) {
  return whole_matches(query, SearchIndex(clip), 0, 1, slack).front();
}

}  // namespace strut::effort
