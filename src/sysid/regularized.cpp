// SPDX-License-Identifier: MIT
// With g = F s h, F the prior's factor, s the deviation of tap 0 and h of unit variance, the estimate solves
//   (s F'U'U F s + I) h = s F'U'y      (everything in units of the noise)
// where U'U and U'y are sums over clips, so that leaving clips out is a subtraction and every prior is tried on the
// same sums.
#include "sysid/lag_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <Eigen/Cholesky>

#include <strut/core/error.h>
#include <strut/sysid/regularized.h>

namespace strut::sysid {
namespace {

using detail::LagSums;

/// The sums of one set of clips, seen by one prior's directions.
struct ProjectedSums {
  Eigen::MatrixXd uu, uy;
  Eigen::VectorXd yy;
};

ProjectedSums project(const LagSums& sums, const Eigen::MatrixXd& factor, Eigen::Index num_inputs) {
  const Eigen::Index n = factor.rows();
  const Eigen::Index r = factor.cols();
  Eigen::MatrixXd half(num_inputs * n, num_inputs * r);
  for (Eigen::Index j = 0; j < num_inputs; ++j) {
    half.middleCols(j * r, r).noalias() = sums.uu.middleCols(j * n, n) * factor;
  }
  ProjectedSums projected{Eigen::MatrixXd(num_inputs * r, num_inputs * r), {}, sums.yy};
  projected.uy.resize(num_inputs * r, sums.uy.cols());
  for (Eigen::Index i = 0; i < num_inputs; ++i) {
    projected.uu.middleRows(i * r, r).noalias() = factor.transpose() * half.middleRows(i * n, n);
    projected.uy.middleRows(i * r, r).noalias() = factor.transpose() * sums.uy.middleRows(i * n, n);
  }
  return projected;
}

/// What a prior is worth, the lower the better, and how well it predicts clips left out.
struct Verdict {
  double criterion = std::numeric_limits<double>::infinity();
  double fit = -std::numeric_limits<double>::infinity();
};

class PriorSearch {
 public:
  PriorSearch(const std::vector<Experiment>& clips, const LeaveOut& leave_out, const std::vector<int>& input_sets,
              const RegularizedOptions& options)
      : options_(options),
        input_sets_(input_sets),
        num_inputs_(clips.front().input.cols()),
        total_(static_cast<int>(num_inputs_), static_cast<int>(clips.front().output.cols()), options.taps) {
    rounds_.assign(leave_out.rounds.size(), {total_, total_});
    // Clips of like roles are summed first: adding sums costs more than adding a clip.
    std::map<std::vector<Role>, LagSums> by_roles;
    for (std::size_t k = 0; k < clips.size(); ++k) {
      std::vector<Role> roles;
      for (const std::vector<Role>& round : leave_out.rounds) roles.push_back(round[k]);
      by_roles
          .try_emplace(roles, static_cast<int>(num_inputs_), static_cast<int>(clips.front().output.cols()),
                       options.taps)
          .first->second.add(clips[k], options.taps);
    }
    for (const auto& [roles, sums] : by_roles) {
      total_ += sums;
      for (std::size_t r = 0; r < roles.size(); ++r) {
        if (roles[r] == Role::kLearn) rounds_[r].learn += sums;
        if (roles[r] == Role::kTest) rounds_[r].test += sums;
      }
    }
    std::erase_if(rounds_, [](const Round& round) { return round.learn.frames == 0.0 || round.test.frames == 0.0; });
    variation_ = Eigen::VectorXd::Zero(total_.y.size());
    Eigen::VectorXd sum = variation_;
    double frames = 0.0;
    for (const Round& round : rounds_) {
      variation_ += round.test.yy;
      sum += round.test.y;
      frames += round.test.frames;
    }
    if (frames > 0.0) variation_ -= sum.cwiseAbs2() / frames;
  }

  /// Coordinate descent over the logarithms of scales and decay, with steps that halve.
  PriorParameters search() {
    PriorParameters best = start();
    Verdict verdict = judge(best);
    for (double step = kFirstStep; step >= kLastStep; step *= 0.5) {
      bool better = true;
      for (int round = 0; better && round < kRounds; ++round) {
        better = false;
        for (int coordinate = 0; coordinate < num_coordinates(); ++coordinate) {
          better = improve(best, verdict, coordinate, step) || better;
        }
      }
    }
    verdict_ = verdict;
    return best;
  }

  [[nodiscard]] const Verdict& verdict() const { return verdict_; }

