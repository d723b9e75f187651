// SPDX-License-Identifier: MIT
#include "support/small_model.h"

#include <vector>

#include <gtest/gtest.h>

#include <strut/math/rotation.h>
#include <strut/representation/pose_encoder.h>

namespace strut::representation {
namespace {

constexpr double kRate = 30.0;

Representation representation_of(const Motion& clip) {
  return fit_representation({clip}, Eigen::Quaterniond(0.8, 0.0, 0.6, 0.0));
}

TEST(RowLayout, HasAPlaceForEveryDegreeOfFreedom) {
  const RowLayout layout(kNumRootDofs + 3 * 11);
  EXPECT_EQ(layout.num_joints(), 11);
  EXPECT_EQ(layout.plane(), 16);
  EXPECT_EQ(layout.slot(kForwardVelocity), kForwardVelocity);
  EXPECT_EQ(layout.slot(layout.num_dofs()), RowLayout::kTimeWarp);
  EXPECT_EQ(layout.slot(kNumRootDofs + 3 * 4 + 1), RowLayout::kRotations + 16 + 4);  // y of the fifth joint
  const Eigen::RowVectorXd row = Eigen::RowVectorXd::LinSpaced(layout.num_dofs() + 1, 1.0, 40.0);
  Eigen::RowVectorXd back(row.size());
  layout.unpack(layout.packed<float>(row).data(), back);
  EXPECT_EQ(back, row);
}

/// Encodes and decodes a clip, frame by frame.
template <typename Scalar>
double round_trip_error(const Motion& clip) {
  const Representation style = representation_of(clip);
  PoseEncoder<Scalar> encoder(style, kRate);
  PoseDecoder<Scalar> decoder(style, kRate);
  const auto joints = static_cast<std::size_t>(clip.skeleton().num_joints());
  std::vector<Scalar> rotations(4 * joints), translations(3 * joints);
  const PoseView<Scalar> pose{rotations.data(), translations.data(), clip.skeleton().num_joints()};
  math::AlignedVector<Scalar> row(static_cast<std::size_t>(encoder.layout().num_slots()));
  std::vector<Pose> frames;
  for (const Pose& given : clip.frames()) {
    const auto from = view(given);
    for (std::size_t i = 0; i < rotations.size(); ++i) rotations[i] = static_cast<Scalar>(from.rotations[i]);
    for (std::size_t i = 0; i < translations.size(); ++i) translations[i] = static_cast<Scalar>(from.translations[i]);
    encoder.encode(pose, row.data());
    if (frames.empty()) decoder.restart(encoder.placement());
    decoder.decode(row.data(), pose, pose);
    frames.push_back(given);
    for (std::size_t j = 0; j < joints; ++j) {
      for (int i = 0; i < 4; ++i)
        frames.back().rotations[j].coeffs()[i] = static_cast<double>(rotations[4 * j + static_cast<std::size_t>(i)]);
      frames.back().rotations[j].normalize();
      for (int i = 0; i < 3; ++i)
        frames.back().translations[j][i] = static_cast<double>(translations[3 * j + static_cast<std::size_t>(i)]);
    }
  }
  return test::largest_difference(clip, Motion(clip.shared_skeleton(), kRate, frames));
}

TEST(PoseEncoder, IsUndoneByTheDecoder) {
  const Motion clip = test::turning_motion(kRate, 10.0);
  EXPECT_LT(round_trip_error<double>(clip), 1e-12);
  // In single precision the steps of 300 frames are rounded one by one; rotations are not summed.
  EXPECT_LT(round_trip_error<float>(clip), 1e-5);
}

TEST(PoseEncoder, StartsAnewAfterReset) {
  const Motion clip = test::turning_motion(kRate, 1.0);
  PoseEncoder<double> encoder(representation_of(clip), kRate);
  math::AlignedVector<double> first(static_cast<std::size_t>(encoder.layout().num_slots())), again(first), other(first);
  encoder.encode(view(clip.frame(0)), first.data());
  encoder.encode(view(clip.frame(9)), other.data());
  encoder.reset();
  encoder.encode(view(clip.frame(0)), again.data());
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
}

TEST(PoseDecoder, TakesJoinedRotationsOfAnyLength) {
  const Motion clip = test::turning_motion(kRate, 1.0);
  const Representation style = representation_of(clip);
  PoseDecoder<double> decoder(style, kRate);
  const RowLayout layout(style.num_dofs());
  math::AlignedVector<double> root(RowLayout::kRotations), rotations(static_cast<std::size_t>(4 * layout.plane()), 0.0);
  const Eigen::Quaterniond turn = math::exp_map({0.3, -0.5, 0.2});
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < layout.num_joints(); ++j)
      rotations[static_cast<std::size_t>(i * layout.plane() + j)] = 3.0 * turn.coeffs()[i];
  }
  Pose pose = clip.frame(0);
  decoder.decode(root.data(), rotations.data(), style.upright(), view(clip.frame(0)), view(pose));
  for (const int joint : style.joints()) {
    EXPECT_LT(pose.rotations[static_cast<std::size_t>(joint)].angularDistance(turn), 1e-7);
  }
}

}  // namespace
}  // namespace strut::representation
