// SPDX-License-Identifier: MIT
#include "effort/average_linkage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <string>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/content_groups.h>
#include <strut/effort/fragment_search.h>

namespace strut::effort {
namespace {

constexpr std::size_t kMostFragments = 20000;
constexpr double kLeastFar = 1e-6;              // [m]: what cannot be like stays apart even where only equals are
constexpr std::size_t kMostForThreshold = 400;  // fragments that like_threshold looks at
constexpr double kFar = 2.0;                    // thresholds: what counts in linkage for a pair that cannot be like
constexpr std::size_t kSample = 1U << 20U;      // costs out of step that the median is taken of, at most
constexpr std::array<double, 3> kRotations = {0.25, 0.5, 0.75};

void check(const std::vector<FrameMatrix>& fragments, const GroupOptions& options) {
  if (!(options.median_share > 0.0 && std::isfinite(options.median_share))) {
    throw InvalidArgument("median_share", "a positive number", std::to_string(options.median_share));
  }
  if (!(options.max_in_step > 0.0 && options.max_in_step <= 1.0)) {
    throw InvalidArgument("max_in_step", "above 0, at most 1", std::to_string(options.max_in_step));
  }
  if (!(options.max_share_at_limit >= 0.0)) {
    throw InvalidArgument("max_share_at_limit", "0 to 1", std::to_string(options.max_share_at_limit));
  }
  if (options.max_cost < 0.0) {
    throw InvalidArgument("max_cost", "a number that is not negative", std::to_string(options.max_cost));
  }
  if (fragments.size() > kMostFragments) {
    throw InvalidArgument("fragments", "at most " + std::to_string(kMostFragments), std::to_string(fragments.size()));
  }
  if (!options.contents.empty() && options.contents.size() != fragments.size()) {
    throw InvalidArgument("contents", "one per fragment or none", std::to_string(options.contents.size()));
  }
  for (const FrameMatrix& fragment : fragments) {
    if (fragment.cols() != fragments.front().cols()) {
      throw InvalidArgument("fragments", std::to_string(fragments.front().cols()) + " columns as the first has",
                            std::to_string(fragment.cols()));
    }
    if (fragment.rows() == 0) throw InvalidArgument("fragments", "at least one frame in each", "none");
  }
}

/// `fragment` beginning with its frame at `share` of it, what came before at its end.
FrameMatrix rotated(const FrameMatrix& fragment, double share) {
  const auto first = static_cast<Eigen::Index>(std::lround(share * static_cast<double>(fragment.rows())));
  FrameMatrix turned(fragment.rows(), fragment.cols());
  turned << fragment.bottomRows(fragment.rows() - first), fragment.topRows(first);
  return turned;
}

/// What is known of a pair of fragments.
struct PairCost {
  float cost, share_at_limit, out_of_step;
};

/// Counts fragments that are compared, for whoever wants to know.
class Progress {
 public:
  Progress(const std::function<void(int, int)>& tell, std::size_t total)
      : tell_(tell), total_(static_cast<int>(total)) {}
  void count() {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    tell_(++done_, total_);
  }

 private:
  const std::function<void(int, int)>& tell_;
  std::mutex mutex_;
  int done_ = 0, total_ = 0;
};

/// All pairs that can be aligned at all, with fragments in the order of their durations: row i has the pairs of i with
/// i + 1, i + 2, ... as far as they are at most twice as long.
class PairCosts {
 public:
  PairCosts(const std::vector<FrameMatrix>& ascending, Progress& progress) : rows_(ascending.size()) {
    const SearchIndex index(ascending);
    std::vector<SearchIndex> out_of_step;
    for (const double share : kRotations) {
      std::vector<FrameMatrix> turned;
      for (const FrameMatrix& fragment : ascending) turned.push_back(rotated(fragment, share));
      out_of_step.emplace_back(turned);
    }
    tbb::parallel_for(0, static_cast<int>(rows_.size()), [&](int i) {
      const FrameMatrix& query = ascending[static_cast<std::size_t>(i)];
      const auto longer =
          std::partition_point(ascending.begin() + i + 1, ascending.end(), [&](const FrameMatrix& other) {
            return other.rows() < 2 * query.rows();  // as far as steps of two frames reach
          });
      const auto last = static_cast<int>(longer - ascending.begin());
      rows_[static_cast<std::size_t>(i)] = row(query, index, out_of_step, i + 1, last);
      progress.count();
    });
  }

