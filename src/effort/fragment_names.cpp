// SPDX-License-Identifier: MIT
#include <filesystem>

#include <strut/effort/fragment_names.h>

namespace strut::effort {
namespace {

std::string base_name(const std::string& clip) {
  const std::filesystem::path path(clip);
  const std::string extension = path.extension().string();
  return (extension == ".bvh" || extension == ".BVH" ? path.stem() : path.filename()).string();
}

}  // namespace

std::map<RecordId, std::string> fragment_names(const FragmentDatabase& database) {
  std::map<std::string, int> sharing;
  for (const ClipRecord& clip : database.clips()) ++sharing[base_name(clip.name)];
  std::map<RecordId, std::string> names;
  for (const FragmentRecord& fragment : database.fragments()) {
    const std::string base = base_name(fragment.clip_name);
    names[fragment.id] = (sharing[base] == 1 && !base.empty() ? base : fragment.clip_name) + " frames " +
                         std::to_string(fragment.frames.begin) + "-" + std::to_string(fragment.frames.end);
  }
  return names;
}

}  // namespace strut::effort
