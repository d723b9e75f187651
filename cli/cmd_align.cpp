// SPDX-License-Identifier: MIT
// strut align: which moment of one clip belongs to which of another, by any of the four methods, as a table and as the
// paper's Figure 2.
#include "align_plot.h"
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/align/time_warp.h>
#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::cli {
namespace {

enum class Method { kImw, kDtw1, kDtw3, kTimeWarp };

struct AlignOptions {
  std::string input, output;
  Method method = Method::kImw;
  int slope_limit = 2;
  double smoothness = 100.0;
  double warp_smoothness = 10.0;
  int rounds = 10;
  std::string csv, plot, dof;
  bool shared_units = false, force = false;
};

const std::map<std::string, int>& methods() {
  const auto number = [](Method method) { return static_cast<int>(method); };
  static const std::map<std::string, int> names{{"imw", number(Method::kImw)},
                                                {"dtw1", number(Method::kDtw1)},
                                                {"dtw3", number(Method::kDtw3)},
                                                {"timewarp", number(Method::kTimeWarp)}};
  return names;
}

const char* title(Method method) {
  switch (method) {
    case Method::kImw:
      return "IMW";
    case Method::kDtw1:
      return "DTW, Type I";
    case Method::kDtw3:
      return "DTW, Type III";
    case Method::kTimeWarp:
      return "the time warp alone";
  }
  return "";
}

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

/// Two clips of one hierarchy at one frame rate, and what of them is compared.
struct Clips {
  Motion input, output;
  representation::AlignmentPair features;
};

Clips read_clips(const AlignOptions& options) {
  PrintedDiagnostics diagnostics;
  Motion input = read_bvh(options.input, {}, &diagnostics).motion;
  Motion output = read_bvh(options.output, {}, &diagnostics).motion;
  if (input.frame_rate() != output.frame_rate()) {
    diagnostics.note(options.output, fmt::format("resampled from {:g} to {:g} frames/s, the rate of {}",
                                                 output.frame_rate(), input.frame_rate(), options.input));
    output = motion::resample(output, input.frame_rate());
  }
  for (const auto& [motion, path] : {std::pair(&input, options.input), std::pair(&output, options.output)}) {
    if (motion->num_frames() < 2) throw BadInput(path, "a clip to align needs at least two frames");
  }
  check_same_skeleton(options.output, output.skeleton(), options.input, input.skeleton());
  using representation::StyleUnits;
  representation::AlignmentPair features =
      representation::alignment_features(input, output, options.shared_units ? StyleUnits::kShared : StyleUnits::kOwn);
  return {std::move(input), std::move(output), std::move(features)};
}

/// A method's answer and the values of what it minimizes.
struct Answer {
  align::Correspondence correspondence;
  std::vector<double> objective;  ///< after each round; DTW and the time warp alone have none
};

Answer solve(const representation::AlignmentPair& features, Method method, const AlignOptions& options) {
  const auto& [input, output] = features;
  switch (method) {
    case Method::kImw: {
      align::IterativeMotionWarpingOptions imw;
      imw.slope_limit = options.slope_limit;
      imw.space = {options.smoothness, options.smoothness};
      imw.max_rounds = options.rounds;
      auto result = align::iterative_motion_warping(input, output, imw);
      return {std::move(result.correspondence), std::move(result.objective)};
    }
    case Method::kDtw1:
      return {align::dynamic_time_warping(input, output, align::LocalConstraint::kTypeI).correspondence, {}};
    case Method::kDtw3:
      return {align::dynamic_time_warping(input, output, align::LocalConstraint::kTypeIII).correspondence, {}};
    case Method::kTimeWarp:
      break;
  }
  return {align::time_warp(input, output, {.slope_limit = static_cast<double>(options.slope_limit)}).correspondence(),
          {}};
}

void print_clip(const char* role, const std::string& path, const Motion& motion) {
  fmt::print("{:7} {}: {} frames at {:g} frames/s, {:.2f} s\n", role, path, motion.num_frames(), motion.frame_rate(),
             motion.duration());
}

void print_report(const Clips& clips, const Answer& answer, const Eigen::VectorXd& smoothed,
                  const AlignOptions& options) {
  print_clip("input", options.input, clips.input);
  print_clip("output", options.output, clips.output);
  const auto compared = ((clips.features.input.cwiseAbs().colwise().maxCoeff().array() > 0.0)).count();
  fmt::print("aligned by {} on {} degrees of freedom\n", title(options.method), compared);
  for (std::size_t k = 0; k < answer.objective.size(); ++k) {
    fmt::print("  E after round {:2}  {:14.4f}\n", k + 1, answer.objective[k]);
  }
  const auto print_warp = [&](const char* what, const Eigen::VectorXd& w) {
    fmt::print("{:14} {:.2f} to {:.2f} output frames per input frame, {:.0f} % of the frames at the slope limit {}\n",
               what, w.minCoeff(), w.maxCoeff(), 100.0 * align::share_at_slope_limit(w, options.slope_limit),
               options.slope_limit);
  };
  print_warp("warp", answer.correspondence.differential_warp);
  if (options.warp_smoothness > 0.0) print_warp("smoothed warp", smoothed);
}

std::string table(const Clips& clips, const align::Correspondence& found, const Eigen::VectorXd& smoothed) {
  std::string csv = "frame,time_s,output_frame,output_time_s,differential_warp,smoothed_differential_warp\n";
  const Eigen::VectorXd output_frame = found.output_time();
  const double rate = clips.input.frame_rate();
  for (Eigen::Index t = 0; t < output_frame.size(); ++t) {
    fmt::format_to(std::back_inserter(csv), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", t, static_cast<double>(t) / rate,
                   output_frame[t], output_frame[t] / rate, found.differential_warp[t], smoothed[t]);
  }
  return csv;
}

// ---- the figure -----------------------------------------------------------------------------------------------------

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The degree of freedom asked for, by its name or by its joint's (then the axis that moves most); of an empty name the
/// joint angle that moves most.
int find_dof(const representation::Representation& representation, const std::string& name,
             const Eigen::VectorXd& movement) {
  const std::string wanted = lower(name);
  int found = -1;
  std::string names;
  for (int dof = 0; dof < representation.num_dofs(); ++dof) {
    const std::string here = representation.dof_name(dof);
    const std::string joint = here.substr(0, here.find_last_of(' '));
    names += (dof == 0 ? "" : ", ") + here;
    if (lower(here) == wanted) return dof;
    const bool matches = name.empty() ? dof >= representation::kNumRootDofs : lower(joint) == wanted;
    if (matches && (found < 0 || movement[dof] > movement[found])) found = dof;
  }
  if (found < 0)
    throw InvalidArgument("--dof", "one of the clips' degrees of freedom", "'" + name + "'", "they are: " + names);
  return found;
}

bool is_angle(int dof) {
  return dof >= representation::kTiltX || dof == representation::kTurningRate;
}

std::string unit(int dof) {
  if (dof == representation::kTurningRate) return "degrees/s";
  if (is_angle(dof)) return "degrees";
  return dof == representation::kHeight ? "m" : "m/s";
}

/// The curves are drawn about mean orientations that both clips share: that of each its own would hide a difference.
std::string figure(const Clips& clips, const Answer& answer, const AlignOptions& options) {
  const auto shared =
      representation::fit_representation({clips.input, clips.output}, motion::upright_reference(clips.input));
  const FrameMatrix input = representation::encode(shared, clips.input),
                    output = representation::encode(shared, clips.output);
  const Eigen::RowVectorXd mean = input.colwise().mean();
  const Eigen::VectorXd movement = (input.rowwise() - mean).colwise().squaredNorm().transpose();
  const int dof = find_dof(shared, options.dof, movement);
  const double scale = is_angle(dof) ? 180.0 / std::numbers::pi : 1.0;
  const auto warp_by = [&](Method method) {
    const Answer& by = method == options.method ? answer : solve(clips.features, method, options);
    return AlignPlot::Warp{title(method), by.correspondence.output_time()};
  };
  const Method other = options.method == Method::kImw ? Method::kDtw1 : options.method;
  return draw_alignment({fmt::format("{} [{}]", shared.dof_name(dof), unit(dof)),
                         file_name(options.input),
                         file_name(options.output),
                         clips.input.frame_rate(),
                         scale * input.col(dof),
                         scale * output.col(dof),
                         warp_by(options.method),
                         {warp_by(other), warp_by(Method::kImw)}});
}

// ---------------------------------------------------------------------------------------------------------------------

void run(const AlignOptions& options) {
  const Overwrite overwrite = overwrite_if(options.force);
  if (!options.csv.empty()) check_output(options.csv, {options.input, options.output}, overwrite);
  if (!options.plot.empty()) check_output(options.plot, {options.input, options.output, options.csv}, overwrite);
  const Clips clips = read_clips(options);
  const Answer answer = naming_the_file(options.output, [&] { return solve(clips.features, options.method, options); });
  const Eigen::VectorXd smoothed =
      align::smooth_differential_warp(answer.correspondence.differential_warp, options.warp_smoothness);
  const std::string plot = options.plot.empty() ? std::string() : figure(clips, answer, options);
  if (!options.csv.empty()) write_file(options.csv, table(clips, answer.correspondence, smoothed), overwrite);
  if (!options.plot.empty()) write_file(options.plot, plot, overwrite);
  print_report(clips, answer, smoothed, options);
}

}  // namespace

