// SPDX-License-Identifier: MIT
#include <vector>

#include <strut/motion/legs.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::representation {
FrameMatrix alignment_features(const FrameMatrix& rows, const Normalization& own, const Normalization& other) {
  FrameMatrix features = own.normalize(rows).rightCols(rows.cols() - kHeight);
  for (Eigen::Index dof = 0; dof < features.cols(); ++dof) {
    if (!other.is_kept(static_cast<int>(dof) + kHeight)) features.col(dof).setZero();
  }
  return features;
}

AlignmentPair alignment_features(const Motion& input, const Motion& output, StyleUnits units) {
  const bool shared = units == StyleUnits::kShared;
  const std::vector<Motion> both{input, output};
  const Eigen::Quaterniond upright = motion::upright_reference(input);
  const auto of_input = fit_representation(shared ? both : std::vector{input}, upright);
  const auto of_output = shared ? of_input : fit_representation({output}, upright);
  check_skeleton(of_input, output.skeleton());
  const FrameMatrix u = encode(of_input, input), y = encode(of_output, output);
  const auto scaling_of_input = fit_normalization(shared ? std::vector{u, y} : std::vector{u});
  const auto scaling_of_output = shared ? scaling_of_input : fit_normalization({y});
  return {alignment_features(u, scaling_of_input, scaling_of_output),
          alignment_features(y, scaling_of_output, scaling_of_input)};
}

}  // namespace strut::representation
