// SPDX-License-Identifier: MIT
// Conventions: by hand on single joints; against the rotation matrices that they stand for; and through a translator,
// which must do the same whatever convention its frames come in.
#include "c/handles.h"
#include "support/small_model.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

using testing::FloatNear;
using testing::Pointwise;

constexpr float kRounding = 1e-6F;        // of numbers about 1
constexpr float kUnitRounding = 1e-4F;    // of lengths of about 100 units
constexpr float kStreamRounding = 2e-5F;  // metres and unit quaternions after a hundred steps from rounded units

constexpr std::array kConventions = {STRUT_CONVENTION_STRUT, STRUT_CONVENTION_GLTF, STRUT_CONVENTION_UNITY,
                                     STRUT_CONVENTION_UNREAL, STRUT_CONVENTION_BLENDER};

/// One joint, from strut's convention to another.
Frame in_convention(const Frame& frame, const strut_axes& axes) {
  Frame result(frame.num_joints());
  const strut_const_pose in = frame.in();
  const strut_pose out = result.out();
  EXPECT_EQ(strut_convert_pose(&in, nullptr, &out, &axes), STRUT_OK) << strut_last_error();
  return result;
}

Frame to_strut(const Frame& frame, const strut_axes& axes) {
  Frame result(frame.num_joints());
  const strut_const_pose in = frame.in();
  const strut_pose out = result.out();
  EXPECT_EQ(strut_convert_pose(&in, &axes, &out, nullptr), STRUT_OK) << strut_last_error();
  return result;
}

Frame joint(const std::vector<float>& rotation, const std::vector<float>& translation) {
  Frame frame(1);
  frame.rotations = rotation;
  frame.translations = translation;
  return frame;
}

void expect_joint(const Frame& frame, const std::vector<float>& rotation, const std::vector<float>& translation) {
  EXPECT_THAT(frame.rotations, Pointwise(FloatNear(kRounding), rotation));
  EXPECT_THAT(frame.translations, Pointwise(FloatNear(kUnitRounding), translation));
}

// A body 1 m to the left, 2 m up, 3 m ahead, that has turned to its left by 60 degrees: sine and cosine of half of it
// are 1/2 and sqrt(3)/2.
const float kSine = 0.5F;
const float kCosine = std::numbers::sqrt3_v<float> / 2.0F;
const Frame kTurnedLeft = joint({0, kSine, 0, kCosine}, {1, 2, 3});

TEST(Conventions, PutLeftUpAndAheadWhereTheySay) {
  expect_joint(in_convention(kTurnedLeft, axes_of(STRUT_CONVENTION_GLTF)), {0, kSine, 0, kCosine}, {1, 2, 3});
  // Unity: X to the right. Turning left is negative about Y, as it is left-handed.
  expect_joint(in_convention(kTurnedLeft, axes_of(STRUT_CONVENTION_UNITY)), {0, -kSine, 0, kCosine}, {-1, 2, 3});
  // Unreal: X ahead, Y to the right, Z up, centimetres. Turning left is negative yaw.
  expect_joint(in_convention(kTurnedLeft, axes_of(STRUT_CONVENTION_UNREAL)), {0, 0, -kSine, kCosine}, {300, -100, 200});
  // Blender: -Y ahead, X to the left of who looks there, Z up. Turning left is positive about Z.
  expect_joint(in_convention(kTurnedLeft, axes_of(STRUT_CONVENTION_BLENDER)), {0, 0, kSine, kCosine}, {1, -3, 2});
}

TEST(Conventions, TurnTheOtherAxesByHand) {
  // Leaning ahead by 60 degrees: about strut's +X, which points left.
  const Frame leaning = joint({kSine, 0, 0, kCosine}, {0, 0, 0});
  expect_joint(in_convention(leaning, axes_of(STRUT_CONVENTION_UNITY)), {kSine, 0, 0, kCosine}, {0, 0, 0});
  expect_joint(in_convention(leaning, axes_of(STRUT_CONVENTION_UNREAL)), {0, kSine, 0, kCosine}, {0, 0, 0});
  expect_joint(in_convention(leaning, axes_of(STRUT_CONVENTION_BLENDER)), {kSine, 0, 0, kCosine}, {0, 0, 0});
  // Tilting to the right, head over: about strut's +Z, ahead.
  const Frame tilting = joint({0, 0, kSine, kCosine}, {0, 0, 0});
  expect_joint(in_convention(tilting, axes_of(STRUT_CONVENTION_UNITY)), {0, 0, -kSine, kCosine}, {0, 0, 0});
  expect_joint(in_convention(tilting, axes_of(STRUT_CONVENTION_UNREAL)), {-kSine, 0, 0, kCosine}, {0, 0, 0});
  expect_joint(in_convention(tilting, axes_of(STRUT_CONVENTION_BLENDER)), {0, -kSine, 0, kCosine}, {0, 0, 0});
}

TEST(Conventions, OfOnesOwnMayPutWFirst) {
  strut_axes axes = axes_of(STRUT_CONVENTION_UNREAL);
  axes.quaternion_order = STRUT_QUATERNION_WXYZ;
  axes.metres_per_unit = 0.0254F;
  const Frame inches = in_convention(joint({kSine, 0, 0, kCosine}, {0, 0.254F, 0}), axes);
  expect_joint(inches, {kCosine, 0, kSine, 0}, {0, 0, 10});
}

