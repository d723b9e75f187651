// SPDX-License-Identifier: MIT
// Correspondences of many signals of the same content: each with one reference, or all with a common timeline that
// none of them sets. Blending, linear analysis and statistics of styles start here (Hsu et al. 2005, 5.1).
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/frame_matrix.h>

namespace strut::align {

/// Finds the correspondence of two signals. Called from several threads at once.
using Aligner = std::function<Correspondence(const Eigen::Ref<const FrameMatrix>& input,
                                             const Eigen::Ref<const FrameMatrix>& output)>;

/// Iterative motion warping with its default options, the differential warp smoothed (10 frames^2).
Correspondence align_smoothly(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output);

/// Every clip's correspondence with `reference` (frames x dofs): of the reference's frames, in the clip. In parallel;
/// the result does not depend on the number of threads. Throws InvalidArgument as the aligner does, with the clip named
/// by its index. Cost: one alignment a clip.
std::vector<Correspondence> align_to_reference(const Eigen::Ref<const FrameMatrix>& reference,
                                               const std::vector<FrameMatrix>& clips,
                                               const Aligner& aligner = align_smoothly);

/// How a group is aligned.
struct GroupOptions {
  int num_frames = 0;       ///< of the common timeline; 0: the geometric mean of the clips' frames
  int max_rounds = 8;       ///< at most this often is every clip aligned with the mean, >= 1
  double tolerance = 0.05;  ///< stop when no moment of a clip moves by more than this share of a timeline frame, >= 0
  Aligner aligner = align_smoothly;
};

/// A group on its common timeline.
struct GroupAlignment {
  std::vector<Correspondence> clips;  ///< of the timeline's frames, in each clip (clips)
  FrameMatrix mean;                   ///< the clips' mean on the timeline (timeline frames x dofs)
  std::vector<double> spread;         ///< root mean square distance of the clips from it, after each round
  double moved = 0.0;                 ///< how far the last round moved a moment at most [timeline frames]
  bool converged = false;             ///< whether that is within the tolerance
};

/// Finds the timeline that all clips have in common. Begins with the clip nearest to the others when all are stretched
/// evenly; then aligns every clip with the mean of all and takes the mean on the timeline that is, at every moment, the
/// mean of the clips' own times (each as a share of its duration), until nothing moves: so no clip sets the timing. The
/// round of least spread is returned. Two clips correspond through the timeline: compose one's inverse with the other.
/// `clips` (frames x dofs), normalized as for iterative_motion_warping. Throws InvalidArgument if there are fewer than
/// two clips, their degrees of freedom differ, an option is out of range, or as the aligner does, with the clip named.
/// In parallel; the result does not depend on the number of threads, nor, but for equals, on the clips' order. Cost:
/// rounds x clips alignments.
GroupAlignment align_group(const std::vector<FrameMatrix>& clips, const GroupOptions& options = {});

}  // namespace strut::align
