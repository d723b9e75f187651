// SPDX-License-Identifier: MIT
// Whether a label says something that can be kept, the same for the database and for tables of labels.
#pragma once

#include <string_view>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// Whether `text` is a date and a time of ISO 8601, as 2026-03-01T14:05, with seconds and a zone (Z, +01:00) or not.
bool is_iso_time(std::string_view text) noexcept;

/// Throws InvalidArgument, its argument named after the field, as FragmentDatabase::add_labels says. Does not look at
/// the target.
void check_label(const LabelRecord& label);

}  // namespace strut::effort
