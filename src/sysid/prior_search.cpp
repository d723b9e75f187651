// SPDX-License-Identifier: MIT
// Every prior is tried on the same sums over clips (lag_sums.h), seen in its directions (projected_sums.h). What is
// kept of one trial for the next: judgements, and the view of the shape that is best so far, on which scales are tried
// at the price of a Cholesky decomposition a round.
#include "sysid/prior_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strut::sysid::detail {
namespace {

constexpr double kUnit = 0.5;         // factors of e in a scale; half as much in the logarithm of the decay
constexpr int kOff = -9;              // units that all but leave a set out
constexpr int kFirstStep = 3;         // in units; the second and last is one unit
constexpr int kMaxRounds = 6;         // over all coordinates, per step
constexpr double kLeastGain = 0.02;   // points of fit, or of twice the log likelihood: less is not worth a step
constexpr double kLeastDecay = 1e-3;  // a response that decays faster is over after tap 0
constexpr double kStartDecay = 11.0;  // factors of e over all taps
constexpr double kStartCorrelation = 0.9;

/// Of the directions kept (kernel_factor). The variances of kSs fall with the fourth power of their number, the others'
/// with the second.
double least_variance(Kernel kernel) {
  return kernel == Kernel::kSs ? 1e-5 : 1e-3;
}

std::vector<Role> roles_of(const LeaveOut& leave_out, std::size_t clip) {
  std::vector<Role> roles;
  for (const std::vector<Role>& round : leave_out.rounds) roles.push_back(round[clip]);
  return roles;
}

bool has(const std::vector<Role>& round, Role role) {
  return std::find(round.begin(), round.end(), role) != round.end();
}

}  // namespace

RoundSums::RoundSums(const std::vector<Experiment>& clips, const LeaveOut& leave_out, int taps)
    : total(static_cast<int>(clips.front().input.cols()), static_cast<int>(clips.front().output.cols()), taps) {
  // Clips of like roles are summed first: adding sums costs more than adding a clip.
  const LagSums none = total;
  std::map<std::vector<Role>, std::vector<const Experiment*>> clips_by_roles;
  for (std::size_t k = 0; k < clips.size(); ++k) clips_by_roles[roles_of(leave_out, k)].push_back(&clips[k]);
  std::map<std::vector<Role>, LagSums> by_roles;
  for (const auto& [roles, alike] : clips_by_roles) by_roles.try_emplace(roles, none).first->second.add(alike, taps);
  for (const auto& [roles, sums] : by_roles) total += sums;
  for (std::size_t r = 0; r < leave_out.rounds.size(); ++r) {
    const std::vector<Role>& clip_roles = leave_out.rounds[r];
    if (!has(clip_roles, Role::kLearn) || !has(clip_roles, Role::kTest)) continue;
    const bool is_whole = !has(clip_roles, Role::kUnused);
    Round& round = rounds.emplace_back(Round{is_whole ? LagSums(0, 0, 0) : none, none, is_whole});
    for (const auto& [roles, sums] : by_roles) {
      if (roles[r] == Role::kTest) round.test += sums;
      if (roles[r] == Role::kLearn && !is_whole) round.learn += sums;
    }
  }
}

PriorSearch::PriorSearch(const RoundSums& sums, const std::vector<int>& input_sets, const RegularizedOptions& options)
    : sums_(sums), input_sets_(input_sets), options_(options), variation_(Eigen::VectorXd::Zero(sums.total.y.size())) {
  Eigen::VectorXd sum = variation_;
  double frames = 0.0;
  for (const RoundSums::Round& round : sums.rounds) {
    variation_ += round.test.yy;
    sum += round.test.y;
    frames += round.test.frames;
  }
  if (frames > 0.0) variation_ -= sum.cwiseAbs2() / frames;
  start_ = start();
}

PriorParameters PriorSearch::search() {
  Point best(static_cast<std::size_t>(num_sets()) + (options_.kernel == Kernel::kDc ? 2 : 1), 0);
  direction_.assign(best.size(), 1);
  for (std::size_t set = 0; set < start_.scales.size(); ++set) try_step(best, set, kOff);
  for (int step = kFirstStep; step > 0; step /= kFirstStep) {
    bool better = true;
    for (int round = 0; better && round < kMaxRounds; ++round) {
      better = false;
      for (std::size_t coordinate = 0; coordinate < best.size(); ++coordinate) {
        better = improve(best, coordinate, step) || better;
      }
    }
  }
  return prior_at(best);
}

/// One step along a coordinate if that is better than to stay, tried first the way it went last.
bool PriorSearch::improve(Point& best, std::size_t coordinate, int step) {
  if (try_step(best, coordinate, direction_[coordinate] * step)) return true;
  if (!try_step(best, coordinate, -direction_[coordinate] * step)) return false;
  direction_[coordinate] *= -1;
  return true;
}

bool PriorSearch::try_step(Point& best, std::size_t coordinate, int step) {
  Point trial = best;
  trial[coordinate] += step;
  const bool is_better = judge(trial) < judge(best) - kLeastGain;
  if (is_better) best = trial;
  const KernelShape kept = prior_at(best).shape;
  std::erase_if(views_, [&](const auto& item) { return item.first != std::pair(kept.decay, kept.correlation); });
  return is_better;
}

