// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/small_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/representation/normalization.h>
#include <strut/representation/pose_encoder.h>
#include <strut/representation/representation.h>

namespace strut::representation {
namespace {

using test::largest_difference;
using test::small_body;
using test::turning_motion;

constexpr double kRoundTrip = 1e-9;  // what the design asks of encode then decode [rad, m]

TEST(Representation, EncodeThenDecodeIsTheIdentity) {
  const Motion clip = turning_motion(30.0, 4.0);
  const auto rep = fit_representation({clip}, Eigen::Quaterniond::Identity());
  const FrameMatrix rows = encode(rep, clip);
  const auto start = placement(pelvis_world(clip.skeleton(), clip.frame(0)), rep.upright());
  const Motion back = decode(rep, rows, clip.frame_rate(), start, clip.shared_skeleton(), clip.frame(0));
  EXPECT_LT(largest_difference(clip, back), kRoundTrip);
}

TEST(Representation, EncodesAndDecodesRealClips) {
  STRUT_REQUIRE_REAL_DATA();
  for (const char* name : {"walk-turn-left_active_004", "run_feminine_002", "wave-both-hands_elderly_009"}) {
    const Motion clip = read_bvh(test::real_data() + "/bandai-namco/dataset-2_" + name + ".bvh").motion;
    const auto rep = fit_representation({clip}, motion::upright_reference(clip));
    const FrameMatrix rows = encode(rep, clip);
    const auto start = placement(pelvis_world(clip.skeleton(), clip.frame(0)), rep.upright());
    // Inner joints have position channels that are rounded per frame: bones are compared as the clip's first frame has
    // them.
    std::vector<Pose> rigid = clip.frames();
    for (Pose& pose : rigid) {
      for (std::size_t j = 2; j < pose.translations.size(); ++j) pose.translations[j] = clip.frame(0).translations[j];
    }
    const Motion source(clip.shared_skeleton(), clip.frame_rate(), std::move(rigid));
    const Motion back = decode(rep, rows, clip.frame_rate(), start, clip.shared_skeleton(), clip.frame(0));
    EXPECT_LT(largest_difference(source, back), kRoundTrip) << name;
    const Motion elsewhere = motion::moved(clip, {-4.0, 0.0, 9.0}, -2.5);
    EXPECT_LT((rows - encode(rep, elsewhere)).cwiseAbs().maxCoeff(), kRoundTrip) << name;
  }
}

TEST(Representation, DoesNotSeeWhereAClipStandsOrFaces) {
  const Motion clip = turning_motion(30.0, 4.0);
  const Motion elsewhere = motion::moved(clip, {3.0, 0.0, -7.0}, 2.0);
  const auto rep = fit_representation({clip}, Eigen::Quaterniond::Identity());
  EXPECT_LT((encode(rep, clip) - encode(rep, elsewhere)).cwiseAbs().maxCoeff(), kRoundTrip);
}

TEST(Representation, GivesVelocitiesPerSecondAtAnyFrameRate) {
  const Motion fast = turning_motion(120.0, 4.0);
  const auto rep = fit_representation({fast}, Eigen::Quaterniond::Identity());
  const FrameMatrix at120 = encode(rep, fast);
  const FrameMatrix at30 = encode(rep, motion::resample(fast, 30.0));
  // Means over the clip agree; single frames differ because the path curves between them.
  EXPECT_NEAR(at120.col(kForwardVelocity).mean(), at30.col(kForwardVelocity).mean(), 0.02);
  EXPECT_NEAR(at120.col(kTurningRate).mean(), at30.col(kTurningRate).mean(), 0.02);
}

TEST(Representation, OfAStraightWalkIsItsSpeed) {
  const auto skeleton = small_body();
  std::vector<Pose> frames(10, rest_pose(*skeleton));
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].translations[0] = {0, 0, 0.05 * static_cast<double>(i)};
  const Motion clip(skeleton, 20.0, frames);
  const FrameMatrix rows = encode(fit_representation({clip}, Eigen::Quaterniond::Identity()), clip);
  for (int t = 0; t < 10; ++t) {
    EXPECT_NEAR(rows(t, kForwardVelocity), 1.0, 1e-12) << t;
    EXPECT_NEAR(rows(t, kSidewaysVelocity), 0.0, 1e-12) << t;
    EXPECT_NEAR(rows(t, kHeight), 0.9, 1e-12) << t;
  }
}

TEST(Representation, StaysNearZeroForJointsRestingFarFromIdentity) {
  const Motion clip = turning_motion(30.0, 4.0);  // its joints rest about two radians from identity
  const FrameMatrix rows = encode(fit_representation({clip}, Eigen::Quaterniond::Identity()), clip);
  EXPECT_LT(rows.rightCols(rows.cols() - kNumRootDofs).cwiseAbs().maxCoeff(), 1.0);
}

TEST(Representation, RefusesAnotherHierarchy) {
  const Motion clip = turning_motion(30.0, 1.0);
  const auto other = std::make_shared<const Skeleton>(std::vector<Joint>{{"hips", -1}, {"a", 0}, {"b", 0}});
  const auto rep = fit_representation({clip}, Eigen::Quaterniond::Identity());
  try {
    encode(rep, Motion(other, 30.0, {rest_pose(*other)}));
    FAIL();
  } catch (const SkeletonMismatch& error) {
    EXPECT_STREQ(error.what(),
                 "the skeleton does not fit: missing 'head', 'left', 'pelvis', 'right', 'root', and 1 more; unknown "
                 "'a', 'b', 'hips'");
  }
}

TEST(Representation, StreamsTheSameRowsAsTheWholeClipAfterTheFirst) {
  const Motion clip = turning_motion(30.0, 1.0);
  const auto rep = fit_representation({clip}, Eigen::Quaterniond::Identity());
  const FrameMatrix whole = encode(rep, clip);
  PoseEncoder<double> encoder(rep, 30.0);
  math::AlignedVector<double> slots(static_cast<std::size_t>(encoder.layout().num_slots()));
  Eigen::RowVectorXd row(rep.num_dofs());
  for (int t = 0; t < clip.num_frames(); ++t) {
    encoder.encode(view(clip.frame(t)), slots.data());
    encoder.layout().unpack(slots.data(), row);
    if (t == 0) continue;
    EXPECT_EQ(row, Eigen::RowVectorXd(whole.row(t))) << t;
  }
}

TEST(Normalization, IsUndoneByDenormalizing) {
  const Motion clip = turning_motion(30.0, 4.0);
  const FrameMatrix rows = encode(fit_representation({clip}, Eigen::Quaterniond::Identity()), clip);
  const auto normalization = fit_normalization({rows});
  const FrameMatrix normal = normalization.normalize(rows);
  for (int d = 0; d < normalization.num_dofs(); ++d) {
    if (!normalization.is_kept(d)) continue;
    EXPECT_NEAR(normal.col(d).mean(), 0.0, 1e-12);
    EXPECT_NEAR(normal.col(d).squaredNorm() / static_cast<double>(normal.rows()), 1.0, 1e-9);
    EXPECT_LT((normalization.denormalize(normal).col(d) - rows.col(d)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Normalization, DropsWhatBarelyMovesAndGivesItsMean) {
  FrameMatrix rows = FrameMatrix::Zero(100, kNumRootDofs + 1);
  for (int t = 0; t < 100; ++t) {
    rows(t, kHeight) = 0.9 + 0.001 * std::sin(t);           // a millimetre
    rows(t, kNumRootDofs) = 0.5 + 0.1 * std::sin(0.3 * t);  // several degrees
  }
  const auto normalization = fit_normalization({rows});
  EXPECT_FALSE(normalization.is_kept(kHeight));
  EXPECT_TRUE(normalization.is_kept(kNumRootDofs));
  EXPECT_EQ(normalization.normalize(rows).col(kHeight).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(normalization.denormalize(FrameMatrix::Constant(1, 7, 5.0))(0, kHeight), 0.9, 1e-3);
}

}  // namespace
}  // namespace strut::representation
