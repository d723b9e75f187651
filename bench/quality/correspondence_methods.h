// SPDX-License-Identifier: MIT
// The alignment methods that docs/correspondence.md compares, what they look at, and the figures that are taken of the
// warps they find. Errors are in frames of 1/30 s, whatever the frame rate.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/frame_matrix.h>
#include <strut/representation/alignment_features.h>

namespace strut::study {

/// What a method is given.
struct Signals {
  FrameMatrix input, output;
  Eigen::VectorXd weights;  ///< empty: all the same
  double frame_rate = 30.0;
};

enum class Solver { kIterative, kTimeWarp, kDtw1, kDtw3, kContinuous, kUniform };

/// A row of a table.
struct Method {
  std::string name;
  Solver solver = Solver::kContinuous;
  representation::FeatureShares features{};  ///< what it looks at
  bool is_smoothed = false;                  ///< over 0.1 s, as learning smooths the paper's warps
  double slope_limit = 3.0;                  ///< of kContinuous
  double slope_reach = -1.0;                 ///< of kContinuous [s]; negative: the default
  double space_reach = -1.0;                 ///< of kContinuous [s]; negative: the default
};

/// Posture alone, as the paper looks at it.
inline constexpr representation::FeatureShares kPosture{1.0, 0.0, 0.0};

/// The paper's four methods, with `features`; `beside` is added to their names.
std::vector<Method> papers_methods(const representation::FeatureShares& features, const std::string& beside = "");

/// The slope limit that `method` keeps; of DTW I, which keeps none, the paper's.
double slope_limit_of(const Method& method);

/// The warp that `method` finds.
align::Correspondence solve(const Method& method, const Signals& signals);

/// Figures of many warps.
class Figures {
 public:
  /// The error of one moment [frames of 1/30 s].
  void add_error(double error);
  /// What `warp`, at `frame_rate`, is like.
  void add_warp(const Eigen::VectorXd& warp, double frame_rate, double slope_limit);
  /// All of another's.
  void add(const Figures& other);

  [[nodiscard]] double mean() const;                  ///< of the absolute errors
  [[nodiscard]] double bias() const;                  ///< mean error: later than the truth is positive
  [[nodiscard]] double quantile(double share) const;  ///< of the absolute errors
  [[nodiscard]] double roughness() const;             ///< root mean square change of the slope in 1/30 s
  [[nodiscard]] double share_at_limit() const;        ///< of frames within 5 % of the slope limit
  [[nodiscard]] std::size_t count() const { return errors_.size(); }

 private:
  std::vector<double> errors_;
  double squared_changes_ = 0.0, changes_ = 0.0, at_limit_ = 0.0, frames_ = 0.0;
};

}  // namespace strut::study
