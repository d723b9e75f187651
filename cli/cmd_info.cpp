// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "");
  command->callback([] { throw Error("info is still to be written"); });
}

}  // namespace strut::cli
