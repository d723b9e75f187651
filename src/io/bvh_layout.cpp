// SPDX-License-Identifier: MIT
// The names of units and axes, and layouts that do not come from a file.
#include <set>

#include <strut/core/error.h>
#include <strut/io/bvh.h>

namespace strut {
namespace {

void check_rotation_order(const std::vector<BvhChannel>& order) {
  const std::set<BvhChannel> distinct(order.begin(), order.end());
  const bool are_rotations = !order.empty() && *distinct.begin() >= BvhChannel::kXRotation;
  if (order.size() != 3 || distinct.size() != 3 || !are_rotations) {
    throw InvalidArgument("rotation_order", "the three rotations, each once",
                          std::to_string(order.size()) + " channels");
  }
}

}  // namespace

double metres_per(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::kMetre:
      return 1.0;
    case LengthUnit::kCentimetre:
      return 0.01;
    case LengthUnit::kMillimetre:
      return 0.001;
    case LengthUnit::kInch:
      return 0.0254;
    case LengthUnit::kFoot:
      return 0.3048;
  }
  return 1.0;
}

const char* plural_name(LengthUnit unit) noexcept {
  switch (unit) {
    case LengthUnit::kMetre:
      return "metres";
    case LengthUnit::kCentimetre:
      return "centimetres";
    case LengthUnit::kMillimetre:
      return "millimetres";
    case LengthUnit::kInch:
      return "inches";
    case LengthUnit::kFoot:
      return "feet";
  }
  return "metres";
}

const char* axis_name(UpAxis up) noexcept {
  return up == UpAxis::kY ? "Y" : "Z";
}

int BvhLayout::num_channels() const noexcept {
  std::size_t count = 0;
  for (const auto& joint_channels : channels) count += joint_channels.size();
  return static_cast<int>(count);
}

BvhLayout default_layout(const Skeleton& skeleton, LengthUnit unit, UpAxis up,
                         const std::vector<BvhChannel>& rotation_order) {
  check_rotation_order(rotation_order);
  BvhLayout layout;
  layout.unit = unit;
  layout.up = up;
  layout.channels.assign(static_cast<std::size_t>(skeleton.num_joints()), rotation_order);
  layout.channels[0].insert(layout.channels[0].begin(),
                            {BvhChannel::kXPosition, BvhChannel::kYPosition, BvhChannel::kZPosition});
  return layout;
}

BvhLayout with_units(const BvhLayout& layout, LengthUnit unit, UpAxis up) {
  BvhLayout result = layout;
  if (unit == layout.unit && up == layout.up) return result;
  result.unit = unit;
  result.up = up;
  result.header.clear();
  result.frame_time_lead.clear();
  if (up != layout.up) result.source_values.reset();
  return result;
}

}  // namespace strut
