// SPDX-License-Identifier: MIT
#include "cycle_alignment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include <strut/align/iterative_motion_warping.h>
#include <strut/blend/gait_loop.h>
#include <strut/math/sampling.h>
#include <strut/representation/relative_root.h>

namespace strut::blend {
namespace {

constexpr int kHarmonics = 3;          // of a warp: heel strike, flat foot, push-off of either foot may each shift
constexpr int kSamples = 96;           // of a cycle in refinement
constexpr int kWarpingSamples = 48;    // in iterative motion warping, whose cost is quadratic
constexpr double kSmoothness = 20.0;   // of its differential warp [samples^2]: about a tenth of the cycle
constexpr int kSteps = 4;              // Gauss-Newton steps per round
constexpr double kStiffness = 0.02;    // of harmonic 1 against what the features say; grows with the harmonic's square
constexpr double kSlowestPace = 0.25;  // of a warp

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Posture without its mean over the cycle: what is left is movement, whatever posture a style holds.
FrameMatrix movement(const Eigen::Ref<const FrameMatrix>& rows, const Eigen::VectorXd& frames) {
  FrameMatrix features = math::sample_rows(rows, frames).rightCols(rows.cols() - representation::kHeight);
  features.rowwise() -= features.colwise().mean().eval();
  return features;
}

class Aligner {
 public:
  Aligner(const std::vector<CutCycle>& cycles, const std::vector<FrameMatrix>& rows, int num_styles)
      : cycles_(cycles), rows_(rows), num_styles_(num_styles), warps_(cycles.size()) {}

  std::vector<CycleWarp> run(int rounds) {
    reference_ = features(medium_cycle(), kSamples);
    for (int i = 0; i < count(); ++i) warp_coarsely(i);
    for (int s = 0; s < num_styles_; ++s) set_style_warp(s, style_warp(s), true);
    for (int round = 0; round < rounds; ++round) {
      centre();
      update_references();
      for (int s = 0; s < num_styles_; ++s) refine_style(s);
      for (int s = 0; s < num_styles_; ++s) refine_cycles(s);
    }
    centre();
    return warps_;
  }

 private:
  [[nodiscard]] FrameMatrix features(int i, int count) const {
    const CutCycle& cycle = cycles_[at(i)];
    return movement(rows_[at(cycle.clip)], frames_of(cycle, warps_[at(i)], count));
  }

  [[nodiscard]] int medium_cycle() const {
    std::vector<int> order(cycles_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), middle, order.end(),
                     [&](int a, int b) { return cycles_[at(a)].speed < cycles_[at(b)].speed; });
    return *middle;
  }

  /// The correspondence to the reference by iterative motion warping, as the nearest periodic warp.
  void warp_coarsely(int i) {
    FrameMatrix input(kWarpingSamples, reference_.cols());
    for (int k = 0; k < kWarpingSamples; ++k) {
      input.row(k) = 0.5 * (reference_.row(2 * k) + reference_.row(2 * k + 1));
    }
    FrameMatrix output = features(i, kWarpingSamples);
    const double unit = std::sqrt(static_cast<double>(input.size()) / std::max(input.squaredNorm(), 1e-12));
    input *= unit;
    output *= unit;
    align::Correspondence found = align::iterative_motion_warping(input, output).correspondence;
    found.differential_warp = align::smooth_differential_warp(found.differential_warp, kSmoothness);
    const Eigen::VectorXd time = found.output_time();
    Eigen::VectorXd series = Eigen::VectorXd::Zero(1 + 2 * kHarmonics);
    for (int k = 0; k < kWarpingSamples; ++k) {
      const double phase = (k + 0.5) / kWarpingSamples;
      series += ((time[k] + 0.5) / kWarpingSamples - phase) * fourier_basis(phase, kHarmonics) / kWarpingSamples;
    }
    warps_[at(i)].set_series(series);
  }

  [[nodiscard]] int count() const { return static_cast<int>(cycles_.size()); }

  [[nodiscard]] std::vector<int> cycles_of(int style) const {
    std::vector<int> own;
    for (int i = 0; i < count(); ++i) {
      if (cycles_[at(i)].style == style) own.push_back(i);
    }
    return own;
  }

  /// The mean warp of a style's cycles.
  [[nodiscard]] Eigen::VectorXd style_warp(int style) const {
    const std::vector<int> own = cycles_of(style);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(1 + 2 * kHarmonics);
    for (const int i : own) mean += warps_[at(i)].series() / static_cast<double>(own.size());
    return mean;
  }

  /// Moves the mean warp of a style's cycles to `series`; `all`: every cycle's warp becomes that.
  void set_style_warp(int style, const Eigen::VectorXd& series, bool all = false) {
    const Eigen::VectorXd change = series - style_warp(style);
    for (const int i : cycles_of(style)) {
      warps_[at(i)].set_series(all ? series : Eigen::VectorXd(warps_[at(i)].series() + change));
    }
  }

  /// Makes the styles' mean warp none, so that phase runs as evenly as the cycles do on average.
  void centre() {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(1 + 2 * kHarmonics);
    for (int s = 0; s < num_styles_; ++s) mean += style_warp(s) / num_styles_;
    for (CycleWarp& warp : warps_) warp.set_series(warp.series() - mean);
  }

