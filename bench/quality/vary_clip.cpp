// SPDX-License-Identifier: MIT
// clip_variations.h as a program, for quality.py. Varies a clip and prints the frames in which it is varied in full, or
// compares clips; prints JSON.
#include "clip_variations.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include <strut/core/error.h>
#include <strut/io/bvh.h>

namespace {

using namespace strut;
using Words = std::vector<std::string>;

constexpr const char* kUsage =
    "usage: vary_clip INPUT.bvh OUTPUT.bvh exaggerate JOINT FACTOR\n"
    "       vary_clip INPUT.bvh OUTPUT.bvh bend JOINT most|least DEGREES HERTZ\n"
    "       vary_clip INPUT.bvh OUTPUT.bvh raise JOINT DEGREES\n"
    "       vary_clip INPUT.bvh OUTPUT.bvh duck SHARE_OF_LEG\n"
    "       vary_clip INPUT.bvh OUTPUT.bvh halt SECONDS\n"
    "       vary_clip INPUT.bvh OUTPUT.bvh stretch|resize FACTOR\n"
    "       vary_clip --response JOINT INPUT.bvh VARIED_INPUT.bvh OUTPUT.bvh VARIED_OUTPUT.bvh\n"
    "       vary_clip --distance FIRST.bvh SECOND.bvh BEGIN END\n";

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kCmPerMetre = 100.0;

/// The command line is not what kUsage says.
class UsageError : public std::exception {};

double number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0') throw UsageError();
  return value;
}

int joint_of(const Motion& clip, const std::string& name) {
  const int joint = clip.skeleton().find(name);
  if (joint < 0) throw InvalidArgument("joint", "a joint of the clip", "'" + name + "'");
  return joint;
}

Motion motion_of(const std::string& path) {
  return read_bvh(path).motion;
}

/// `words`: the kind of variation and its numbers.
quality::VariedClip varied(const Motion& clip, const Words& words) {
  const auto is = [&](const char* kind, std::size_t count) { return words[0] == kind && words.size() == count; };
  if (is("exaggerate", 3)) return quality::exaggerated(clip, joint_of(clip, words[1]), number(words[2]));
  if (is("bend", 5) && (words[2] == "most" || words[2] == "least")) {
    const auto direction = words[2] == "most" ? quality::Direction::kMost : quality::Direction::kLeast;
    return quality::bent(clip, joint_of(clip, words[1]), direction, kRadians * number(words[3]), number(words[4]));
  }
  if (is("raise", 3)) return quality::raised(clip, joint_of(clip, words[1]), kRadians * number(words[2]));
  if (is("duck", 2)) return quality::ducked(clip, number(words[1]));
  if (is("halt", 2)) return quality::halted(clip, number(words[1]));
  if (is("stretch", 2)) return quality::stretched(clip, number(words[1]));
  if (is("resize", 2)) return quality::resized(clip, number(words[1]));
  throw UsageError();
}

void vary(const Words& words) {
  const BvhClip clip = read_bvh(words[0]);
  const quality::VariedClip result = varied(clip.motion, {words.begin() + 2, words.end()});
  write_bvh(words[1], result.motion, clip.layout);
  std::printf("{\"begin\": %d, \"end\": %d}\n", result.frames.begin, result.frames.end);
}

void print_response(const Words& words) {
  const Motion input = motion_of(words[2]);
  const quality::Response found = quality::response(input, motion_of(words[3]), motion_of(words[4]),
                                                    motion_of(words[5]), joint_of(input, words[1]));
  std::printf("{\"share\": %.6f, \"correlation\": %.6f, \"gain\": %.6f}\n", found.share, found.correlation, found.gain);
}

void print_distance(const Words& words) {
  const motion::FrameRange frames{static_cast<int>(number(words[3])), static_cast<int>(number(words[4]))};
  const double metres = quality::frame_distance(motion_of(words[1]), motion_of(words[2]), frames);
  std::printf("{\"distance_cm\": %.6f}\n", kCmPerMetre * metres);
}

void run(const Words& words) {
  if (words.size() == 6 && words[0] == "--response") return print_response(words);
  if (words.size() == 5 && words[0] == "--distance") return print_distance(words);
  if (words.size() >= 3 && words[0][0] != '-') return vary(words);
  throw UsageError();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run({argv + 1, argv + argc});
    return 0;
  } catch (const UsageError&) {
    std::fputs(kUsage, stderr);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vary_clip: %s\n", error.what());
    return 1;
  }
}