/// All 48 ways of pointing right, up and forward along three axes.
std::vector<strut_axes> all_axes() {
  std::vector<strut_axes> found;
  for (const std::array<int, 3>& order :
       std::vector<std::array<int, 3>>{{1, 2, 3}, {2, 3, 1}, {3, 1, 2}, {1, 3, 2}, {3, 2, 1}, {2, 1, 3}}) {
    for (int signs = 0; signs < 8; ++signs) {
      strut_axes axes = axes_of(STRUT_CONVENTION_STRUT);
      axes.right = (signs & 1) != 0 ? -order[0] : order[0];
      axes.up = (signs & 2) != 0 ? -order[1] : order[1];
      axes.forward = (signs & 4) != 0 ? -order[2] : order[2];
      axes.metres_per_unit = 0.01F;
      axes.quaternion_order = signs % 2;
      found.push_back(axes);
    }
  }
  return found;
}

/// The matrix B that takes coordinates along `axes` to strut's, by their meaning alone.
Eigen::Matrix3d basis_of(const strut_axes& axes) {
  const auto row = [](int axis) {
    Eigen::RowVector3d unit = Eigen::RowVector3d::Zero();
    unit[std::abs(axis) - 1] = axis < 0 ? -1.0 : 1.0;
    return unit;
  };
  Eigen::Matrix3d basis;
  basis << -row(axes.right), row(axes.up), row(axes.forward);  // +X points left
  return basis;
}

Eigen::Matrix3d rotation_of(const Frame& frame, const strut_axes& axes) {
  const std::vector<float>& q = frame.rotations;
  const bool w_first = axes.quaternion_order == STRUT_QUATERNION_WXYZ;
  return w_first ? Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix()
                 : Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
}

TEST(Axes, OfEveryKindAreAChangeOfBasis) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -3).normalized()));
  const Pose pose{{turn}, {{0.3, -0.4, 0.5}}};
  int left_handed = 0;
  for (const strut_axes& axes : all_axes()) {
    const Frame seen = in_convention(Frame(pose), axes);
    const Eigen::Matrix3d basis = basis_of(axes);
    left_handed += basis.determinant() < 0.0;
    const Eigen::Matrix3d expected = basis.transpose() * turn.toRotationMatrix() * basis;
    EXPECT_LT((rotation_of(seen, axes) - expected).norm(), kRounding);
    const Eigen::Vector3d moved = basis.transpose() * pose.translations[0] * 100.0;
    EXPECT_LT((Eigen::Map<const Eigen::Vector3f>(seen.translations.data()).cast<double>() - moved).norm(),
              kUnitRounding);
  }
  EXPECT_EQ(left_handed, 24);
}

TEST(Axes, ThereAndBackIsTheSamePose) {
  const Frame frame(turning_motion(30.0, 1.0).frame(7));
  for (const strut_axes& axes : all_axes()) {
    const FrameDifference difference = largest_difference(to_strut(in_convention(frame, axes), axes), frame);
    EXPECT_EQ(difference.rotation, 0.0F);
    EXPECT_LT(difference.translation, kRounding);
  }
}

TEST(Axes, ConvertInPlaceAndWithStrides) {
  struct Transform {
    std::array<float, 3> translation;
    std::array<float, 4> rotation;
    std::array<float, 3> scale;
  };
  const Frame frame(turning_motion(30.0, 1.0).frame(3));
  const strut_axes unreal = axes_of(STRUT_CONVENTION_UNREAL);
  std::vector<Transform> wide(6, Transform{{}, {}, {7, 8, 9}});
  const strut_pose out{wide[0].rotation.data(), wide[0].translation.data(), sizeof(Transform), sizeof(Transform), 6};
  const strut_const_pose in = frame.in();
  ASSERT_EQ(strut_convert_pose(&in, nullptr, &out, &unreal), STRUT_OK);
  const strut_const_pose again{out.rotations, out.translations, sizeof(Transform), sizeof(Transform), 6};
  ASSERT_EQ(strut_convert_pose(&again, &unreal, &out, nullptr), STRUT_OK);
  for (std::size_t j = 0; j < wide.size(); ++j) {
    EXPECT_EQ(wide[j].scale, (std::array<float, 3>{7, 8, 9}));
    EXPECT_EQ(wide[j].rotation[2], frame.rotations[4 * j + 2]);
    EXPECT_NEAR(wide[j].translation[1], frame.translations[3 * j + 1], kRounding);
  }
}

TEST(Translators, DoTheSameInEveryConvention) {
  const Motion clip = turning_motion(30.0, 4.0);
  const ModelHandle model = handle_of(StyleModel(radial_parts(clip)));
  for (const int convention : kConventions) {
    strut_axes axes = axes_of(convention);
    axes.quaternion_order = convention == STRUT_CONVENTION_BLENDER ? STRUT_QUATERNION_WXYZ : STRUT_QUATERNION_XYZW;
    strut_translator_options options;
    ASSERT_EQ(strut_translator_options_init(&options, sizeof options), STRUT_OK);
    options.axes = &axes;
    const TranslatorHandle direct = translator_of({model.get()});
    const TranslatorHandle converting = translator_of({model.get()}, &options);
    Frame plain(6);
    Frame seen(6);
    for (const Pose& pose : clip.frames()) {
      const Frame input(pose);
      const Frame input_seen = in_convention(input, axes);
      const std::array in = {input.in(), input_seen.in()};
      const std::array out = {plain.out(), seen.out()};
      ASSERT_EQ(strut_translator_push(direct.get(), &in[0], &out[0]), STRUT_OK);
      ASSERT_EQ(strut_translator_push(converting.get(), &in[1], &out[1]), STRUT_OK);
      const FrameDifference difference = largest_difference(to_strut(seen, axes), plain);
      ASSERT_LT(difference.rotation, kStreamRounding) << convention;
      ASSERT_LT(difference.translation, kStreamRounding) << convention;
    }
    EXPECT_GT(largest_difference(plain, Frame(clip.frames().back())).rotation, 0.01F) << "nothing was translated";
  }
}

}  // namespace
}  // namespace strut::test
