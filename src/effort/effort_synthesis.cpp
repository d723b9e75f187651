// SPDX-License-Identifier: MIT
// Bodies meet here: matching, choosing and blending are done on the model's body at the model's rate, cutting and
// joining on the input's.
#include "motion_edges.h"
#include "retarget.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

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

// Joins.
constexpr double kLongestTrim = 0.1;   // that a piece may lose, or what was kept may go on for, at a join [s]
constexpr double kMostTrimmed = 0.25;  // of a piece, at each end
constexpr double kTrimPrice = 0.5;     // of 0.1 s, in squared units of posture
constexpr double kTimesUsual = 1.5;    // how far above nearly all of the sources a joint may accelerate at a join

void check(const Motion& motion, const Skeleton& skeleton, const ApplyOptions& options) {
  if (const std::string mismatch = describe_mismatch(skeleton, motion.skeleton()); !mismatch.empty()) {
    throw SkeletonMismatch(mismatch);
  }
  if (motion.num_frames() < kFewestFrames) {
    throw InvalidArgument("motion", "4 frames or more", std::to_string(motion.num_frames()));
  }
  for (const auto& [name, value] :
       {std::pair{"unasked_weight", options.unasked_weight}, std::pair{"shortest_gap", options.shortest_gap},
        std::pair{"join_weight", options.join_weight}, std::pair{"jerk_weight", options.jerk_weight}}) {
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

/// What is put one after the other: frames [begin, end) of some material.
struct Part {
  Motion material;
  std::vector<motion::Footplant> plants;
  int begin = 0, end = 0;
  int least_begin = 0, greatest_begin = 0;  // where it may begin and end
  int least_end = 0, greatest_end = 0;
  int source = -1, source_begin = 0;  // of the material
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

/// What 99 of 100 of the fragments' joints accelerate by at most, over all frames [rad/s^2].
double usual_acceleration(const EffortModel& model) {
  constexpr double kNearlyAll = 0.99;
  std::vector<double> all;
  for (const ModelFragment& fragment : model.fragments()) {
    const std::vector<double> some = joint_accelerations(fragment.motion);
    all.insert(all.end(), some.begin(), some.end());
  }
  if (all.empty()) return std::numeric_limits<double>::infinity();
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return *at;
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
        postures_{chooser.model().parts().upright, chooser.model().parts().space, chooser.model().parts().threshold},
        most_(kTimesUsual * usual_acceleration(chooser.model())),
        legs_(motion::find_legs(motion)) {
    if (legs_) plants_ = postprocess::detect_footplants(motion, *legs_);
  }

  AppliedEffort run(Diagnostics* diagnostics) {
    AppliedEffort result{motion_, {}, 0.0, plants_};
    const std::vector<Snippet> snippets = snippets_of(chooser_.model(), motion_, features_, options_);
    result.coverage = coverage(snippets);
    std::vector<std::vector<ChosenBlend>> candidates;
    for (const Snippet& snippet : snippets) {
      result.snippets.push_back(seen(snippet));
      candidates.push_back(candidates_for(result.snippets.back()));
    }
    choose(candidates, result.snippets);
    std::vector<Part> parts;
    for (const AppliedSnippet& snippet : result.snippets) parts.push_back(part_of(snippet));
    for (std::size_t i = 1; i < parts.size(); ++i) cut_where_it_fits(parts[i - 1], parts[i]);
    if (result.coverage > 0.0) put_together(parts, result, diagnostics);
    look_again(result);
    return result;
  }

 private:
  /// A snippet, how it moves and what is wanted of it.
  AppliedSnippet seen(const Snippet& snippet) const {
    AppliedSnippet applied;
    applied.input = applied.output = snippet.frames;
    applied.group = snippet.group;
    applied.fragment = snippet.fragment;
    applied.match_cost = snippet.cost;
    if (snippet.group == kNoMatch) return applied;
    applied.before = shown_by(on_model_.slice(snippet.frames.begin, snippet.frames.end), snippet.group);
    applied.wanted = wanted_.at(0.5 * (snippet.frames.begin + snippet.frames.end - 1) * motion_.frame_time());
    for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
      if (!is_rated(applied.wanted[factor])) applied.wanted[factor] = std::clamp(applied.before[factor], -1.0, 1.0);
    }
    return applied;
  }

  /// What might be put in a snippet's place; nothing where it is kept.
  std::vector<ChosenBlend> candidates_for(const AppliedSnippet& snippet) const {
    if (snippet.group == kNoMatch) return {};
    ChoiceOptions choice = options_.choice;
    for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
      if (!wanted_.asks_for(static_cast<Factor>(factor))) choice.weights[factor] *= options_.unasked_weight;
    }
    return chooser_.candidates(snippet.group, known(snippet.wanted, snippet.group), choice);
  }

  /// Of candidates that are about as near to what is wanted, those that go on from one another.
  void choose(const std::vector<std::vector<ChosenBlend>>& candidates, std::vector<AppliedSnippet>& snippets) const {
    std::vector<std::vector<SequenceCandidate>> places(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      places[i].resize(std::max<std::size_t>(1, candidates[i].size()));
      if (candidates[i].empty()) {
        const motion::FrameRange& kept = snippets[i].input;
        const Motion stretch = on_model_.slice(kept.begin, kept.end);
        places[i].front() = {0.0, beginning(stretch, postures_), ending(stretch, postures_)};
      }
      tbb::parallel_for(std::size_t{0}, candidates[i].size(), [&](std::size_t c) {
        const Motion motion = chooser_.synthesize(candidates[i][c]).motion;
        SequenceCandidate& candidate = places[i][c];
        candidate = {0.0, beginning(motion, postures_), ending(motion, postures_)};
        candidate.price = std::pow(candidates[i][c].error, 2) +
                          options_.jerk_weight * (excess(candidate.begin) + excess(candidate.end));
      });
    }
    const auto chosen = cheapest_sequence(places, options_.join_weight, 1.0 / kFeatureRate, postures_.unit);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (!candidates[i].empty()) snippets[i].blend = candidates[i][chosen[i]];
    }
  }

  /// By how much a joint accelerates more at an edge than is usual of the sources, as a share, squared.
  [[nodiscard]] double excess(const MotionEdge& edge) const {
    return std::pow(std::max(0.0, edge.acceleration / most_ - 1.0), 2);
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
    const int reach = static_cast<int>(std::lround(kLongestTrim * motion_.frame_rate()));
    if (snippet.group == kNoMatch) return kept(snippet.input, reach);
    const Blend blend = chooser_.synthesize(snippet.blend);
    Part part{motion::resample(on_skeleton(blend.motion, motion_.shared_skeleton(), scale_), motion_.frame_rate()), {}};
    const double ratio = part.material.frame_rate() / blend.motion.frame_rate();
    for (const motion::Footplant& plant : blend.plants) {
      const int begin = static_cast<int>(std::lround(plant.begin * ratio));
      const int end = std::min(part.material.num_frames(), static_cast<int>(std::lround(plant.end * ratio)));
      if (begin < end) part.plants.push_back({plant.foot, begin, end});
    }
    part.end = part.greatest_end = part.material.num_frames();
    part.greatest_begin = std::min(reach, static_cast<int>(kMostTrimmed * part.end));
    part.least_end = part.end - part.greatest_begin;
    return part;
  }

  /// A stretch of the input, with what is beyond it.
  [[nodiscard]] Part kept(const motion::FrameRange& range, int reach) const {
    const motion::FrameRange all{std::max(0, range.begin - reach), std::min(motion_.num_frames(), range.end + reach)};
    Part part{motion_.slice(all.begin, all.end), plants_within(plants_, all)};
    const int trim = std::min(reach, static_cast<int>(kMostTrimmed * range.num_frames()));
    part.begin = range.begin - all.begin;
    part.end = range.end - all.begin;
    part.greatest_begin = part.begin + trim;
    part.least_end = part.end - trim;
    part.greatest_end = all.num_frames();
    part.source = 0;
    part.source_begin = all.begin;
    return part;
  }

  /// Moves the end of a part and the beginning of the next to where they go together best.
  void cut_where_it_fits(Part& last, Part& next) const {
    const auto ends = edges_within(last.material, last.least_end - 1, last.greatest_end, postures_);
    const auto begins = edges_within(next.material, next.least_begin, next.greatest_begin + 1, postures_);
    const double frame_time = motion_.frame_time(), trim = kTrimPrice * frame_time / kLongestTrim;
    double least = std::numeric_limits<double>::infinity();
    int end = last.end, begin = next.begin;
    for (int e = last.least_end; e <= last.greatest_end; ++e) {
      for (int b = next.least_begin; b <= next.greatest_begin; ++b) {
        const auto& edge = ends[static_cast<std::size_t>(e - last.least_end)];
        const auto& onto = begins[static_cast<std::size_t>(b - next.least_begin)];
        const double price = misfit(edge, onto, frame_time, postures_.unit * scale_) +
                             trim * (std::abs(e - last.end) + std::abs(b - next.begin));
        if (price >= least) continue;
        least = price;
        end = e;
        begin = b;
      }
    }
    last.end = end;
    next.begin = begin;
  }

  void put_together(const std::vector<Part>& parts, AppliedEffort& result, Diagnostics* diagnostics) const {
    std::vector<Piece> pieces;
    std::vector<std::vector<motion::Footplant>> plants;
    for (const Part& part : parts) {
      pieces.push_back({part.material.slice(part.begin, part.end), part.source, part.source_begin + part.begin});
      plants.push_back(plants_within(part.plants, {part.begin, part.end}));
    }
    const JoinedMotion joined = join(pieces, options_.join);
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
  PostureSpace postures_;
  double most_;  // that a joint may accelerate at an edge [rad/s^2]
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
