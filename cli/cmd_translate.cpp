// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_translate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("translate", "");
  command->callback([] { throw Error("translate is still to be written"); });
}

}  // namespace strut::cli
