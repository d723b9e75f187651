// SPDX-License-Identifier: MIT
// The strut program: finds the command, runs it, and turns every error into one clear message and an exit code.
#include "commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <new>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/core/version.h>

namespace strut::cli {
namespace {

/// what() of file errors already reads `path: error: ...`; the others get the program's name in that place.
void print_error(const Error& error, bool names_a_file) {
  say(fmt::format("{}{}\n", names_a_file ? "" : "strut: error: ", error.what()));
  if (!error.hint().empty()) say(fmt::format("hint: {}\n", error.hint()));
}

int run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return kDone;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    print_usage_error(app, error);
    return kUsage;
  } catch (const ParseError& error) {
    print_error(error, true);
    return kBadInput;
  } catch (const VersionError& error) {
    print_error(error, true);
    return kBadInput;
  } catch (const FileError& error) {
    print_error(error, true);
    return error.action() == FileAction::kRead ? kBadInput : kFailed;
  } catch (const BadInput& error) {
    print_error(error, true);
    return kBadInput;
  } catch (const SkeletonMismatch& error) {
    print_error(error, true);
    return kMismatch;
  } catch (const Error& error) {
    print_error(error, false);
    return kFailed;
  } catch (const std::bad_alloc&) {
    say("strut: error: out of memory\n");
    return kFailed;
  } catch (const std::exception& error) {
    // Where {fmt} cannot write to standard output, flush_output says so in our words.
    if (std::ferror(stdout) == 0) say(fmt::format("strut: error: {}\n", error.what()));
    return kFailed;
  }
}

/// A full disk or a closed pipe behind standard output shows only when it is flushed.
int flush_output(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  say("strut: error: cannot write to standard output\n");
  return code == kDone ? kFailed : code;
}

/// A file that is opened while a standard stream is closed would take its number, and messages would go into the file.
/// Input and output are occupied the wrong way around, so that using them still fails.
void occupy_standard_streams() {
  if (::fcntl(STDIN_FILENO, F_GETFD) < 0) ::open("/dev/null", O_WRONLY);
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0) ::open("/dev/null", O_WRONLY);
}

}  // namespace
}  // namespace strut::cli

int main(int argc, char** argv) {
  using namespace strut::cli;
  occupy_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file too large is an error like a full disk
  CLI::App app("strut learns a style of human movement from a few paired clips and puts it on new motion.", "strut");
  app.set_version_flag("--version", std::string("strut ") + strut::version());
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  add_pair(app);
  add_learn(app);
  add_translate(app);
  add_clean(app);
  add_align(app);
  add_info(app);
  add_convert(app);
  add_measure(app);
  add_footplants(app);
  add_sysid(app);
  add_blend(app);
  add_effort(app);
  add_view(app);
  add_report(app);
  add_demo(app);
  add_completion(app);
  return flush_output(run(app, argc, argv));
}
