// SPDX-License-Identifier: MIT
// Bodies meet here: matching, choosing and blending are done on the model's body at the model's rate, cutting and
// joining on the input's.
#include "retarget.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/descriptors.h>
#include <strut/effort/effort_synthesis.h>
#include <strut/effort/inertialization.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::effort {
namespace {

constexpr int kFewestFrames = 4;

void check(const Motion& motion, const Skeleton& skeleton, const ApplyOptions& options) {
  if (const std::string mismatch = describe_mismatch(skeleton, motion.skeleton()); !mismatch.empty()) {
    throw SkeletonMismatch(mismatch);
  }
  if (motion.num_frames() < kFewestFrames) {
    throw InvalidArgument("motion", "4 frames or more", std::to_string(motion.num_frames()));
  }
  for (const auto& [name, value] :
       {std::pair{"unasked_weight", options.unasked_weight}, std::pair{"shortest_gap", options.shortest_gap},
        std::pair{"join_weight", options.join_weight}}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw InvalidArgument(name, "a number of at least 0", std::to_string(value));
    }
  }
}

/// The first frame at or after frame `frame` of a motion at kFeatureRate.
int at_rate(int frame, double rate, int num_frames) {
  return std::min(num_frames, static_cast<int>(std::lround(frame * rate / kFeatureRate)));
}

/// Leaves unmatched stretches of less than `shortest` frames to their neighbours: half to each.
void close_gaps(std::vector<Snippet>& snippets, double shortest) {
  if (std::none_of(snippets.begin(), snippets.end(), [](const Snippet& s) { return s.group != kNoMatch; })) return;
  for (std::size_t i = 0; i < snippets.size(); ++i) {
    const motion::FrameRange gap = snippets[i].frames;
    if (snippets[i].group != kNoMatch || gap.num_frames() >= shortest) continue;
    const bool has_next = i + 1 < snippets.size();
    const int middle = i == 0 ? gap.begin : (has_next ? gap.begin + gap.num_frames() / 2 : gap.end);
    if (i > 0) snippets[i - 1].frames.end = middle;
    if (has_next) snippets[i + 1].frames.begin = middle;
  }
  std::erase_if(snippets, [&](const Snippet& s) { return s.group == kNoMatch && s.frames.num_frames() < shortest; });
}

/// A motion as a model sees it and the snippets it falls into, in its own frames.
std::vector<Snippet> snippets_of(const EffortModel& model, const Motion& motion, const FrameMatrix& features,
                                 const ApplyOptions& options) {
  std::vector<KnownFragment> known;
  for (std::size_t i = 0; i < model.fragments().size(); ++i) {
    known.push_back({model.features(static_cast<int>(i)), model.fragments()[i].group});
  }
  auto snippets = segment_motion(known, features, {model.parts().threshold, options.boundary_frames});
  for (Snippet& snippet : snippets) {
    snippet.frames = {at_rate(snippet.frames.begin, motion.frame_rate(), motion.num_frames()),
                      at_rate(snippet.frames.end, motion.frame_rate(), motion.num_frames())};
  }
  snippets.back().frames.end = motion.num_frames();  // resampling may leave out the last frames
  close_gaps(snippets, options.shortest_gap * motion.frame_rate());
  return snippets;
}

/// What is put one after the other.
struct Part {
  Piece piece;
  std::vector<motion::Footplant> plants;
};

std::vector<motion::Footplant> plants_within(const std::vector<motion::Footplant>& plants,
                                             const motion::FrameRange& range) {
  std::vector<motion::Footplant> within;
  for (const motion::Footplant& plant : plants) {
    const int begin = std::max(plant.begin, range.begin) - range.begin;
    const int end = std::min(plant.end, range.end) - range.begin;
    if (begin < end) within.push_back({plant.foot, begin, end});
  }
  return within;
}

