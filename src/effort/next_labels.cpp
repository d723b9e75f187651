// SPDX-License-Identifier: MIT
// Symbols: C covariance of what is unknown of the candidates in one factor, v variance of a label around it. A label of
// c turns C into C - C_c C_c^T / (C_cc + v_c), and lowers its trace by |C_c|^2 / (C_cc + v_c).
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/next_labels.h>

namespace strut::effort {
namespace {

// Alphas closer than this look alike.
constexpr double kSameAlpha = 0.02;
// A group is asked about this many times as often as its share.
constexpr double kMostOfShare = 2.0;

void check(const NextLabelOptions& options) {
  if (options.count < 1) throw InvalidArgument("count", "at least 1", std::to_string(options.count));
  if (options.max_candidates < 1) {
    throw InvalidArgument("max_candidates", "at least 1", std::to_string(options.max_candidates));
  }
  for (const double weight : options.weights) {
    if (!(weight >= 0.0 && std::isfinite(weight))) {
      throw InvalidArgument("weights", "numbers of 0 or more", std::to_string(weight));
    }
  }
}

/// A pair in one order, for (i, j, a) is (j, i, 1 - a).
std::pair<int, int> ordered(int first, int second) {
  return std::minmax({first, second});
}

bool is_rated_in(const EffortRegressionParts& parts, const LabelledBlend& blend, int factor) {
  return is_rated(parts.effort(blend.first, factor)) && is_rated(parts.effort(blend.second, factor));
}

/// What is unknown of the candidates in one factor.
class Unknown {
 public:
  Unknown(const EffortRegression& regression, const std::vector<LabelledBlend>& candidates, int factor)
      : covariance_(regression.covariance(candidates, static_cast<Factor>(factor))),
        label_variance_(regression.label_variance(candidates, static_cast<Factor>(factor))) {
    for (std::size_t n = 0; n < candidates.size(); ++n) {
      if (is_rated_in(regression.parts(), candidates[n], factor)) continue;
      covariance_.row(static_cast<Eigen::Index>(n)).setZero();
      covariance_.col(static_cast<Eigen::Index>(n)).setZero();
    }
  }

  /// By how much a label of each candidate would lower the mean variance of all (candidates).
  [[nodiscard]] Eigen::VectorXd gains() const {
    if (covariance_.size() == 0 || label_variance_.maxCoeff() == 0.0) return Eigen::VectorXd::Zero(covariance_.rows());
    const Eigen::ArrayXd squares = covariance_.colwise().squaredNorm().transpose();
    return (squares / (covariance_.diagonal() + label_variance_).array()).matrix() /
           static_cast<double>(covariance_.rows());
  }

  void learn(Eigen::Index candidate) {
    const Eigen::VectorXd column = covariance_.col(candidate);
    covariance_.noalias() -= column * (column / (column[candidate] + label_variance_[candidate])).transpose();
  }

 private:
  Eigen::MatrixXd covariance_;
  Eigen::VectorXd label_variance_;
};

SuggestedBlend suggestion(const EffortRegression& regression, const LabelledBlend& blend, double gain) {
  const Eigen::VectorXd alpha = Eigen::VectorXd::Constant(1, blend.alpha);
  return {blend.first, blend.second, blend.alpha, regression.predict(blend.first, blend.second, alpha).front(), gain};
}

/// Which candidates may still be asked about.
class Choices {
 public:
  Choices(const EffortRegression& regression, const std::vector<LabelledBlend>& candidates, int count)
      : candidates_(candidates), groups_(regression.parts().group) {
    std::set<int> groups;
    for (const LabelledBlend& blend : candidates) groups.insert(groups_[blend.first]);
    most_ = std::max(1, static_cast<int>(std::ceil(kMostOfShare * count /
                                                   std::max<double>(1.0, static_cast<double>(groups.size())))));
  }

  [[nodiscard]] bool may(std::size_t n) const {
    const LabelledBlend& blend = candidates_[n];
    const auto asked = asked_.find(groups_[blend.first]);
    return !taken_.contains(ordered(blend.first, blend.second)) && (asked == asked_.end() || asked->second < most_);
  }

  void take(std::size_t n) {
    taken_.insert(ordered(candidates_[n].first, candidates_[n].second));
    ++asked_[groups_[candidates_[n].first]];
  }

 private:
  const std::vector<LabelledBlend>& candidates_;
  const Eigen::VectorXi& groups_;
  int most_ = 1;
  std::set<std::pair<int, int>> taken_;
  std::map<int, int> asked_;
};

}  // namespace

std::vector<LabelledBlend> candidate_blends(const EffortRegression& regression, const std::vector<FragmentPair>& pairs,
                                            const NextLabelOptions& options) {
  check(options);
  const EffortRegressionParts& parts = regression.parts();
  std::map<std::pair<int, int>, std::vector<double>> labelled;
  for (const LabelledBlend& blend : parts.blends) {
    const bool turned = blend.first > blend.second;
    labelled[ordered(blend.first, blend.second)].push_back(turned ? 1.0 - blend.alpha : blend.alpha);
  }
  std::vector<LabelledBlend> all;
  for (const FragmentPair& pair : pairs) {
    if (std::min(pair.first, pair.second) < 0 || std::max(pair.first, pair.second) >= regression.num_fragments()) {
      throw InvalidArgument("pairs", "fragments from 0 to " + std::to_string(regression.num_fragments() - 1),
                            std::to_string(pair.first) + " and " + std::to_string(pair.second));
    }
    const auto found = labelled.find(ordered(pair.first, pair.second));
    for (const double alpha : options.alphas) {
      const double turned = pair.first > pair.second ? 1.0 - alpha : alpha;
      LabelledBlend blend{pair.first, pair.second, alpha};
      const bool is_known =
          found != labelled.end() && std::any_of(found->second.begin(), found->second.end(),
                                                 [&](double known) { return std::abs(known - turned) < kSameAlpha; });
      bool has_factor = false;
      for (int d = 0; d < kNumPredictedFactors; ++d) has_factor = has_factor || is_rated_in(parts, blend, d);
      if (!is_known && has_factor) all.push_back(blend);
    }
  }
  const auto most = static_cast<std::size_t>(options.max_candidates);
  if (all.size() <= most) return all;
  std::vector<LabelledBlend> some;
  for (std::size_t n = 0; n < most; ++n) some.push_back(all[n * all.size() / most]);
  return some;
}

std::vector<SuggestedBlend> next_labels(const EffortRegression& regression,
                                        const std::vector<LabelledBlend>& candidates, const NextLabelOptions& options) {
  check(options);
  std::vector<Unknown> unknown;
  for (int d = 0; d < kNumPredictedFactors; ++d) unknown.emplace_back(regression, candidates, d);
  Choices choices(regression, candidates, options.count);
  std::vector<SuggestedBlend> result;
  while (static_cast<int>(result.size()) < options.count) {
    Eigen::VectorXd gains = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(candidates.size()));
    for (int d = 0; d < kNumPredictedFactors; ++d)
      gains += options.weights[d] * unknown[static_cast<std::size_t>(d)].gains();
    std::size_t best = candidates.size();
    double most = 0.0;
    for (std::size_t n = 0; n < candidates.size(); ++n) {
      const double gain = gains[static_cast<Eigen::Index>(n)];
      if (!(gain > most) || !choices.may(n)) continue;
      most = gain;
      best = n;
    }
    if (best == candidates.size()) break;
    choices.take(best);
    result.push_back(suggestion(regression, candidates[best], most));
    for (Unknown& factor : unknown) factor.learn(static_cast<Eigen::Index>(best));
  }
  return result;
}

}  // namespace strut::effort
