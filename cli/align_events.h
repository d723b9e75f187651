// SPDX-License-Identifier: MIT
// How well an alignment puts footplants onto footplants: what a viewer sees first when two clips of walking are played
// in step. No method of alignment looks at footplants, so they can judge one.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/motion/annotation.h>

namespace strut::cli {

/// The footplants of both clips of an alignment; none where a clip has no two legs.
struct AlignPlants {
  std::optional<std::vector<motion::Footplant>> input, output;
};

/// A foot that comes down in the input, and where.
struct OnsetPair {
  int foot = 0;         ///< 0 left, 1 right
  double input = 0.0;   ///< when, in the input [frames]
  double mapped = 0.0;  ///< where the alignment puts that in the output [frames]
  double output = 0.0;  ///< when the same foot comes down there [frames]; meaningless unless paired
  bool is_paired = false;

  [[nodiscard]] double error() const noexcept { return mapped - output; }
};

/// How far the onsets of footplants are from where an alignment puts them.
struct OnsetErrors {
  std::vector<OnsetPair> onsets;    ///< of the input, by foot, then time
  std::vector<OnsetPair> unpaired;  ///< of the output: foot and output alone mean something
  int num_pairs = 0;
  double mean = 0.0;     ///< of the pairs' absolute errors [frames]
  double largest = 0.0;  ///< [frames]

  /// Times a foot comes down in the output.
  [[nodiscard]] int num_outputs() const noexcept { return num_pairs + static_cast<int>(unpaired.size()); }
};

/// Pairs each onset of the input with the onset of the same foot in the output that is nearest to where `output_time`
/// [output frames] (input frames) puts it, if it is the nearest to that one too. A footplant under way when its clip
/// begins has no onset. An alignment that is a step off leaves onsets unpaired at the ends. Cost O(onsets log
/// onsets).
OnsetErrors onset_errors(const std::vector<motion::Footplant>& input, const std::vector<motion::Footplant>& output,
                         const Eigen::VectorXd& output_time);

/// How long the gait cycles between these footplants are, as a median [frames]: from a foot's onset to its next, or
/// twice from one foot's to the other's where there is no more; 0 if there are not two onsets.
double cycle_length(const std::vector<motion::Footplant>& plants);

}  // namespace strut::cli
