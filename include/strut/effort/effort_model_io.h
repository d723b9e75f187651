// SPDX-License-Identifier: MIT
// Effort models as files (.struteffort): FlatBuffers, checked byte by byte before anything is followed. The schema is
// src/effort/effort_model.fbs.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <strut/core/file.h>
#include <strut/effort/effort_model.h>

namespace strut::effort {

/// Whether `bytes` begin as an effort model file does (says nothing about the rest).
bool is_effort_model(std::string_view bytes) noexcept;

/// Parses an effort model and fits what follows from it (EffortModel). `name` is what errors call it.
/// Throws ParseError if the bytes are no intact effort model, VersionError if the format is another version's.
std::shared_ptr<const EffortModel> parse_effort_model(std::string_view bytes, const std::string& name);

/// read_file then parse_effort_model: also throws FileError.
std::shared_ptr<const EffortModel> read_effort_model(const std::string& path);

/// The file's bytes.
std::string format_effort_model(const EffortModel& model);

/// format_effort_model then write_file: throws FileError.
void write_effort_model(const std::string& path, const EffortModel& model, Overwrite overwrite = Overwrite::kRefuse);

}  // namespace strut::effort
