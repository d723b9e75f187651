// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/effort/blend_choice.h>
#include <strut/effort/descriptors.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::effort {
namespace {

constexpr double kCoarseStep = 0.25, kFineStep = 0.05;  // of alpha
constexpr int kRefined = 4;                             // times the candidates: pairs whose alpha is looked at closely
constexpr int kMostOfOneFragment = 4;                   // candidates that share a fragment share its errors
constexpr int kMostCandidates = 200;
constexpr double kUnfittedDeviation = 0.6;  // of labels from an estimate that follows nobody's labels: as their own

/// Too short to be described.
bool is_too_short(const Motion& motion) {
  constexpr int kFewestFrames = 4;
  return motion.num_frames() < kFewestFrames || motion.duration() * kDescriptorRate < kFewestFrames;
}

/// Squared, of the factors that are wanted; NaN where one of those is not known.
double squared_error(const EffortVector& effort, const EffortVector& wanted, const EffortVector& weights) {
  double sum = 0.0;
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    if (!is_rated(wanted[factor]) || weights[factor] == 0.0) continue;
    const double off = effort[factor] - wanted[factor];
    sum += weights[factor] * off * off;
  }
  return sum;
}

/// What a blend beyond its fragments counts as error.
double exaggeration(double alpha, const ChoiceOptions& options) {
  const double beyond = std::max({0.0, -alpha, alpha - 1.0});
  return options.beyond_weight * beyond * beyond;
}

Eigen::VectorXd alphas_between(double least, double greatest, double step) {
  const auto count = static_cast<Eigen::Index>(std::lround((greatest - least) / step)) + 1;
  return Eigen::VectorXd::LinSpaced(std::max<Eigen::Index>(count, 2), least, greatest);
}

/// A blend that might be chosen.
struct Candidate {
  ChosenBlend blend;
  double error = 0.0;  // squared, as predicted

  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(a.error, a.blend.first, a.blend.second) < std::tie(b.error, b.blend.first, b.blend.second);
  }
};

/// Eq. 2 over all pairs on a coarse grid of alpha: the best of every pair, best first.
std::vector<Candidate> coarse_search(const EffortRegression& regression, const std::vector<FragmentPair>& pairs,
                                     const EffortVector& wanted, const ChoiceOptions& options) {
  std::vector<Candidate> found;
  if (pairs.empty()) return found;
  const Eigen::VectorXd alphas = alphas_between(options.least_alpha, options.greatest_alpha, kCoarseStep);
  const auto predicted = regression.predict(pairs, alphas);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    Candidate best;
    best.blend.first = pairs[p].first;
    best.blend.second = pairs[p].second;
    best.error = std::nan("");
    for (Eigen::Index a = 0; a < alphas.size(); ++a) {
      const auto row = static_cast<Eigen::Index>(p);
      const EffortVector effort(predicted[kFlow](row, a), predicted[kWeight](row, a), predicted[kTime](row, a));
      const double error = squared_error(effort, wanted, options.weights) + exaggeration(alphas[a], options);
      if (std::isnan(error) || error >= best.error) continue;
      best.error = error;
      best.blend.alpha = alphas[a];
    }
    if (!std::isnan(best.error)) found.push_back(best);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Looks more closely around the alpha of `candidate`.
void refine(Candidate& candidate, const EffortRegression& regression, const EffortVector& wanted,
            const ChoiceOptions& options) {
  const double least = std::max(options.least_alpha, candidate.blend.alpha - kCoarseStep);
  const double greatest = std::min(options.greatest_alpha, candidate.blend.alpha + kCoarseStep);
  const Eigen::VectorXd alphas = alphas_between(least, greatest, kFineStep);
  const auto predicted = regression.predict(candidate.blend.first, candidate.blend.second, alphas);
  std::optional<double> best;
  for (std::size_t a = 0; a < predicted.size(); ++a) {
    const double error = squared_error(predicted[a].effort, wanted, options.weights) +
                         exaggeration(alphas[static_cast<Eigen::Index>(a)], options);
    if (std::isnan(error) || (best && error >= *best)) continue;
    best = candidate.error = error;
    candidate.blend.alpha = alphas[static_cast<Eigen::Index>(a)];
    candidate.blend.predicted = predicted[a].effort;
    candidate.blend.deviation = predicted[a].deviation;
  }
}

/// Takes from sorted candidates the first `count` of which no fragment is in too many; the next ones, if that leaves
/// too few.
std::vector<Candidate> take_diverse(std::vector<Candidate>& sorted, int count) {
  std::vector<Candidate> taken, left;
  std::map<int, int> uses;
  for (const Candidate& candidate : sorted) {
    const auto [first, second] = std::pair{candidate.blend.first, candidate.blend.second};
    const bool is_worn = std::max(uses[first], uses[second]) >= kMostOfOneFragment;
    if (is_worn || std::ssize(taken) == count) {
      left.push_back(candidate);
      continue;
    }
    taken.push_back(candidate);
    ++uses[first];
    if (second != first) ++uses[second];
  }
  const auto missing = std::min<std::ptrdiff_t>(count - std::ssize(taken), std::ssize(left));
  taken.insert(taken.end(), left.begin(), left.begin() + missing);
  left.erase(left.begin(), left.begin() + missing);
  sorted = std::move(left);
  return taken;
}

/// What a movement shows, and how far labels are from that.
EffortPrediction seen_in(const Motion& motion, int group, const KinematicEstimator& estimator) {
  EffortPrediction seen{estimator.estimate(group, describe(motion)).effort, estimator.numbers().left_out_error};
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    if (!estimator.is_fitted(static_cast<Factor>(factor))) seen.deviation[factor] = kUnfittedDeviation;
  }
  return seen;
}

