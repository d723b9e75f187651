// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <string>

#include <strut/blend/gait_loop.h>
#include <strut/core/error.h>
#include <strut/representation/relative_root.h>

namespace strut::blend {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kSteps = 64;  // of integrals over a cycle: exact for what the series holds

Eigen::VectorXd log_time_row(const GaitLoop& loop) {
  Eigen::VectorXd row(kSteps);
  for (int k = 0; k < kSteps; ++k) {
    row[k] = loop.series().bottomRows<1>().dot(fourier_basis((k + 0.5) / kSteps, loop.harmonics()));
  }
  return row;
}

}  // namespace

bool PlantPhase::holds(double phase) const noexcept {
  const double since = phase - begin - std::floor(phase - begin);
  return since < end - begin;
}

Eigen::VectorXd fourier_basis(double phase, int harmonics) {
  Eigen::VectorXd basis(1 + 2 * harmonics);
  basis[0] = 1.0;
  for (int h = 1; h <= harmonics; ++h) {
    const double angle = kTwoPi * h * phase;
    basis[2 * h - 1] = std::numbers::sqrt2 * std::cos(angle);
    basis[2 * h] = std::numbers::sqrt2 * std::sin(angle);
  }
  return basis;
}

Eigen::VectorXd fourier_basis_rate(double phase, int harmonics) {
  Eigen::VectorXd rate(1 + 2 * harmonics);
  rate[0] = 0.0;
  for (int h = 1; h <= harmonics; ++h) {
    const double angle = kTwoPi * h * phase;
    rate[2 * h - 1] = -std::numbers::sqrt2 * kTwoPi * h * std::sin(angle);
    rate[2 * h] = std::numbers::sqrt2 * kTwoPi * h * std::cos(angle);
  }
  return rate;
}

GaitLoop::GaitLoop(FrameMatrix series, const std::array<PlantPhase, 2>& plants)
    : series_(std::move(series)), plants_(plants) {
  if (series_.rows() <= representation::kNumRootDofs || series_.cols() < 3 || series_.cols() % 2 == 0) {
    throw InvalidArgument("series", "a row per degree of freedom and one of time, 1 + 2 harmonics columns",
                          std::to_string(series_.rows()) + " x " + std::to_string(series_.cols()));
  }
  bool finite = series_.allFinite();
  for (const PlantPhase& plant : plants_) finite = finite && std::isfinite(plant.begin) && std::isfinite(plant.end);
  if (!finite) throw InvalidArgument("series", "finite numbers", "a number that is not finite");
}

Eigen::VectorXd GaitLoop::at(double phase) const {
  return series_ * fourier_basis(phase, harmonics());
}

Eigen::VectorXd GaitLoop::rate_at(double phase) const {
  return series_ * fourier_basis_rate(phase, harmonics());
}

double GaitLoop::pace(double phase) const {
  return std::exp(-series_.bottomRows<1>().dot(fourier_basis(phase, harmonics())));
}

double GaitLoop::duration() const {
  return log_time_row(*this).array().exp().mean();
}

double GaitLoop::mean(int signal) const {
  const Eigen::VectorXd time = log_time_row(*this).array().exp();
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    sum += time[k] * series_.row(signal).dot(fourier_basis((k + 0.5) / kSteps, harmonics()));
  }
  return sum / time.sum();
}

Eigen::Vector2d GaitLoop::velocity() const {
  const Eigen::VectorXd time = log_time_row(*this).array().exp() / kSteps;
  const double turning = mean(representation::kTurningRate);
  // The way the body faces sways to and fro about its mean, and what is sideways or forward with it.
  Eigen::VectorXd facing(kSteps);
  Eigen::Matrix2Xd step(2, kSteps);
  double turned = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::Vector3d root = series_.topRows<3>() * fourier_basis((k + 0.5) / kSteps, harmonics());
    const double turn = (root[representation::kTurningRate] - turning) * time[k];
    facing[k] = turned + 0.5 * turn;
    turned += turn;
    step.col(k) = root.head<2>() * time[k];
  }
  facing.array() -= facing.dot(time) / time.sum();
  Eigen::Vector2d travelled = Eigen::Vector2d::Zero();
  for (int k = 0; k < kSteps; ++k) {
    const double c = std::cos(facing[k]), s = std::sin(facing[k]);
    travelled += Eigen::Vector2d(c * step(0, k) + s * step(1, k), -s * step(0, k) + c * step(1, k));
  }
  return travelled / time.sum();
}

Eigen::VectorXd GaitLoop::packed() const {
  Eigen::VectorXd numbers(series_.size() + 4);
  numbers.head(series_.size()) = Eigen::Map<const Eigen::VectorXd>(series_.data(), series_.size());
  numbers.tail<4>() << plants_[0].begin, plants_[0].end, plants_[1].begin, plants_[1].end;
  return numbers;
}

GaitLoop GaitLoop::unpacked(const Eigen::Ref<const Eigen::VectorXd>& numbers, int num_signals) {
  const Eigen::Index size = numbers.size() - 4;
  if (num_signals < 1 || size < num_signals || size % num_signals != 0) {
    throw InvalidArgument("numbers", "a whole series of " + std::to_string(num_signals) + " signals and four phases",
                          std::to_string(numbers.size()) + " numbers");
  }
  const Eigen::VectorXd phases = numbers.tail<4>();
  const Eigen::VectorXd series = numbers.head(size);
  return {Eigen::Map<const FrameMatrix>(series.data(), num_signals, size / num_signals),
          {PlantPhase{phases[0], phases[1]}, PlantPhase{phases[2], phases[3]}}};
}

FrameMatrix fit_series(const Eigen::Ref<const FrameMatrix>& samples, const Eigen::Ref<const Eigen::VectorXd>& gap,
                       int harmonics) {
  const Eigen::Index count = samples.rows();
  if (harmonics < 1 || count <= 2 * harmonics || gap.size() != samples.cols()) {
    throw InvalidArgument("samples", "more than " + std::to_string(2 * harmonics) + " rows, and a gap per column",
                          std::to_string(count) + " rows, " + std::to_string(gap.size()) + " gaps");
  }
  // At evenly spread phases the basis stays orthonormal: the least-squares fit is the projection.
  FrameMatrix series = FrameMatrix::Zero(samples.cols(), 1 + 2 * harmonics);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double phase = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    series += (samples.row(k).transpose() - (phase - 0.5) * gap) * fourier_basis(phase, harmonics).transpose();
  }
  return series / static_cast<double>(count);
}

}  // namespace strut::blend
