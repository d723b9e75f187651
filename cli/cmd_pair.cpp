// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_pair(CLI::App& app) {
  CLI::App* command = app.add_subcommand("pair", "");
  command->callback([] { throw Error("pair is still to be written"); });
}

}  // namespace strut::cli
