// SPDX-License-Identifier: MIT
// strut learn: learns a style from a pair list.
#include "commands.h"
#include "learn_report.h"
#include "paired_clips.h"
#include "terminal.h"

#include <map>
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
  LearnOptions options;
  bool force = false;
};

/// FNV-1a, 64 bits: tells whether a file is the one that was learnt from; no protection against forgery.
std::string fingerprint(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

json describe_files(const std::vector<std::string>& paths) {
  json files = json::array();
  for (const std::string& path : paths) files.push_back({{"file", path}, {"fnv1a64", fingerprint(read_file(path))}});
  return files;
}

json describe_options(const LearnOptions& options) {
  return {{"scale_smoothness", options.alignment.space.scale_smoothness},
          {"offset_smoothness", options.alignment.space.offset_smoothness},
          {"time_warp_smoothing", options.time_warp_smoothing},
          {"lead_in", options.lead_in},
          {"max_order", options.identification.max_order},
          {"block_rows", options.identification.block_rows},
          {"longest_memory", options.longest_memory},
          {"ridge", options.identification.ridge},
          {"frame_rate", options.frame_rate}};
}

void run(const LearnArguments& arguments) {
  check_writable(arguments.output, overwrite_if(arguments.force));
  Diagnostics diagnostics;
  const PairedClips clips = read_paired_clips(arguments.pairs, &diagnostics);
  const json sources = {{"strut", version()},
                        {"pair_list", arguments.pairs},
                        {"inputs", describe_files(clips.input_paths)},
                        {"outputs", describe_files(clips.output_paths)},
                        {"options", describe_options(arguments.options)}};
  LearntStyle learnt;
  {
    ProgressLine line("learning");
    learnt = learn_style(
        clips.inputs, clips.outputs, clips.pairs, arguments.options,
        [&](const LearnReport& report) {
          json provenance = sources;
          provenance["report"] = report_as_json(report);
          return provenance.dump();
        },
        &diagnostics, [&](const std::string& step, int done, int total) { line.update(step, done, total); });
  }
  write_style_model(arguments.output, *learnt.model, overwrite_if(arguments.force));
  print_diagnostics(diagnostics);
  print_report(learnt.report, *learnt.model);
}

}  // namespace

void add_learn(CLI::App& app) {
  auto arguments = std::make_shared<LearnArguments>();
  LearnOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand("learn", "Learn a style from paired clips");
  command->add_option("pairs", arguments->pairs, "Pair list made by strut pair (.toml)")->required();
  command->add_option("-o,--output", arguments->output, "Style model to write (.strut)")->required();
  command->add_option("--max-order", options.identification.max_order, "Largest number of states tried per joint")
      ->check(CLI::Range(0, 20))
      ->capture_default_str();
  command
      ->add_option("--block-rows", options.identification.block_rows,
                   "Past and future of subspace identification [frames]")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  command
      ->add_option("--weighting", options.identification.weighting,
                   "Of the subspace step: n4sid, moesp or cva (default cva)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, sysid::Weighting>{
          {"n4sid", sysid::Weighting::kN4sid}, {"moesp", sysid::Weighting::kMoesp}, {"cva", sysid::Weighting::kCva}}));
  command->add_option("--memory", options.longest_memory, "Slowest decay the model's states may have, to 1/e [s]")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--ridge", options.identification.ridge, "Shrinkage of the matrices B and D, 0 for none")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--smoothness", options.alignment.space.scale_smoothness, "Weight of smoothness in the space warp")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--time-smoothing", options.time_warp_smoothing, "Reach of the time warp's smoothing [s]")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--frame-rate", options.frame_rate, "Frames per second of the model; 0: the first input clip's")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--force", arguments->force, "Overwrite an existing file");
  command->callback([arguments] {
    arguments->options.alignment.space.offset_smoothness = arguments->options.alignment.space.scale_smoothness;
    run(*arguments);
  });
}

}  // namespace strut::cli
