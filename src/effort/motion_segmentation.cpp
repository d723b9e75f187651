// SPDX-License-Identifier: MIT
// The cut is a shortest path: node j stands before frame j, a frame that matches nothing leads from j to j + 1, a
// candidate from its begin to its end.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <strut/core/error.h>
#include <strut/effort/fragment_search.h>
#include <strut/effort/motion_segmentation.h>

namespace strut::effort {
namespace {

/// The cheapest way to a node.
struct Arrival {
  double cost = std::numeric_limits<double>::infinity();
  int snippets = 0;
  int candidate = kNoMatch;  // that arrives here; none: an unmatched frame
};

bool is_better(const Arrival& a, const Arrival& b) {
  return a.cost < b.cost || (a.cost == b.cost && a.snippets < b.snippets);
}

void check_candidates(const std::vector<SnippetCandidate>& candidates, int num_frames) {
  for (const SnippetCandidate& candidate : candidates) {
    const motion::FrameRange& at = candidate.frames;
    if (at.begin < 0 || at.end <= at.begin || at.end > num_frames || !(candidate.cost >= 0.0)) {
      throw InvalidArgument("candidates", "stretches of the frames 0 to " + std::to_string(num_frames) + ", costs >= 0",
                            std::to_string(at.begin) + " to " + std::to_string(at.end));
    }
  }
}

void check_options(const std::vector<KnownFragment>& fragments, const SegmentationOptions& options) {
  if (fragments.empty()) throw InvalidArgument("fragments", "at least one", "none");
  if (!(options.threshold > 0.0) || !std::isfinite(options.threshold)) {
    throw InvalidArgument("threshold", "a positive number of metres", std::to_string(options.threshold));
  }
  if (!(options.boundary_frames >= 0.0) || !std::isfinite(options.boundary_frames)) {
    throw InvalidArgument("boundary_frames", "a number of at least 0", std::to_string(options.boundary_frames));
  }
}

/// Every match that is better than matching nothing.
std::vector<SnippetCandidate> candidates_of(const std::vector<KnownFragment>& fragments,
                                            const Eigen::Ref<const FrameMatrix>& recording, double threshold) {
  std::vector<SnippetCandidate> candidates;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const SubsequenceCosts costs = subsequence_costs(fragments[f].features, recording);
    for (Eigen::Index end = 0; end < costs.cost.size(); ++end) {
      const double cost = costs.cost[end];
      if (!(cost < threshold)) continue;
      candidates.push_back({{costs.begin[end], static_cast<int>(end) + 1}, static_cast<int>(f), cost});
    }
  }
  return candidates;
}

}  // namespace

std::vector<int> cheapest_cut(const std::vector<SnippetCandidate>& candidates, int num_frames, double boundary,
                              double unmatched) {
  check_candidates(candidates, num_frames);
  std::vector<std::vector<int>> ending(static_cast<std::size_t>(num_frames) + 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    ending[static_cast<std::size_t>(candidates[i].frames.end)].push_back(static_cast<int>(i));
  }
  std::vector<Arrival> best(ending.size());
  best[0].cost = 0.0;
  for (std::size_t node = 1; node < ending.size(); ++node) {
    best[node] = {best[node - 1].cost + unmatched, best[node - 1].snippets, kNoMatch};
    for (const int i : ending[node]) {
      const SnippetCandidate& candidate = candidates[static_cast<std::size_t>(i)];
      const Arrival& before = best[static_cast<std::size_t>(candidate.frames.begin)];
      const Arrival here{before.cost + candidate.cost * candidate.frames.num_frames() + boundary, before.snippets + 1,
                         i};
      if (is_better(here, best[node])) best[node] = here;
    }
  }
  std::vector<int> chosen;
  for (int node = num_frames; node > 0;) {
    const int candidate = best[static_cast<std::size_t>(node)].candidate;
    if (candidate != kNoMatch) chosen.push_back(candidate);
    node = candidate == kNoMatch ? node - 1 : candidates[static_cast<std::size_t>(candidate)].frames.begin;
  }
  std::reverse(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<Snippet> segment_motion(const std::vector<KnownFragment>& fragments,
                                    const Eigen::Ref<const FrameMatrix>& recording,
                                    const SegmentationOptions& options) {
  check_options(fragments, options);
  const int num_frames = static_cast<int>(recording.rows());
  std::vector<Snippet> snippets;
  if (num_frames == 0) return snippets;
  const auto candidates = candidates_of(fragments, recording, options.threshold);
  const auto fill_to = [&](int frame) {
    const int from = snippets.empty() ? 0 : snippets.back().frames.end;
    if (frame > from) snippets.push_back({{from, frame}});
  };
  for (const int i :
       cheapest_cut(candidates, num_frames, options.boundary_frames * options.threshold, options.threshold)) {
    const SnippetCandidate& chosen = candidates[static_cast<std::size_t>(i)];
    fill_to(chosen.frames.begin);
    const int group = fragments[static_cast<std::size_t>(chosen.fragment)].group;
    snippets.push_back({chosen.frames, group, chosen.fragment, chosen.cost});
  }
  fill_to(num_frames);
  return snippets;
}

double coverage(const std::vector<Snippet>& snippets) {
  int matched = 0, all = 0;
  for (const Snippet& snippet : snippets) {
    all += snippet.frames.num_frames();
    if (snippet.group != kNoMatch) matched += snippet.frames.num_frames();
  }
  return all == 0 ? 0.0 : static_cast<double>(matched) / all;
}

}  // namespace strut::effort
