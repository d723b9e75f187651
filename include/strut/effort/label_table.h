// SPDX-License-Identifier: MIT
// Labels as comma-separated values, to be filled in by a person in any spreadsheet: between a database and a table with
// the columns fragment (an id) or clip, begin_frame, end_frame, or first, second, alpha of a blend; rater, labelled_at,
// source, flow, weight, time, space (empty: left out; "not present"), repeat (1: shown again) and comment.
#pragma once

#include <string>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// What came of a table.
struct LabelImport {
  int added = 0;
  int repeated = 0;   ///< rows of a rater, target and time that are there already, left out
  int estimates = 0;  ///< rows whose source is "estimate": never taken for labels, left out
};

/// Takes the table at `path` into the database, all of it or nothing. Only rater, labelled_at and a target are required
/// columns. Throws FileError, or ParseError (line and column) for what cannot be a label: a number that is none or is
/// outside [-1, 1], a fragment that is not there, a blend of a pair that is not accepted, no rater, no time.
LabelImport import_labels(FragmentDatabase& database, const std::string& path);

/// All labels as a table; importing it elsewhere gives the same labels. With `with_estimates` the estimates follow, of
/// source "estimate", for a person to start from.
std::string format_labels(const FragmentDatabase& database, bool with_estimates = false);

}  // namespace strut::effort
