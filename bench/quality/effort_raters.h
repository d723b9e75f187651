// SPDX-License-Identifier: MIT
// Synthetic raters: four kinds of expert who label any movement by what it looks like, so that it can be known how well
// their labels are predicted. None of them stands for a person.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/effort/descriptors.h>
#include <strut/effort/effort.h>
#include <strut/motion/motion.h>

namespace strut::study {

/// What raters go by beside the engine's descriptors: of the root mean square speed of all joints, unweighted.
enum Cue {
  kHalts = effort::kNumDescriptors,  ///< speed maxima per second that stand out of the minima beside them
  kBusyShare,                        ///< share of the time above half of the greatest speed
  kBurst,                            ///< log of the greatest speed over the mean
  kSinking,                          ///< how far the pelvis goes up and down, per its greatest height
  kLowest,                           ///< the pelvis's least height [log m]
  kFastestJoint,                     ///< log of the greatest speed of any joint
  kNumCues
};

/// describe(), then the cues above (kNumCues).
Eigen::VectorXd movement_cues(const Motion& motion);

/// What is usual in each group, so that a rater judges a movement against others of its content.
struct CueScale {
  std::vector<effort::DescriptorScale> descriptors;
  std::vector<Eigen::VectorXd> mean, deviation;

  [[nodiscard]] Eigen::VectorXd standardized(int group, const Eigen::VectorXd& cues) const;
};
CueScale cue_scale(const std::vector<Eigen::VectorXd>& cues, const std::vector<int>& groups, int num_groups);

enum class RaterKind {
  kPlain,        ///< each factor is one cue: minus hand smoothness, minus height, log acceleration
  kInteracting,  ///< other cues, of which one changes what another says
  kCounting,     ///< counts halts and looks at the whole body; answers in quarters, and 0 where little is seen
  kHidden,       ///< the plain rater, and beside it something that is in no movement: an intent of each showing's own
};
inline constexpr int kNumRaterKinds = 4;
inline constexpr const char* kRaterNames[kNumRaterKinds] = {"plain", "interacting", "counting", "hidden cue"};

/// What is shown to a rater.
struct Showing {
  int group = 0;
  Eigen::VectorXd cues;
  std::uint64_t id = 0;  ///< the same for the same movement
};
std::uint64_t fragment_id(int fragment);
std::uint64_t blend_id(int first, int second, double alpha);

/// A synthetic rater.
class Rater {
 public:
  Rater(RaterKind kind, double noise, CueScale scale, std::uint64_t seed = 1)
      : kind_(kind), noise_(noise), scale_(std::move(scale)), seed_(seed) {}

  /// What it would say without noise.
  [[nodiscard]] effort::EffortVector judged(const Showing& shown) const;
  /// What it says the `repeat`-th time, in [-1, 1].
  [[nodiscard]] effort::EffortVector label(const Showing& shown, int repeat = 0) const;

 private:
  RaterKind kind_;
  double noise_;
  CueScale scale_;
  std::uint64_t seed_;
};

}  // namespace strut::study
