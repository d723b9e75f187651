// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/lti_bank.h>

namespace strut::sysid {
namespace {

LtiSystem some_system(int states, int inputs, int outputs) {
  const auto some = [](int rows, int cols) { return Eigen::MatrixXd(0.3 * Eigen::MatrixXd::Random(rows, cols)); };
  return {some(states, states), some(states, inputs), some(outputs, states), some(outputs, inputs)};
}

/// Systems of many shapes: more than fit one group, some whose lanes stand side by side and some whose do not.
struct Mixed {
  Mixed() {
    for (int b = 0; b < 21; ++b) systems.push_back(some_system(b % 5, 3, 3));
    systems.push_back(some_system(4, 6, 6));
    systems.push_back(some_system(0, 2, 1));
    for (int b = 0; b < 21; ++b) banked.push_back({&systems[at(b)], {b, b + 24, b + 48}, {b, b + 24, b + 48}});
    banked.push_back({&systems[21], {80, 71, 75, 3, 72, 79}, {73, 75, 77, 79, 81, 72}});
    banked.push_back({&systems[22], {0, 82}, {90}});
  }
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  static constexpr int kInputs = 83, kOutputs = 91;
  std::vector<LtiSystem> systems;
  std::vector<BankedSystem> banked;
};

template <typename Scalar>
class LtiBankOf : public testing::Test {
 protected:
  static constexpr double kRounding = sizeof(Scalar) == 4 ? 1e-5 : 1e-13;  // of numbers up to about 1
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LtiBankOf, Scalars);

TYPED_TEST(LtiBankOf, StepsEverySystemAsItStepsAlone) {
  const Mixed mixed;
  const LtiBank<TypeParam> bank(mixed.banked, Mixed::kInputs, Mixed::kOutputs);
  math::AlignedVector<TypeParam> input(Mixed::kInputs), output(Mixed::kOutputs, TypeParam(7));
  math::AlignedVector<TypeParam> state(static_cast<std::size_t>(bank.state_size()));
  math::AlignedVector<TypeParam> scratch(static_cast<std::size_t>(bank.scratch_size()));
  const FrameMatrix inputs = FrameMatrix::Random(30, Mixed::kInputs);
  std::vector<FrameMatrix> expected;
  for (const BankedSystem& banked : mixed.banked) {
    FrameMatrix own(inputs.rows(), banked.system->num_inputs());
    for (std::size_t i = 0; i < banked.inputs.size(); ++i)
      own.col(static_cast<Eigen::Index>(i)) = inputs.col(banked.inputs[i]);
    expected.push_back(simulate(*banked.system, own));
  }
  for (Eigen::Index t = 0; t < inputs.rows(); ++t) {
    for (int i = 0; i < Mixed::kInputs; ++i) input[Mixed::at(i)] = static_cast<TypeParam>(inputs(t, i));
    bank.step(input.data(), state.data(), scratch.data(), output.data());
    for (std::size_t s = 0; s < mixed.banked.size(); ++s) {
      for (std::size_t i = 0; i < mixed.banked[s].outputs.size(); ++i) {
        EXPECT_NEAR(output[Mixed::at(mixed.banked[s].outputs[i])], expected[s](t, static_cast<Eigen::Index>(i)),
                    this->kRounding);
      }
    }
  }
  EXPECT_EQ(output[82], TypeParam(7));  // nobody's
}

TYPED_TEST(LtiBankOf, TellsWhereEveryStateStands) {
  const Mixed mixed;
  const LtiBank<TypeParam> bank(mixed.banked, Mixed::kInputs, Mixed::kOutputs);
  std::vector<int> places;
  for (std::size_t s = 0; s < mixed.systems.size(); ++s) {
    for (int i = 0; i < mixed.systems[s].num_states(); ++i) {
      places.push_back(bank.place_of_state(static_cast<int>(s), i));
    }
  }
  std::sort(places.begin(), places.end());
  EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
  EXPECT_GE(places.front(), 0);
  EXPECT_LT(places.back(), bank.state_size());
}

TEST(LtiBank, RefusesIndicesThatDoNotFit) {
  const LtiSystem system = some_system(1, 2, 1);
  EXPECT_THROW(LtiBank<float>({{&system, {0}, {0}}}, 5, 5), InvalidArgument);
  EXPECT_THROW(LtiBank<float>({{&system, {0, 5}, {0}}}, 5, 5), InvalidArgument);
  EXPECT_THROW(LtiBank<float>({{&system, {0, 1}, {-1}}}, 5, 5), InvalidArgument);
}

}  // namespace
}  // namespace strut::sysid
