// SPDX-License-Identifier: MIT
#include "support/small_model.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/model/style_model.h>

namespace strut {
namespace {

template <typename Change>
std::string refusal(Change change) {
  StyleModelParts parts = test::copying_parts(test::turning_motion(30.0, 1.0));
  change(parts);
  try {
    const StyleModel model(std::move(parts));
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StyleModel, CountsTheStatesOfAllBlocks) {
  StyleModelParts parts = test::copying_parts(test::turning_motion(30.0, 1.0));
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  parts.blocks[3].system = sysid::LtiSystem(0.5 * one, one, one, one);
  parts.blocks[5].system = sysid::LtiSystem(0.9 * one, one, one, one);
  EXPECT_EQ(StyleModel(std::move(parts)).num_states(), 2);
}

TEST(StyleModel, RefusesPartsThatDoNotFit) {
  EXPECT_EQ(refusal([](StyleModelParts&) {}), "accepted");
  EXPECT_THAT(refusal([](StyleModelParts& parts) { parts.frame_rate = 0.0; }), testing::HasSubstr("frame_rate"));
  EXPECT_THAT(refusal([](StyleModelParts& parts) { parts.blocks[0].input_dofs[0] = 99; }),
              testing::HasSubstr("got 99"));
  EXPECT_THAT(refusal([](StyleModelParts& parts) { parts.blocks[1].output_dofs[0] = 0; }), testing::HasSubstr("again"));
  EXPECT_THAT(refusal([](StyleModelParts& parts) { parts.output_scaling = parts.input_scaling; }),
              testing::HasSubstr("output_scaling"));
}

TEST(StyleModel, RefusesContextsAndMapsThatDoNotFit) {
  EXPECT_EQ(refusal([](StyleModelParts& parts) { parts.context = Eigen::MatrixXd::Zero(2, 3); }),
            "context: expected 18 degrees of freedom, got 3");
  EXPECT_EQ(refusal([](StyleModelParts& parts) { parts.context = Eigen::MatrixXd::Constant(1, 18, NAN); }),
            "context: expected finite numbers, got NaN or infinity");
  EXPECT_EQ(refusal([](StyleModelParts& parts) { parts.blocks[0].input_dofs[0] = 18; }),
            "block 'root sideways velocity' inputs: expected degrees of freedom below 18, got 18");
  EXPECT_EQ(refusal([](StyleModelParts& parts) {
              parts.context = Eigen::MatrixXd::Ones(1, 18);
              parts.blocks[0].input_dofs[0] = 18;  // context 0
            }),
            "accepted");
  EXPECT_EQ(refusal([](StyleModelParts& parts) { parts.radial_map = test::some_radial_map(18, 3); }),
            "blocks: expected none beside a radial map, got some");
  EXPECT_EQ(refusal([](StyleModelParts& parts) {
              parts.blocks.clear();
              parts.radial_map = test::some_radial_map(18, 3);
            }),
            "basis: expected 0 features, got 4");
}

postprocess::FootplantClassifier footplants_of(Eigen::Index states) {
  const postprocess::FootplantBoundary foot{Eigen::VectorXd::Ones(states), 0.5, true};
  return postprocess::FootplantClassifier({foot, foot});
}

TEST(StyleModel, RefusesFootplantsOfAnotherState) {
  EXPECT_EQ(refusal([](StyleModelParts& parts) { parts.footplants = footplants_of(1); }),
            "footplants: expected 0 states, got 1");
  EXPECT_EQ(refusal([](StyleModelParts& parts) {
              parts = test::radial_parts(test::turning_motion(30.0, 1.0));
              parts.footplants = footplants_of(4);
            }),
            "accepted");
  EXPECT_EQ(refusal([](StyleModelParts& parts) {
              const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
              parts.blocks[3].system = sysid::LtiSystem(0.5 * one, one, one, one);
              parts.footplants = footplants_of(1);
            }),
            "accepted");
}

TEST(StyleModel, RefusesUnstableSystems) {
  EXPECT_THAT(refusal([](StyleModelParts& parts) {
                const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
                parts.blocks[0].system = sysid::LtiSystem(one, one, one, one);
              }),
              testing::HasSubstr("stable"));
}

}  // namespace
}  // namespace strut
