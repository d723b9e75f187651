// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_demo(CLI::App& app) {
  CLI::App* command = app.add_subcommand("demo", "");
  command->callback([] { throw Error("demo is still to be written"); });
}

}  // namespace strut::cli
