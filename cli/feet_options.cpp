// SPDX-License-Identifier: MIT
#include "feet_options.h"

#include "input_files.h"

#include <fmt/core.h>

namespace strut::cli {
namespace {

/// The names of the joints, for a person to choose from.
std::string joint_names(const Skeleton& skeleton) {
  std::string names;
  for (const Joint& joint : skeleton.joints()) names += (names.empty() ? "" : ", ") + joint.name;
  return names;
}

}  // namespace

void add_feet_option(CLI::App& command, FeetOptions& feet) {
  command
      .add_option_function<std::string>(
          "--feet",
          [&feet](const std::string& word) {
            const auto comma = word.find(',');
            if (comma == 0 || comma == std::string::npos || comma + 1 == word.size()) {
              throw CLI::ValidationError("--feet",
                                         fmt::format("expected two joints' names, LEFT,RIGHT, got '{}'", word));
            }
            feet = {word.substr(0, comma), word.substr(comma + 1)};
          },
          "The joints that are the feet: ankles or toes (default: found by the body's shape)")
      ->type_name("LEFT,RIGHT");
}

motion::Legs legs_of(const std::string& path, const Motion& clip, const FeetOptions& feet) {
  if (feet.left.empty()) {
    const auto legs = motion::find_legs(clip);
    if (legs) return *legs;
    throw BadInput(path, clip.num_frames() == 0 ? "expected at least one frame, got none" : "no two legs were found",
                   "name the feet: --feet LEFT,RIGHT");
  }
  try {
    return motion::legs_with_feet(clip, feet.left, feet.right);
  } catch (const InvalidArgument& error) {
    throw BadInput(path, std::string("--feet: ") + std::string(error.what()).substr(error.argument().size() + 2),
                   "its joints are: " + joint_names(clip.skeleton()));
  }
}

bool holds_stretch(const BvhLayout& layout, const motion::Legs& legs) {
  for (const int foot : {0, 1}) {
    for (const int joint : {legs.foot(foot).knee, legs.foot(foot).ankle}) {
      if (layout.channels[static_cast<std::size_t>(joint)].size() < 6) return false;
    }
  }
  return true;
}

}  // namespace strut::cli
