// SPDX-License-Identifier: MIT
// Puts together what the header, the rows and the guesses give: text to BvhClip.
#include "bvh_header.h"
#include "bvh_motion.h"
#include "bvh_text.h"
#include "bvh_units.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <strut/io/bvh.h>

namespace strut {
namespace {

using io::detail::BodyExtent;
using io::detail::BvhCursor;
using io::detail::BvhHeader;
using io::detail::JointColumns;

// Bodies outside these heights are usually a misread unit rather than a very small or large person.
constexpr double kSmallestBody = 0.8;  // [m]
constexpr double kLargestBody = 2.8;   // [m]; arms raised count

struct Units {
  LengthUnit unit;
  UpAxis up;
};

std::string short_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr};
}

void report_units(const Units& units, double height, const BvhReadOptions& options, const std::string& name,
                  Diagnostics& diagnostics) {
  const double metres = height * metres_per(units.unit);
  std::string assumed;
  if (!options.unit) {
    assumed = std::string("lengths read as ") + plural_name(units.unit) + " (the skeleton spans " +
              short_number(height) + ")";
  }
  if (!options.up) assumed += std::string(assumed.empty() ? "" : ", ") + axis_name(units.up) + " as up";
  if (!assumed.empty()) diagnostics.note(name, assumed);
  if (metres < kSmallestBody || metres > kLargestBody) {
    diagnostics.warn(name, "the skeleton spans " + short_number(metres) + " m, which no person does",
                     options.unit ? "" : "give the unit if the guess is wrong");
  }
}

Units find_units(const std::vector<Joint>& joints, const Pose* first_frame, const BvhReadOptions& options,
                 const std::string& name, Diagnostics* diagnostics) {
  const Skeleton skeleton(joints);
  const BodyExtent rest = io::detail::body_extent(skeleton, rest_pose(skeleton));
  const BodyExtent first = first_frame != nullptr ? io::detail::body_extent(skeleton, *first_frame) : rest;
  const double height = std::max(rest.largest(), first.largest());
  const Units units = {options.unit.value_or(io::detail::guess_unit(height)),
                       options.up.value_or(io::detail::guess_up(first, rest))};
  if (diagnostics != nullptr) report_units(units, height, options, name, *diagnostics);
  return units;
}

std::vector<Joint> in_metres_y_up(std::vector<Joint> joints, const Units& units) {
  const double scale = metres_per(units.unit);
  for (Joint& joint : joints) {
    joint.offset = scale * io::detail::to_y_up(joint.offset, units.up);
    joint.end_site = scale * io::detail::to_y_up(joint.end_site, units.up);
  }
  return joints;
}

Pose in_metres_y_up(Pose pose, const Units& units) {
  const double scale = metres_per(units.unit);
  for (auto& translation : pose.translations) translation = scale * io::detail::to_y_up(translation, units.up);
  if (units.up == UpAxis::kZ) {
    for (auto& rotation : pose.rotations) rotation = io::detail::to_y_up(rotation, units.up);
  }
  return pose;
}

std::string line_end_of(std::string_view text) {
  const auto end = text.find('\n');
  return end != text.npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

}  // namespace

BvhClip parse_bvh(std::string_view text, const std::string& name, const BvhReadOptions& options,
                  Diagnostics* diagnostics) {
  BvhCursor cursor(text, name);
  BvhHeader header = io::detail::parse_header(cursor);
  std::vector<double> values = io::detail::parse_rows(cursor, header, diagnostics);
  const auto columns = io::detail::columns_of(header.channels);
  const auto width = static_cast<std::size_t>(header.num_channels);
  const std::size_t num_frames = values.size() / width;
  const auto source_pose = [&](std::size_t row) {
    return io::detail::pose_from_row(values.data() + row * width, columns, header.joints, options.positions);
  };

  const Pose first = num_frames > 0 ? source_pose(0) : Pose{};
  const Units units = find_units(header.joints, num_frames > 0 ? &first : nullptr, options, name, diagnostics);
  std::vector<Pose> frames;
  frames.reserve(num_frames);
  for (std::size_t row = 0; row < num_frames; ++row) frames.push_back(in_metres_y_up(source_pose(row), units));

  auto skeleton = std::make_shared<const Skeleton>(in_metres_y_up(std::move(header.joints), units));
  BvhLayout layout;
  layout.channels = std::move(header.channels);
  layout.unit = units.unit;
  layout.up = units.up;
  layout.positions = options.positions;
  layout.header = std::move(header.text);
  layout.frame_time_lead = std::move(header.frame_time_lead);
  layout.frame_time = std::move(header.frame_time);
  layout.frame_rate = header.frame_rate;
  layout.skeleton = skeleton;
  layout.line_end = line_end_of(text);
  layout.source_values = std::make_shared<const std::vector<double>>(std::move(values));
  return {Motion(std::move(skeleton), header.frame_rate, std::move(frames)), std::move(layout)};
}

BvhClip read_bvh(const std::string& path, const BvhReadOptions& options, Diagnostics* diagnostics) {
  return parse_bvh(read_file(path), path, options, diagnostics);
}

}  // namespace strut
