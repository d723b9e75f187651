// SPDX-License-Identifier: MIT
#include "support/small_model.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/motion/body_parts.h>
#include <strut/motion/kinematics.h>

namespace strut::motion {
namespace {

/// The names of a body's joints by part.
std::map<std::string, std::vector<std::string>> names_by_part(const Motion& motion) {
  std::map<std::string, std::vector<std::string>> names;
  const std::vector<BodyPart> parts = body_parts(motion);
  for (std::size_t j = 0; j < parts.size(); ++j) {
    names[kBodyPartNames[static_cast<std::size_t>(parts[j])]].push_back(
        motion.skeleton().joint(static_cast<int>(j)).name);
  }
  return names;
}

TEST(BodyParts, OfTheGeneratorsBodyAreWhatTheirNamesSay) {
  const auto names = names_by_part(generate::generate_walk({.duration = 1.0}, {}).motion);
  ASSERT_EQ(names.size(), 6U);
  for (const auto& [part, joints] : names) {
    for (const std::string& joint : joints) {
      const bool is_left = joint.find("left") != std::string::npos || joint.find("Left") != std::string::npos;
      const bool is_right = joint.find("right") != std::string::npos || joint.find("Right") != std::string::npos;
      EXPECT_EQ(is_left, part.starts_with("left_")) << joint << " in " << part;
      EXPECT_EQ(is_right, part.starts_with("right_")) << joint << " in " << part;
    }
  }
  EXPECT_EQ(names.at("left_arm").size(), names.at("right_arm").size());
  EXPECT_EQ(names.at("left_leg").size(), 4U);
}

TEST(BodyParts, DoNotDependOnTheWayTheBodyFaces) {
  const Motion walk = generate::generate_walk({.duration = 1.0}, {}).motion;
  EXPECT_EQ(body_parts(walk), body_parts(moved(walk, {3, 0, 1}, 2.0)));
}

TEST(BodyParts, OfABodyWithoutLegsAreAllTrunk) {
  const Motion clip = test::turning_motion(30.0, 1.0);  // two limbs of one bone
  for (const BodyPart part : body_parts(clip)) EXPECT_EQ(part, BodyPart::kTrunk);
}

TEST(BodyParts, NeedAFrame) {
  const Motion clip = test::turning_motion(30.0, 1.0);
  EXPECT_THROW(body_parts(clip.slice(0, 0)), InvalidArgument);
}

}  // namespace
}  // namespace strut::motion
