// SPDX-License-Identifier: MIT
// Chooses how much of a residual each part of the process explains, and how far it reaches, by coordinate search in
// logarithms. What is raised: the marginal likelihood (Rasmussen and Williams 2006, section 5.4.1), plus the density of
// the labels of fragments, and of groups, left out (section 5.4.2, in blocks), plus a prior around the defaults, which
// decides where there are few labels. Then deviations are scaled so that they cover left-out fragments' labels.
#include "effort/residual_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace strut::effort::detail {
namespace {

using Blends = std::vector<LabelledBlend>;

// Blends that settings are looked for on, and that they are refined on; more would change them by little.
constexpr std::size_t kRoughBlends = 120, kMostBlends = 240;
constexpr int kFragmentFolds = 3;                    // a partition of fragments
constexpr int kPartitions = 2;                       // of fragments, each into kFragmentFolds
constexpr std::size_t kLeastGroups = 3;              // that groups are left out of
constexpr double kPriorDeviation = 1.0;              // of logarithms of settings
constexpr double kFirstStep = 0.8, kLastStep = 0.4;  // of logarithms of settings
constexpr int kMostSweeps = 3;                       // by one step
constexpr double kLeastSetting = 1e-3;
constexpr double kCoverage = 0.9, kNormalQuantile = 1.6448536269514722;  // of 90 % of a normal distribution
// As many labels as the calibration of none counts for.
constexpr double kPriorLabels = 20.0;

using Setting = double ResidualSettings::*;
constexpr std::array<Setting, 8> kAll = {&ResidualSettings::misfit,      &ResidualSettings::noise,
                                         &ResidualSettings::kinematics,  &ResidualSettings::labels,
                                         &ResidualSettings::posture,     &ResidualSettings::label_reach,
                                         &ResidualSettings::alpha_reach, &ResidualSettings::posture_reach};
constexpr std::size_t kNumLinear = 2;  // the first of them are all that linear labels have

/// Blends that are not seen together, and those of them that are predicted.
struct Block {
  std::vector<int> hidden, judged;
};

/// Which part of a partition a fragment is in: spread over every group, by an order that mixes neighbours.
int fold_of(int fragment, int partition) {
  const unsigned mixed =
      (static_cast<unsigned>(fragment) + 1U) * 2654435761U + static_cast<unsigned>(partition) * 40503U;
  return static_cast<int>((mixed >> 13U) % kFragmentFolds);
}

/// Blends that touch a fold's fragments are hidden; judged are those with both.
std::vector<Block> fragment_blocks(const Blends& blends) {
  std::vector<Block> blocks;
  for (int partition = 0; partition < kPartitions; ++partition) {
    for (int fold = 0; fold < kFragmentFolds; ++fold) {
      Block block;
      for (std::size_t n = 0; n < blends.size(); ++n) {
        const bool first = fold_of(blends[n].first, partition) == fold;
        const bool second = fold_of(blends[n].second, partition) == fold;
        if (first || second) block.hidden.push_back(static_cast<int>(n));
        if (first && second) block.judged.push_back(static_cast<int>(block.hidden.size()) - 1);
      }
      if (!block.judged.empty() && block.hidden.size() < blends.size()) blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

std::vector<Block> group_blocks(const BlendInputs& inputs, const Blends& blends) {
  const auto group_of = [&](const LabelledBlend& blend) { return inputs.parts().group[blend.first]; };
  std::set<int> groups;
  for (const LabelledBlend& blend : blends) groups.insert(group_of(blend));
  if (groups.size() < kLeastGroups) return {};
  std::vector<Block> blocks;
  for (const int group : groups) {
    Block block;
    for (std::size_t n = 0; n < blends.size(); ++n) {
      if (group_of(blends[n]) != group) continue;
      block.judged.push_back(static_cast<int>(block.hidden.size()));
      block.hidden.push_back(static_cast<int>(n));
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Errors of judged blends, and the deviations they were expected to have.
struct LeftOut {
  std::vector<double> errors, deviations;

  [[nodiscard]] double mean_log_density() const {
    double sum = 0.0;
    for (std::size_t n = 0; n < errors.size(); ++n) {
      const double z = errors[n] / deviations[n];
      sum -= 0.5 * (z * z + std::log(2.0 * std::numbers::pi)) + std::log(deviations[n]);
    }
    return errors.empty() ? 0.0 : sum / static_cast<double>(errors.size());
  }
};

/// A subset of labelled blends that settings are judged on.
class Judge {
 public:
  Judge(const BlendInputs& inputs, int factor, Blends blends)
      : inputs_(inputs),
        factor_(factor),
        blends_(std::move(blends)),
        terms_(inputs.terms(blends_, factor)),
        residuals_(residuals(inputs, factor, blends_)),
        by_fragment_(fragment_blocks(blends_)),
        by_group_(group_blocks(inputs, blends_)) {}

  /// The higher the better.
  [[nodiscard]] double score(const ResidualSettings& settings) const {
    const Given given = condition(settings);
    const double count = static_cast<double>(blends_.size());
    double result = given.log_likelihood / count + log_prior(settings) / count;
    if (!by_fragment_.empty()) result += left_out(given, by_fragment_).mean_log_density();
    if (!by_group_.empty()) result += left_out(given, by_group_).mean_log_density();
    return result;
  }

  /// What deviations have to be multiplied by so that 90 % intervals hold 90 % of what was left out.
  [[nodiscard]] double calibration(const ResidualSettings& settings) const {
    if (by_fragment_.empty()) return 1.0;
    const LeftOut found = left_out(condition(settings), by_fragment_);
    std::vector<double> ratios;
    for (std::size_t n = 0; n < found.errors.size(); ++n) {
      ratios.push_back(std::abs(found.errors[n]) / found.deviations[n]);
    }
    const double count = static_cast<double>(ratios.size());
    const auto rank = std::min(ratios.size() - 1, static_cast<std::size_t>(std::ceil(kCoverage * (count + 1.0))) - 1);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(rank), ratios.end());
    const double needed = std::clamp(ratios[rank] / kNormalQuantile, 0.5, 2.0);
    return std::pow(needed, count / (count + kPriorLabels));
  }

 private:
  struct Given {
    Eigen::MatrixXd inverse;  // of the labels' covariance
    Eigen::VectorXd weights;
    double log_likelihood = 0.0;
  };

  [[nodiscard]] Given condition(const ResidualSettings& settings) const {
    const ResidualKernel kernel(inputs_, factor_, settings);
    Eigen::MatrixXd covariance = kernel.between(blends_, terms_, blends_, terms_);
    covariance.diagonal() += kernel.label_variance(blends_);
    const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
    Given given;
    given.inverse = llt.solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
    given.weights = given.inverse * residuals_;
    const Eigen::MatrixXd& factor = llt.matrixLLT();
    given.log_likelihood = -0.5 * residuals_.dot(given.weights) - factor.diagonal().array().log().sum() -
                           0.5 * static_cast<double>(blends_.size()) * std::log(2.0 * std::numbers::pi);
    return given;
  }

  /// Given all other blends, a hidden block's labels have covariance ([K^-1]_bb)^-1 and errors that times [K^-1 r]_b.
  static LeftOut left_out(const Given& given, const std::vector<Block>& blocks) {
    LeftOut found;
    for (const Block& block : blocks) {
      const Eigen::LLT<Eigen::MatrixXd> llt(given.inverse(block.hidden, block.hidden));
      const auto size = static_cast<Eigen::Index>(block.hidden.size());
      const Eigen::MatrixXd covariance = llt.solve(Eigen::MatrixXd::Identity(size, size));
      const Eigen::VectorXd errors = covariance * given.weights(block.hidden);
      for (const int n : block.judged) {
        found.errors.push_back(errors[n]);
        found.deviations.push_back(std::sqrt(covariance(n, n)));
      }
    }
    return found;
  }

  static double log_prior(const ResidualSettings& settings) {
    const ResidualSettings defaults;
    double sum = 0.0;
    for (const Setting setting : kAll) {
      if (settings.*setting == 0.0) continue;
      const double z = std::log(settings.*setting / (defaults.*setting)) / kPriorDeviation;
      sum -= 0.5 * z * z;
    }
    return sum;
  }

  const BlendInputs& inputs_;
  int factor_;
  Blends blends_;
  Eigen::MatrixXd terms_;
  Eigen::VectorXd residuals_;
  std::vector<Block> by_fragment_, by_group_;
};

/// Evenly over the list.
Blends thinned(const Blends& blends, std::size_t most) {
  if (blends.size() <= most) return blends;
  Blends result;
  for (std::size_t n = 0; n < most; ++n) result.push_back(blends[n * blends.size() / most]);
  return result;
}

/// Steps every setting up and down, by ever smaller steps, and keeps what scores higher.
ResidualSettings climb(const Judge& judge, ResidualSettings settings, std::size_t count, double first_step) {
  double best = judge.score(settings);
  for (double step = first_step; step >= kLastStep; step *= 0.5) {
    bool improved = true;
    for (int sweep = 0; improved && sweep < kMostSweeps; ++sweep) {
      improved = false;
      for (std::size_t k = 0; k < count; ++k) {
        for (const double ratio : {std::exp(step), std::exp(-step)}) {
          ResidualSettings tried = settings;
          tried.*kAll[k] = std::max(kLeastSetting, tried.*kAll[k] * ratio);
          const double score = judge.score(tried);
          if (!(score > best)) continue;
          best = score;
          settings = tried;
          improved = true;
          break;
        }
      }
    }
  }
  return settings;
}

}  // namespace

ResidualSettings choose_settings(const BlendInputs& inputs, int factor, const Blends& blends, bool is_linear) {
  ResidualSettings settings;
  if (is_linear) settings.kinematics = settings.labels = settings.posture = 0.0;
  const Blends rated = rated_blends(inputs, factor, blends);
  if (rated.empty()) return settings;
  const std::size_t count = is_linear ? kNumLinear : kAll.size();
  if (rated.size() > kRoughBlends) {
    settings = climb(Judge(inputs, factor, thinned(rated, kRoughBlends)), settings, count, kFirstStep);
  }
  const Judge judge(inputs, factor, thinned(rated, kMostBlends));
  settings = climb(judge, settings, count, rated.size() > kRoughBlends ? kLastStep : kFirstStep);
  settings.calibration = judge.calibration(settings);
  return settings;
}

}  // namespace strut::effort::detail
