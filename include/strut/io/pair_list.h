// SPDX-License-Identifier: MIT
// Pair lists: the TOML file that says which clip in the input style belongs to which in the output style. `strut pair`
// writes it, people edit it, `strut learn` reads it:
//
//   [[pair]]
//   input = "normal_001.bvh"      # relative to the list's own folder
//   output = "elderly_001.bvh"
//   input_frames = [30, 96]       # optional: from 0, end not included
//   output_frames = [41, 104]
//
// Comments are a person's and are kept when a list is read and written again. Pairs that a person rejected stand at the
// end as comments, so that taking the "# " away brings them back.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <strut/core/file.h>
#include <strut/motion/annotation.h>

namespace strut {

/// One side of a pair.
struct PairedClip {
  std::string path;                          ///< as a program opens it: the list's folder is already in front
  std::optional<motion::FrameRange> frames;  ///< the whole clip where there are none
  std::size_t line = 0, column = 0;          ///< where the list gives the frames (or else the path); 0 if not read
};

/// One pair of a list.
struct PairListEntry {
  PairedClip input;
  PairedClip output;
  std::string comment;  ///< above the pair for a person to read, one or more lines; comments inside it are added to it
};

/// A list with all that a person sees in it.
struct PairList {
  std::string heading;                  ///< the comment at its top, which a blank line parts from the first pair's
  std::vector<PairListEntry> pairs;     ///< what is learnt from
  std::vector<PairListEntry> rejected;  ///< commented out at the end
  std::string ending;                   ///< the comment after the last pair
};

/// Reads a pair list.
/// Throws FileError if it cannot be read, ParseError (line and column) if it is not TOML, holds no pair, a key it does
/// not know, a value of another type, a path that is empty, or a range of frames that is negative, reversed or empty.
/// Whether the clips exist and are long enough is seen when they are read: see frames_within.
std::vector<PairListEntry> read_pair_list(const std::string& path);

/// The same from text; `path` stands for the file in messages, and its folder is what paths are relative to.
std::vector<PairListEntry> parse_pair_list(std::string_view text, const std::string& path);

/// The same with every comment: none is lost, those inside a pair are kept above it. Throws as parse_pair_list.
PairList parse_annotated_pair_list(std::string_view text, const std::string& path);

/// The frames that `clip` of the list at `list_path` names in a clip of `num_frames` frames.
/// Throws ParseError, pointing into the list, if they reach beyond the clip or the clip has no frame.
motion::FrameRange frames_within(const PairedClip& clip, int num_frames, const std::string& list_path);

/// The text of a list to be saved at `path`: clips are named relative to its folder, `heading` (may be empty, several
/// lines) stands at the top as a comment. Reading it back gives the same pairs.
/// Throws InvalidArgument if there is no pair or a range of frames is negative, reversed or empty.
std::string format_pair_list(const std::vector<PairListEntry>& pairs, const std::string& path,
                             const std::string& heading = {});

/// The same of a list with its comments; parse_annotated_pair_list gives them back, but for blank lines at their ends.
std::string format_pair_list(const PairList& list, const std::string& path);

/// Writes format_pair_list's text to `path`, all or nothing. Throws also FileError.
void write_pair_list(const std::string& path, const std::vector<PairListEntry>& pairs, const std::string& heading = {},
                     Overwrite overwrite = Overwrite::kRefuse);

}  // namespace strut
