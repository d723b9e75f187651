// SPDX-License-Identifier: MIT
#include "paired_clips.h"

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

  int index_of(const std::string& path) {
    const auto [found, is_new] = indices_.try_emplace(path, static_cast<int>(clips_.size()));
    if (is_new) {
      clips_.push_back(read_bvh(path, {}, diagnostics_).motion);
      paths_.push_back(path);
    }
    return found->second;
  }

 private:
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
    pair.input_clip = inputs.index_of(entry.input.path);
    pair.output_clip = outputs.index_of(entry.output.path);
    const Motion& input = result.inputs[static_cast<std::size_t>(pair.input_clip)];
    const Motion& output = result.outputs[static_cast<std::size_t>(pair.output_clip)];
    pair.input_frames = frames_within(entry.input, input.num_frames(), path);
    pair.output_frames = frames_within(entry.output, output.num_frames(), path);
    pair.slope_limit = learn::slope_limit_for(seconds(pair.input_frames, input), seconds(pair.output_frames, output));
    pair.name = in_words(entry.input, pair.input_frames) + " with " + in_words(entry.output, pair.output_frames);
    result.pairs.push_back(std::move(pair));
  }
  return result;
}

}  // namespace strut::cli
