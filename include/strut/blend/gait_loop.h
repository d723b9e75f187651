// SPDX-License-Identifier: MIT
// One gait cycle that closes: every degree of freedom of the representation, and how fast time runs, as a Fourier
// series of the gait phase. Whatever numbers a series has, its end meets its beginning in value and in every
// derivative; and series add, so that models may be linear in them.
#pragma once

#include <array>

#include <Eigen/Core>

#include <strut/math/frame_matrix.h>

namespace strut::blend {

/// When a foot is planted, in gait phase [cycles].
struct PlantPhase {
  double begin = 0.0;  ///< for the left foot near 0, for the right near 1/2
  double end = 0.0;    ///< later than begin; may be beyond 1

  /// Whether the foot stands at `phase`, whatever whole cycles it holds.
  [[nodiscard]] bool holds(double phase) const noexcept;
};

/// The Fourier basis of `harmonics` at `phase` [cycles]: 1, then sqrt 2 cos and sqrt 2 sin of each harmonic.
/// Orthonormal over a cycle: the sum of a series' squared coefficients is the mean of its square. (1 + 2 harmonics)
Eigen::VectorXd fourier_basis(double phase, int harmonics);

/// Derivative of fourier_basis by the phase [per cycle].
Eigen::VectorXd fourier_basis_rate(double phase, int harmonics);

/// A closed gait cycle. Phase 0 is where the left foot comes down.
class GaitLoop {
 public:
  /// `series` (signals x 1 + 2 harmonics): a row per degree of freedom of representation/representation.h [rad, m, per
  /// second], the last row the logarithm of the time a cycle would take at this phase's pace [ln s].
  /// Throws InvalidArgument if there are no more rows than the root has degrees of freedom, no harmonic, an even number
  /// of columns, or a number is not finite.
  GaitLoop(FrameMatrix series, const std::array<PlantPhase, 2>& plants);

  [[nodiscard]] const FrameMatrix& series() const noexcept { return series_; }
  [[nodiscard]] const std::array<PlantPhase, 2>& plants() const noexcept { return plants_; }
  [[nodiscard]] int harmonics() const noexcept { return static_cast<int>(series_.cols() - 1) / 2; }
  [[nodiscard]] int num_signals() const noexcept { return static_cast<int>(series_.rows()); }

  /// All signals at `phase` [cycles]. Cost O(signals x harmonics).
  [[nodiscard]] Eigen::VectorXd at(double phase) const;
  /// Their derivatives by the phase [per cycle].
  [[nodiscard]] Eigen::VectorXd rate_at(double phase) const;
  /// How fast the phase advances at `phase` [cycles/s], > 0.
  [[nodiscard]] double pace(double phase) const;
  /// Of a whole cycle [s], > 0.
  [[nodiscard]] double duration() const;
  /// Mean over time of a signal.
  [[nodiscard]] double mean(int signal) const;
  /// How far the body gets in a cycle over how long that takes, to the left of the mean direction faced and along it
  /// [m/s]; of a body that walks straight on, its length is the speed.
  [[nodiscard]] Eigen::Vector2d velocity() const;

  /// All numbers in one vector: the series row by row, then begin and end of the left and the right footplant.
  [[nodiscard]] Eigen::VectorXd packed() const;
  /// The inverse. Throws InvalidArgument if the size does not fit `num_signals`, or as the constructor.
  static GaitLoop unpacked(const Eigen::Ref<const Eigen::VectorXd>& numbers, int num_signals);

 private:
  FrameMatrix series_;
  std::array<PlantPhase, 2> plants_;
};

/// The series nearest to `samples` (N x signals) at the phases (k + 1/2) / N, by least squares. What is left between
/// the end of the cycle and the beginning of the next, `gap` (signals), is first distributed evenly over the cycle.
/// Returns signals x (1 + 2 harmonics). Throws InvalidArgument if N <= 2 harmonics or the sizes differ. Cost O(N x
/// signals x harmonics).
FrameMatrix fit_series(const Eigen::Ref<const FrameMatrix>& samples, const Eigen::Ref<const Eigen::VectorXd>& gap,
                       int harmonics);

}  // namespace strut::blend