/// Two opinions on one number, weighted by their variances; where one has none, by halves.
double combined(double a, double deviation_a, double b, double deviation_b) {
  if (!is_rated(a) || !is_rated(b)) return is_rated(a) ? a : b;
  if (!is_rated(deviation_a) || !is_rated(deviation_b)) return 0.5 * (a + b);
  const double variance_a = deviation_a * deviation_a, variance_b = deviation_b * deviation_b;
  const double sum = variance_a + variance_b;
  return sum > 0.0 ? (a * variance_b + b * variance_a) / sum : 0.5 * (a + b);
}

void check(const EffortVector& wanted, const EffortVector& weights) {
  if (!weights.allFinite() || weights.minCoeff() < 0.0 || weights.maxCoeff() <= 0.0) {
    throw InvalidArgument("weights", "numbers of at least 0, not all 0", "others");
  }
  bool any = false;
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    if (!is_rated(wanted[factor])) continue;
    if (!std::isfinite(wanted[factor])) throw InvalidArgument("wanted", "finite numbers", "infinity");
    any = any || weights[factor] > 0.0;
  }
  if (!any) throw InvalidArgument("wanted", "a value of flow, weight or time that counts", "none");
}

void check(const ChoiceOptions& options) {
  if (!(options.least_alpha >= kLeastAlpha && options.least_alpha <= 0.0)) {
    throw InvalidArgument("least_alpha", "a number from -2 to 0", std::to_string(options.least_alpha));
  }
  if (!(options.greatest_alpha >= 1.0 && options.greatest_alpha <= kLargestAlpha)) {
    throw InvalidArgument("greatest_alpha", "a number from 1 to 3", std::to_string(options.greatest_alpha));
  }
  if (!(options.beyond_weight >= 0.0) || !std::isfinite(options.beyond_weight)) {
    throw InvalidArgument("beyond_weight", "a number of at least 0", std::to_string(options.beyond_weight));
  }
  if (options.num_candidates < 1 || options.num_candidates > kMostCandidates) {
    throw InvalidArgument("num_candidates", "1 to 200", std::to_string(options.num_candidates));
  }
}