  /// The mean of each style's cycles as they are aligned now, and the mean of those.
  void update_references() {
    of_style_.assign(at(num_styles_), FrameMatrix::Zero(reference_.rows(), reference_.cols()));
    reference_.setZero();
    for (int s = 0; s < num_styles_; ++s) {
      const std::vector<int> own = cycles_of(s);
      for (const int i : own) of_style_[at(s)] += features(i, kSamples) / static_cast<double>(own.size());
      reference_ += of_style_[at(s)] / num_styles_;
    }
  }

  /// Brings a style to the mean of all: one change of warp for all its cycles.
  void refine_style(int style) {
    const std::vector<int> own = cycles_of(style);
    for (int step = 0; step < kSteps; ++step) {
      Normal normal;
      for (const int i : own) add_cycle(i, reference_, normal);
      const Eigen::VectorXd mean = style_warp(style);
      set_style_warp(style, mean + normal.step(mean));
    }
  }

  /// Brings the cycles of a style to their mean, which stays where it is: they differ least, so that is where what
  /// belongs together is plainest.
  void refine_cycles(int style) {
    const Eigen::VectorXd mean = style_warp(style);
    for (const int i : cycles_of(style)) {
      for (int step = 0; step < kSteps; ++step) {
        Normal normal;
        add_cycle(i, of_style_[at(style)], normal);
        warps_[at(i)].set_series(warps_[at(i)].series() + normal.step(warps_[at(i)].series() - mean));
      }
    }
    set_style_warp(style, mean);
  }

  /// Normal equations of a Gauss-Newton step.
  struct Normal {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(1 + 2 * kHarmonics, 1 + 2 * kHarmonics);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(1 + 2 * kHarmonics);

    /// The step, where stiffness pulls back what is `bent` already.
    [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& bent) const {
      Eigen::MatrixXd stiff = left;
      Eigen::VectorXd towards = right;
      const double unit = left.trace() / static_cast<double>(left.rows());
      if (!(unit > 0.0)) return Eigen::VectorXd::Zero(right.size());
      for (int h = 1; h <= kHarmonics; ++h) {
        for (const int c : {2 * h - 1, 2 * h}) {
          stiff(c, c) += kStiffness * h * h * unit;
          towards[c] -= kStiffness * h * h * unit * bent[c];
        }
      }
      return stiff.ldlt().solve(towards);
    }
  };

  /// Adds what a cycle's distance to `reference` says about its warp.
  void add_cycle(int i, const FrameMatrix& reference, Normal& normal) const {
    const CutCycle& cycle = cycles_[at(i)];
    const FrameMatrix& rows = rows_[at(cycle.clip)];
    const Eigen::VectorXd frames = frames_of(cycle, warps_[at(i)], kSamples);
    constexpr double kStep = 0.25;  // of the difference quotient [frames]
    const FrameMatrix here = movement(rows, frames);
    const FrameMatrix slope = (movement(rows, frames.array() + kStep) - movement(rows, frames.array() - kStep)) *
                              (cycle.length / (2.0 * kStep));
    for (int k = 0; k < kSamples; ++k) {
      const Eigen::VectorXd basis = fourier_basis((k + 0.5) / kSamples, kHarmonics);
      normal.left += slope.row(k).squaredNorm() * basis * basis.transpose();
      normal.right -= slope.row(k).dot(here.row(k) - reference.row(k)) * basis;
    }
  }

  const std::vector<CutCycle>& cycles_;
  const std::vector<FrameMatrix>& rows_;
  int num_styles_;
  std::vector<CycleWarp> warps_;
  FrameMatrix reference_;
  std::vector<FrameMatrix> of_style_;
};

}  // namespace

CycleWarp::CycleWarp() : series_(Eigen::VectorXd::Zero(1 + 2 * kHarmonics)) {}

double CycleWarp::position(double phase) const {
  return phase + series_.dot(fourier_basis(phase, kHarmonics));
}

double CycleWarp::pace(double phase) const {
  return 1.0 + series_.dot(fourier_basis_rate(phase, kHarmonics));
}

double CycleWarp::phase(double position) const {
  double low = position - 1.0, high = position + 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (this->position(middle) < position ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void CycleWarp::set_series(const Eigen::VectorXd& series) {
  series_ = series;
  series_[0] = std::clamp(series_[0], -0.25, 0.25);
  double slowest = 1.0;
  for (int k = 0; k < kSamples; ++k) slowest = std::min(slowest, pace((k + 0.5) / kSamples));
  if (slowest < kSlowestPace) series_.tail(2 * kHarmonics) *= (1.0 - kSlowestPace) / (1.0 - slowest);
}

Eigen::VectorXd frames_of(const CutCycle& cycle, const CycleWarp& warp, int count) {
  Eigen::VectorXd frames(count);
  for (int k = 0; k < count; ++k) frames[k] = cycle.begin + cycle.length * warp.position((k + 0.5) / count);
  return frames;
}

std::vector<CycleWarp> align_cycles(const std::vector<CutCycle>& cycles, const std::vector<FrameMatrix>& rows,
                                    int num_styles, int rounds) {
  return Aligner(cycles, rows, num_styles).run(rounds);
}

}  // namespace strut::blend
