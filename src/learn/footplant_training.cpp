// SPDX-License-Identifier: MIT
#include "learn/footplant_training.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/extrapolation.h>

namespace strut::learn {
namespace {

using motion::Footplant;
using postprocess::FootplantClassifier;
using postprocess::LabelledStates;
using sysid::Role;

// A model runs over this much input before a clip, as it does when it translates one [s].
constexpr double kWarmUp = 0.3;

void check(const std::vector<Footplant>& plants, int clip, int num_frames) {
  for (const Footplant& plant : plants) {
    const bool fits = plant.foot >= 0 && plant.foot <= 1 && plant.begin >= 0 && plant.begin < plant.end;
    if (fits && plant.end <= num_frames) continue;
    throw InvalidArgument("footplants of output clip " + std::to_string(clip),
                          "foot 0 or 1 and frames inside 0 to " + std::to_string(num_frames),
                          "foot " + std::to_string(plant.foot) + ", frames " + std::to_string(plant.begin) + " to " +
                              std::to_string(plant.end));
  }
}

/// `plants` of `clip`, as it is when resampled to `num_frames` frames of `frame_rate`.
FrameMatrix marks_of(const std::vector<Footplant>& plants, const Motion& clip, double frame_rate,
                     Eigen::Index num_frames) {
  FrameMatrix own = FrameMatrix::Zero(clip.num_frames(), 2);
  for (const Footplant& plant : plants) own.col(plant.foot).segment(plant.begin, plant.end - plant.begin).setOnes();
  const double step = clip.frame_rate() / frame_rate;
  FrameMatrix marks(num_frames, 2);
  for (Eigen::Index t = 0; t < marks.rows(); ++t) {
    marks.row(t) = own.row(std::min<Eigen::Index>(std::lround(static_cast<double>(t) * step), own.rows() - 1));
  }
  return marks;
}

/// Of a radial map: what its basis sees in each row of normalized `input` (frames x dofs), taken to have stood still
/// before.
FrameMatrix lagged_contexts(const StyleModelParts& parts, const FrameMatrix& input) {
  const FrameMatrix contexts = input * parts.context.transpose();
  const std::vector<int>& lags = parts.radial_map->lags;
  FrameMatrix states(input.rows(), contexts.cols() * static_cast<Eigen::Index>(lags.size()));
  for (std::size_t l = 0; l < lags.size(); ++l) {
    for (Eigen::Index t = 0; t < input.rows(); ++t) {
      states.row(t).segment(static_cast<Eigen::Index>(l) * contexts.cols(), contexts.cols()) =
          contexts.row(std::max<Eigen::Index>(0, t - lags[l]));
    }
  }
  return states;
}

/// The states of all blocks, one block after the other, after each row of normalized `input`.
FrameMatrix block_states(const StyleModelParts& parts, const FrameMatrix& input) {
  FrameMatrix inputs(input.rows(), input.cols() + parts.context.rows());
  inputs << input, input * parts.context.transpose();
  Eigen::Index size = 0;
  for (const StyleBlock& block : parts.blocks) size += block.system.num_states();
  FrameMatrix states(input.rows(), size);
  Eigen::Index next = 0;
  for (const StyleBlock& block : parts.blocks) {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(block.system.num_states());
    Eigen::VectorXd scratch = state, u(block.system.num_inputs()), y(block.system.num_outputs());
    for (Eigen::Index t = 0; t < input.rows(); ++t) {
      for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = inputs(t, block.input_dofs[static_cast<std::size_t>(i)]);
      block.system.step(state, u, y, scratch);
      states.row(t).segment(next, state.size()) = state.transpose();
    }
    next += state.size();
  }
  return states;
}

/// The model's state at every frame of `clip` (frames x dofs, in the input representation's units).
FrameMatrix states_of(const StyleModelParts& parts, const FrameMatrix& clip) {
  const auto warm_up = static_cast<int>(std::lround(kWarmUp * parts.frame_rate));
  FrameMatrix rows(warm_up + clip.rows(), clip.cols());
  rows << representation::extrapolate_back(clip, warm_up), clip;
  const FrameMatrix input = parts.input_scaling.normalize(rows);
  return (parts.radial_map ? lagged_contexts(parts, input) : block_states(parts, input)).bottomRows(clip.rows());
}

std::vector<LabelledStates> label(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                  const StyleModelParts& parts) {
  std::vector<FrameMatrix> states;
  for (const FrameMatrix& clip : examples.input.clips) states.push_back(states_of(parts, clip));
  std::vector<LabelledStates> labelled;
  for (const AlignedPair& pair : aligned) {
    const FrameMatrix& clip = states[static_cast<std::size_t>(pair.input_clip)];
    labelled.push_back({clip.middleRows(pair.input_frames.begin, pair.input_frames.num_frames()), {}});
    for (Eigen::Index t = 0; t < pair.planted.rows(); ++t) {
      for (Eigen::Index foot = 0; foot < 2; ++foot) {
        labelled.back().planted[static_cast<std::size_t>(foot)].push_back(pair.planted(t, foot) > 0.5);
      }
    }
  }
  return labelled;
}

/// Mean agreement over the pairs left out, each judged by a classifier trained without it; 0 if none could be.
double left_out_agreement(const std::vector<LabelledStates>& labelled, const sysid::LeaveOut& rounds) {
  double right = 0.0, frames = 0.0;
  for (const std::vector<Role>& roles : rounds.rounds) {
    std::vector<LabelledStates> learnt, left_out;
    for (std::size_t i = 0; i < labelled.size(); ++i) {
      if (roles[i] == Role::kLearn) learnt.push_back(labelled[i]);
      if (roles[i] == Role::kTest) left_out.push_back(labelled[i]);
    }
    if (learnt.empty() || left_out.empty()) continue;
    const FootplantClassifier classifier = postprocess::train_footplant_classifier(learnt);
    double count = 0.0;
    for (const LabelledStates& pair : left_out) count += static_cast<double>(pair.states.rows());
    right += count * postprocess::agreement(classifier, left_out);
    frames += count;
  }
  return frames > 0.0 ? right / frames : 0.0;
}

}  // namespace

std::vector<FrameMatrix> footplant_marks(const std::vector<Motion>& clips,
                                         const std::vector<std::vector<Footplant>>& given, const Examples& examples,
                                         Diagnostics* diagnostics) {
  if (!given.empty() && given.size() != clips.size()) {
    throw InvalidArgument("footplants", std::to_string(clips.size()) + " lists, one per output clip",
                          std::to_string(given.size()));
  }
  std::vector<FrameMatrix> marks;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const auto legs = given.empty() ? motion::find_legs(clips[i]) : std::nullopt;
    if (given.empty() && !legs) {
      if (diagnostics != nullptr) {
        diagnostics->note("footplants", "not learnt: no two legs were found in output clip " + std::to_string(i));
      }
      return {};
    }
    const std::vector<Footplant> plants = legs ? postprocess::detect_footplants(clips[i], *legs) : given[i];
    check(plants, static_cast<int>(i), clips[i].num_frames());
    marks.push_back(marks_of(plants, clips[i], examples.frame_rate, examples.output.clips[i].rows()));
  }
  return marks;
}

std::optional<FootplantReport> learn_footplants(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                                StyleModelParts& parts) {
  if (examples.planted.empty()) return std::nullopt;
  const std::vector<LabelledStates> labelled = label(examples, aligned, parts);
  parts.footplants = postprocess::train_footplant_classifier(labelled);
  return FootplantReport{left_out_agreement(labelled, leave_out(aligned)),
                         postprocess::agreement(*parts.footplants, labelled)};
}

}  // namespace strut::learn
