// SPDX-License-Identifier: MIT
#include "c/joint_transforms.h"

#include "c/axis_map.h"
#include "c/status.h"

#include <string>

namespace strut::c {
namespace {

template <typename Float>
Float* aligned(const char* name, Float* numbers) {
  if (numbers == nullptr || reinterpret_cast<std::uintptr_t>(numbers) % alignof(float) != 0) {
    throw InvalidArgument(name, "pointers to floats", numbers == nullptr ? "NULL" : "one that is not aligned");
  }
  return numbers;
}

std::ptrdiff_t step_of(const char* name, std::size_t stride, std::size_t numbers) {
  if (stride == 0) return static_cast<std::ptrdiff_t>(numbers);
  if (stride < numbers * sizeof(float) || stride % sizeof(float) != 0 || stride > PTRDIFF_MAX) {
    throw InvalidArgument(name, "strides of whole joints that are multiples of 4 bytes", std::to_string(stride));
  }
  return static_cast<std::ptrdiff_t>(stride / sizeof(float));
}

template <typename Float, typename Pose>
JointTransforms<Float> joints_of_pose(const char* name, const Pose* given) {
  const Pose& pose = required(name, given);
  if (pose.num_joints < 1) throw InvalidArgument(name, "joints", std::to_string(pose.num_joints));
  return {aligned(name, pose.rotations), aligned(name, pose.translations), step_of(name, pose.rotation_stride, 4),
          step_of(name, pose.translation_stride, 3), pose.num_joints};
}

}  // namespace

JointTransforms<const float> joints_of(const char* name, const strut_const_pose* pose) {
  return joints_of_pose<const float>(name, pose);
}

JointTransforms<float> joints_of(const char* name, const strut_pose* pose) {
  return joints_of_pose<float>(name, pose);
}

void check_num_joints(const char* name, int expected, int got) {
  if (got == expected) return;
  throw InvalidArgument(name, std::to_string(expected) + " joints", std::to_string(got));
}

}  // namespace strut::c

strut_status strut_convert_pose(const strut_const_pose* input, const strut_axes* from, const strut_pose* output,
                                const strut_axes* to) {
  using namespace strut::c;
  return guarded([&] {
    const auto source = joints_of("input", input);
    const auto target = joints_of("output", output);
    check_num_joints("output", source.num_joints, target.num_joints);
    const AxisMap in(axes_or_default("from", from));
    const AxisMap out(axes_or_default("to", to));
    for (int j = 0; j < source.num_joints; ++j) {
      in.rotation_to_strut(source.rotation(j), target.rotation(j));
      out.rotation_from_strut(target.rotation(j), target.rotation(j));
      in.translation_to_strut(source.translation(j), target.translation(j));
      out.translation_from_strut(target.translation(j), target.translation(j));
    }
    return STRUT_OK;
  });
}
