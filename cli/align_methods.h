// SPDX-License-Identifier: MIT
// The alignment methods the program offers. To offer another one, add a row to the table in align_methods.cpp: help,
// completion, reports and figures take it from there.
#pragma once

#include <optional>
#include <vector>

#include <strut/align/correspondence.h>
#include <strut/align/time_warp.h>
#include <strut/math/frame_matrix.h>
#include <strut/representation/alignment_features.h>

namespace strut::cli {

/// What a method looks at (alignment_features.h).
enum class SignalSet {
  kPosture,  ///< the paper's
  kAll,      ///< posture, movement and the stillness of the feet
};

/// What a person may set of an alignment; each method takes what it knows.
struct AlignSettings {
  align::TimeWarpOptions time{};        ///< resolution, ends, weights; not its slope limit
  std::optional<double> slope_limit{};  ///< none: the method's own
  double smoothness = 100.0;            ///< of the spatial warp
  int rounds = 10;
  double frame_rate = 30.0;  ///< of both clips [frames/s]
};

/// A method's answer.
struct AlignAnswer {
  align::Correspondence correspondence;
  std::vector<double> objective{};  ///< what it minimizes, after each round or step; empty where there are none
  FrameMatrix seen_input{};         ///< the input as it was compared in the end; empty: as it is
  bool is_exact = true;             ///< false if not all warps were looked at
};

/// One method.
struct AlignMethod {
  const char* name;           ///< on the command line
  const char* title;          ///< to a person
  const char* description;    ///< in the help
  const char* compared_with;  ///< the name of the method drawn beside it
  bool opens_ends;            ///< whether it can look for the input inside the output
  SignalSet signals;          ///< what it looks at unless told
  double warp_smoothness;     ///< of its differential warp unless told [frames^2]; 0 where it is smooth by itself
  bool has_rounds;            ///< whether AlignAnswer::objective is of rounds; else of many small steps
  /// The largest output frames per input frame; 0: any. Throws InvalidArgument for one it cannot keep.
  double (*slope_limit)(const AlignSettings&);
  /// Throws InvalidArgument as the library does.
  AlignAnswer (*solve)(const representation::AlignmentPair&, const AlignSettings&);
};

/// All of them, the default first.
const std::vector<AlignMethod>& align_methods();

/// The method for these ends where none is asked for: the default, or the first that can open them.
const AlignMethod& default_method(align::Ends ends);

/// The method that is drawn beside `method`. With open ends it is another one if the usual one cannot do that.
const AlignMethod& compared_method(const AlignMethod& method, align::Ends ends);

}  // namespace strut::cli
