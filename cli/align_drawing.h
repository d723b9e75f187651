// SPDX-License-Identifier: MIT
// From an alignment to its figure: chooses what is drawn (a degree of freedom, a method to compare with, a window) and
// computes the maps.
#pragma once

#include "align_figure.h"
#include "alignment.h"

#include <string>

namespace strut::cli {

/// What is drawn of `alignment`. Solves the pair by the method it is compared with too, and says so if
/// that cannot. Throws InvalidArgument for a
/// --dof or --window that is not of these clips. Cost: that of aligning, and O(frames x dofs).
AlignFigure figure_of(const Alignment& alignment, const AlignOptions& options, Diagnostics& diagnostics);

/// Mean squared distances between blocks of frames: rows for `output`'s frames from `output_begin` on, columns for
/// `input`'s; at most `most` of either, of the given numbers of frames. Exact, from the blocks' means alone. Cost
/// O(frames x dofs + most^2 x dofs).
FrameMatrix block_distances(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                            Eigen::Index most);

}  // namespace strut::cli