/// Puts what was wanted on one motion.
class Application {
 public:
  Application(const BlendChooser& chooser, const Motion& motion, const EffortCurve& wanted, const ApplyOptions& options)
      : chooser_(chooser),
        motion_(motion),
        wanted_(wanted),
        options_(options),
        scale_(leg_length(motion) / leg_length(chooser.model().fragments().front().motion)),
        on_model_(on_skeleton(motion, chooser.model().shared_skeleton(), 1.0 / scale_)),
        features_(matching_features(on_model_, chooser.model().parts().upright, chooser.model().parts().space)),
        legs_(motion::find_legs(motion)) {
    if (legs_) plants_ = postprocess::detect_footplants(motion, *legs_);
  }

  AppliedEffort run(Diagnostics* diagnostics) {
    AppliedEffort result{motion_, {}, 0.0, plants_};
    const std::vector<Snippet> snippets = snippets_of(chooser_.model(), motion_, features_, options_);
    result.coverage = coverage(snippets);
    std::vector<Part> parts;
    for (const Snippet& snippet : snippets) {
      result.snippets.push_back(choose(snippet, result.snippets));
      parts.push_back(part_of(result.snippets.back()));
    }
    if (result.coverage > 0.0) put_together(parts, result, diagnostics);
    look_again(result);
    return result;
  }

