// SPDX-License-Identifier: MIT
#include "effort_keys.h"

#include "csv_table.h"
#include "usage.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/effort/blend_choice.h>

namespace strut::cli {
namespace {

constexpr const char* kTimeColumn = "time_s";
constexpr const char* kColumns = "the columns are time_s and one or more of flow, weight and time";

/// The factors that have a column.
std::vector<int> factors_of(const std::string& path) {
  std::vector<int> factors;
  for (const std::string& name : read_csv_names(path)) {
    if (name == kTimeColumn) continue;
    int factor = 0;
    while (factor < effort::kNumPredictedFactors && name != effort::kFactorNames.at(static_cast<std::size_t>(factor)))
      ++factor;
    if (factor == effort::kNumPredictedFactors) {
      throw ParseError(path, 1, 0, "time_s, flow, weight or time", "'" + name + "'", kColumns);
    }
    factors.push_back(factor);
  }
  if (factors.empty()) throw ParseError(path, 1, 0, "a column flow, weight or time", "none", kColumns);
  return factors;
}

}  // namespace

void add_effort_sliders(CLI::App& command, EffortSliders& sliders) {
  CLI::Option* keys = command.add_option("--keys", sliders.keys,
                                         "Table of what is wanted over time (time_s, flow, weight, time), instead of "
                                         "these");
  keys->type_name("TABLE");
  const std::pair<const char*, std::optional<double>*> all[] = {
      {"flow", &sliders.flow}, {"weight", &sliders.weight}, {"time", &sliders.time}};
  for (std::size_t factor = 0; factor < std::size(all); ++factor) {
    const auto& poles = effort::kFactorPoles.at(factor);
    command
        .add_option(fmt::format("--{}", all[factor].first), *all[factor].second,
                    fmt::format("From {} (-1) to {} (1); not given: stays as it is", poles[0], poles[1]))
        ->check(number_in(-1.0, 1.0))
        ->excludes(keys);
  }
}

effort::EffortCurve effort_wanted(const EffortSliders& sliders) {
  if (!sliders.keys.empty()) return read_effort_keys(sliders.keys);
  if (!sliders.flow && !sliders.weight && !sliders.time) {
    throw CLI::ValidationError(
        "--flow, --weight and --time are missing: one or more from -1 to 1 (or --keys, a table "
        "of them over time)");
  }
  return effort::EffortCurve(effort::EffortVector(sliders.flow.value_or(effort::kNotRated),
                                                  sliders.weight.value_or(effort::kNotRated),
                                                  sliders.time.value_or(effort::kNotRated)));
}

effort::EffortCurve read_effort_keys(const std::string& path) {
  const std::vector<int> factors = factors_of(path);
  std::vector<std::string> columns{kTimeColumn};
  for (const int factor : factors) columns.emplace_back(effort::kFactorNames.at(static_cast<std::size_t>(factor)));
  std::vector<effort::EffortKey> keys;
  for (const CsvRow& row : read_csv_rows(path, {}, columns)) {
    const auto refuse = [&](std::size_t column, const std::string& expected) {
      throw ParseError(path, row.line, row.number_columns[column], expected, fmt::format("{:g}", row.numbers[column]));
    };
    if (!keys.empty() && row.numbers[0] <= keys.back().time) {
      refuse(0, fmt::format("a time after {:g} s", keys.back().time));
    }
    effort::EffortKey key{row.numbers[0], effort::EffortVector::Constant(effort::kNotRated)};
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (std::abs(row.numbers[k + 1]) > 1.0) refuse(k + 1, "a number from -1 to 1");
      key.effort[factors[k]] = row.numbers[k + 1];
    }
    keys.push_back(key);
  }
  return effort::EffortCurve(std::move(keys));
}

effort::EffortVector parse_effort_weights(const std::string& word) {
  if (word == "equal") return effort::EffortVector::Ones();
  if (word == "noticed") return effort::noticed_weights();
  std::istringstream stream(word);
  effort::EffortVector weights = effort::EffortVector::Constant(-1.0);
  std::string number, rest;
  for (int factor = 0; factor < effort::kNumPredictedFactors && std::getline(stream, number, ','); ++factor) {
    if (!CLI::detail::lexical_cast(number, weights[factor]) || !std::isfinite(weights[factor])) weights[factor] = -1.0;
  }
  if (weights.minCoeff() < 0.0 || weights.maxCoeff() <= 0.0 || std::getline(stream, rest)) {
    throw CLI::ValidationError("--weights",
                               "expected equal, noticed or FLOW,WEIGHT,TIME, numbers of at least 0 and not "
                               "all 0, got '" +
                                   word + "'");
  }
  return weights;
}

}  // namespace strut::cli
