// SPDX-License-Identifier: MIT
#include "correspondence_groups.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include <strut/align/groupwise.h>
#include <strut/align/warp_curve.h>

namespace strut::study {
namespace {

using Walks = std::vector<generate::Walk>;

/// Whether `method` can align signals of so many frames.
bool can_align(const Method& method, Eigen::Index a, Eigen::Index b) {
  const auto [shorter, longer] = std::minmax(a, b);
  return static_cast<double>(longer) <= slope_limit_of(method) * static_cast<double>(shorter);
}

/// Those of a group that `method` can align with its first.
Walks within_reach(const Method& method, Walks walks) {
  const int frames = walks.front().motion.num_frames();
  std::erase_if(walks,
                [&](const generate::Walk& walk) { return !can_align(method, walk.motion.num_frames(), frames); });
  return walks;
}

std::vector<FrameMatrix> postures_of(const Walks& walks) {
  std::vector<FrameMatrix> postures;
  for (const generate::Walk& walk : walks) {
    postures.push_back(representation::alignment_features(walk.motion, walk.motion).input);
  }
  return postures;
}

/// From one walk to another by way of what both correspond with.
align::Correspondence through(const align::Correspondence& from, const align::Correspondence& to) {
  return align::compose(align::inverse(from), to);
}

void add(Figures& figures, const align::Correspondence& found, const std::vector<double>& truth) {
  const Eigen::VectorXd time = found.output_time();
  for (Eigen::Index t = 0; t < time.size(); ++t) figures.add_error(time[t] - truth[static_cast<std::size_t>(t)]);
}

GroupFigures judge_group(const Method& method, const Walks& group) {
  const Walks walks = within_reach(method, group);
  const align::Aligner aligner = [&](const auto& input, const auto& output) {
    return solve(method, {input, output, {}, walks.front().motion.frame_rate()});
  };
  const std::vector<FrameMatrix> postures = postures_of(walks);
  const auto by_reference = align::align_to_reference(postures.front(), postures, aligner);
  align::GroupOptions options;
  options.aligner = aligner;
  const auto by_timeline = align::align_group(postures, options).clips;
  GroupFigures figures;
  for (std::size_t a = 0; a < walks.size(); ++a) {
    for (std::size_t b = 0; b < walks.size(); ++b) {
      if (a == b || !can_align(method, postures[a].rows(), postures[b].rows())) continue;
      const std::vector<double> truth = generate::true_correspondence(walks[a], walks[b]);
      add(figures.direct, aligner(postures[a], postures[b]), truth);
      add(figures.reference, through(by_reference[a], by_reference[b]), truth);
      add(figures.timeline, through(by_timeline[a], by_timeline[b]), truth);
    }
  }
  return figures;
}

}  // namespace

GroupFigures judge_groups(const Method& method, const std::vector<Walks>& groups) {
  std::vector<GroupFigures> of_group(groups.size());
  tbb::parallel_for(std::size_t{0}, groups.size(),
                    [&](std::size_t i) { of_group[i] = judge_group(method, groups[i]); });
  GroupFigures figures;
  for (const GroupFigures& one : of_group) {
    figures.direct.add(one.direct);
    figures.reference.add(one.reference);
    figures.timeline.add(one.timeline);
  }
  return figures;
}

}  // namespace strut::study
