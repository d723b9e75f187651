// SPDX-License-Identifier: MIT
#include "commands.h"

#include <strut/core/error.h>

namespace strut::cli {

void add_convert(CLI::App& app) {
  CLI::App* command = app.add_subcommand("convert", "");
  command->callback([] { throw Error("convert is still to be written"); });
}

}  // namespace strut::cli
