// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/effort_curve.h>

namespace strut::effort {
namespace {

void check_key(const EffortKey& key, const EffortKey& first) {
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    const std::string name = kFactorNames[static_cast<std::size_t>(factor)];
    const double value = key.effort[factor];
    if (is_rated(value) != is_rated(first.effort[factor])) {
      throw InvalidArgument("keys", name + " in all keys or in none", "in some");
    }
    if (is_rated(value) && !(std::abs(value) <= 1.0)) {
      throw InvalidArgument("keys", name + " between -1 and 1", std::to_string(value));
    }
  }
}

}  // namespace

EffortCurve::EffortCurve(const EffortVector& effort) : EffortCurve(std::vector<EffortKey>{{0.0, effort}}) {}

EffortCurve::EffortCurve(std::vector<EffortKey> keys) : keys_(std::move(keys)) {
  if (keys_.empty()) throw InvalidArgument("keys", "at least one", "none");
  std::vector<double> times;
  for (const EffortKey& key : keys_) {
    if (!std::isfinite(key.time) || (!times.empty() && key.time <= times.back())) {
      throw InvalidArgument("keys", "times that ascend", std::to_string(key.time) + " s");
    }
    check_key(key, keys_.front());
    times.push_back(key.time);
  }
  if (!asks_for(kFlow) && !asks_for(kWeight) && !asks_for(kTime)) {
    throw InvalidArgument("keys", "a value of flow, weight or time", "none");
  }
  if (keys_.size() < 2) return;
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    if (!asks_for(static_cast<Factor>(factor))) continue;
    std::vector<double> values;
    for (const EffortKey& key : keys_) values.push_back(key.effort[factor]);
    curves_[static_cast<std::size_t>(factor)].emplace(times, std::move(values));
  }
}

EffortVector EffortCurve::at(double time) const {
  if (time <= keys_.front().time || keys_.size() < 2) return keys_.front().effort;
  if (time >= keys_.back().time) return keys_.back().effort;
  EffortVector effort = EffortVector::Constant(kNotRated);
  for (std::size_t factor = 0; factor < curves_.size(); ++factor) {
    if (curves_[factor]) effort[static_cast<Eigen::Index>(factor)] = curves_[factor]->at(time);
  }
  return effort;
}

}  // namespace strut::effort
