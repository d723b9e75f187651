// SPDX-License-Identifier: MIT
// Style models as files (.strut): FlatBuffers, checked byte by byte before anything is followed. The schema is
// src/model/style_model.fbs.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <strut/core/file.h>
#include <strut/model/style_model.h>

namespace strut {

/// Whether `bytes` begin as a style model file does (says nothing about the rest).
bool is_style_model(std::string_view bytes) noexcept;

/// Parses a style model. `name` is what errors call it.
/// Throws ParseError if the bytes are no intact style model, VersionError if the format is another version's.
std::shared_ptr<const StyleModel> parse_style_model(std::string_view bytes, const std::string& name);

/// read_file then parse_style_model: also throws FileError.
std::shared_ptr<const StyleModel> read_style_model(const std::string& path);

/// The file's bytes.
std::string format_style_model(const StyleModel& model);

/// format_style_model then write_file: throws FileError.
void write_style_model(const std::string& path, const StyleModel& model, Overwrite overwrite = Overwrite::kRefuse);

}  // namespace strut
