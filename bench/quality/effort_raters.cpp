// SPDX-License-Identifier: MIT
#include "effort_raters.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <utility>

#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>

namespace strut::study {
namespace {

using effort::EffortVector;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFarthest = 3.0;   // a cue counts up to so many deviations
constexpr double kStandsOut = 1.2;  // a maximum of speed against the minima beside it
constexpr double kQuarter = 0.25;   // steps of the counting rater
constexpr double kUnseen = 0.2;     // below which it says 0
constexpr double kIntent = 0.35;    // of the hidden cue

/// Speed maxima that are kStandsOut times the least since the one before and until the next.
int count_halts(const VectorXd& speed) {
  int count = 0;
  double least = speed[0], most = speed[0];
  bool rises = true;
  for (Index i = 1; i < speed.size(); ++i) {
    if (rises) {
      most = std::max(most, speed[i]);
      if (speed[i] * kStandsOut >= most) continue;
      ++count;
      least = speed[i];
    } else {
      least = std::min(least, speed[i]);
      if (speed[i] <= least * kStandsOut) continue;
      most = speed[i];
    }
    rises = !rises;
  }
  return count;
}

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9E3779B97F4A7C15ULL + b;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

EffortVector random_vector(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

EffortVector plain(const VectorXd& z) {
  return {std::tanh(-0.6 * z[effort::kHandSmoothness]), std::tanh(-0.6 * z[effort::kHeight]),
          std::tanh(0.6 * z[effort::kLogAcceleration])};
}

/// Jerk for its speed binds, unless the way is curved; braking is strong, more so from low down; a burst is sudden,
/// more so in a short movement.
EffortVector interacting(const VectorXd& z) {
  const double jerky = z[effort::kLogJerk] - z[effort::kLogMeanSpeed];
  const double low = -z[effort::kHeight], braking = z[effort::kLogPeakDeceleration];
  const double shortness = -z[effort::kLogDuration];
  return {std::tanh(0.6 * jerky - 0.25 * z[effort::kCurvature] * z[effort::kExtent]),
          std::tanh(0.45 * braking + 0.35 * low + 0.25 * braking * low),
          std::tanh(0.45 * z[kBurst] * (1.0 + 0.5 * std::tanh(shortness)) + 0.45 * shortness)};
}

EffortVector counting(const VectorXd& z) {
  EffortVector said{std::tanh(0.6 * z[kHalts]), std::tanh(0.5 * z[kSinking] - 0.4 * z[kLowest]),
                    std::tanh(0.5 * z[kFastestJoint] - 0.3 * z[kBusyShare])};
  for (double& value : said) value = std::abs(value) < kUnseen ? 0.0 : kQuarter * std::round(value / kQuarter);
  return said;
}

}  // namespace

VectorXd movement_cues(const Motion& motion) {
  const auto positions = motion::joint_positions_world(motion::resample(motion, effort::kDescriptorRate));
  const int pelvis = motion.skeleton().pelvis();
  const auto joints = positions[0].size();
  VectorXd speed = VectorXd::Zero(static_cast<Index>(positions.size()) - 1);
  double fastest = 0.0, highest = -1e9, least = 1e9, ground = 1e9;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double height = positions[i][static_cast<std::size_t>(pelvis)].y();
    highest = std::max(highest, height);
    least = std::min(least, height);
    for (std::size_t j = static_cast<std::size_t>(pelvis); j < joints; ++j) {
      ground = std::min(ground, positions[i][j].y());
      if (i == 0) continue;
      const double moved = effort::kDescriptorRate * (positions[i][j] - positions[i - 1][j]).norm();
      fastest = std::max(fastest, moved);
      speed[static_cast<Index>(i) - 1] += moved * moved / static_cast<double>(joints);
    }
  }
  speed = speed.cwiseSqrt();
  VectorXd cues(static_cast<Index>(kNumCues));
  cues.head(effort::kNumDescriptors) = effort::describe(motion);
  cues[kHalts] = count_halts(speed) * effort::kDescriptorRate / static_cast<double>(speed.size());
  cues[kBusyShare] = (speed.array() > 0.5 * speed.maxCoeff()).cast<double>().mean();
  cues[kBurst] = std::log((speed.maxCoeff() + 1e-6) / (speed.mean() + 1e-6));
  cues[kSinking] = (highest - least) / (highest - ground + 1e-6);
  cues[kLowest] = std::log(std::max(least - ground, 1e-3));
  cues[kFastestJoint] = std::log(fastest + 1e-6);
  return cues;
}

VectorXd CueScale::standardized(int group, const VectorXd& cues) const {
  const auto g = static_cast<std::size_t>(group);
  VectorXd z = (cues - mean[g]).cwiseQuotient(deviation[g].cwiseMax(1e-9));
  z.head(effort::kNumDescriptors) = effort::standardized(descriptors[g], cues.head(effort::kNumDescriptors));
  return z.cwiseMax(-kFarthest).cwiseMin(kFarthest);
}

CueScale cue_scale(const std::vector<VectorXd>& cues, const std::vector<int>& groups, int num_groups) {
  CueScale scale;
  for (int group = 0; group < num_groups; ++group) {
    Eigen::MatrixXd rows(0, static_cast<Index>(kNumCues));
    for (std::size_t i = 0; i < cues.size(); ++i) {
      if (groups[i] != group) continue;
      rows.conservativeResize(rows.rows() + 1, rows.cols());
      rows.row(rows.rows() - 1) = cues[i].transpose();
    }
    scale.mean.emplace_back(rows.colwise().mean().transpose());
    const Eigen::MatrixXd centred = rows.rowwise() - scale.mean.back().transpose();
    scale.deviation.emplace_back(centred.colwise().norm().transpose() / std::sqrt(static_cast<double>(rows.rows())));
    scale.descriptors.push_back(effort::descriptor_scale(rows.leftCols(effort::kNumDescriptors)));
  }
  return scale;
}

std::uint64_t fragment_id(int fragment) {
  return mixed(17, static_cast<std::uint64_t>(fragment));
}

std::uint64_t blend_id(int first, int second, double alpha) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &alpha, sizeof bits);
  return mixed(mixed(fragment_id(first), static_cast<std::uint64_t>(second)), bits);
}

EffortVector Rater::judged(const Showing& shown) const {
  const VectorXd z = scale_.standardized(shown.group, shown.cues);
  EffortVector said = EffortVector::Zero();
  switch (kind_) {
    case RaterKind::kPlain:
      said = plain(z);
      break;
    case RaterKind::kInteracting:
      said = interacting(z);
      break;
    case RaterKind::kCounting:
      said = counting(z);
      break;
    case RaterKind::kHidden:
      said = plain(z) + kIntent * random_vector(mixed(seed_, shown.id));
      break;
  }
  return said.cwiseMax(-1.0).cwiseMin(1.0);
}

EffortVector Rater::label(const Showing& shown, int repeat) const {
  const std::uint64_t seed = mixed(mixed(seed_ + 99, shown.id), static_cast<std::uint64_t>(repeat));
  return (judged(shown) + noise_ * random_vector(seed)).cwiseMax(-1.0).cwiseMin(1.0);
}

}  // namespace strut::study
