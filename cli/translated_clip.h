// SPDX-License-Identifier: MIT
// A style put on a clip that was read from a file, ready to be written as one: for the command and for the page.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model.h>
#include <strut/translate/translate_motion.h>

namespace strut::cli {

struct TranslatedClip {
  Translation translation;
  BvhLayout layout;  ///< to write the motion in
};

/// Translates the clip at `path`. `keep_layout`: it will be written in the file's own channels; legs stretch only where
/// the channels can hold that. Throws SkeletonMismatch and BadInput, naming the file, and InvalidArgument if an option
/// is out of range.
TranslatedClip translate_file(const std::string& path, const BvhClip& clip,
                              const std::vector<std::shared_ptr<const StyleModel>>& models, TranslateOptions options,
                              bool keep_layout, Diagnostics* diagnostics);

}  // namespace strut::cli