  /// The impulse response estimated from all clips.
  ImpulseResponse estimate(const PriorParameters& prior) {
    const Eigen::MatrixXd factor = kernel_factor(prior.shape, options_.taps);
    const Eigen::Index r = factor.cols();
    const Eigen::MatrixXd h = solve(projections(prior.shape).total, deviations(prior, r));
    ImpulseResponse response(static_cast<std::size_t>(options_.taps), Eigen::MatrixXd(h.cols(), num_inputs_));
    for (Eigen::Index i = 0; i < num_inputs_; ++i) {
      const Eigen::MatrixXd taps = factor * h.middleRows(i * r, r);  // taps x outputs
      for (int k = 0; k < options_.taps; ++k) response[static_cast<std::size_t>(k)].col(i) = taps.row(k).transpose();
    }
    return response;
  }

 private:
  static constexpr double kFirstStep = 2.0, kLastStep = 0.5;  // factors of e
  static constexpr int kRounds = 4;

  [[nodiscard]] int num_sets() const { return *std::max_element(input_sets_.begin(), input_sets_.end()) + 1; }
  [[nodiscard]] int num_coordinates() const { return num_sets() + (options_.kernel == Kernel::kDc ? 2 : 1); }

  /// A tenth of the output is noise, the rest comes from every set alike, within a third of the taps.
  [[nodiscard]] PriorParameters start() const {
    PriorParameters prior{{options_.kernel, std::exp(-4.0 / options_.taps), 0.9},
                          std::vector<double>(static_cast<std::size_t>(num_sets()), 1.0)};
    std::vector<double> variances(prior.scales.size(), 0.0);
    for (Eigen::Index i = 0; i < num_inputs_; ++i) {
      variances[set_of(i)] += total_.uu(i * options_.taps, i * options_.taps) / total_.frames;
    }
    for (std::size_t s = 0; s < variances.size(); ++s) {
      if (variances[s] > 0.0) prior.scales[s] = 10.0 / variances[s];
    }
    return prior;
  }

  [[nodiscard]] std::size_t set_of(Eigen::Index input) const {
    return static_cast<std::size_t>(input_sets_[static_cast<std::size_t>(input)]);
  }

  bool improve(PriorParameters& best, Verdict& verdict, int coordinate, double step) {
    for (const double move : {step, -step}) {
      PriorParameters trial = best;
      if (coordinate < num_sets()) {
        trial.scales[static_cast<std::size_t>(coordinate)] *= std::exp(move);
      } else if (coordinate == num_sets()) {
        trial.shape.decay = std::exp(std::log(best.shape.decay) * std::exp(0.5 * move));
      } else {
        trial.shape.correlation = std::tanh(std::atanh(best.shape.correlation) + 0.5 * move);
      }
      const Verdict found = judge(trial);
      if (!(found.criterion < verdict.criterion)) continue;
      best = trial;
      verdict = found;
      return true;
    }
    return false;
  }

  struct Projections {
    ProjectedSums total;
    std::vector<std::pair<ProjectedSums, ProjectedSums>> rounds;  // learn, test
  };

  const Projections& projections(const KernelShape& shape) {
    const auto key = std::pair(shape.decay, shape.correlation);
    const auto known = projected_.find(key);
    if (known != projected_.end()) return known->second;
    const Eigen::MatrixXd factor = kernel_factor(shape, options_.taps);
    Projections& all = projected_[key];
    all.total = project(total_, factor, num_inputs_);
    for (const Round& round : rounds_) {
      all.rounds.emplace_back(project(round.learn, factor, num_inputs_), project(round.test, factor, num_inputs_));
    }
    return all;
  }

  [[nodiscard]] Eigen::VectorXd deviations(const PriorParameters& prior, Eigen::Index directions) const {
    Eigen::VectorXd result(num_inputs_ * directions);
    for (Eigen::Index i = 0; i < num_inputs_; ++i) {
      result.segment(i * directions, directions).setConstant(std::sqrt(prior.scales[set_of(i)]));
    }
    return result;
  }

  /// Coefficients of the prior's directions.
  static Eigen::MatrixXd solve(const ProjectedSums& sums, const Eigen::VectorXd& s) {
    Eigen::MatrixXd uu = s.asDiagonal() * sums.uu * s.asDiagonal();
    uu.diagonal().array() += 1.0;
    return s.asDiagonal() * uu.llt().solve(s.asDiagonal() * sums.uy);
  }

