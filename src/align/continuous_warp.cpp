// SPDX-License-Identifier: MIT
// Symbols: u input, y output, T where each input frame begins in the output (T[0] = -1/2, T[m] = n - 1/2), w its
// differences, tau the middles of its steps. Of E only T[1] ... T[m - 1] are free.
#include "align/signals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <strut/align/continuous_warp.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>

namespace strut::align {
namespace {

using Signals = Eigen::Ref<const FrameMatrix>;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How much the barrier counts, per frame, beside a mean squared distance in units of the signals' variance: small, so
// that slopes come near the limit where the signals ask for it.
constexpr double kBarrier = 1e-3;
// Of the way to the nearest limit, the most that a step may go.
constexpr double kMostOfTheWay = 0.95;
// A start is drawn inside to this share of the way from the even slope to the limit.
constexpr double kInside = 0.98;
// Steps of the time warp between two space warps, and how often one is halved.
constexpr int kStepsPerRound = 3;
constexpr int kHalvings = 8;
// Added to the normal equations: relative, against overshooting, and absolute, where signals say nothing.
constexpr double kDamping = 1e-6;
constexpr double kRidge = 1e-9;
// Over how long a warp of counts is smoothed before it is refined [s].
constexpr double kSmoothing = 0.1;
// The start's slope limit, and how many times steeper than the even slope it may be where that is steep itself.
constexpr double kPapersLimit = 2.0;
constexpr double kSpareSlope = 1.5;
// Lengths this near the slope limit leave no choice.
constexpr double kNoChoice = 1e-6;

void check_number(const char* name, double value, bool is_good, const char* expected) {
  if (is_good && std::isfinite(value)) return;
  throw InvalidArgument(name, expected, std::to_string(value));
}

void check_options(const ContinuousWarpOptions& options, double frame_rate) {
  check_number("frame_rate", frame_rate, frame_rate > 0.0, "a positive number");
  check_number("slope_limit", options.slope_limit, options.slope_limit > 1.0, "a number above 1");
  check_number("slope_reach", options.slope_reach, options.slope_reach >= 0.0, "a number that is not negative");
  check_number("space_reach", options.space_reach, options.space_reach >= 0.0, "a number that is not negative");
  check_number("max_rounds", options.max_rounds, options.max_rounds >= 1, "at least 1");
  check_number("tolerance", options.tolerance, options.tolerance >= 0.0, "a number that is not negative");
}

/// The weights of the degrees of freedom, their sum 1.
Eigen::RowVectorXd shares_of(const VectorXd& weights, Index dofs) {
  detail::check_weights(weights, dofs);
  if (weights.size() == 0) return Eigen::RowVectorXd::Constant(dofs, 1.0 / static_cast<double>(dofs));
  return (weights / weights.sum()).transpose();
}

/// The output between its frames: Catmull-Rom cubics, the ends continued straight.
class Curve {
 public:
  explicit Curve(const Signals& y) : frames_(y.rows()), padded_(std::max<Index>(y.rows(), 2) + 2, y.cols()) {
    padded_.middleRows(1, frames_) = y;
    if (frames_ == 1) padded_.row(2) = y.row(0);
    const Index last = padded_.rows() - 1;
    padded_.row(0) = 2.0 * padded_.row(1) - padded_.row(2);
    padded_.row(last) = 2.0 * padded_.row(last - 1) - padded_.row(last - 2);
  }

  /// Values at `at` [frames], and slopes per frame if `slopes` is not null; at and beyond the ends, constant.
  void sample(const VectorXd& at, FrameMatrix& values, FrameMatrix* slopes) const {
    const auto last = static_cast<double>(frames_ - 1);
    for (Index t = 0; t < at.size(); ++t) {
      const double x = std::clamp(at[t], 0.0, last);
      const Index j = std::min(static_cast<Index>(x), padded_.rows() - 4);
      const double f = x - static_cast<double>(j);
      combine(j, 0.5 * f * (-1.0 + f * (2.0 - f)), 1.0 + f * f * (1.5 * f - 2.5), 0.5 * f * (1.0 + f * (4.0 - 3.0 * f)),
              0.5 * f * f * (f - 1.0), values.row(t));
      if (slopes == nullptr) continue;
      const double moves = x == at[t] ? 0.5 : 0.0;
      combine(j, moves * (-1.0 + f * (4.0 - 3.0 * f)), moves * f * (9.0 * f - 10.0),
              moves * (1.0 + f * (8.0 - 9.0 * f)), moves * f * (3.0 * f - 2.0), slopes->row(t));
    }
  }

