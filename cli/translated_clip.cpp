// SPDX-License-Identifier: MIT
#include "translated_clip.h"

#include "feet_options.h"
#include "input_files.h"

#include <utility>

#include <strut/motion/legs.h>

namespace strut::cli {

TranslatedClip translate_file(const std::string& path, const BvhClip& clip,
                              const std::vector<std::shared_ptr<const StyleModel>>& models, TranslateOptions options,
                              bool keep_layout, Diagnostics* diagnostics) {
  BvhLayout layout =
      keep_layout ? clip.layout : default_layout(clip.motion.skeleton(), clip.layout.unit, clip.layout.up);
  if (options.clean_feet) {
    const auto legs = motion::find_legs(clip.motion);
    if (!legs || !holds_stretch(layout, *legs)) options.footskate.max_stretch = 0.0;
  }
  try {
    Translation translation =
        naming_the_file(path, [&] { return translate_with_moments(models, clip.motion, options, diagnostics); });
    return {std::move(translation), std::move(layout)};
  } catch (const SkeletonMismatch& error) {
    refuse_clip(path, error);
  }
}

}  // namespace strut::cli
