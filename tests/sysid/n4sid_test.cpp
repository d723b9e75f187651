// SPDX-License-Identifier: MIT
#include "sysid/known_system.h"

#include <algorithm>
#include <complex>
#include <utility>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/sysid/n4sid.h>

namespace strut::sysid {
namespace {

constexpr double kRecovered = 1e-6;  // of poles, without noise

std::vector<std::complex<double>> poles(const Eigen::MatrixXd& a) {
  const Eigen::VectorXcd values = a.eigenvalues();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& one, const auto& other) {
    return std::pair(one.real(), one.imag()) < std::pair(other.real(), other.imag());
  });
  return sorted;
}

TEST(HankelFactor, IsTheTriangleOfTheDataWhateverTheOrderOfAdding) {
  const auto clips = test::clips_of(test::known_system(), {.count = 9, .frames = 70});
  HankelFactor all(2, 3, 3), some(2, 3, 3), rest(2, 3, 3);
  for (std::size_t k = 0; k < clips.size(); ++k) {
    all.add(clips[k]);
    (k % 2 == 0 ? some : rest).add(clips[k]);
  }
  rest.add(some);
  EXPECT_EQ(all.num_columns(), 9 * (70 - 6 + 1));
  EXPECT_EQ(rest.num_columns(), all.num_columns());
  const Eigen::MatrixXd gram = all.triangle().transpose() * all.triangle();
  EXPECT_LT((rest.triangle().transpose() * rest.triangle() - gram).norm(), 1e-10 * gram.norm());
  double first_future_input = 0.0;
  for (const Experiment& clip : clips) first_future_input += clip.input.col(0).segment(3, 65).squaredNorm();
  EXPECT_NEAR(gram(0, 0), first_future_input, 1e-10 * first_future_input);
}

TEST(HankelFactor, TakesNothingFromShortClipsAndLeadIns) {
  HankelFactor factor(2, 3, 10);
  factor.add(test::clips_of(test::known_system(), {.count = 1, .frames = 19, .lead_in = 30}).front());
  EXPECT_EQ(factor.num_columns(), 0);
  EXPECT_EQ(Subspace(factor, Weighting::kCva).max_order(), 0);
}

TEST(HankelFactor, RefusesEmptyShapes) {
  EXPECT_THROW(HankelFactor(0, 1, 10), InvalidArgument);
  EXPECT_THROW(HankelFactor(1, 0, 10), InvalidArgument);
  EXPECT_THROW(HankelFactor(1, 1, 0), InvalidArgument);
}

class SubspaceWeighting : public testing::TestWithParam<Weighting> {};
INSTANTIATE_TEST_SUITE_P(All, SubspaceWeighting,
                         testing::Values(Weighting::kN4sid, Weighting::kMoesp, Weighting::kCva));

TEST_P(SubspaceWeighting, ShowsOrderAndPolesWithoutNoise) {
  const LtiSystem truth = test::known_system();
  HankelFactor factor(2, 3, 8);
  for (const Experiment& clip : test::clips_of(truth, {.initial_state = 1.0})) factor.add(clip);
  const Subspace subspace(factor, GetParam());
  EXPECT_LT(subspace.singular_values()[4], 1e-6 * subspace.singular_values()[3]);
  const auto found = poles(subspace.a_and_c(4).a);
  const auto expected = poles(truth.a());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT(std::abs(found[k] - expected[k]), kRecovered);
  EXPECT_THROW((void)subspace.a_and_c(subspace.max_order() + 1), InvalidArgument);
  EXPECT_EQ(subspace.a_and_c(0).c.rows(), 3);
}

}  // namespace
}  // namespace strut::sysid
