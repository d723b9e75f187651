// SPDX-License-Identifier: MIT
// The strut program: finds the command, runs it, and turns every error into one clear message and an exit code.
#include "commands.h"
#include "terminal.h"

#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/core/version.h>

namespace strut::cli {
namespace {

/// what() of file errors already reads `path: error: ...`; the others get the program's name in that place.
void print_error(const Error& error, bool names_a_file) {
  fmt::print(stderr, "{}{}\n", names_a_file ? "" : "strut: error: ", error.what());
  if (!error.hint().empty()) fmt::print(stderr, "hint: {}\n", error.hint());
}

int run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  } catch (const ParseError& error) {
    print_error(error, true);
    return kBadInput;
  } catch (const VersionError& error) {
    print_error(error, true);
    return kBadInput;
  } catch (const FileError& error) {
    print_error(error, true);
    return error.action() == FileAction::kRead ? kBadInput : kFailed;
  } catch (const SkeletonMismatch& error) {
    print_error(error, true);
    return kMismatch;
  } catch (const Error& error) {
    print_error(error, false);
    return kFailed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "strut: error: out of memory\n");
    return kFailed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "strut: error: {}\n", error.what());
    return kFailed;
  }
}

/// A full disk or a closed pipe behind standard output shows only when it is flushed.
int flush_output(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  fmt::print(stderr, "strut: error: cannot write to standard output\n");
  return code == kDone ? kFailed : code;
}

}  // namespace
}  // namespace strut::cli

int main(int argc, char** argv) {
  using namespace strut::cli;
  CLI::App app("strut learns a style of human movement from a few paired clips and puts it on new motion.", "strut");
  app.set_version_flag("--version", std::string("strut ") + strut::version());
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  add_pair(app);
  add_learn(app);
  add_translate(app);
  add_align(app);
  add_info(app);
  add_convert(app);
  add_measure(app);
  add_demo(app);
  add_completion(app);
  return flush_output(run(app, argc, argv));
}
