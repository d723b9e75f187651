// SPDX-License-Identifier: MIT
// Aligning a clip with another as a person asks for it: from two files and the options to a correspondence, what it is
// worth, and what to be wary of. The report, the tables and the figure are made of this.
#pragma once

#include "align_events.h"
#include "align_figure.h"
#include "align_methods.h"
#include "feet_options.h"

#include <optional>
#include <string>
#include <vector>

#include <strut/align/correspondence.h>
#include <strut/core/diagnostics.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::cli {

/// The command line of strut align.
struct AlignOptions {
  std::string input;
  std::vector<std::string> outputs;
  std::optional<int> method;   ///< its index in align_methods(); none: default_method
  std::optional<int> signals;  ///< a SignalSet; none: the method's
  AlignSettings settings;
  std::optional<double> warp_smoothness;  ///< [frames^2]; none: the method's
  std::vector<std::string> weights;       ///< NAME=X
  bool shared_units = false;
  FeetOptions feet;
  std::string csv, inverse_csv, plot;
  int figure = 0;  ///< a FigurePart
  std::string dof;
  std::optional<Span> window;  ///< of the input that is drawn [s]
  bool groupwise = false;
  bool json = false, force = false;
};

/// A clip that is aligned.
struct AlignClip {
  std::string path;
  Motion motion;
};

/// A warp, how it runs, and how it meets the footplants.
struct JudgedWarp {
  align::Correspondence warp;
  Eigen::VectorXd output_time;  ///< [output frames] (input frames)
  std::optional<OnsetErrors> onsets{};
};

/// Two clips, aligned.
struct Alignment {
  const AlignClip* input = nullptr;  ///< not owned
  AlignClip output;
  const AlignMethod* method = nullptr;
  SignalSet signals = SignalSet::kAll;
  AlignSettings settings{};  ///< with every signal's weight
  double slope_limit = 0.0;  ///< 0: none
  representation::AlignmentPair features{};
  AlignAnswer answer{};
  JudgedWarp found{}, smoothed{}, even{};  ///< `even`: the input stretched evenly, what an alignment must beat
  AlignPlants plants{};
  std::string no_plants{};  ///< why they are missing
  Diagnostics warnings{};   ///< what is to be doubted
};

/// Reads the clip at `path`. Throws what reading does, and BadInput if it has fewer than two frames.
AlignClip read_align_clip(const std::string& path, Diagnostics& diagnostics);

/// A clip that was read already. Throws BadInput if it has fewer than two frames.
AlignClip align_clip(const std::string& path, Motion motion);

/// The method that `options` ask for. Throws InvalidArgument if it cannot do what else they ask for.
const AlignMethod& method_of(const AlignOptions& options);

/// What `method` is to look at.
SignalSet signals_of(const AlignOptions& options, const AlignMethod& method);

/// `clip` at the frame rate of `reference`, resampled with a note if it has another. Throws SkeletonMismatch, naming
/// both.
void make_comparable(AlignClip& clip, const AlignClip& reference, Diagnostics& diagnostics);

/// When `clip`'s feet are planted; nothing, and why in `missing`, for a body without two legs. Throws BadInput if it
/// has not the feet that were named.
std::optional<std::vector<motion::Footplant>> plants_of(const AlignClip& clip, const FeetOptions& feet,
                                                        std::string& missing);

/// How many signals tell anything.
int num_compared(const Alignment& alignment);

/// Aligns `input` with `output`, which is resampled if its frame rate is another. Throws SkeletonMismatch, and
/// BadInput, naming the output's file, where there is nothing to align by or no alignment within the limits.
Alignment align_clips(const AlignClip& input, AlignClip output, const AlignOptions& options, Diagnostics& diagnostics);

/// `warp` with its differential warp smoothed as asked for, or as `method` needs it.
align::Correspondence smoothed(const align::Correspondence& warp, const AlignMethod& method,
                               const AlignOptions& options);

/// Whether smoothing changed anything.
bool is_smoothed(const Alignment& alignment);

/// The same pair aligned by another method, judged in the same way.
AlignAnswer solve(const Alignment& alignment, const AlignMethod& method);
JudgedWarp judge(const Alignment& alignment, const align::Correspondence& warp);

/// What is to be doubted of an alignment that was judged; empty if nothing is.
Diagnostics warnings_of(const Alignment& alignment);

}  // namespace strut::cli
