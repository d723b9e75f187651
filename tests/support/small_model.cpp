// SPDX-License-Identifier: MIT
#include "support/small_model.h"

#include <algorithm>
#include <cmath>

#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>

namespace strut::test {
namespace {

Pose pose_at(const Skeleton& skeleton, double t) {
  Pose pose = rest_pose(skeleton);
  pose.translations[1] = {std::sin(0.5 * t), 0.9 + 0.03 * std::sin(7 * t), 1.2 * t};
  for (std::size_t j = 1; j < pose.rotations.size(); ++j) {
    const double phase = static_cast<double>(j);
    pose.rotations[j] =
        math::exp_map({2.0 + 0.4 * std::sin(4 * t + phase), 0.3 * std::cos(3 * t), 0.2 * std::sin(2 * t + phase)});
  }
  pose.rotations[1] =
      math::rotation_about_y(0.5 * t) * math::exp_map({0.2 * std::sin(5 * t), 0.0, 0.1 + 0.1 * std::cos(4 * t)});
  return pose;
}

}  // namespace

std::shared_ptr<const Skeleton> small_body() {
  return std::make_shared<const Skeleton>(std::vector<Joint>{{"root", -1, {0, 0, 0}},
                                                             {"pelvis", 0, {0, 0.9, 0}},
                                                             {"left", 1, {0.1, 0, 0}},
                                                             {"right", 1, {-0.1, 0, 0}},
                                                             {"spine", 1, {0, 0.2, 0}},
                                                             {"head", 4, {0, 0.3, 0}}});
}

Motion turning_motion(double frame_rate, double duration) {
  const auto skeleton = small_body();
  std::vector<Pose> frames;
  for (int i = 0; i < static_cast<int>(duration * frame_rate); ++i)
    frames.push_back(pose_at(*skeleton, i / frame_rate));
  return {skeleton, frame_rate, std::move(frames)};
}

StyleModelParts copying_parts(const Motion& clip, double log_time_warp) {
  const auto rep = representation::fit_representation({clip}, Eigen::Quaterniond::Identity());
  const int dofs = rep.num_dofs();
  Eigen::VectorXd output_mean = Eigen::VectorXd::Zero(dofs + 1);
  output_mean[dofs] = log_time_warp;
  StyleModelParts parts{clip.frame_rate(),
                        rep,
                        rep,
                        {Eigen::VectorXd::Zero(dofs), Eigen::VectorXd::Ones(dofs)},
                        {output_mean, Eigen::VectorXd::Ones(dofs + 1)},
                        {},
                        {},
                        {},
                        R"({"made": "by hand"})"};
  for (int d = 0; d < dofs; ++d) {
    parts.blocks.push_back(
        {rep.dof_name(d),
         {d},
         {d},
         sysid::LtiSystem({}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0), Eigen::MatrixXd::Ones(1, 1))});
  }
  return parts;
}

StyleModelParts exaggerating_parts(const Motion& clip, double pose, double movement) {
  StyleModelParts parts = copying_parts(clip);
  std::vector<Eigen::Quaterniond> means = parts.output.mean_rotations();
  for (const int joint : parts.output.joints()) {
    Eigen::Quaterniond& mean = means[static_cast<std::size_t>(joint)];
    mean = math::exp_map({pose, 0.0, 0.0}) * mean;
  }
  parts.output = {parts.output.shared_skeleton(), means, parts.output.upright(), parts.output.travel_joint()};
  for (StyleBlock& block : parts.blocks) {
    if (block.output_dofs[0] < representation::kNumRootDofs) continue;
    block.system =
        sysid::LtiSystem({}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0), movement * Eigen::MatrixXd::Ones(1, 1));
  }
  return parts;
}

RadialMap some_radial_map(int num_dofs, int centres) {
  constexpr int kContexts = 2;
  const std::vector<int> lags = {0, 3};
  const auto some = [](Eigen::Index rows, Eigen::Index cols, double size, double phase) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(
        rows, cols, [&](auto r, auto c) { return size * std::sin(phase + 1.3 * double(r) + 2.9 * double(c)); });
  };
  return {.lags = lags,
          .basis = {some(kContexts * std::ssize(lags), centres, 0.5, 0.1), 0.3},
          .input = some(num_dofs, centres, 0.2, 0.2),
          .output = some(num_dofs + 1, centres, 0.2, 0.3),
          .smoothing = 0.7,
          .spread = Eigen::VectorXd::LinSpaced(num_dofs, 0.1, 0.2),
          .fast = 0.4,
          .share = Eigen::VectorXd::LinSpaced(num_dofs, 0.2, 0.6)};
}

StyleModelParts radial_parts(const Motion& clip, int centres) {
  StyleModelParts parts = copying_parts(clip);
  const int dofs = parts.input.num_dofs();
  parts.blocks.clear();
  parts.context = Eigen::MatrixXd::Zero(2, dofs);
  parts.context(0, representation::kNumRootDofs) = 1.0;
  parts.context(1, representation::kHeight) = parts.context(1, dofs - 1) = 0.5;
  parts.radial_map = some_radial_map(dofs, centres);
  return parts;
}

std::vector<std::shared_ptr<const StyleModel>> remembering_models(const Motion& clip) {
  auto parts = copying_parts(clip);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  for (auto& block : parts.blocks) block.system = sysid::LtiSystem(0.5 * one, one, 0.3 * one, 0.7 * one);
  return {std::make_shared<const StyleModel>(std::move(parts)), std::make_shared<const StyleModel>(radial_parts(clip))};
}

double largest_difference(const Motion& a, const Motion& b) {
  double largest = a.num_frames() == b.num_frames() ? 0.0 : 1e9;
  for (int t = 0; t < std::min(a.num_frames(), b.num_frames()); ++t) {
    const auto x = motion::forward_kinematics(a.skeleton(), a.frame(t));
    const auto y = motion::forward_kinematics(b.skeleton(), b.frame(t));
    for (std::size_t j = 1; j < x.positions.size(); ++j) {
      largest = std::max(largest, (x.positions[j] - y.positions[j]).norm());
      largest = std::max(largest, (x.rotations[j].conjugate() * y.rotations[j]).vec().norm());
    }
  }
  return largest;
}

}  // namespace strut::test
