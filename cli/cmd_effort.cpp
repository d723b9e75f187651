// SPDX-License-Identifier: MIT
// strut effort: from a folder of clips to motion that is freer, stronger or more sudden (effort_<name>.cpp hold its
// commands).
#include "commands.h"
#include "effort_commands.h"

namespace strut::cli {
namespace {

constexpr const char* kSteps =
    "From a folder of clips to a slider:\n"
    "  strut effort segment moves.db clips/*.bvh                      cut the clips into fragments\n"
    "  strut effort match moves.db                                    group fragments of like content\n"
    "  strut effort estimate moves.db                                 give every fragment a first Effort\n"
    "  strut effort learn moves.db --estimates -o moves.struteffort   learn how that carries over to blends\n"
    "  strut effort apply moves.struteffort clip.bvh --time 0.8 -o sudden.bvh\n"
    "With labels of people: strut effort labels moves.db --import labels.csv, then learn without --estimates.\n"
    "Flow runs from free (-1) to bound (1), Weight from light to strong, Time from sustained to sudden.";

}  // namespace

void add_effort(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("effort", "Make motion freer, stronger or more sudden, by labelled examples (Laban Effort)");
  command->footer(kSteps);
  command->require_subcommand(1);
  add_effort_segment(*command);
  add_effort_match(*command);
  add_effort_labels(*command);
  add_effort_estimate(*command);
  add_effort_apply(*command);
  add_effort_blend(*command);
  add_effort_learn(*command);
  add_effort_next(*command);
}

}  // namespace strut::cli
