// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/postprocess/footplant_classifier.h>

namespace strut::postprocess {
namespace {

void check_clips(const std::vector<LabelledStates>& clips) {
  Eigen::Index frames = 0;
  for (const LabelledStates& clip : clips) {
    frames += clip.states.rows();
    if (clip.states.cols() != clips.front().states.cols()) {
      throw InvalidArgument("states", std::to_string(clips.front().states.cols()) + " columns",
                            std::to_string(clip.states.cols()));
    }
    for (const std::vector<bool>& planted : clip.planted) {
      if (static_cast<Eigen::Index>(planted.size()) == clip.states.rows()) continue;
      throw InvalidArgument("planted", std::to_string(clip.states.rows()) + " frames", std::to_string(planted.size()));
    }
    if (!clip.states.allFinite()) throw InvalidArgument("states", "finite numbers", "NaN or infinity");
  }
  if (frames == 0) throw InvalidArgument("clips", "at least one frame", "none");
}

FootplantBoundary train_foot(const FrameMatrix& states, const std::vector<bool>& planted,
                             const DiscriminantOptions& options) {
  const auto count = std::count(planted.begin(), planted.end(), true);
  if (count == 0 || count == states.rows()) {
    return {Eigen::VectorXd::Zero(states.cols()), count == 0 ? 1.0 : -1.0, true};
  }
  Discriminant found = discriminant_analysis(states, planted, options);
  return {std::move(found.projection), found.boundary, true};
}

}  // namespace

FootplantClassifier::FootplantClassifier(std::array<FootplantBoundary, 2> feet) : feet_(std::move(feet)) {
  if (feet_[0].projection.size() != feet_[1].projection.size()) {
    throw InvalidArgument(
        "projection", "as many states for both feet",
        std::to_string(feet_[0].projection.size()) + " and " + std::to_string(feet_[1].projection.size()));
  }
  for (const FootplantBoundary& foot : feet_) {
    if (foot.projection.allFinite() && std::isfinite(foot.boundary)) continue;
    throw InvalidArgument("footplants", "finite numbers", "NaN or infinity");
  }
}

FootplantClassifier train_footplant_classifier(const std::vector<LabelledStates>& clips,
                                               const DiscriminantOptions& options) {
  check_clips(clips);
  Eigen::Index frames = 0;
  for (const LabelledStates& clip : clips) frames += clip.states.rows();
  FrameMatrix states(frames, clips.front().states.cols());
  std::array<std::vector<bool>, 2> planted;
  Eigen::Index next = 0;
  for (const LabelledStates& clip : clips) {
    states.middleRows(next, clip.states.rows()) = clip.states;
    next += clip.states.rows();
    for (std::size_t f = 0; f < 2; ++f) {
      planted[f].insert(planted[f].end(), clip.planted[f].begin(), clip.planted[f].end());
    }
  }
  return FootplantClassifier({train_foot(states, planted[0], options), train_foot(states, planted[1], options)});
}

double agreement(const FootplantClassifier& classifier, const std::vector<LabelledStates>& clips) {
  double right = 0.0, all = 0.0;
  for (const LabelledStates& clip : clips) {
    for (Eigen::Index t = 0; t < clip.states.rows(); ++t) {
      for (int foot = 0; foot < 2; ++foot) {
        const bool is_planted = clip.planted[static_cast<std::size_t>(foot)][static_cast<std::size_t>(t)];
        right += classifier.is_planted(foot, clip.states.row(t).transpose()) == is_planted ? 1.0 : 0.0;
        all += 1.0;
      }
    }
  }
  return all > 0.0 ? right / all : 1.0;
}

}  // namespace strut::postprocess