  [[nodiscard]] int size() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const std::vector<PairCost>& row(int i) const { return rows_[static_cast<std::size_t>(i)]; }

 private:
  static std::vector<PairCost> row(const FrameMatrix& query, const SearchIndex& index,
                                   const std::vector<SearchIndex>& out_of_step, int first, int last) {
    std::vector<PairCost> pairs;
    for (const FragmentMatch& match : whole_matches(query, index, first, last)) {
      pairs.push_back({static_cast<float>(match.cost), static_cast<float>(match.share_at_limit),
                       std::numeric_limits<float>::infinity()});
    }
    for (const SearchIndex& turned : out_of_step) {
      const auto matches = whole_matches(query, turned, first, last);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        pairs[k].out_of_step = std::min(pairs[k].out_of_step, static_cast<float>(matches[k].cost));
      }
    }
    return pairs;
  }

  std::vector<std::vector<PairCost>> rows_;
};

/// The share of the median of the costs out of step, of every so many pairs where there are very many; 0 without pairs.
double threshold_of(const PairCosts& pairs, double share) {
  std::size_t count = 0, seen = 0;
  for (int i = 0; i < pairs.size(); ++i) count += pairs.row(i).size();
  if (count == 0) return 0.0;
  const std::size_t every = (count + kSample - 1) / kSample;
  std::vector<float> costs;
  for (int i = 0; i < pairs.size(); ++i) {
    for (const PairCost& pair : pairs.row(i)) {
      if (seen++ % every == 0) costs.push_back(pair.out_of_step);
    }
  }
  const auto at = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), at, costs.end());
  return share * *at;
}

/// When pairs are like: by their cost, or, of one named content, by its share of the cost out of step.
struct Likeness {
  bool is_named = false;
  double threshold = 0.0;  // [m], or a share
  double max_in_step = 0.0;

  [[nodiscard]] bool is_in_step(const PairCost& pair) const { return pair.cost <= max_in_step * pair.out_of_step; }
  [[nodiscard]] float distance(const PairCost& pair) const {
    if (!is_named) return pair.cost;
    return pair.out_of_step > 0.0F ? pair.cost / pair.out_of_step : 0.0F;
  }
};

/// Groups of the fragments in the order of durations.
std::vector<int> link(const PairCosts& pairs, const Likeness& like) {
  const auto far = static_cast<float>(std::max(kFar * like.threshold, kLeastFar));
  detail::AverageLinkage linkage(pairs.size(), far);
  for (int i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < pairs.row(i).size(); ++k) {
      const PairCost& pair = pairs.row(i)[k];
      const float distance = like.distance(pair);
      const bool is_near = like.is_named || like.is_in_step(pair);
      linkage.set(i, i + 1 + static_cast<int>(k), is_near ? distance : std::max(distance, far));
    }
  }
  return linkage.groups(like.threshold);
}

PairVerdict verdict_of(const PairCost& pair, bool is_one_group, const Likeness& like, double max_share_at_limit) {
  if (!like.is_named && pair.cost > like.threshold) return PairVerdict::kUnlike;
  if (!like.is_in_step(pair)) return PairVerdict::kOutOfStep;
  if (!is_one_group) return PairVerdict::kOtherGroup;
  return pair.share_at_limit > max_share_at_limit ? PairVerdict::kSlopeLimit : PairVerdict::kAccepted;
}

/// Numbers groups in the order of their first fragments.
void number_groups(ContentGroups& groups) {
  std::vector<int> numbers(groups.group.size(), -1);
  for (int& group : groups.group) {
    int& number = numbers[static_cast<std::size_t>(group)];
    if (number < 0) number = groups.num_groups++;
    group = number;
  }
}