  Verdict judge(const PriorParameters& prior) {
    const Projections& sums = projections(prior.shape);
    const Eigen::VectorXd s = deviations(prior, sums.total.uu.rows() / num_inputs_);
    const bool by_likelihood = options_.selection == Selection::kMarginalLikelihood || sums.rounds.empty();
    Verdict verdict;
    verdict.fit = sums.rounds.empty() ? 0.0 : left_out_fit(sums, s);
    verdict.criterion = by_likelihood ? negative_log_likelihood(sums.total, s) : -verdict.fit;
    if (!std::isfinite(verdict.criterion)) verdict.criterion = std::numeric_limits<double>::infinity();
    return verdict;
  }

  [[nodiscard]] double left_out_fit(const Projections& sums, const Eigen::VectorXd& s) const {
    Eigen::VectorXd errors = Eigen::VectorXd::Zero(variation_.size());
    for (const auto& [learn, test] : sums.rounds) {
      const Eigen::MatrixXd g = solve(learn, s);
      const Eigen::MatrixXd modelled = test.uu * g;
      errors += test.yy;
      for (Eigen::Index o = 0; o < errors.size(); ++o) {
        errors[o] += g.col(o).dot(modelled.col(o)) - 2.0 * g.col(o).dot(test.uy.col(o));
      }
    }
    double fit = 0.0;
    int counted = 0;
    for (Eigen::Index o = 0; o < errors.size(); ++o) {
      if (!(variation_[o] > 1e-12 * total_.yy[o])) continue;
      fit += 100.0 * (1.0 - std::sqrt(std::max(0.0, errors[o]) / variation_[o]));
      ++counted;
    }
    return counted > 0 ? fit / counted : 0.0;
  }

  /// Minus twice the logarithm of the probability of the outputs, each with its own noise variance at its best.
  [[nodiscard]] double negative_log_likelihood(const ProjectedSums& all, const Eigen::VectorXd& s) const {
    Eigen::MatrixXd uu = s.asDiagonal() * all.uu * s.asDiagonal();
    uu.diagonal().array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> llt(uu);
    const Eigen::MatrixXd uy = s.asDiagonal() * all.uy;
    const Eigen::MatrixXd explained = llt.matrixL().solve(uy);
    const double determinant = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
    double total = 0.0;
    for (Eigen::Index o = 0; o < uy.cols(); ++o) {
      const double residual = std::max(all.yy[o] - explained.col(o).squaredNorm(), 1e-12 * all.yy[o]);
      if (all.yy[o] > 0.0) total += total_.frames * std::log(residual / total_.frames) + determinant;
    }
    return total;
  }

  const RegularizedOptions& options_;
  const std::vector<int>& input_sets_;
  Eigen::Index num_inputs_;
  LagSums total_;
  struct Round {
    LagSums learn, test;
  };
  std::vector<Round> rounds_;
  Eigen::VectorXd variation_;
  std::map<std::pair<double, double>, Projections> projected_;
  Verdict verdict_;
};

void check(const std::vector<Experiment>& experiments, const LeaveOut& leave_out, const std::vector<int>& input_sets,
           const RegularizedOptions& options) {
  check_experiments(experiments);
  for (const std::vector<Role>& round : leave_out.rounds) {
    if (round.size() == experiments.size()) continue;
    throw InvalidArgument("leave_out", std::to_string(experiments.size()) + " clips", std::to_string(round.size()));
  }
  if (static_cast<Eigen::Index>(input_sets.size()) != experiments.front().input.cols()) {
    throw InvalidArgument("input_sets", std::to_string(experiments.front().input.cols()) + " elements",
                          std::to_string(input_sets.size()));
  }
  for (const int set : input_sets) {
    if (set < 0 || set >= static_cast<int>(input_sets.size())) {
      throw InvalidArgument("input_sets", "sets counted from 0", std::to_string(set));
    }
  }
  if (options.taps < 1) throw InvalidArgument("taps", "1 or more", std::to_string(options.taps));
}

}  // namespace

Regularized identify_regularized(const std::vector<Experiment>& experiments, const LeaveOut& leave_out,
                                 const std::vector<int>& input_sets, const RegularizedOptions& options) {
  check(experiments, leave_out, input_sets, options);
  PriorSearch search(experiments, leave_out, input_sets, options);
  const PriorParameters prior = search.search();
  TruncatedSystem truncated = balanced_truncation(search.estimate(prior), options.truncation);
  return {std::move(truncated.system), search.verdict().fit, prior, truncated.error};
}

}  // namespace strut::sysid
