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
#include <strut/motion/motion.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::cli {

/// The command line of strut align.
struct AlignOptions {
  std::string input;
  std::vector<std::string> outputs;
  int method = 0;  ///< its index in align_methods()
  AlignSettings settings;
  double warp_smoothness = 10.0;     ///< [frames^2]
  std::vector<std::string> weights;  ///< NAME=X
  bool shared_units = false;
  FeetOptions feet;
  std::string csv, inverse_csv, plot;
  int figure = 0;  ///< a FigurePart
  std::string dof;
  std::optional<Span> window;  ///< of the input that is drawn [s]
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
  AlignSettings settings{};  ///< with every degree of freedom's weight
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

/// How many degrees of freedom tell anything.
int num_compared(const Alignment& alignment);

/// Aligns `input` with `output`, which is resampled if its frame rate is another. Throws SkeletonMismatch, and
/// BadInput, naming the output's file, where there is nothing to align by or no alignment within the limits.
Alignment align_clips(const AlignClip& input, AlignClip output, const AlignOptions& options, Diagnostics& diagnostics);

/// `warp` with its differential warp smoothed.
align::Correspondence smoothed(const align::Correspondence& warp, double smoothness);

/// The same pair aligned by another method, judged in the same way.
AlignAnswer solve(const Alignment& alignment, const AlignMethod& method);
JudgedWarp judge(const Alignment& alignment, const align::Correspondence& warp);

/// What is to be doubted of an alignment that was judged; empty if nothing is.
Diagnostics warnings_of(const Alignment& alignment);

/// The degree of freedom called `name`: its own name or its joint's; then of the joint's the one for which `rank`
/// (dofs) is highest. Throws InvalidArgument for `option`, with all names, if there is none.
int find_dof(const std::string& option, const representation::Representation& shape, const std::string& name,
             const Eigen::VectorXd& rank);

}  // namespace strut::cli