void add_align(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("align", "Find which moment of a clip belongs to which moment of another of the same content");
  const auto options = std::make_shared<AlignOptions>();
  command->add_option("input", options->input, "BVH file: the clip whose frames are given a place")
      ->required()
      ->type_name("INPUT");
  command
      ->add_option("output", options->output, "BVH file of the same hierarchy: the clip in whose time they are placed")
      ->required()
      ->type_name("OUTPUT");
  command
      ->add_option("--method", options->method,
                   "imw: iterative motion warping; dtw1, dtw3: dynamic time warping with Rabiner and Juang's local "
                   "constraints of Type I or III; timewarp: the time-warp stage of imw alone (default: imw)")
      ->transform(one_of(methods()).description(""))
      ->type_name("imw|dtw1|dtw3|timewarp");
  command
      ->add_option("--slope-limit", options->slope_limit,
                   "An input frame covers at most this many output frames and at least one over it; imw and timewarp "
                   "(default: 2)")
      ->check(number_in(1, align::kLargestSlopeLimit).description(""))
      ->type_name("N");
  command
      ->add_option("--smoothness", options->smoothness,
                   "Stiffness of imw's spatial warp, for signals of unit variance (default: 100)")
      ->check(not_negative().description(""))
      ->type_name("X");
  command->add_option("--rounds", options->rounds, "At most this many rounds of imw (default: 10)")
      ->check(number_in(1, 1000).description(""))
      ->type_name("N");
  command
      ->add_option("--warp-smoothness", options->warp_smoothness,
                   "Smoothing of the differential warp in the last column of the table [frames^2]; 0: none "
                   "(default: 10)")
      ->check(not_negative().description(""))
      ->type_name("X");
  command
      ->add_option(
          "--csv", options->csv,
          "Write a table: frame, time [s], output frame, output time [s], differential warp, the same smoothed "
          "(default: none)")
      ->type_name("FILE");
  command
      ->add_option(
          "--plot", options->plot,
          "Draw an SVG: a degree of freedom of both clips with what corresponds, then the input warped in time "
          "by dtw1 (or the method chosen) and by imw (default: none)")
      ->type_name("FILE");
  command
      ->add_option(
          "--dof", options->dof,
          "The degree of freedom to draw, e.g. 'LeftUpLeg x', or a joint's name (default: the joint angle that "
          "moves most)")
      ->type_name("NAME");
  command->add_flag("--shared-units", options->shared_units,
                    "Compare postures as they are, about one mean and in one unit for both clips (default: each clip "
                    "about its own mean in its own standard deviation, as strut learn does)");
  command->add_flag("--force", options->force, "Overwrite files that exist (default: refuse)");
  command->callback([options] { run(*options); });
}

}  // namespace strut::cli
