// SPDX-License-Identifier: MIT
// strut learn: learns a style from a pair list.
#include "commands.h"
#include "fingerprint.h"
#include "footplant_table.h"
#include "input_files.h"
#include "learn_report.h"
#include "paired_clips.h"
#include "terminal.h"
#include "usage.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>
#include <strut/core/version.h>
#include <strut/learn/learn_style.h>
#include <strut/model/style_model_io.h>

namespace strut::cli {
namespace {

using json = nlohmann::ordered_json;

struct LearnArguments {
  std::string pairs, output;
  std::string footplants;  // of the output clips, a table; empty: detected
  LearnOptions options;
  bool force = false;
};

json describe_files(const std::vector<std::string>& paths) {
  json files = json::array();
  for (const std::string& path : paths) files.push_back({{"file", path}, {"fnv1a64", fingerprint(read_file(path))}});
  return files;
}

std::string method_name(LearnMethod method) {
  if (method == LearnMethod::kRadial) return "radial";
  return method == LearnMethod::kLinear ? "linear" : "paper";
}

json describe_options(const LearnOptions& options) {
  const bool is_continuous =
      options.alignment_method == AlignmentMethod::kContinuous && options.method != LearnMethod::kPaper;
  return {{"alignment", is_continuous ? "continuous" : "iterative"},
          {"scale_smoothness", options.alignment.space.scale_smoothness},
          {"offset_smoothness", options.alignment.space.offset_smoothness},
          {"time_warp_smoothing", options.time_warp_smoothing ? json(*options.time_warp_smoothing) : json("chosen")},
          {"lead_in", options.lead_in},
          {"method", method_name(options.method)},
          {"context", options.context},
          {"centres", options.radial.centres},
          {"width", options.radial.width},
          {"shrinkage", options.radial.ridge},
          {"lags", options.radial.lags},
          {"lag", options.radial.lag},
          {"max_order", options.identification.max_order},
          {"block_rows", options.identification.block_rows},
          {"longest_memory", options.longest_memory},
          {"ridge", options.identification.ridge},
          {"frame_rate", options.frame_rate}};
}

void run(const LearnArguments& arguments) {
  check_output(arguments.output, {arguments.pairs}, overwrite_if(arguments.force));
  PrintedDiagnostics diagnostics;
  const PairedClips clips = read_paired_clips(arguments.pairs, &diagnostics);
  check_output(arguments.output, clips.input_paths, overwrite_if(arguments.force));
  check_output(arguments.output, clips.output_paths, overwrite_if(arguments.force));
  LearnOptions options = arguments.options;
  if (!arguments.footplants.empty()) {
    check_output(arguments.output, {arguments.footplants}, overwrite_if(arguments.force));
    options.footplants = read_footplants(arguments.footplants, clips, diagnostics);
  }
  const json sources = {{"strut", version()},
                        {"pair_list", arguments.pairs},
                        {"inputs", describe_files(clips.input_paths)},
                        {"outputs", describe_files(clips.output_paths)},
                        {"footplants", arguments.footplants.empty() ? json("detected") : json(arguments.footplants)},
                        {"options", describe_options(options)}};
  LearntStyle learnt;
  {
    ProgressLine line("learning");
    const auto provenance = [&](const LearnReport& report) {
      json all = sources;
      all["report"] = report_as_json(report);
      // A file's name may be in any encoding.
      return all.dump(-1, ' ', false, json::error_handler_t::replace);
    };
    const auto progress = [&](const std::string& step, int done, int total) { line.update(step, done, total); };
    learnt = naming_the_file(arguments.pairs, [&] {
      return learn_style(clips.inputs, clips.outputs, clips.pairs, options, provenance, &diagnostics, progress);
    });
  }
  write_style_model(arguments.output, *learnt.model, overwrite_if(arguments.force));
  print_report(learnt.report, *learnt.model);
}

}  // namespace

void add_learn(CLI::App& app) {
  auto arguments = std::make_shared<LearnArguments>();
  LearnOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand("learn", "Learn a style from paired clips");
  command->add_option("pairs", arguments->pairs, "Pair list made by strut pair (.toml)")->required();
  command->add_option("-o,--output", arguments->output, "Style model to write (.strut)")->required();
  command->add_option("--method", options.method, "Kind of model: radial, linear or paper (default radial)")
      ->transform(one_of({{"radial", static_cast<int>(LearnMethod::kRadial)},
                          {"linear", static_cast<int>(LearnMethod::kLinear)},
                          {"paper", static_cast<int>(LearnMethod::kPaper)}})
                      .description(""))
      ->type_name("radial|linear|paper");
  command
      ->add_option("--context", options.context,
                   "Principal components of the whole body that every part sees; 0: none, and linear systems")
      ->check(number_in(0, 100))
      ->capture_default_str();
  command->add_option("--centres", options.radial.centres, "Most basis functions of a radial model")
      ->check(number_in(1, 5000))
      ->capture_default_str();
  command->add_option("--width", options.radial.width, "Their width, in distances of an example to its nearest centre")
      ->check(number_in(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--shrinkage", options.radial.ridge, "Of a radial model's weights")
      ->check(number_in(1e-9, 1e6))
      ->capture_default_str();
  command->add_option("--max-order", options.identification.max_order, "Largest number of states tried per joint")
      ->check(number_in(0, 20))
      ->capture_default_str();
  command
      ->add_option("--block-rows", options.identification.block_rows,
                   "Past and future of subspace identification [frames]")
      ->check(number_in(1, 50))
      ->capture_default_str();
  command
      ->add_option("--weighting", options.identification.weighting,
                   "Of the subspace step: n4sid, moesp or cva (default cva)")
      ->transform(one_of({{"n4sid", static_cast<int>(sysid::Weighting::kN4sid)},
                          {"moesp", static_cast<int>(sysid::Weighting::kMoesp)},
                          {"cva", static_cast<int>(sysid::Weighting::kCva)}})
                      .description(""))
      ->type_name("n4sid|moesp|cva");
  command->add_option("--memory", options.longest_memory, "Slowest decay the model's states may have, to 1/e [s]")
      ->check(number_in(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--ridge", options.identification.ridge, "Shrinkage of the matrices B and D, 0 for none")
      ->check(number_in(0.0, 10.0))
      ->capture_default_str();
  CLI::Option* alignment =
      command
          ->add_option("--alignment", options.alignment_method,
                       "How moments are matched: continuous, or iterative as in the paper (default continuous; "
                       "--method paper: iterative)")
          ->transform(one_of({{"continuous", static_cast<int>(AlignmentMethod::kContinuous)},
                              {"iterative", static_cast<int>(AlignmentMethod::kIterative)}})
                          .description(""))
          ->type_name("continuous|iterative");
  command
      ->add_option("--smoothness", options.alignment.space.scale_smoothness,
                   "Weight of smoothness in the space warp, with --alignment iterative")
      ->needs(alignment)
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--time-smoothing", options.time_warp_smoothing,
                   "Reach of the time warp's smoothing [s] (default: chosen on left-out pairs)")
      ->check(number_in(0.0, 10.0));
  command->add_option("--frame-rate", options.frame_rate, "Frames per second of the model; 0: the first input clip's")
      ->check(number_in(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--footplants", arguments->footplants,
                   "Footplants of the output clips, as strut footplants --csv lists them (default: detected)")
      ->type_name("TABLE");
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] {
    arguments->options.alignment.space.offset_smoothness = arguments->options.alignment.space.scale_smoothness;
    run(*arguments);
  });
}

}  // namespace strut::cli