void check_group(const EffortModel& model, int group) {
  if (group >= 0 && group < model.num_groups()) return;
  throw InvalidArgument("group", "one from 0 to " + std::to_string(model.num_groups() - 1), std::to_string(group));
}

}  // namespace

struct BlendChooser::Parts {
  std::shared_ptr<const EffortModel> model;
  std::vector<std::vector<FragmentPair>> pairs;                                 // of every group
  std::mutex guard;                                                             // of blends
  std::map<std::pair<int, int>, std::shared_ptr<const SpaceTimeBlend>> blends;  // null: cannot be blended

  std::shared_ptr<const SpaceTimeBlend> blend_of(int first, int second);
  std::vector<Candidate> single_fragments(int group, const EffortVector& wanted, const EffortVector& weights) const;
  std::optional<Blend> synthesized(const ChosenBlend& chosen);
  void score_again(Candidate& candidate, int group, const EffortVector& wanted, const ChoiceOptions& options);
  std::vector<ChosenBlend> best_of(std::vector<Candidate> sorted, int group, const EffortVector& wanted,
                                   const ChoiceOptions& options);
};

std::shared_ptr<const SpaceTimeBlend> BlendChooser::Parts::blend_of(int first, int second) {
  {
    const std::lock_guard lock(guard);
    const auto found = blends.find({first, second});
    if (found != blends.end()) return found->second;
  }
  std::shared_ptr<const SpaceTimeBlend> made;
  try {
    made = std::make_shared<const SpaceTimeBlend>(model->fragment(first).motion, model->fragment(second).motion);
  } catch (const InvalidArgument&) {
    // too far apart in posture or duration
  }
  const std::lock_guard lock(guard);
  return blends.emplace(std::pair{first, second}, std::move(made)).first->second;
}

std::optional<Blend> BlendChooser::Parts::synthesized(const ChosenBlend& chosen) {
  const Motion& first = model->fragment(chosen.first).motion;
  if (chosen.first == chosen.second) {
    const auto legs = motion::find_legs(first);
    const Eigen::VectorXd own = Eigen::VectorXd::LinSpaced(first.num_frames(), 0.0, first.num_frames() - 1.0);
    return Blend{first, legs ? postprocess::detect_footplants(first, *legs) : std::vector<motion::Footplant>{}, own,
                 own};
  }
  const auto blend = blend_of(chosen.first, chosen.second);
  if (!blend) return std::nullopt;
  return blend->at(chosen.alpha);
}

std::vector<Candidate> BlendChooser::Parts::single_fragments(int group, const EffortVector& wanted,
                                                             const EffortVector& weights) const {
  std::vector<Candidate> found;
  for (const int i : model->group(group)) {
    const EffortVector& label = model->fragment(i).effort;
    const double error = squared_error(label, wanted, weights);
    const EffortVector unknown = EffortVector::Constant(kNotRated);
    if (!std::isnan(error)) found.push_back({{i, i, 0.0, label, EffortVector::Zero(), unknown, label}, error});
  }
  if (found.empty()) {
    throw InvalidArgument("wanted", "factors that fragments of group " + std::to_string(group) + " are labelled in",
                          "others");
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The error is NaN if it cannot be synthesized.
void BlendChooser::Parts::score_again(Candidate& candidate, int group, const EffortVector& wanted,
                                      const ChoiceOptions& options) {
  const auto blend = synthesized(candidate.blend);
  candidate.error = std::nan("");
  if (!blend || is_too_short(blend->motion)) return;
  const EffortPrediction seen = seen_in(blend->motion, group, model->parts().estimator);
  ChosenBlend& scored = candidate.blend;
  scored.estimated = seen.effort;
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    scored.expected[factor] =
        combined(scored.predicted[factor], scored.deviation[factor], seen.effort[factor], seen.deviation[factor]);
  }
  candidate.error = squared_error(scored.expected, wanted, options.weights) + exaggeration(scored.alpha, options);
}

/// Scores the first candidates again, and the next ones while none can be blended.
std::vector<ChosenBlend> BlendChooser::Parts::best_of(std::vector<Candidate> sorted, int group,
                                                      const EffortVector& wanted, const ChoiceOptions& options) {
  const bool scores_again = options.num_candidates > 1;
  while (!sorted.empty()) {
    std::vector<Candidate> candidates = take_diverse(sorted, options.num_candidates);
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
      const double predicted = candidates[i].error;
      score_again(candidates[i], group, wanted, options);
      if (scores_again || std::isnan(candidates[i].error)) return;
      candidates[i].error = predicted;
      candidates[i].blend.expected = candidates[i].blend.predicted;
    });
    std::erase_if(candidates, [](const Candidate& candidate) { return std::isnan(candidate.error); });
    if (candidates.empty()) continue;
    std::sort(candidates.begin(), candidates.end());
    std::vector<ChosenBlend> chosen;
    for (const Candidate& candidate : candidates) {
      chosen.push_back(candidate.blend);
      chosen.back().error = std::sqrt(candidate.error);
    }
    return chosen;
  }
  throw InvalidArgument("group", "fragments that can be synthesized", "none");
}

