// SPDX-License-Identifier: MIT
// The files that the program in C beside this reads: make_models FOLDER writes radial.strut, linear.strut (of the same
// skeleton), renamed.strut (another name), cut.strut (half a file) and newer.strut (a format of the future).
#include "support/small_model.h"
#include "support/walks.h"

#include <cstdio>
#include <string>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/model/style_model_io.h>

namespace {

using namespace strut;

constexpr char kFutureVersion = 99;

bool is_of_the_future(const std::string& bytes) {
  try {
    parse_style_model(bytes, "changed");
  } catch (const VersionError&) {
    return true;
  } catch (const Error&) {
    return false;
  }
  return false;
}

/// The file with the one byte changed that says its version.
std::string of_the_future(const std::string& bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = kFutureVersion;
    if (is_of_the_future(changed)) return changed;
  }
  throw InvalidArgument("bytes", "a style model that states its version", "none");
}

void write_models(const std::string& folder) {
  const Motion clip = test::turning_motion(30.0, 2.0);
  const StyleModel radial(test::radial_parts(clip));
  const std::string bytes = format_style_model(radial);
  const auto write = [&](const char* name, const std::string& text) {
    write_file(folder + "/" + name, text, Overwrite::kAllow);
  };
  write("radial.strut", bytes);
  write("linear.strut", format_style_model(*test::copying_model(clip)));
  write("renamed.strut", format_style_model(*test::copying_model(test::renamed(clip, 2, "tail"))));
  write("cut.strut", bytes.substr(0, bytes.size() / 2));
  write("newer.strut", of_the_future(bytes));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    write_models(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
