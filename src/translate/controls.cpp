// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>
#include <string>

#include <strut/core/error.h>
#include <strut/translate/controls.h>

namespace strut {
namespace {

void check_strength(const std::string& name, double value) {
  if (value >= 0.0 && value <= kMostStrength) return;
  throw InvalidArgument(name, "a number from 0 to 1.5", std::to_string(value));
}

}  // namespace

void check_controls(const TranslatorControls& controls, int num_models) {
  check_strength("strength", controls.strength);
  check_strength("pose", controls.pose);
  check_strength("movement", controls.movement);
  for (std::size_t part = 0; part < controls.parts.size(); ++part) {
    check_strength(motion::kBodyPartNames.at(part), controls.parts[part]);
  }
  if (controls.weights.empty()) return;
  if (std::ssize(controls.weights) != num_models) {
    throw InvalidArgument("weights", std::to_string(num_models) + " (a model each)",
                          std::to_string(controls.weights.size()));
  }
  for (const double weight : controls.weights) {
    if (!(weight >= 0.0 && std::isfinite(weight))) {
      throw InvalidArgument("weights", "numbers that are not negative", std::to_string(weight));
    }
  }
  if (std::accumulate(controls.weights.begin(), controls.weights.end(), 0.0) <= 0.0) {
    throw InvalidArgument("weights", "one above 0", "none");
  }
}

}  // namespace strut
