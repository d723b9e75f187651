// SPDX-License-Identifier: MIT
// Reaches of several kinds, slow or sudden, high or low, and someone who labels them and their blends by how they move.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <strut/effort/effort_regression.h>
#include <strut/effort/fragment_features.h>

namespace strut::effort::test {

/// A reach that gets faster and slower: how sharply, how far, how high, how long.
struct Reach {
  double sharpness = 2.0, size = 0.5, height = 1.0, duration = 1.0;
};

/// Fragments, and what is needed to see their blends.
struct Simulation {
  std::vector<Reach> reaches;
  std::vector<LabelledFragment> fragments;
  std::vector<LabelledBlend> blends;
  double noise = 0.0;  ///< of every label
  std::mt19937 random{7};

  static constexpr int kPlaces = 6;

  Simulation(int groups, int per_group, double label_noise) : noise(label_noise) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int group = 0; group < groups; ++group) {
      for (int k = 0; k < per_group; ++k) {
        reaches.push_back(
            {1.5 + 2.0 * unit(random), 0.3 + 0.4 * unit(random), 0.8 + 0.4 * unit(random), 0.8 + 0.8 * unit(random)});
        LabelledFragment fragment;
        fragment.group = group;
        fragment.features = seen(reaches.back(), reaches.back(), 0.0, group);
        fragment.effort = rated(reaches.back(), reaches.back(), 0.0);
        fragments.push_back(std::move(fragment));
      }
    }
  }

  /// `count` blends of random pairs at random alphas, labelled; inside [0, 1] or from -0.5 to 1.5.
  void label(int count, bool beyond = false) {
    std::uniform_real_distribution<double> alpha(beyond ? -0.5 : 0.05, beyond ? 1.5 : 0.95);
    std::uniform_int_distribution<int> any(0, static_cast<int>(fragments.size()) - 1);
    while (static_cast<int>(blends.size()) < count) {
      const int i = any(random), j = any(random);
      if (i == j || fragments[static_cast<std::size_t>(i)].group != fragments[static_cast<std::size_t>(j)].group)
        continue;
      const double a = alpha(random);
      blends.push_back({i, j, a, rated(reaches[static_cast<std::size_t>(i)], reaches[static_cast<std::size_t>(j)], a)});
    }
  }

  static double mixed(double a, double b, double alpha) { return (1.0 - alpha) * a + alpha * b; }

  static FrameMatrix seen(const Reach& a, const Reach& b, double alpha, int group) {
    const auto frames = static_cast<Eigen::Index>(std::lround(mixed(a.duration, b.duration, alpha) * kFeatureRate));
    FrameMatrix features(frames, kPlaces);
    const auto at = [group](const Reach& reach, double u, int k) {
      const double there = std::pow(u, reach.sharpness), back = std::pow(1.0 - u, reach.sharpness);
      return reach.height * (k % 3 == 1) + reach.size * std::sin(1.0 + k + 2.0 * group) * there / (there + back);
    };
    for (Eigen::Index t = 0; t < frames; ++t) {
      const double u = static_cast<double>(t) / static_cast<double>(frames - 1);
      for (int k = 0; k < kPlaces; ++k) features(t, k) = mixed(at(a, u, k), at(b, u, k), alpha);
    }
    return features;
  }

  /// Flow by height, Weight by size, Time by acceleration: drawn together towards -1 and 1.
  EffortVector rated(const Reach& a, const Reach& b, double alpha) {
    std::normal_distribution<double> normal;
    const auto logs = [](const Reach& r) {
      return std::log(r.size) + 1.2 * std::log(r.sharpness) - 2.0 * std::log(r.duration);
    };
    const double loss = 0.5 * alpha * (1.0 - alpha) * std::abs(a.sharpness - b.sharpness);
    EffortVector label(std::tanh(4.0 * (mixed(a.height, b.height, alpha) - 1.0)),
                       std::tanh(5.0 * (mixed(a.size, b.size, alpha) - 0.5)),
                       std::tanh(mixed(logs(a), logs(b), alpha) - loss));
    for (double& value : label) value = std::clamp(value + noise * normal(random), -1.0, 1.0);
    return label;
  }
};

}  // namespace strut::effort::test