double PriorSearch::judge(const Point& point) {
  const auto [entry, is_new] = judged_.try_emplace(point, std::numeric_limits<double>::infinity());
  if (!is_new) return entry->second;
  const PriorParameters prior = prior_at(point);
  const double found = by_likelihood() ? unlikelihood(prior) : -left_out_fit(prior);
  if (std::isfinite(found)) entry->second = found;
  return entry->second;
}

double PriorSearch::unlikelihood(const PriorParameters& prior) {
  const View& seen = view(prior.shape);
  return negative_log_likelihood(seen.total, deviations(prior, seen.factor.cols()));
}

double PriorSearch::left_out_fit(const PriorParameters& prior) {
  constexpr double kVaries = 1e-12;  // of its energy: less is the rounding of a constant
  View& seen = view(prior.shape);
  if (seen.rounds.empty()) add_rounds(seen);
  const Eigen::VectorXd s = deviations(prior, seen.factor.cols());
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(variation_.size());
  for (const auto& [learn, test] : seen.rounds) errors += squared_errors(test, solve(learn, s));
  double fit = 0.0;
  int counted = 0;
  for (Eigen::Index o = 0; o < errors.size(); ++o) {
    if (!(variation_[o] > kVaries * sums_.total.yy[o])) continue;
    fit += 100.0 * (1.0 - std::sqrt(std::max(0.0, errors[o]) / variation_[o]));
    ++counted;
  }
  return counted > 0 ? fit / counted : 0.0;
}

ImpulseResponse PriorSearch::estimate(const PriorParameters& prior) {
  const View& seen = view(prior.shape);
  const Eigen::Index r = seen.factor.cols();
  const Eigen::MatrixXd g = solve(seen.total, deviations(prior, r));
  const auto num_inputs = static_cast<Eigen::Index>(input_sets_.size());
  ImpulseResponse response(static_cast<std::size_t>(options_.taps), Eigen::MatrixXd(g.cols(), num_inputs));
  for (Eigen::Index i = 0; i < num_inputs; ++i) {
    const Eigen::MatrixXd taps = seen.factor * g.middleRows(i * r, r);  // taps x outputs
    for (int k = 0; k < options_.taps; ++k) response[static_cast<std::size_t>(k)].col(i) = taps.row(k).transpose();
  }
  return response;
}

int PriorSearch::num_sets() const {
  return *std::max_element(input_sets_.begin(), input_sets_.end()) + 1;
}

std::size_t PriorSearch::set_of(Eigen::Index input) const {
  return static_cast<std::size_t>(input_sets_[static_cast<std::size_t>(input)]);
}

bool PriorSearch::by_likelihood() const {
  return options_.selection == Selection::kMarginalLikelihood || sums_.rounds.empty();
}

/// Tap 0 of every set makes as much output as the noise; the response is over after a third of the taps.
PriorParameters PriorSearch::start() const {
  PriorParameters prior{{options_.kernel, std::exp(-kStartDecay / options_.taps), kStartCorrelation},
                        std::vector<double>(static_cast<std::size_t>(num_sets()), 1.0)};
  std::vector<double> variances(prior.scales.size(), 0.0);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(input_sets_.size()); ++i) {
    variances[set_of(i)] += sums_.total.uu(i * options_.taps, i * options_.taps) / sums_.total.frames;
  }
  for (std::size_t s = 0; s < variances.size(); ++s) {
    if (variances[s] > 0.0) prior.scales[s] = 1.0 / variances[s];
  }
  return prior;
}

PriorParameters PriorSearch::prior_at(const Point& point) const {
  PriorParameters prior = start_;
  const std::size_t sets = prior.scales.size();
  for (std::size_t s = 0; s < sets; ++s) prior.scales[s] *= std::exp(kUnit * point[s]);
  const double slower = std::exp(0.5 * kUnit * point[sets]);
  prior.shape.decay = std::max(kLeastDecay, std::exp(std::log(start_.shape.decay) * slower));
  if (point.size() > sets + 1) {
    prior.shape.correlation = std::tanh(std::atanh(start_.shape.correlation) + 0.5 * kUnit * point[sets + 1]);
  }
  return prior;
}

PriorSearch::View& PriorSearch::view(const KernelShape& shape) {
  const auto [entry, is_new] = views_.try_emplace({shape.decay, shape.correlation});
  View& result = entry->second;
  if (is_new) {
    result.factor = kernel_factor(shape, options_.taps, least_variance(shape.kernel));
    result.total = project(sums_.total, result.factor);
  }
  return result;
}

void PriorSearch::add_rounds(View& view) const {
  for (const RoundSums::Round& round : sums_.rounds) {
    ProjectedSums test = project(round.test, view.factor);
    ProjectedSums learn = round.is_whole ? without(view.total, test) : project(round.learn, view.factor);
    view.rounds.emplace_back(std::move(learn), std::move(test));
  }
}

Eigen::VectorXd PriorSearch::deviations(const PriorParameters& prior, Eigen::Index directions) const {
  const auto num_inputs = static_cast<Eigen::Index>(input_sets_.size());
  Eigen::VectorXd result(num_inputs * directions);
  for (Eigen::Index i = 0; i < num_inputs; ++i) {
    result.segment(i * directions, directions).setConstant(std::sqrt(prior.scales[set_of(i)]));
  }
  return result;
}

}  // namespace strut::sysid::detail
