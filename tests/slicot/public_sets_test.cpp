// SPDX-License-Identifier: MIT
// Test fits on the public identification sets beside SLICOT's, at the same order and with an order of either's own
// choice: the first half of a set trains, the second half tests, all scaled by the training half's mean and deviation,
// simulated from rest.
#include "slicot/slicot.h"
#include "support/data.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <strut/sysid/identify.h>

namespace strut::test {
namespace {

using sysid::Experiment;

constexpr int kBlockRows = 10;
constexpr int kMostStates = 6;
constexpr double kDiverged = -100.0;  // fits below are all alike: it diverges

struct Halves {
  std::string name;
  Experiment train, test;
};

std::vector<double> numbers_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<double> numbers;
  for (double number; file >> number;) numbers.push_back(number);
  return numbers;
}

Halves halves(const std::filesystem::path& folder, const std::string& line) {
  std::istringstream fields(line);
  std::string name, samples, inputs, outputs;
  for (std::string* field : {&name, &samples, &inputs, &outputs}) std::getline(fields, *field, ',');
  const Eigen::Index rows = std::stoi(samples), num_inputs = std::stoi(inputs), num_outputs = std::stoi(outputs);
  const std::vector<double> numbers = numbers_in(folder / (name + ".dat"));
  FrameMatrix table = Eigen::Map<const FrameMatrix>(numbers.data(), rows, num_inputs + num_outputs);
  const Eigen::Index half = rows / 2;
  const Eigen::RowVectorXd mean = table.topRows(half).colwise().mean();
  table.rowwise() -= mean;
  const Eigen::RowVectorXd power = table.topRows(half).colwise().squaredNorm() / static_cast<double>(half - 1);
  table = table * power.cwiseSqrt().cwiseInverse().asDiagonal();
  const auto part = [&](Eigen::Index begin, Eigen::Index end) {
    return Experiment{table.block(begin, 0, end - begin, num_inputs),
                      table.block(begin, num_inputs, end - begin, num_outputs)};
  };
  return {name, part(0, half), part(half, rows)};
}

std::vector<Halves> public_sets() {
  const std::filesystem::path folder = std::filesystem::path(real_data()) / "sysid";
  std::ifstream index(folder / "index.csv");
  std::vector<Halves> sets;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) sets.push_back(halves(folder, line));
  return sets;
}

double fit_of(const sysid::LtiSystem& system, const Halves& set) {
  const double fit = simulated_fit(system, {set.test});
  return fit > kDiverged ? fit : kDiverged;
}

const sysid::IdentifyOptions kOptions{
    .max_order = kMostStates, .block_rows = kBlockRows, .weighting = sysid::Weighting::kMoesp, .max_radius = 0.999};

TEST(PublicSets, AreFittedNoWorseThanBySlicotAtTheSameOrder) {
  STRUT_REQUIRE_REAL_DATA();
  // Where poles near the unit circle or drift decide, either may be lucky: a few points at one order, never on average.
  constexpr double kLuck = 5.0;
  double total = 0.0;
  for (const Halves& set : public_sets()) {
    for (int order = 1; order <= kMostStates; ++order) {
      const double ours = fit_of(sysid::identify_order({set.train}, order, kOptions), set);
      const double theirs = fit_of(slicot_identify(SlicotMethod::kCombined, set.train, kBlockRows, order).system, set);
      EXPECT_GT(ours, theirs - kLuck) << set.name << ", " << order << " states";
      total += ours - theirs;
    }
  }
  EXPECT_GE(total, 0.0);
}

TEST(PublicSets, AreFittedNoWorseThanBySlicotWithAnOrderOfItsOwn) {
  STRUT_REQUIRE_REAL_DATA();
  constexpr double kLuck = 2.0;  // % fit: what left-out data of one record leave open
  double total = 0.0;
  for (const Halves& set : public_sets()) {
    sysid::IdentifyOptions options = kOptions;
    options.starts = sysid::Starts::kEvery;
    const double ours = fit_of(sysid::identify({set.train}, {0}, options).system, set);
    const int order = slicot_order(SlicotMethod::kCombined, set.train, kBlockRows);
    const double theirs = fit_of(
        slicot_identify(SlicotMethod::kCombined, set.train, kBlockRows, std::clamp(order, 1, kBlockRows - 1)).system,
        set);
    EXPECT_GT(ours, theirs - kLuck) << set.name;
    EXPECT_GT(ours, 0.0) << set.name;
    total += ours - theirs;
  }
  EXPECT_GE(total, 0.0);
}

}  // namespace
}  // namespace strut::test
