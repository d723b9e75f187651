// SPDX-License-Identifier: MIT
// strut view: serves a page on which clips are compared, translated, paired and labelled.
#include "commands.h"
#include "terminal.h"
#include "usage.h"
#include "view/page.h"
#include "view/routes.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace strut::cli {
namespace {

struct ViewArguments {
  std::vector<std::string> files;
  int port = 0;
  bool no_browser = false;
};

void run(const ViewArguments& arguments) {
  Workspace workspace(arguments.files);
  PageServer server(kViewerPage, arguments.port);
  add_clip_routes(server, workspace);
  fmt::print("{}\n", server.address());
  std::fflush(stdout);
  server.run();
}

}  // namespace

void add_view(CLI::App& app) {
  CLI::App* command = app.add_subcommand("view", "Look at clips, models, pair lists and labels in the browser");
  const auto arguments = std::make_shared<ViewArguments>();
  command->add_option("files", arguments->files, "Clips (BVH), style models, pair lists, fragment databases")
      ->required();
  command->add_option("--port", arguments->port, "Port of 127.0.0.1 to serve on (default: any that is free)")
      ->check(number_in(0, 65535));
  command->add_flag("--no-browser", arguments->no_browser, "Only print the address");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