 private:
  /// What to put in a snippet's place.
  AppliedSnippet choose(const Snippet& snippet, const std::vector<AppliedSnippet>& before) const {
    AppliedSnippet applied;
    applied.input = applied.output = snippet.frames;
    applied.group = snippet.group;
    applied.fragment = snippet.fragment;
    applied.match_cost = snippet.cost;
    if (snippet.group == kNoMatch) return applied;
    applied.before = shown_by(on_model_.slice(snippet.frames.begin, snippet.frames.end), snippet.group);
    applied.wanted = wanted_.at(0.5 * (snippet.frames.begin + snippet.frames.end - 1) * motion_.frame_time());
    ChoiceOptions choice = options_.choice;
    for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
      if (is_rated(applied.wanted[factor])) continue;
      applied.wanted[factor] = std::clamp(applied.before[factor], -1.0, 1.0);
      choice.weights[factor] *= options_.unasked_weight;
    }
    const auto candidates = chooser_.candidates(snippet.group, known(applied.wanted, snippet.group), choice);
    applied.blend = candidates.front();
    if (!before.empty()) applied.blend = smoothest(candidates, end_of(before.back()));
    return applied;
  }

  /// Of candidates that are about as near to what is wanted, the one that goes on from the posture `end`.
  [[nodiscard]] ChosenBlend smoothest(const std::vector<ChosenBlend>& candidates, const Eigen::VectorXd& end) const {
    const auto price = [&](const ChosenBlend& blend) {
      const double step = (edge_of(blend, false) - end).norm() / chooser_.model().parts().threshold;
      return blend.error * blend.error + options_.join_weight * step * step;
    };
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const ChosenBlend& a, const ChosenBlend& b) { return price(a) < price(b); });
  }

  /// The posture with which a blend begins or ends.
  [[nodiscard]] Eigen::VectorXd edge_of(const ChosenBlend& blend, bool at_end) const {
    const auto edge = [&](int fragment) {
      const FrameMatrix& rows = chooser_.model().features(fragment);
      return rows.row(at_end ? rows.rows() - 1 : 0).transpose().eval();
    };
    return (1.0 - blend.alpha) * edge(blend.first) + blend.alpha * edge(blend.second);
  }

  [[nodiscard]] Eigen::VectorXd end_of(const AppliedSnippet& snippet) const {
    if (snippet.group != kNoMatch) return edge_of(snippet.blend, true);
    const auto last = std::lround((snippet.input.end - 1) * kFeatureRate / motion_.frame_rate());
    return features_.row(std::min<Eigen::Index>(last, features_.rows() - 1)).transpose();
  }

  /// Without the factors that nobody asked for and nothing of the group is labelled in.
  EffortVector known(EffortVector wanted, int group) const {
    for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
      if (wanted_.asks_for(static_cast<Factor>(factor))) continue;
      const auto& fragments = chooser_.model().group(group);
      const auto is_labelled = [&](int i) { return is_rated(chooser_.model().fragment(i).effort[factor]); };
      if (!std::all_of(fragments.begin(), fragments.end(), is_labelled)) wanted[factor] = kNotRated;
    }
    return wanted;
  }

  Part part_of(const AppliedSnippet& snippet) const {
    if (snippet.group == kNoMatch) {
      return {{motion_.slice(snippet.input.begin, snippet.input.end), 0, snippet.input.begin},
              plants_within(plants_, snippet.input)};
    }
    const Blend blend = chooser_.synthesize(snippet.blend);
    const Motion motion =
        motion::resample(on_skeleton(blend.motion, motion_.shared_skeleton(), scale_), motion_.frame_rate());
    const double ratio = motion.frame_rate() / blend.motion.frame_rate();
    std::vector<motion::Footplant> plants;
    for (const motion::Footplant& plant : blend.plants) {
      const int begin = static_cast<int>(std::lround(plant.begin * ratio));
      const int end = std::min(motion.num_frames(), static_cast<int>(std::lround(plant.end * ratio)));
      if (begin < end) plants.push_back({plant.foot, begin, end});
    }
    return {{motion}, std::move(plants)};
  }

  void put_together(const std::vector<Part>& parts, AppliedEffort& result, Diagnostics* diagnostics) const {
    std::vector<Piece> pieces;
    std::vector<std::vector<motion::Footplant>> plants;
    for (const Part& part : parts) {
      pieces.push_back(part.piece);
      plants.push_back(part.plants);
    }
    const JoinedMotion joined = join(pieces);
    result.motion = joined.motion;
    result.plants = joined_plants(joined, plants);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const int end = i + 1 < parts.size() ? joined.begins[i + 1] : joined.motion.num_frames();
      result.snippets[i].output = {joined.begins[i], end};
    }
    if (options_.clean_feet && legs_) {
      result.motion =
          postprocess::clean_footskate(result.motion, *legs_, result.plants, options_.footskate, diagnostics);
    }
  }

  void look_again(AppliedEffort& result) const {
    for (AppliedSnippet& snippet : result.snippets) {
      if (snippet.group == kNoMatch) continue;
      const Motion made = on_skeleton(result.motion.slice(snippet.output.begin, snippet.output.end),
                                      chooser_.model().shared_skeleton(), 1.0 / scale_);
      snippet.after = shown_by(made, snippet.group);
    }
  }

  EffortVector shown_by(const Motion& motion, int group) const {
    if (motion.num_frames() < kFewestFrames || motion.duration() * kDescriptorRate < kFewestFrames) {
      return EffortVector::Constant(kNotRated);
    }
    return chooser_.estimate(motion, group).effort;
  }

  const BlendChooser& chooser_;
  const Motion& motion_;
  const EffortCurve& wanted_;
  const ApplyOptions& options_;
  double scale_;  // the input's legs over the model's
  Motion on_model_;
  FrameMatrix features_;  // of the input, as matching sees it
  std::optional<motion::Legs> legs_;
  std::vector<motion::Footplant> plants_;  // of the input
};

}  // namespace

AppliedEffort apply_effort(const BlendChooser& chooser, const Motion& motion, const EffortCurve& wanted,
                           const ApplyOptions& options, Diagnostics* diagnostics) {
  check(motion, chooser.model().skeleton(), options);
  AppliedEffort result = Application(chooser, motion, wanted, options).run(diagnostics);
  constexpr double kHalf = 0.5;
  if (diagnostics != nullptr && result.coverage > 0.0 && result.coverage < kHalf) {
    diagnostics->warn("", "less than half of the motion is like anything the model knows",
                      "add clips of what it shows to the database, or look at the snippets: strut effort apply "
                      "--report");
  }
  return result;
}

}  // namespace strut::effort
