// SPDX-License-Identifier: MIT
// What the page asks to be translated, and how: the controls of strut translate as JSON, what they may be, and the
// command that does the same.
#pragma once

#include "view/workspace.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <strut/translate/translate_motion.h>

namespace strut::cli {

struct TranslateRequest {
  std::string clip;                 ///< its file's id
  std::vector<std::string> models;  ///< ids; the first one has what the shares of the others leave
  TranslateOptions options;
  bool keep_layout = false;
};

/// {"clip": ID, "models": [{"id": ID}, {"id": ID, "share": 0 to 1}, ...], NAME: VALUE, ...}, NAME one of those of
/// controls_as_json; what is left out is as usual. Throws Refusal for what it does not know or cannot be,
/// InvalidArgument for shares that are more than 1 together.
TranslateRequest parse_translate_request(const std::string& body);

/// {"numbers": [{"name", "group", "least", "greatest", "usual"}], "switches": [{"name", "usual"}]}; warmUp in seconds.
nlohmann::ordered_json controls_as_json();

/// "CLIP_MODEL.bvh", of characters that every system has in names.
std::string output_name(const TranslateRequest& request, const Workspace& workspace);

/// `strut translate ...` for a shell, with the files as they were named, read as the session reads them, and only what
/// is not as usual.
std::string command_line(const TranslateRequest& request, const Workspace& workspace);

}  // namespace strut::cli
