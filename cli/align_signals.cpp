// SPDX-License-Identifier: MIT
#include "align_signals.h"

#include "input_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include <strut/core/error.h>
#include <strut/motion/legs.h>
#include <strut/representation/alignment_features.h>

namespace strut::cli {
namespace {

using representation::alignment_features;
using representation::StyleUnits;

constexpr const char* kRoot = "root";  // how the root's degrees of freedom begin
constexpr double kStill = 1e-9;        // deviations: a signal that spreads less does not move
constexpr const char* kFeet = "feet";  // what --weight calls their signals

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool moves(const FrameMatrix& signals) {
  return ((signals.colwise().maxCoeff() - signals.colwise().minCoeff()).array() > kStill).any();
}

std::string others_than(const std::vector<const AlignClip*>& clips) {
  return clips.size() == 2 ? clips.front()->path : std::string("all other clips");
}

/// Refuses clips of which nothing tells one moment from another: any answer would be as good.
void check_movement(const std::vector<const AlignClip*>& clips, const AlignSignals& signals) {
  const auto counts = [&](const FrameMatrix& clip) {
    return moves(signals.weights.size() > 0 ? FrameMatrix(clip * signals.weights.asDiagonal()) : clip);
  };
  if (std::all_of(signals.clips.begin(), signals.clips.end(), counts)) return;
  const std::string reason = "nothing moves in it, so no moment can be told from another";
  for (const AlignClip* clip : clips) {
    if (!moves(alignment_features(clip->motion, clip->motion).input)) throw BadInput(clip->path, reason);
  }
  throw BadInput(clips.back()->path, "no degree of freedom that counts moves both in it and in " + others_than(clips),
                 "leave out --weight, or compare postures as they are with --signals posture --shared-units");
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

/// What every degree of freedom of the posture is multiplied by for one word, NAME=X; a joint's name stands for all of
/// its own.
void weigh(Eigen::VectorXd& weights, const representation::Representation& shape, const std::string& name,
           double weight) {
  const std::string wanted = wanted_name(shape, name);
  if (find_dof("--weight", shape, name, Eigen::VectorXd::LinSpaced(shape.num_dofs(), 0.0, 1.0)) <
      representation::kHeight) {
    throw InvalidArgument("--weight", "a degree of freedom of the posture", "'" + name + "'", "travel is not compared");
  }
  for (int k = 0; k < weights.size(); ++k) {
    const std::string dof = lower(shape.dof_name(k + representation::kHeight));
    if (dof == wanted || is_of(dof, wanted)) weights[k] = weight;
  }
}

/// What every one of `num_signals` signals is multiplied by: a degree of freedom's movement with it, after all
/// postures.
Eigen::VectorXd factors_of(const Motion& motion, const std::vector<std::string>& words, Eigen::Index num_signals) {
  const auto shape = representation::fit_representation({motion}, motion::upright_reference(motion));
  const Eigen::Index num_postures = shape.num_dofs() - representation::kHeight;
  const Eigen::Index num_feet = num_signals > num_postures ? num_signals - 2 * num_postures : 0;
  Eigen::VectorXd postures = Eigen::VectorXd::Ones(num_postures);
  double feet = 1.0;
  for (const std::string& word : words) {
    const auto [name, weight] = parse_weight(word);
    if (lower(name) == kFeet && num_feet > 0) {
      feet = weight;
    } else {
      weigh(postures, shape, name, weight);
    }
  }
  Eigen::VectorXd factors = Eigen::VectorXd::Constant(num_signals, feet);
  factors.head(num_postures) = postures;
  if (num_signals > num_postures) factors.segment(num_postures, num_postures) = postures;
  if (!(factors.maxCoeff() > 0.0)) throw InvalidArgument("--weight", "a weight above 0", "nothing but 0");
  return factors;
}

/// The paper's: two clips, in units of their own or shared ones.
AlignSignals postures_of(const AlignClip& input, const AlignClip& output, bool shared_units) {
  auto pair = alignment_features(input.motion, output.motion, shared_units ? StyleUnits::kShared : StyleUnits::kOwn);
  return {{std::move(pair.input), std::move(pair.output)}, {}};
}

/// Signals of any number of clips.
AlignSignals timing_of(const std::vector<const AlignClip*>& clips, SignalSet set, const FeetOptions& feet) {
  std::vector<Motion> motions;
  for (const AlignClip* clip : clips) motions.push_back(clip->motion);
  if (set == SignalSet::kPosture) {
    // No weights: stiffnesses are meant for signals that count 1 each.
    return {representation::timing_features(motions, std::nullopt, {1.0, 0.0, 0.0}).clips, {}};
  }
  const AlignClip& first = *clips.front();
  const auto legs = feet.left.empty() ? motion::find_legs(first.motion) : legs_of(first.path, first.motion, feet);
  auto group = representation::timing_features(motions, legs);
  return {std::move(group.clips), std::move(group.weights)};
}

}  // namespace

AlignSignals signals_of(const std::vector<const AlignClip*>& clips, SignalSet set, const AlignOptions& options) {
  AlignSignals signals = clips.size() == 2 && set == SignalSet::kPosture
                             ? postures_of(*clips.front(), *clips.back(), options.shared_units)
                             : timing_of(clips, set, options.feet);
  if (!options.weights.empty()) {
    const Eigen::Index num_signals = signals.clips.front().cols();
    const Eigen::VectorXd factors = factors_of(clips.front()->motion, options.weights, num_signals);
    signals.weights = signals.weights.size() > 0 ? signals.weights.cwiseProduct(factors) : factors;
  }
  check_movement(clips, signals);
  return signals;
}

const char* signals_name(SignalSet set) {
  return set == SignalSet::kPosture ? "posture" : "all";
}

std::string signals_in_words(SignalSet set, int num_compared) {
  if (set == SignalSet::kPosture) return fmt::format("{} degrees of freedom", num_compared);
  return fmt::format("{} signals of posture, movement and feet", num_compared);
}

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

}  // namespace strut::cli
