// SPDX-License-Identifier: MIT
// strut view: serves a page on which clips are compared, translated, paired and labelled, until it is interrupted.
#include "bvh_options.h"
#include "commands.h"
#include "feet_options.h"
#include "live_files.h"
#include "terminal.h"
#include "usage.h"
#include "view/open_browser.h"
#include "view/page.h"
#include "view/routes.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>

namespace strut::cli {
namespace {

constexpr int kInterval = 250;  // how often it is looked whether a browser was found [ms]

struct ViewArguments {
  std::vector<std::string> files;
  int port = 0;
  bool no_browser = false;
  ViewOptions options;
};

void note_no_browser(const std::string& why) {
  say(fmt::format("strut: note: no browser was opened: {}\nhint: open the address above\n", why));
}

/// Nothing if no browser can be opened, which a person is told.
std::unique_ptr<BrowserPage> browser_at(const std::string& address) {
  try {
    return std::make_unique<BrowserPage>(address);
  } catch (const Error& error) {
    note_no_browser(error.what());
    return nullptr;
  }
}

/// Throws Interrupted, and Error if the server ends by itself.
void wait_for_the_end(const PageServer& server, const InterruptSignals& signals, BrowserPage* browser) {
  while (server.is_running()) {
    signals.wait(-1, 0, kInterval);
    if (browser != nullptr && browser->has_failed()) note_no_browser("none was found");
  }
  signals.wait(-1, 0, 0);
  throw Error("the page cannot be served any longer");
}

void run(const ViewArguments& arguments) {
  Workspace workspace(arguments.files, arguments.options);
  PageServer server(kViewerPage, arguments.port);
  add_clip_routes(server, workspace);
  add_translate_routes(server, workspace);
  add_pair_routes(server, workspace);
  add_label_routes(server, workspace);
  const InterruptSignals signals;
  server.start();
  fmt::print("{}\n", server.address());
  if (std::fflush(stdout) != 0) return;  // main tells
  say("Ctrl+C ends it.\n");
  const auto browser = arguments.no_browser ? nullptr : browser_at(server.address());
  try {
    wait_for_the_end(server, signals, browser.get());
  } catch (const Interrupted&) {
  }
}

}  // namespace

void add_view(CLI::App& app) {
  CLI::App* command = app.add_subcommand("view", "Look at clips, models, pair lists and labels in the browser");
  const auto arguments = std::make_shared<ViewArguments>();
  command
      ->add_option("files", arguments->files,
                   "Clips (BVH), style models, pair lists (their clips come along), fragment databases")
      ->required();
  command->add_option("--port", arguments->port, "Port of 127.0.0.1 to serve on (default: any that is free)")
      ->check(number_in(0, 65535));
  command->add_flag("--no-browser", arguments->no_browser, "Only print the page's address");
  command->add_option("--rater", arguments->options.rater, "Who labels (default: the page asks)")->type_name("NAME");
  add_bvh_read_options(*command, "--", arguments->options.read);
  add_feet_option(*command, arguments->options.feet);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
