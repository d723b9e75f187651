// SPDX-License-Identifier: MIT
// A pair list with its clips read.
#pragma once

#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/learn/clip_pair.h>
#include <strut/motion/motion.h>

namespace strut::cli {

/// Clips of both styles and the pairs between them.
struct PairedClips {
  std::vector<std::string> input_paths, output_paths;  ///< as found, each once
  std::vector<Motion> inputs, outputs;                 ///< in the same order
  std::vector<learn::ClipPair> pairs;                  ///< by index into them
};

/// Reads the list at `path` and every clip it names, each once. Throws what reading lists and clips throws, and
/// ParseError (naming the line) for a range beyond its clip.
PairedClips read_paired_clips(const std::string& path, Diagnostics* diagnostics);

}  // namespace strut::cli
