// SPDX-License-Identifier: MIT
// How well are gaits predicted that no example shows, and how do they walk? Prints the tables of docs/blend.md:
//   blend_study                 left-out combinations of style and speed of generated walks, against the exact walk
//   blend_study FOLDER          the same on the recorded walks and runs in FOLDER (Bandai-Namco, dataset 2)
//   blend_study --walk          what is synthesized, measured: speed, feet, loops, changes
//   blend_study --picture SVG   poses of synthesized cycles, style by speed
#include "blend_study.h"

#include <cstdio>
#include <exception>
#include <string>

int main(int argc, char** argv) {
  using namespace strut::study;
  try {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first.empty()) {
      judge_generated();
    } else if (first == "--walk") {
      judge_synthesis();
    } else if (first == "--picture" && argc == 3) {
      draw_cycles(argv[2]);
    } else {
      judge_recorded(first);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "blend_study: %s\n", error.what());
    return 1;
  }
}
