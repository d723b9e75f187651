// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_learn(CLI::App& app) {
  CLI::App* command = app.add_subcommand("learn", "");
  command->callback([] { throw Error("learn is still to be written"); });
}

}  // namespace strut::cli
