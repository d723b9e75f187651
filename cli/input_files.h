// SPDX-License-Identifier: MIT
// What the commands share in refusing files: the library's refusals do not know the file, the person needs its name.
#pragma once

#include <string>
#include <vector>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/motion/skeleton.h>

namespace strut::cli {

/// What was asked cannot be done with this input file, though it could be read: exit code 3.
class BadInput : public Error {
 public:
  BadInput(const std::string& path, const std::string& reason, std::string hint = {})
      : Error(path + ": error: " + reason, std::move(hint)) {}
};

/// Does `work` with the file at `path`; what it refuses is the file's fault.
template <typename Work>
auto naming_the_file(const std::string& path, Work work) {
  try {
    return work();
  } catch (const InvalidArgument& error) {
    // The argument's name means something to a programmer only.
    throw BadInput(path, std::string(error.what()).substr(error.argument().size() + 2), error.hint());
  }
}

/// Passes `error` on as one of the clip at `path`: that a model does not fit is the clip's fault in a person's eyes.
[[noreturn]] void refuse_clip(const std::string& path, const SkeletonMismatch& error);

/// Throws SkeletonMismatch, naming both files, if `skeleton` has other joints than `reference`.
void check_same_skeleton(const std::string& path, const Skeleton& skeleton, const std::string& reference_path,
                         const Skeleton& reference);

/// What is enough to know a file's kind by: it may be far too long to be read whole. Nothing of a pipe, whose bytes
/// come once, and of what cannot be read.
std::string first_bytes(const std::string& path);

/// Refuses, before anything is computed, an output that cannot be written or that is one of the command's own inputs
/// or earlier outputs: --force is meant for the results of earlier runs.
void check_output(const std::string& output, const std::vector<std::string>& inputs, Overwrite overwrite);

}  // namespace strut::cli
