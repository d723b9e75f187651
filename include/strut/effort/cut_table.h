// SPDX-License-Identifier: MIT
// Where clips are cut, as comma-separated values that a person edits: columns clip, begin_frame, end_frame (the end is
// not included) and, if wanted, performer and action; others are for reading only.
#pragma once

#include <string>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// All fragments as a table; a clip without any has a row without frames.
std::string format_cuts(const FragmentDatabase& database);

/// Cuts the clips that the table at `path` names as it says; others stay as they are. Fragments whose frames stay keep
/// their ids and labels. All or nothing. How many clips were named. Throws FileError, or ParseError (line and column)
/// for a clip that is not there, frames outside it or that overlap, and, with kRefuse, for labelled fragments that
/// would go, naming them.
int import_cuts(FragmentDatabase& database, const std::string& path, OnLabels labels = OnLabels::kRefuse);

}  // namespace strut::effort
