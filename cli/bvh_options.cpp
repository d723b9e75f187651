// SPDX-License-Identifier: MIT
#include "bvh_options.h"

#include <array>
#include <cctype>
#include <utility>

namespace strut::cli {
namespace {

constexpr std::array<std::pair<const char*, LengthUnit>, 5> kUnits = {{{"m", LengthUnit::kMetre},
                                                                       {"cm", LengthUnit::kCentimetre},
                                                                       {"mm", LengthUnit::kMillimetre},
                                                                       {"in", LengthUnit::kInch},
                                                                       {"ft", LengthUnit::kFoot}}};

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

[[noreturn]] void refuse(const std::string& option, const std::string& expected, const std::string& word) {
  throw CLI::ValidationError(option, "expected " + expected + ", got '" + word + "'");
}

}  // namespace

LengthUnit parse_unit(const std::string& option, const std::string& word) {
  for (const auto& [name, unit] : kUnits) {
    if (lower(word) == name) return unit;
  }
  refuse(option, "m, cm, mm, in or ft", word);
}

UpAxis parse_up(const std::string& option, const std::string& word) {
  if (lower(word) == "y") return UpAxis::kY;
  if (lower(word) == "z") return UpAxis::kZ;
  refuse(option, "y or z", word);
}

void add_bvh_read_options(CLI::App& command, const std::string& prefix, BvhReadOptions& options) {
  const std::string unit = prefix + "unit", up = prefix + "up";
  command
      .add_option_function<std::string>(
          unit, [unit, &options](const std::string& word) { options.unit = parse_unit(unit, word); },
          "Unit of the lengths in the input: m, cm, mm, in or ft (default: guessed from the skeleton's size)")
      ->type_name("UNIT");
  command
      .add_option_function<std::string>(
          up, [up, &options](const std::string& word) { options.up = parse_up(up, word); },
          "Axis that points up in the input: y or z (default: guessed from the skeleton's main axis)")
      ->type_name("AXIS");
  command
      .add_option_function<std::string>(
          "--positions",
          [&options](const std::string& word) {
            if (lower(word) != "replace" && lower(word) != "add") refuse("--positions", "replace or add", word);
            options.positions =
                lower(word) == "add" ? PositionChannels::kAddToOffset : PositionChannels::kReplaceOffset;
          },
          "Whether position channels in the input replace a joint's OFFSET or add to it (default: replace)")
      ->type_name("MODE");
}

std::string words_of(const BvhReadOptions& options) {
  std::string words;
  for (const auto& [name, unit] : kUnits) {
    if (options.unit == unit) words += std::string(" --unit ") + name;
  }
  if (options.up) words += std::string(" --up ") + lower(axis_name(*options.up));
  if (options.positions == PositionChannels::kAddToOffset) words += " --positions add";
  return words;
}

}  // namespace strut::cli
