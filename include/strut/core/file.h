// SPDX-License-Identifier: MIT
// Whole files in and out. Writing is all or nothing: the bytes go to an unnamed (or temporary) file in the target's
// folder, which takes the target's name only when complete, so a failed or interrupted run leaves nothing half-written.
#pragma once

#include <string>
#include <string_view>

namespace strut {

/// What to do when the file to be written is already there.
enum class Overwrite { kRefuse, kAllow };

/// Reads a whole file, bytes unchanged.
/// Throws FileError if it cannot be opened or read, or is a directory. Cost: one pass.
std::string read_file(const std::string& path);

/// Writes a whole file atomically. Parent folders are not made.
/// Throws FileError if the file exists and `overwrite` is kRefuse, or if writing fails (disk full, no permission); then
/// whatever stood at `path` before is untouched. Devices and pipes (/dev/stdout) are written straight through.
void write_file(const std::string& path, std::string_view bytes, Overwrite overwrite = Overwrite::kRefuse);

/// Throws the FileError that write_file would for a target that already exists or whose folder is missing; lets a long
/// computation refuse before it starts.
void check_writable(const std::string& path, Overwrite overwrite);

}  // namespace strut