 private:
  void combine(Index j, double a, double b, double c, double d, FrameMatrix::RowXpr into) const {
    into = a * padded_.row(j) + b * padded_.row(j + 1) + c * padded_.row(j + 2) + d * padded_.row(j + 3);
  }

  Index frames_;
  FrameMatrix padded_;
};

/// Symmetric equations in which an unknown meets its two neighbours on either side.
struct FiveDiagonals {
  VectorXd main, first, second, right;  ///< first[i] is beside i - 1, second[i] beside i - 2

  explicit FiveDiagonals(Index n)
      : main(VectorXd::Zero(n)), first(VectorXd::Zero(n)), second(VectorXd::Zero(n)), right(VectorXd::Zero(n)) {}

  /// Adds weight (r + c0 x_i + c1 x_{i+1} + c2 x_{i+2})^2 / 2, with unknowns outside held at zero.
  void add_square(Index i, double weight, double r, double c0, double c1, double c2) {
    const double c[] = {c0, c1, c2};
    for (Index p = 0; p < 3; ++p) {
      if (!has(i + p)) continue;
      main[i + p] += weight * c[p] * c[p];
      right[i + p] -= weight * r * c[p];
      if (p >= 1 && has(i + p - 1)) first[i + p] += weight * c[p] * c[p - 1];
      if (p == 2 && has(i)) second[i + 2] += weight * c[2] * c[0];
    }
  }

  /// LDL'; the equations are spent.
  VectorXd solve() {
    const Index n = main.size();
    VectorXd x = right;
    for (Index i = 0; i < n; ++i) {
      if (i >= 2) {
        first[i] -= second[i] * first[i - 1];
        second[i] /= main[i - 2];
        main[i] -= second[i] * second[i] * main[i - 2];
        x[i] -= second[i] * x[i - 2];
      }
      if (i >= 1) {
        first[i] /= main[i - 1];
        main[i] -= first[i] * first[i] * main[i - 1];
        x[i] -= first[i] * x[i - 1];
      }
    }
    x.array() /= main.array();
    for (Index i = n - 1; i >= 0; --i) {
      if (i + 1 < n) x[i] -= first[i + 1] * x[i + 1];
      if (i + 2 < n) x[i] -= second[i + 2] * x[i + 2];
    }
    return x;
  }

 private:
  [[nodiscard]] bool has(Index i) const { return i >= 0 && i < main.size(); }
};

/// Slopes as they may be.
struct SlopeRange {
  double least, greatest, even;

  /// Whether the lengths leave a choice at all.
  [[nodiscard]] bool is_open() const { return even > least * (1.0 + kNoChoice) && greatest > even * (1.0 + kNoChoice); }

  /// 0 at the even slope, rising to infinity at the ends of the range.
  [[nodiscard]] double barrier(const VectorXd& w) const {
    if (!is_open()) return 0.0;
    if ((w.array() <= least || w.array() >= greatest).any()) return kInfinity;
    return -kBarrier *
           (((w.array() - least) / (even - least)).log() + ((greatest - w.array()) / (greatest - even)).log()).sum();
  }

  /// `w` with the sum that makes its mean the even slope, drawn to it until it lies inside.
  [[nodiscard]] VectorXd drawn_inside(const VectorXd& w) const {
    const VectorXd from_even = w.array() * (even * static_cast<double>(w.size()) / w.sum()) - even;
    double share = 1.0;
    for (const double distance : from_even) {
      const double room = distance > 0.0 ? greatest - even : even - least;
      if (distance != 0.0) share = std::min(share, kInside * room / std::abs(distance));
    }
    return (share * from_even).array() + even;
  }

