// SPDX-License-Identifier: MIT
// What a database's fragments are called in tables for people: by the clip's own name instead of the whole path.
#pragma once

#include <map>
#include <string>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// Every fragment's name, as "raise_001 frames 0-20" (the end is not included): the file's name without folder and
/// extension, or the clip's whole name where two clips of the database share that. Cost O(fragments log fragments).
std::map<RecordId, std::string> fragment_names(const FragmentDatabase& database);

}  // namespace strut::effort
