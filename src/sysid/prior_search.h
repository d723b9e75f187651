// SPDX-License-Identifier: MIT
// Private to regularized identification: the prior under which clips left out are predicted best, or the data are
// most probable.
#pragma once

#include "sysid/lag_sums.h"
#include "sysid/projected_sums.h"

#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <strut/sysid/regularized.h>

namespace strut::sysid::detail {

/// Sums over all clips, and over those that learn and test in each round.
struct RoundSums {
  struct Round {
    LagSums learn, test;
    bool is_whole;  ///< every clip learns or tests; `learn` is then left empty, being all that does not test
  };
  LagSums total;
  std::vector<Round> rounds;  ///< those that have clips to learn from and to test

  RoundSums(const std::vector<Experiment>& clips, const LeaveOut& leave_out, int taps);
};

/// Searches the prior. The arguments must outlive it, and be as identify_regularized demands.
class PriorSearch {
 public:
  PriorSearch(const RoundSums& sums, const std::vector<int>& input_sets, const RegularizedOptions& options);

  /// Coordinate descent over the logarithms of scales and decay, in large steps and then in small ones, after each set
  /// was tried as good as left out. No prior is judged twice.
  PriorParameters search();

  /// Of the clips left out under `prior` [%]; 0 if no output of theirs varies, or there are none.
  [[nodiscard]] double left_out_fit(const PriorParameters& prior);

  /// The impulse response estimated from all clips.
  [[nodiscard]] ImpulseResponse estimate(const PriorParameters& prior);

 private:
  /// A prior to try: how many of the smallest steps each coordinate is from where the search starts.
  using Point = std::vector<int>;
  /// One shape's view of the sums.
  struct View {
    Eigen::MatrixXd factor;
    ProjectedSums total;
    std::vector<std::pair<ProjectedSums, ProjectedSums>> rounds;  // learn, test; made when first asked for
  };

  [[nodiscard]] int num_sets() const;
  [[nodiscard]] std::size_t set_of(Eigen::Index input) const;
  [[nodiscard]] bool by_likelihood() const;
  [[nodiscard]] PriorParameters start() const;
  [[nodiscard]] PriorParameters prior_at(const Point& point) const;
  bool improve(Point& best, std::size_t coordinate, int step);
  bool try_step(Point& best, std::size_t coordinate, int step);
  double judge(const Point& point);
  double unlikelihood(const PriorParameters& prior);
  View& view(const KernelShape& shape);
  void add_rounds(View& view) const;
  [[nodiscard]] Eigen::VectorXd deviations(const PriorParameters& prior, Eigen::Index directions) const;

  const RoundSums& sums_;
  const std::vector<int>& input_sets_;
  const RegularizedOptions& options_;
  Eigen::VectorXd variation_;  // of the clips that test, about their mean
  PriorParameters start_;
  std::map<Point, double> judged_;  // the lower the better
  std::vector<int> direction_;      // that each coordinate went last: 1 or -1
  std::map<std::pair<double, double>, View> views_;
};

}  // namespace strut::sysid::detail