  /// The longest part (at most 1) of the step from slopes `w` to `w + change` that stays inside.
  [[nodiscard]] double room(const VectorXd& w, const VectorXd& change) const {
    double part = 1.0;
    for (Index t = 0; t < w.size(); ++t) {
      const double to_limit = change[t] > 0.0 ? greatest - w[t] : least - w[t];
      if (change[t] != 0.0) part = std::min(part, kMostOfTheWay * to_limit / change[t]);
    }
    return part;
  }
};

VectorXd steps_of(const VectorXd& curve) {
  return curve.tail(curve.size() - 1) - curve.head(curve.size() - 1);
}

class Refinement {
 public:
  Refinement(const Signals& input, const Signals& output, const VectorXd& start, double frame_rate,
             const ContinuousWarpOptions& options)
      : input_(input),
        curve_(output),
        shares_(shares_of(options.weights, input.cols())),
        options_(options),
        stiffness_(std::pow(options.slope_reach * frame_rate, 2)),
        range_{1.0 / options.slope_limit, options.slope_limit,
               static_cast<double>(output.rows()) / static_cast<double>(input.rows())},
        even_{std::vector<int>(static_cast<std::size_t>(input.rows()), 1)},
        values_(input.rows(), input.cols()),
        slopes_(input.rows(), input.cols()) {
    const double space = std::pow(options.space_reach * frame_rate, 2);
    space_ = {space, space};
    place(range_.drawn_inside(start), output.rows());
  }

  ContinuousWarp run() {
    ContinuousWarp result;
    double before = kInfinity;
    for (int round = 0; round < options_.max_rounds; ++round) {
      if (!warp_space(result.space_warp)) break;
      result.objective.push_back(energy_);
      for (int k = 0; k < kStepsPerRound && step(); ++k) result.objective.push_back(energy_);
      if (before - energy_ <= options_.tolerance * energy_) break;
      before = energy_;
    }
    result.correspondence.differential_warp = steps_of(begins_);
    return result;
  }

 private:
  void place(const VectorXd& w, Index output_frames) {
    begins_.resize(w.size() + 1);
    begins_[0] = -0.5;
    for (Index t = 0; t < w.size(); ++t) begins_[t + 1] = begins_[t] + w[t];
    begins_[w.size()] = static_cast<double>(output_frames) - 0.5;
  }

  static VectorXd middles(const VectorXd& begins) {
    return 0.5 * (begins.head(begins.size() - 1) + begins.tail(begins.size() - 1));
  }

  /// a and b for the warp as it is; false, and nothing is changed, if that would raise the objective by rounding.
  bool warp_space(SpaceWarp& space) {
    curve_.sample(middles(begins_), values_, nullptr);
    SpaceWarp found = align::space_warp(input_, values_, even_, space_);
    FrameMatrix warped = found.apply(input_);
    std::swap(warped, warped_);
    const double roughness_before = std::exchange(roughness_, roughness(found));
    const double energy = objective(begins_);
    if (energy < energy_) {
      energy_ = energy;
      space = std::move(found);
      return true;
    }
    std::swap(warped, warped_);
    roughness_ = roughness_before;
    return false;
  }

  [[nodiscard]] double roughness(const SpaceWarp& space) const {
    const Index n = input_.rows() - 1;
    const auto squared_steps = [n](const FrameMatrix& c) {
      return (c.bottomRows(n) - c.topRows(n)).colwise().squaredNorm().eval();
    };
    return space_.scale_smoothness * (squared_steps(space.scale) + squared_steps(space.offset)).dot(shares_);
  }

  double objective(const VectorXd& begins) {
    const VectorXd w = steps_of(begins);
    const double barrier = range_.barrier(w);
    if (!(barrier < kInfinity)) return kInfinity;
    curve_.sample(middles(begins), values_, nullptr);
    const double distance = (warped_ - values_).array().square().matrix().colwise().sum().dot(shares_);
    return distance + roughness_ + stiffness_ * steps_of(w.array().log()).squaredNorm() + barrier;
  }

  /// One Gauss-Newton step, as long as it lowers the objective; false if none does.
  bool step() {
    if (begins_.size() < 3 || !range_.is_open()) return false;
    VectorXd change = VectorXd::Zero(begins_.size());
    change.segment(1, begins_.size() - 2) = equations().solve();
    double part = range_.room(steps_of(begins_), steps_of(change));
    for (int k = 0; k <= kHalvings; ++k, part *= 0.5) {
      const VectorXd tried = begins_ + part * change;
      const double energy = objective(tried);
      if (!(energy < energy_)) continue;
      energy_ = energy;
      begins_ = tried;
      return true;
    }
    return false;
  }

