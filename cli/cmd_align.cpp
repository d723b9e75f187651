// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_align(CLI::App& app) {
  CLI::App* command = app.add_subcommand("align", "");
  command->callback([] { throw Error("align is still to be written"); });
}

}  // namespace strut::cli
