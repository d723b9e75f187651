// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_completion(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "");
  command->callback([] { throw Error("completion is still to be written"); });
}

}  // namespace strut::cli