  /// Of the changes of T[1] ... T[m - 1]; half the gradient and the curvature of E.
  FiveDiagonals equations() {
    const Index m = begins_.size() - 1;
    const VectorXd w = steps_of(begins_);
    FiveDiagonals equations(m - 1);
    curve_.sample(middles(begins_), values_, &slopes_);
    for (Index t = 0; t < m; ++t) {
      const auto slope = slopes_.row(t).array();
      const double curvature = (shares_.array() * slope.square()).sum();
      const double pull = (shares_.array() * slope * (warped_.row(t) - values_.row(t)).array()).sum();
      // The square (curvature tau - pull)^2 / curvature; tau is the mean of T[t] and T[t + 1].
      if (curvature > 0.0) equations.add_square(t - 1, curvature, -pull / curvature, 0.5, 0.5, 0.0);
      const double above = w[t] - range_.least, below = range_.greatest - w[t];
      const double bend = 0.5 * kBarrier * (1.0 / (above * above) + 1.0 / (below * below));
      const double slant = 0.5 * kBarrier * (1.0 / below - 1.0 / above);
      equations.add_square(t - 1, bend, slant / bend, -1.0, 1.0, 0.0);
      if (t == 0) continue;
      const double before = 1.0 / w[t - 1], after = 1.0 / w[t];
      equations.add_square(t - 2, stiffness_, std::log(w[t] * before), before, -before - after, after);
    }
    equations.main = (1.0 + kDamping) * equations.main.array() + kRidge;
    return equations;
  }

  FrameMatrix input_;
  Curve curve_;
  Eigen::RowVectorXd shares_;
  const ContinuousWarpOptions& options_;
  double stiffness_;
  SpaceWarpOptions space_;
  SlopeRange range_;
  TimeWarp even_;                // what is compared with the input is in its time already
  FrameMatrix values_, slopes_;  // of the output, at the middles of the input's frames
  FrameMatrix warped_;           // the input in space
  VectorXd begins_;              // T
  double roughness_ = 0.0, energy_ = kInfinity;
};

void check_lengths(Index m, Index n, double limit) {
  const double even = static_cast<double>(n) / static_cast<double>(m);
  if (even <= limit * (1.0 + kNoChoice) && even * limit >= 1.0 - kNoChoice) return;
  const auto frames = static_cast<double>(m);
  throw InvalidArgument("output",
                        std::to_string(std::llround(std::ceil(frames / limit))) + " to " +
                            std::to_string(std::llround(std::floor(frames * limit))) + " frames for an input of " +
                            std::to_string(m) + " frames",
                        std::to_string(n) + " frames", "allow a larger slope limit or trim the longer one");
}

/// Of the time-warp stage, whose cost rises with it: as the paper's, more only where the lengths ask for it.
double starting_limit(Index m, Index n, double limit) {
  const double ratio = static_cast<double>(std::max(m, n)) / static_cast<double>(std::min(m, n));
  return std::max(std::min(limit, kPapersLimit), std::min(limit, kSpareSlope * ratio));
}

void check_start(const Correspondence& start, Index input_frames) {
  const VectorXd& w = start.differential_warp;
  if (start.output_begin != 0.0 || start.output_rest != 0.0) {
    throw InvalidArgument("start", "one that covers the whole output", "open ends");
  }
  if (w.size() == input_frames && w.allFinite() && (w.array() > 0.0).all()) return;
  throw InvalidArgument("start", std::to_string(input_frames) + " positive numbers",
                        w.size() == input_frames ? "another number" : std::to_string(w.size()) + " numbers");
}

}  // namespace

ContinuousWarp refine_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                           const Correspondence& start, double frame_rate, const ContinuousWarpOptions& options) {
  detail::check_signals(input, output);
  check_options(options, frame_rate);
  check_lengths(input.rows(), output.rows(), options.slope_limit);
  check_start(start, input.rows());
  return Refinement(input, output, start.differential_warp, frame_rate, options).run();
}

ContinuousWarp continuous_warp(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                               double frame_rate, const ContinuousWarpOptions& options) {
  check_options(options, frame_rate);
  detail::check_signals(input, output);
  check_lengths(input.rows(), output.rows(), options.slope_limit);
  TimeWarpOptions counts;
  counts.slope_limit = starting_limit(input.rows(), output.rows(), options.slope_limit);
  counts.weights = options.weights;
  const Correspondence counted = time_warp(input, output, counts).correspondence();
  const double frames = kSmoothing * frame_rate;
  return refine_warp(input, output, {smooth_differential_warp(counted.differential_warp, frames * frames)}, frame_rate,
                     options);
}

}  // namespace strut::align
