// SPDX-License-Identifier: MIT
// Gait models as files (.strutgait): FlatBuffers, checked byte by byte before anything is followed. The schema is
// src/blend/gait_model.fbs.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <strut/blend/gait_model.h>
#include <strut/core/file.h>

namespace strut::blend {

/// Whether `bytes` begin as a gait model file does (says nothing about the rest).
bool is_gait_model(std::string_view bytes) noexcept;

/// Parses a gait model. `name` is what errors call it.
/// Throws ParseError if the bytes are no intact gait model, VersionError if the format is another version's.
std::shared_ptr<const GaitModel> parse_gait_model(std::string_view bytes, const std::string& name);

/// read_file then parse_gait_model: also throws FileError.
std::shared_ptr<const GaitModel> read_gait_model(const std::string& path);

/// The file's bytes.
std::string format_gait_model(const GaitModel& model);

/// format_gait_model then write_file: throws FileError.
void write_gait_model(const std::string& path, const GaitModel& model, Overwrite overwrite = Overwrite::kRefuse);

}  // namespace strut::blend