BlendChooser::BlendChooser(std::shared_ptr<const EffortModel> model) : parts_(std::make_unique<Parts>()) {
  if (!model) throw InvalidArgument("model", "an effort model", "null");
  parts_->model = std::move(model);
  parts_->pairs.resize(static_cast<std::size_t>(parts_->model->num_groups()));
  for (const FragmentPair& pair : parts_->model->parts().pairs) {
    parts_->pairs[static_cast<std::size_t>(parts_->model->fragment(pair.first).group)].push_back(pair);
  }
}
BlendChooser::~BlendChooser() = default;
BlendChooser::BlendChooser(BlendChooser&&) noexcept = default;
BlendChooser& BlendChooser::operator=(BlendChooser&&) noexcept = default;

const EffortModel& BlendChooser::model() const noexcept {
  return *parts_->model;
}

ChosenBlend BlendChooser::choose(int group, const EffortVector& wanted, const ChoiceOptions& options) const {
  return candidates(group, wanted, options).front();
}

std::vector<ChosenBlend> BlendChooser::candidates(int group, const EffortVector& wanted,
                                                  const ChoiceOptions& options) const {
  check(wanted, options.weights);
  check(options);
  check_group(model(), group);
  const EffortRegression& regression = model().parts().regression;
  std::vector<Candidate> found =
      coarse_search(regression, parts_->pairs[static_cast<std::size_t>(group)], wanted, options);
  found.resize(std::min(found.size(), static_cast<std::size_t>(kRefined * options.num_candidates)));
  for (Candidate& candidate : found) refine(candidate, regression, wanted, options);
  const std::vector<Candidate> singles = parts_->single_fragments(group, wanted, options.weights);
  found.insert(found.end(), singles.begin(), singles.end());
  std::sort(found.begin(), found.end());
  return parts_->best_of(found, group, wanted, options);
}

ChosenBlend BlendChooser::choose_fragment(int group, const EffortVector& wanted, const EffortVector& weights) const {
  check(wanted, weights);
  check_group(model(), group);
  const Candidate best = parts_->single_fragments(group, wanted, weights).front();
  ChosenBlend chosen = best.blend;
  chosen.error = std::sqrt(best.error);
  return chosen;
}

Blend BlendChooser::synthesize(const ChosenBlend& chosen) const {
  auto blend = parts_->synthesized(chosen);
  if (!blend) throw InvalidArgument("chosen", "two fragments that can be blended", "others");
  return *std::move(blend);
}

EffortPrediction BlendChooser::estimate(const Motion& motion, int group) const {
  check_group(model(), group);
  return seen_in(motion, group, model().parts().estimator);
}

}  // namespace strut::effort
