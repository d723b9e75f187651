// SPDX-License-Identifier: MIT
// Finds which moment of a normal step belongs to which moment of a limping one, by the continuous warp that learning
// aligns with, and holds it against the truth, which the generator of the two walks knows.
#include <cmath>
#include <cstdio>
#include <vector>

#include <strut/align/continuous_warp.h>
#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/representation/alignment_features.h>

int main() {
  try {
    // 1. The same few steps, walked in two styles.
    const strut::generate::WalkContent content{.duration = 3.0, .speed = 1.2};
    const auto normal = strut::generate::generate_walk(content, {}, 30.0);
    const auto limping = strut::generate::generate_walk(content, {.cadence_scale = 0.85, .limp = 0.7}, 30.0);

    // 2. Alignment sees signals, not skeletons: a row per frame, a column per degree of freedom, each of unit variance,
    //    and what each counts. Here: posture, how it changes, and how still the feet are.
    const auto signals = strut::representation::timing_features(normal.motion, limping.motion);
    strut::align::ContinuousWarpOptions options;
    options.weights = signals.weights;
    const auto aligned = strut::align::continuous_warp(signals.input, signals.output, 30.0, options);
    std::printf("%zu steps; E from %.2f to %.2f\n", aligned.objective.size(), aligned.objective.front(),
                aligned.objective.back());

    // 3. Where each input frame lies in the output's time, beside where it truly does.
    const Eigen::VectorXd found = aligned.correspondence.output_time();
    const std::vector<double> truth = strut::generate::true_correspondence(normal, limping);
    double error = 0.0;
    for (Eigen::Index t = 0; t < found.size(); ++t) error += std::abs(found[t] - truth[static_cast<std::size_t>(t)]);
    std::printf("mean timing error: %.2f frames of %d\n", error / static_cast<double>(found.size()),
                limping.motion.num_frames());
    return 0;
  } catch (const strut::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
