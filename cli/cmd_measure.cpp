// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_measure(CLI::App& app) {
  CLI::App* command = app.add_subcommand("measure", "");
  command->callback([] { throw Error("measure is still to be written"); });
}

}  // namespace strut::cli
