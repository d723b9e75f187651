// SPDX-License-Identifier: MIT
#include "paired_clips.h"

#include "input_files.h"

#include <map>

#include <strut/io/bvh.h>
#include <strut/io/pair_list.h>

namespace strut::cli {
namespace {

/// The clips of one style, each read once.
class ClipSet {
 public:
  ClipSet(std::vector<std::string>& paths, std::vector<Motion>& clips, Diagnostics* diagnostics)
      : paths_(paths), clips_(clips), diagnostics_(diagnostics) {}

  int index_of(const PairedClip& clip, const std::string& list_path) {
    const auto [found, is_new] = indices_.try_emplace(clip.path, static_cast<int>(clips_.size()));
    if (is_new) {
      clips_.push_back(read_clip(clip, list_path));
      paths_.push_back(clip.path);
    }
    return found->second;
  }

 private:
  Motion read_clip(const PairedClip& clip, const std::string& list_path) {
    try {
      return read_bvh(clip.path, {}, diagnostics_).motion;
    } catch (const FileError& error) {
      throw FileError(FileAction::kRead, clip.path, error.reason(),
                      "it is named in " + list_path + ":" + std::to_string(clip.line) + ", relative to that list");
    }
  }

  std::vector<std::string>& paths_;
  std::vector<Motion>& clips_;
  Diagnostics* diagnostics_;
  std::map<std::string, int> indices_;
};

double seconds(const motion::FrameRange& range, const Motion& clip) {
  return (range.end - range.begin) / clip.frame_rate();
}

std::string in_words(const PairedClip& clip, const motion::FrameRange& frames) {
  return clip.path + " [" + std::to_string(frames.begin) + ", " + std::to_string(frames.end) + "]";
}

}  // namespace

PairedClips read_paired_clips(const std::string& path, Diagnostics* diagnostics) {
  PairedClips result;
  ClipSet inputs(result.input_paths, result.inputs, diagnostics);
  ClipSet outputs(result.output_paths, result.outputs, diagnostics);
  for (const PairListEntry& entry : read_pair_list(path)) {
    learn::ClipPair pair;
    pair.input_clip = inputs.index_of(entry.input, path);
    pair.output_clip = outputs.index_of(entry.output, path);
    const Motion& input = result.inputs[static_cast<std::size_t>(pair.input_clip)];
    const Motion& output = result.outputs[static_cast<std::size_t>(pair.output_clip)];
    pair.input_frames = frames_within(entry.input, input.num_frames(), path);
    pair.output_frames = frames_within(entry.output, output.num_frames(), path);
    pair.slope_limit = learn::slope_limit_for(seconds(pair.input_frames, input), seconds(pair.output_frames, output));
    const Motion& first = result.inputs.front();
    check_same_skeleton(entry.input.path, input.skeleton(), result.input_paths.front(), first.skeleton());
    check_same_skeleton(entry.output.path, output.skeleton(), result.input_paths.front(), first.skeleton());
    pair.name = in_words(entry.input, pair.input_frames) + " with " + in_words(entry.output, pair.output_frames);
    result.pairs.push_back(std::move(pair));
  }
  return result;
}

}  // namespace strut::cli
