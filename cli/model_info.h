// SPDX-License-Identifier: MIT
// What a style model holds, in words and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <strut/model/style_model.h>

namespace strut::cli {

/// A model's provenance: text that anybody may have written. What is not as strut writes it is shown as it is.
nlohmann::ordered_json provenance_as_json(const std::string& provenance);

/// Frame rate, joints, the radial map or the blocks with their orders, and the model's provenance (files, options,
/// figures on left-out pairs).
nlohmann::ordered_json model_as_json(const std::string& path, const StyleModel& model);

/// The same for a person, on standard output.
void print_model(const std::string& path, const StyleModel& model);

}  // namespace strut::cli
