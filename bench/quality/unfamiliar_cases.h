// SPDX-License-Identifier: MIT
// Motion as no example shows it, beside the same motion as examples do show it, and models to put on both: the cases of
// the study of generalization (Hsu et al. 2005, 4.5). Generated, and made from real takes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <strut/model/style_model.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::quality {

/// A clip that is unlike the examples in `frames`.
struct UnfamiliarCase {
  std::string name;
  Motion clip;
  motion::FrameRange frames;    ///< of the clip
  std::optional<Motion> plain;  ///< frame for frame the same without, where there is such a motion
  std::shared_ptr<const StyleModel> model;
};

/// A content of real takes: what was learnt, and takes that were not.
struct FamiliarContent {
  std::string name;
  std::vector<Motion> takes;
  std::shared_ptr<const StyleModel> model;
};

/// A limp learnt from generated walks; stepping over, ducking, a raised arm, standing, sideways, other bodies.
std::vector<UnfamiliarCase> generated_cases();

/// Takes 009-012 of every content in `folder` (dataset-2_CONTENT_STYLE_TAKE.bvh), models from 001-008. Throws FileError
/// where one is missing.
std::vector<FamiliarContent> familiar_contents(const std::string& folder);

/// Variations of a familiar walk, takes of other contents and styles through its model.
std::vector<UnfamiliarCase> real_cases(const std::string& folder, const FamiliarContent& walk);

}  // namespace strut::quality
