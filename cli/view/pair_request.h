// SPDX-License-Identifier: MIT
// What the page sends of pairs, checked before anything is done with it.
#pragma once

#include "view/pair_answer.h"
#include "view/workspace.h"

#include <nlohmann/json.hpp>

#include <strut/io/pair_list.h>

namespace strut::cli {

/// The list that `body` (as pair_list_answer gives it) describes. Throws Refusal, naming the pair by its number from 1,
/// for a clip that is not of the session and for frames that are not within it; of rejected pairs and of clips that
/// cannot be read, frames need only be in order. Throws nlohmann::json::exception for another shape.
PairList pair_list_of(const nlohmann::ordered_json& body, Workspace& workspace);

/// The stretch that `side` ({clip, frames}) describes. Throws Refusal and what reading the clip throws.
ViewStretch stretch_of(const nlohmann::ordered_json& side, Workspace& workspace);

}  // namespace strut::cli
