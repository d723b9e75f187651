// SPDX-License-Identifier: MIT
// strut view: the curves of a clip, as the page asks for them.
#include "metrics/test_body.h"
#include "support/program.h"
#include "support/walks.h"
#include "view_session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/io/bvh.h>
#include <strut/motion/joint_curves.h>

namespace strut::test {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr float kPrinted = 1e-3F;  // [m], [degrees]: BVH files hold a few decimals

class ViewCurves : public testing::Test {
 protected:
  ViewCurves() { write_clip(here_.file("walk.bvh"), walk_); }

  static std::vector<std::string> names_in(const ViewContainer& clip) {
    std::vector<std::string> names;
    for (const json& curve : clip.header.at("curves")) names.push_back(curve.at("name"));
    return names;
  }
  std::vector<float> values(const std::string& name) const {
    return session_->container("clips/c0/curve?name=" + name).arrays.at("values");
  }
  void open(const std::string& file) { session_ = std::make_unique<ViewSession>(std::vector{here_.file(file)}); }

  Workplace here_;
  Motion walk_ = short_walk(0.0);
  std::unique_ptr<ViewSession> session_;
};

TEST_F(ViewCurves, AreNamedWithTheirJointAndUnit) {
  open("walk.bvh");
  const ViewContainer clip = session_->container("clips/c0");
  const auto names = names_in(clip);
  for (const char* name : {"body/speed", "body/slide/left", "body/jerk", "0/rotation/x", "3/position/z", "3/speed"}) {
    EXPECT_THAT(names, Contains(name));
  }
  for (const json& curve : clip.header.at("curves")) {
    const std::string name = curve.at("name");
    if (name.rfind("body/", 0) == 0) continue;
    EXPECT_EQ(curve.at("joint"), walk_.skeleton().joint(std::stoi(name)).name);
  }
}

TEST_F(ViewCurves, HaveANumberPerFrame) {
  open("walk.bvh");
  for (const std::string& name : names_in(session_->container("clips/c0"))) {
    EXPECT_EQ(values(name).size(), static_cast<std::size_t>(walk_.num_frames())) << name;
  }
}

TEST_F(ViewCurves, AreWhatTheLibraryComputes) {
  open("walk.bvh");
  const FrameMatrix expected = motion::position_curve(walk_, 2);
  const auto found = values("2/position/y");
  for (int i = 0; i < walk_.num_frames(); ++i) {
    EXPECT_NEAR(found[static_cast<std::size_t>(i)], expected(i, 1), kPrinted) << i;
  }
}

TEST_F(ViewCurves, OfSlideIsTheClipsSlide) {
  open("walk.bvh");
  const auto both = session_->container("clips/c0").arrays.at("slide");
  const auto right = values("body/slide/right");
  ASSERT_EQ(both.size(), 2 * right.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(std::isnan(both[2 * i + 1]), std::isnan(right[i])) << i;
    if (!std::isnan(right[i])) {
      EXPECT_EQ(both[2 * i + 1], right[i]) << i;
    }
  }
  EXPECT_TRUE(std::any_of(right.begin(), right.end(), [](float x) { return std::isnan(x); }));
  EXPECT_FALSE(std::all_of(right.begin(), right.end(), [](float x) { return std::isnan(x); }));
}

TEST_F(ViewCurves, OfATurningBodyGoOnBeyondHalfATurn) {
  const auto turn = [](Pose& pose, double t) {
    pose.rotations[0] = Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d::UnitY());
  };
  const Motion turning = metrics::test::test_motion(61, 30.0, turn);  // to 4 rad
  write_bvh(here_.file("turn.bvh"), turning, default_layout(turning.skeleton()), Overwrite::kAllow);
  open("turn.bvh");
  EXPECT_NEAR(values("0/rotation/y").back(), 4.0 * 180.0 / 3.14159265, 0.1);
}

TEST_F(ViewCurves, OfABodyWithoutLegsAreThoseOfItsJoints) {
  const auto arm = std::make_shared<const Skeleton>(std::vector<Joint>{{"base", -1, {0, 1, 0}}, {"tip", 0, {0, 1, 0}}});
  const Motion motion(arm, 30.0, std::vector<Pose>(5, rest_pose(*arm)));
  write_bvh(here_.file("arm.bvh"), motion, default_layout(*arm), Overwrite::kAllow);
  open("arm.bvh");
  const ViewContainer clip = session_->container("clips/c0");
  EXPECT_THAT(names_in(clip), Contains("1/rotation/z"));
  EXPECT_THAT(names_in(clip), Not(Contains(StartsWith("body/"))));
  for (const float slide : clip.arrays.at("slide")) EXPECT_TRUE(std::isnan(slide));
}

TEST_F(ViewCurves, ThatThereAreNotAreRefused) {
  open("walk.bvh");
  for (const char* name : {"99/speed", "body/charm", "", "-1/rotation/x", "0/rotation/x/"}) {
    const ViewAnswer answer = session_->get(std::string("clips/c0/curve?name=") + name);
    EXPECT_EQ(answer.status, 404) << name;
    EXPECT_THAT(answer.problem(), HasSubstr("no curve"));
  }
  EXPECT_EQ(session_->get("clips/c0/curve").status, 400);
  EXPECT_EQ(session_->get("clips/c7/curve?name=body/speed").status, 404);
}

}  // namespace
}  // namespace strut::test
