// SPDX-License-Identifier: MIT
#include "input_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace strut::cli {

void refuse_clip(const std::string& path, const SkeletonMismatch& error) {
  throw SkeletonMismatch(path + ": error: " + error.what(),
                         "translate motion of the character the style was learnt on");
}

void check_same_skeleton(const std::string& path, const Skeleton& skeleton, const std::string& reference_path,
                         const Skeleton& reference) {
  const std::string mismatch = describe_mismatch(reference, skeleton);
  if (mismatch.empty()) return;
  throw SkeletonMismatch(path + ": error: not the skeleton of " + reference_path + ": " + mismatch);
}

std::string first_bytes(const std::string& path) {
  constexpr std::size_t kEnough = 4096;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::string bytes(kEnough, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

void check_output(const std::string& output, const std::vector<std::string>& inputs, Overwrite overwrite) {
  check_writable(output, overwrite);
  for (const std::string& input : inputs) {
    std::error_code missing;
    const bool is_input = output == input || std::filesystem::equivalent(output, input, missing);
    if (is_input && !std::filesystem::is_character_file(output, missing)) {
      throw FileError(FileAction::kWrite, output, "is needed as '" + input + "' and cannot be overwritten",
                      "give the output a name of its own");
    }
  }
}

}  // namespace strut::cli