/// Its coordinates less their means over time.
FrameMatrix movement_of(const FrameMatrix& fragment) {
  return fragment.rowwise() - fragment.colwise().mean();
}

/// The pairs of one group or like, with fragments by their number in `order`.
void add_pairs(const PairCosts& costs, const std::vector<int>& order, const std::vector<int>& linked,
               const Likeness& like, double max_share_at_limit, std::vector<MatchedPair>& pairs) {
  for (int i = 0; i < costs.size(); ++i) {
    for (std::size_t k = 0; k < costs.row(i).size(); ++k) {
      const PairCost& pair = costs.row(i)[k];
      const auto j = static_cast<std::size_t>(i) + 1 + k;
      const bool is_one_group = linked[static_cast<std::size_t>(i)] == linked[j];
      if (!is_one_group && like.distance(pair) > like.threshold) continue;
      const auto [first, second] = std::minmax(order[static_cast<std::size_t>(i)], order[j]);
      pairs.push_back(
          {first, second, pair.cost, pair.share_at_limit, verdict_of(pair, is_one_group, like, max_share_at_limit)});
    }
  }
}

/// Groups the fragments `order` among themselves. A group is numbered as one of its fragments.
void group_content(const std::vector<FrameMatrix>& fragments, std::vector<int> order, bool is_named,
                   const GroupOptions& options, Progress& progress, ContentGroups& groups) {
  const auto at = [&](int index) -> const FrameMatrix& { return fragments[static_cast<std::size_t>(index)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(a).rows() < at(b).rows(); });
  std::vector<FrameMatrix> ascending;
  for (const int index : order) ascending.push_back(is_named ? movement_of(at(index)) : at(index));
  const PairCosts costs(ascending, progress);
  Likeness like{is_named, options.max_in_step, options.max_in_step};
  if (!is_named) {
    like.threshold = std::isnan(options.max_cost) ? threshold_of(costs, options.median_share) : options.max_cost;
    groups.threshold = like.threshold;
  }
  const std::vector<int> linked = link(costs, like);
  for (std::size_t k = 0; k < order.size(); ++k) {
    groups.group[static_cast<std::size_t>(order[k])] = order[static_cast<std::size_t>(linked[k])];
  }
  add_pairs(costs, order, linked, like, options.max_share_at_limit, groups.pairs);
}

}  // namespace

const char* name_of(PairVerdict verdict) noexcept {
  constexpr std::array<const char*, 5> kNames = {"accepted", "unlike", "out of step", "slope limit", "other group"};
  return kNames[static_cast<std::size_t>(verdict)];
}

ContentGroups group_fragments(const std::vector<FrameMatrix>& fragments, const GroupOptions& options) {
  check(fragments, options);
  std::map<std::string, std::vector<int>> contents;
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    contents[options.contents.empty() ? "" : options.contents[k]].push_back(static_cast<int>(k));
  }
  Progress progress(options.progress, fragments.size());
  ContentGroups groups;
  groups.group.resize(fragments.size());
  for (const auto& [content, members] : contents) {
    group_content(fragments, members, !content.empty(), options, progress, groups);
  }
  number_groups(groups);
  std::sort(groups.pairs.begin(), groups.pairs.end(), [](const MatchedPair& a, const MatchedPair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return groups;
}

double like_threshold(const std::vector<FrameMatrix>& fragments) {
  const GroupOptions options;
  const std::size_t every = (fragments.size() + kMostForThreshold - 1) / kMostForThreshold;
  std::vector<FrameMatrix> picked;
  for (std::size_t k = 0; k < fragments.size(); k += every) picked.push_back(fragments[k]);
  check(picked, options);
  if (picked.size() < 2) return 0.0;
  std::stable_sort(picked.begin(), picked.end(),
                   [](const FrameMatrix& a, const FrameMatrix& b) { return a.rows() < b.rows(); });
  Progress progress(options.progress, picked.size());
  return threshold_of(PairCosts(picked, progress), options.median_share);
}

}  // namespace strut::effort
