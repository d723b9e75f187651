// SPDX-License-Identifier: MIT
// Models through the C interface: loading, counting owners, facts.
#include "c/handles.h"
#include "c/versioned_struct.h"

#include <limits>
#include <string>
#include <string_view>

#include <strut/model/style_model_io.h>
#include <strut/representation/representation.h>

namespace strut::c {
namespace {

std::vector<motion::BodyPart> parts_of(const StyleModel& model) {
  const Motion standing(model.output().shared_skeleton(), 1.0, {representation::mean_pose(model.output())});
  return motion::body_parts(standing);
}

/// Runs `read` and gives a handle to the model that it returns.
template <typename Read>
strut_status load(strut_model** model, const Read& read) noexcept {
  return guarded([&] {
    strut_model*& handle = required("model", model);
    handle = nullptr;
    handle = new strut_model(read());
    return STRUT_OK;
  });
}

strut_joint joint_of(const strut_model& model, int index, const AxisMap& axes) {
  const Joint& joint = model.model->skeleton().joint(index);
  const Eigen::Vector3f offset = joint.offset.cast<float>();
  strut_joint result{};
  result.parent = joint.parent;
  result.name = joint.name.c_str();
  axes.translation_from_strut(offset.data(), &result.offset[0]);
  result.part = static_cast<std::int32_t>(model.parts.at(static_cast<std::size_t>(index)));
  return result;
}

Skeleton skeleton_of(const char* const* names, const std::int32_t* parents, int num_joints) {
  std::vector<Joint> joints;
  joints.reserve(static_cast<std::size_t>(num_joints));
  for (int j = 0; j < num_joints; ++j) {
    Joint joint;
    joint.name = &required("names", names[j]);
    joint.parent = parents[j];
    joints.push_back(std::move(joint));
  }
  return Skeleton(std::move(joints));
}

}  // namespace
}  // namespace strut::c

strut_model::strut_model(std::shared_ptr<const strut::StyleModel> learnt)
    : model(std::move(learnt)), parts(strut::c::parts_of(*model)) {}

strut_status strut_model_load(const char* path, strut_model** model) {
  return strut::c::load(model, [&] { return strut::read_style_model(&strut::c::required("path", path)); });
}

strut_status strut_model_load_memory(const void* bytes, size_t size, const char* name, strut_model** model) {
  return strut::c::load(model, [&] {
    const auto* text = static_cast<const char*>(&strut::c::required("bytes", static_cast<const char*>(bytes)));
    return strut::parse_style_model({text, size}, name == nullptr ? "model" : name);
  });
}

strut_status strut_model_retain(const strut_model* model) {
  return strut::c::guarded([&] {
    strut::c::required("model", model).references.fetch_add(1, std::memory_order_relaxed);
    return STRUT_OK;
  });
}

void strut_model_release(const strut_model* model) {
  // What other threads did with the model happens before it is freed.
  if (model != nullptr && model->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete model;
}

strut_status strut_model_get_info(const strut_model* model, strut_model_info* info) {
  using namespace strut::c;
  return guarded([&] {
    const strut::StyleModel& style = *required("model", model).model;
    strut_model_info result{};
    result.num_joints = style.skeleton().num_joints();
    result.frame_rate = style.frame_rate();
    result.num_dofs = style.num_dofs();
    result.method = style.radial_map() ? STRUT_METHOD_RADIAL : STRUT_METHOD_LINEAR;
    result.provenance = style.provenance().c_str();
    give("info", &required("info", info), result);
    return STRUT_OK;
  });
}

strut_status strut_model_get_joint(const strut_model* model, int32_t index, const strut_axes* axes,
                                   strut_joint* joint) {
  using namespace strut::c;
  return guarded([&] {
    const int num_joints = required("model", model).model->skeleton().num_joints();
    if (index < 0 || index >= num_joints) {
      throw strut::InvalidArgument("index", "0 to " + std::to_string(num_joints - 1), std::to_string(index));
    }
    give("joint", &required("joint", joint), joint_of(*model, index, AxisMap(axes_or_default("axes", axes))));
    return STRUT_OK;
  });
}

strut_status strut_model_check_skeleton(const strut_model* model, const char* const* names, const int32_t* parents,
                                        int32_t num_joints) {
  using namespace strut::c;
  return guarded([&] {
    const strut::StyleModel& style = *required("model", model).model;
    required("names", names);
    required("parents", parents);
    if (num_joints < 1) throw strut::InvalidArgument("num_joints", "1 or more", std::to_string(num_joints));
    strut::representation::check_skeleton(style.input(), skeleton_of(names, parents, num_joints));
    return STRUT_OK;
  });
}
