// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include <strut/core/error.h>
#include <strut/effort/fragment_features.h>
#include <strut/math/rotation.h>
#include <strut/motion/kinematics.h>
#include <strut/representation/relative_root.h>

namespace strut::effort {
namespace {

using Eigen::Index;

constexpr double kUnitLength = 1e-6;   // how far from length 1 a rotation may be, as for Motion
constexpr double kLeastShare = 1e-12;  // of the largest variance: what lies below is rounding, not a direction

/// Sum over all clips of what `sum` makes of one.
template <typename Sum, typename Of>
Sum over_clips(const std::vector<FrameMatrix>& clips, Sum sum, const Of& of) {
  for (const FrameMatrix& clip : clips) sum += of(clip);
  return sum;
}

void check(const std::vector<FrameMatrix>& clips, int max_dimensions) {
  if (max_dimensions < 1) throw InvalidArgument("max_dimensions", "at least 1", std::to_string(max_dimensions));
  Index frames = 0;
  for (const FrameMatrix& clip : clips) {
    frames += clip.rows();
    if (clip.cols() != clips.front().cols()) {
      throw InvalidArgument("clips", std::to_string(clips.front().cols()) + " features as the first has",
                            std::to_string(clip.cols()));
    }
    if (!clip.allFinite()) throw InvalidArgument("clips", "finite numbers", "one that is not");
  }
  if (frames == 0 || clips.front().cols() == 0) throw InvalidArgument("clips", "at least one frame", "none");
}

/// How many of the ascending variances are worth keeping.
Index count_dimensions(const Eigen::VectorXd& variances, int max_dimensions) {
  const double least = kLeastShare * std::max(variances.maxCoeff(), 0.0);
  const Index moving = (variances.array() > least).count();
  return std::clamp<Index>(moving, 1, max_dimensions);
}

}  // namespace

std::vector<int> feature_joints(const Skeleton& skeleton) {
  std::vector<int> joints{skeleton.pelvis()};
  for (int j = skeleton.pelvis() + 1; j < skeleton.num_joints(); ++j) {
    if (std::binary_search(joints.begin(), joints.end(), skeleton.joint(j).parent)) joints.push_back(j);
  }
  return joints;
}

FrameMatrix joint_features(const Motion& motion, const Eigen::Quaterniond& upright) {
  if (!(std::abs(upright.norm() - 1.0) <= kUnitLength)) {
    throw InvalidArgument("upright", "a rotation", "a quaternion of length " + std::to_string(upright.norm()));
  }
  const std::vector<int> joints = feature_joints(motion.skeleton());
  FrameMatrix features(motion.num_frames(), 3 * static_cast<Index>(joints.size()));
  motion::WorldPose world;
  for (int t = 0; t < motion.num_frames(); ++t) {
    motion::forward_kinematics(motion.skeleton(), motion.frame(t), world);
    const auto pelvis = static_cast<std::size_t>(joints.front());
    const auto place = representation::placement({world.rotations[pelvis], world.positions[pelvis]}, upright);
    const Eigen::Matrix3d turn = math::rotation_about_y(-place.heading).toRotationMatrix();
    const Eigen::Vector3d ground(place.x, 0.0, place.z);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      features.block<1, 3>(t, 3 * static_cast<Index>(k)) =
          (turn * (world.positions[static_cast<std::size_t>(joints[k])] - ground)).transpose();
    }
  }
  return features;
}

FeatureSpace fit_feature_space(const std::vector<FrameMatrix>& clips, int max_dimensions) {
  check(clips, max_dimensions);
  const Index features = clips.front().cols();
  const auto frames = static_cast<double>(over_clips(clips, Index{0}, [](const auto& clip) { return clip.rows(); }));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(features);
  FeatureSpace space;
  space.mean = over_clips(clips, zero,
                          [](const FrameMatrix& clip) -> Eigen::VectorXd { return clip.colwise().sum().transpose(); }) /
               frames;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(features, features);
  const auto scatter = [&](const FrameMatrix& clip) -> Eigen::MatrixXd {
    const FrameMatrix centred = clip.rowwise() - space.mean.transpose();
    return centred.transpose() * centred;
  };
  const Eigen::MatrixXd covariance = over_clips(clips, none, scatter) / frames;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::VectorXd& variances = solver.eigenvalues();
  const Index dimensions = count_dimensions(variances, max_dimensions);
  space.components = solver.eigenvectors().rightCols(dimensions).rowwise().reverse();
  for (Index d = 0; d < dimensions; ++d) {
    // An eigenvector's sign is a matter of the solver: the largest entry shall be positive.
    Index largest = 0;
    space.components.col(d).cwiseAbs().maxCoeff(&largest);
    if (space.components(largest, d) < 0.0) space.components.col(d) *= -1.0;
  }
  const double total = variances.cwiseMax(0.0).sum();
  space.kept = total > 0.0 ? std::min(1.0, variances.tail(dimensions).cwiseMax(0.0).sum() / total) : 1.0;
  return space;
}

FrameMatrix project(const FeatureSpace& space, const Eigen::Ref<const FrameMatrix>& features) {
  if (features.cols() != space.mean.size()) {
    throw InvalidArgument("features", std::to_string(space.mean.size()) + " columns", std::to_string(features.cols()));
  }
  return (features.rowwise() - space.mean.transpose()) * space.components;
}

}  // namespace strut::effort
