// SPDX-License-Identifier: MIT
#include "alignment.h"

#include "input_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/representation.h>

namespace strut::cli {
namespace {

using representation::alignment_features;
using representation::AlignmentPair;
using representation::StyleUnits;

constexpr const char* kRoot = "root";  // how the root's degrees of freedom begin
constexpr double kStill = 1e-9;        // deviations: a signal that spreads less does not move

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool moves(const FrameMatrix& signals) {
  return ((signals.colwise().maxCoeff() - signals.colwise().minCoeff()).array() > kStill).any();
}

/// Refuses clips of which nothing tells one moment from another: any answer would be as good.
void check_movement(const AlignClip& input, const AlignClip& output, const AlignmentPair& features,
                    const Eigen::VectorXd& weights) {
  const auto counts = [&](const FrameMatrix& signals) {
    return moves(weights.size() > 0 ? FrameMatrix(signals * weights.asDiagonal()) : signals);
  };
  if (counts(features.input) && counts(features.output)) return;
  const std::string reason = "nothing moves in it, so no moment can be told from another";
  for (const AlignClip* clip : {&input, &output}) {
    if (!moves(alignment_features(clip->motion, clip->motion).input)) throw BadInput(clip->path, reason);
  }
  throw BadInput(output.path, "no degree of freedom that counts moves both in it and in " + input.path,
                 "leave out --weight, or compare postures as they are with --shared-units");
}

/// NAME=X to its parts. Throws InvalidArgument.
std::pair<std::string, double> parse_weight(const std::string& word) {
  const auto equals = word.rfind('=');
  double weight = std::nan("");
  const bool fits = equals != std::string::npos && equals > 0 &&
                    CLI::detail::lexical_cast(word.substr(equals + 1), weight) && weight >= 0.0 &&
                    std::isfinite(weight);
  if (!fits) {
    throw InvalidArgument("--weight", "NAME=X with a number X that is not negative", "'" + word + "'",
                          "e.g. --weight LeftUpLeg=2");
  }
  return {word.substr(0, equals), weight};
}

/// Whether `dof` is one of `joint`, both in lower case. The degrees of freedom of the root have names of their own.
bool is_of(const std::string& dof, const std::string& joint) {
  return joint == kRoot ? dof.starts_with(joint + " ") : dof.substr(0, dof.find_last_of(' ')) == joint;
}

/// `name` in lower case; kRoot for a joint whose movement the root's degrees of freedom are.
std::string wanted_name(const representation::Representation& shape, const std::string& name) {
  std::string wanted = lower(name);
  const auto& below = shape.joints();
  for (int joint = 0; joint < shape.skeleton().num_joints(); ++joint) {
    const bool is_root = std::find(below.begin(), below.end(), joint) == below.end();
    if (is_root && lower(shape.skeleton().joint(joint).name) == wanted) return kRoot;
  }
  return wanted;
}

/// What every degree of freedom weighs; empty if nothing was said. A joint's name stands for all of its own.
Eigen::VectorXd weights_of(const Motion& motion, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  const auto shape = representation::fit_representation({motion}, motion::upright_reference(motion));
  const int num_compared = shape.num_dofs() - representation::kHeight;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(num_compared);
  for (const std::string& word : words) {
    const auto [name, weight] = parse_weight(word);
    const std::string wanted = wanted_name(shape, name);
    if (find_dof("--weight", shape, name, Eigen::VectorXd::LinSpaced(shape.num_dofs(), 0.0, 1.0)) <
        representation::kHeight) {
      throw InvalidArgument("--weight", "a degree of freedom of the posture", "'" + name + "'",
                            "travel is not compared");
    }
    for (int k = 0; k < num_compared; ++k) {
      const std::string dof = lower(shape.dof_name(k + representation::kHeight));
      if (dof == wanted || is_of(dof, wanted)) weights[k] = weight;
    }
  }
  if (!(weights.maxCoeff() > 0.0)) throw InvalidArgument("--weight", "a weight above 0", "nothing but 0");
  return weights;
}

std::optional<std::vector<motion::Footplant>> plants_of(const AlignClip& clip, const FeetOptions& feet,
                                                        std::string& missing) {
  if (feet.left.empty() && !motion::find_legs(clip.motion)) {
    if (missing.empty()) missing = "no two legs were found in " + clip.path;
    return std::nullopt;
  }
  return postprocess::detect_footplants(clip.motion, legs_of(clip.path, clip.motion, feet));
}

}  // namespace

int find_dof(const std::string& option, const representation::Representation& shape, const std::string& name,
             const Eigen::VectorXd& rank) {
  const std::string wanted = wanted_name(shape, name);
  int found = -1;
  std::string all;
  for (int dof = 0; dof < shape.num_dofs(); ++dof) {
    const std::string here = lower(shape.dof_name(dof));
    all += (dof == 0 ? "" : ", ") + shape.dof_name(dof);
    if (here == wanted) return dof;
    if (is_of(here, wanted) && (found < 0 || rank[dof] > rank[found])) found = dof;
  }
  if (found >= 0) return found;
  throw InvalidArgument(option, "one of the clips' degrees of freedom or joints", "'" + name + "'", "they are: " + all);
}

AlignClip read_align_clip(const std::string& path, Diagnostics& diagnostics) {
  Motion motion = read_bvh(path, {}, &diagnostics).motion;
  if (motion.num_frames() < 2) throw BadInput(path, "a clip to align needs at least two frames");
  return {path, std::move(motion)};
}

int num_compared(const Alignment& alignment) {
  Eigen::ArrayXd reach = alignment.features.input.cwiseAbs().colwise().maxCoeff().transpose().array();
  if (alignment.settings.time.weights.size() > 0) reach *= alignment.settings.time.weights.array();
  return static_cast<int>((reach > 0.0).count());
}

align::Correspondence smoothed(const align::Correspondence& warp, double smoothness) {
  return {align::smooth_differential_warp(warp.differential_warp, smoothness), warp.output_begin, warp.output_rest};
}

AlignAnswer solve(const Alignment& alignment, const AlignMethod& method) {
  return naming_the_file(alignment.output.path, [&] { return method.solve(alignment.features, alignment.settings); });
}

JudgedWarp judge(const Alignment& alignment, const align::Correspondence& warp) {
  JudgedWarp judged{warp, warp.output_time(), {}};
  if (alignment.plants.input && alignment.plants.output) {
    judged.onsets = onset_errors(*alignment.plants.input, *alignment.plants.output, judged.output_time);
  }
  return judged;
}

Alignment align_clips(const AlignClip& input, AlignClip output, const AlignOptions& options, Diagnostics& diagnostics) {
  check_same_skeleton(output.path, output.motion.skeleton(), input.path, input.motion.skeleton());
  const double rate = input.motion.frame_rate();
  if (output.motion.frame_rate() != rate) {
    diagnostics.note(output.path, fmt::format("resampled from {:g} to {:g} frames/s, the rate of {}",
                                              output.motion.frame_rate(), rate, input.path));
    output.motion = motion::resample(output.motion, rate);
  }
  Alignment a{.input = &input, .output = std::move(output)};
  a.method = &align_methods()[static_cast<std::size_t>(options.method)];
  a.settings = options.settings;
  a.settings.time.weights = weights_of(input.motion, options.weights);
  if (a.settings.time.ends != align::Ends::kFixed && !a.method->opens_ends) {
    throw InvalidArgument("--ends", std::string("fixed with --method ") + a.method->name, "open ones",
                          "imw and timewarp can look for a clip inside another");
  }
  a.slope_limit = a.method->slope_limit(a.settings);
  a.features =
      alignment_features(input.motion, a.output.motion, options.shared_units ? StyleUnits::kShared : StyleUnits::kOwn);
  check_movement(input, a.output, a.features, a.settings.time.weights);
  a.plants.input = plants_of(input, options.feet, a.no_plants);
  a.plants.output = plants_of(a.output, options.feet, a.no_plants);
  a.answer = solve(a, *a.method);
  const align::Correspondence& found = a.answer.correspondence;
  a.found = judge(a, found);
  a.smoothed = judge(a, smoothed(found, options.warp_smoothness));
  const Eigen::Index frames = found.differential_warp.size();
  a.even = judge(
      a, {Eigen::VectorXd::Constant(frames, found.differential_warp.mean()), found.output_begin, found.output_rest});
  if (!a.answer.is_exact) {
    diagnostics.note(a.output.path, "so long a pair is searched coarse to fine: the warp need not be the best of all");
  }
  a.warnings = warnings_of(a);
  diagnostics.append(a.warnings);
  return a;
}

}  // namespace strut::cli
