// SPDX-License-Identifier: MIT
#include "learn/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <strut/model/model_step.h>
#include <strut/motion/kinematics.h>
#include <strut/representation/representation.h>
#include <strut/representation/retime.h>

namespace strut::learn {
namespace {

constexpr std::array kSmoothings = {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8};  // [frames]
constexpr std::array kFastGains = {0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};
constexpr Eigen::Index kEnoughFrames = 1500;  // to know a mean jerk well

/// Joint positions in the heading frame, the pelvis above the origin: (3 x joints) a frame [m].
std::vector<Eigen::Matrix3Xd> body_positions(const representation::Representation& style, FrameMatrix rows,
                                             double frame_rate) {
  rows.leftCols<representation::kHeight>().setZero();  // neither travels nor turns
  const Skeleton& skeleton = style.skeleton();
  Pose bones;
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    bones.rotations.push_back(Eigen::Quaterniond::Identity());
    bones.translations.push_back(skeleton.joint(j).offset);
  }
  const Motion motion = representation::decode(style, rows, frame_rate, {}, style.shared_skeleton(), bones);
  std::vector<Eigen::Matrix3Xd> positions;
  for (const auto& frame : motion::joint_positions_world(motion)) {
    positions.emplace_back(3, skeleton.num_joints());
    for (std::size_t j = 0; j < frame.size(); ++j) positions.back().col(static_cast<Eigen::Index>(j)) = frame[j];
  }
  return positions;
}

/// Mean over frames, joints and axes of the absolute third difference [m/frame^3].
class JerkMean {
 public:
  void add(const representation::Representation& style, const FrameMatrix& rows, double frame_rate) {
    const std::vector<Eigen::Matrix3Xd> x = body_positions(style, rows, frame_rate);
    for (std::size_t t = 3; t < x.size(); ++t) {
      sum_ += (x[t] - 3.0 * x[t - 1] + 3.0 * x[t - 2] - x[t - 3]).cwiseAbs().mean();
      frames_ += 1.0;
    }
  }
  [[nodiscard]] double mean() const { return frames_ > 0.0 ? sum_ / frames_ : 0.0; }

 private:
  double sum_ = 0.0, frames_ = 0.0;
};

/// The input rows of a clip in the output style, re-timed.
FrameMatrix translate(const std::shared_ptr<const StyleModel>& model, const FrameMatrix& rows) {
  ModelStep<double> step(model);
  FrameMatrix output(rows.rows(), model->num_dofs() + 1);
  Eigen::RowVectorXd frame(output.cols());
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    step.step(rows.row(t), frame);
    output.row(t) = frame;
  }
  return representation::retime(output.leftCols(model->num_dofs()), output.col(model->time_warp_dof()));
}

double jerk_of_translations(const Examples& examples, const std::shared_ptr<const StyleModel>& model) {
  JerkMean jerk;
  Eigen::Index frames = 0;
  for (const FrameMatrix& clip : examples.input.clips) {
    if (frames > kEnoughFrames) break;
    jerk.add(model->output(), translate(model, clip), model->frame_rate());
    frames += clip.rows();
  }
  return jerk.mean();
}

}  // namespace

Spectrum choose_spectrum(const Examples& examples, StyleModelParts parts) {
  JerkMean real;
  for (const FrameMatrix& clip : examples.output.clips) {
    real.add(examples.output.representation, clip, examples.frame_rate);
  }
  const auto jerk_with = [&](const Spectrum& spectrum) {
    parts.radial_map->smoothing = spectrum.smoothing;
    parts.radial_map->fast = spectrum.fast;
    return jerk_of_translations(examples, std::make_shared<const StyleModel>(parts)) / std::max(real.mean(), 1e-12);
  };
  Spectrum best;
  double jerk = jerk_with(best);
  const bool is_rough = jerk > 1.0;
  const auto& candidates = is_rough ? kSmoothings : kFastGains;
  for (const double candidate : candidates) {
    const Spectrum trial = is_rough ? Spectrum{candidate, 0.0} : Spectrum{0.0, candidate};
    const double found = jerk_with(trial);
    if (std::abs(std::log(found)) >= std::abs(std::log(jerk))) break;
    best = trial;
    jerk = found;
  }
  return best;
}

}  // namespace strut::learn
