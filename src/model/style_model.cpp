// SPDX-License-Identifier: MIT
#include <cmath>
#include <numeric>
#include <string>

#include <strut/core/error.h>
#include <strut/model/style_model.h>

namespace strut {
namespace {

void check_dofs(const StyleBlock& block, const std::vector<int>& dofs, int systems_count, int available,
                const char* which) {
  if (static_cast<int>(dofs.size()) != systems_count) {
    throw InvalidArgument("block '" + block.name + "' " + which, std::to_string(systems_count) + " degrees of freedom",
                          std::to_string(dofs.size()));
  }
  for (const int dof : dofs) {
    if (dof < 0 || dof >= available) {
      throw InvalidArgument("block '" + block.name + "' " + which,
                            "degrees of freedom below " + std::to_string(available), std::to_string(dof));
    }
  }
}

void check_block(const StyleBlock& block, int num_inputs, std::vector<bool>& given) {
  check_dofs(block, block.input_dofs, block.system.num_inputs(), num_inputs, "inputs");
  check_dofs(block, block.output_dofs, block.system.num_outputs(), static_cast<int>(given.size()), "outputs");
  for (const int dof : block.output_dofs) {
    if (given[static_cast<std::size_t>(dof)]) {
      throw InvalidArgument("block '" + block.name + "'", "outputs of its own",
                            "degree of freedom " + std::to_string(dof) + " again");
    }
    given[static_cast<std::size_t>(dof)] = true;
  }
  const double radius = block.system.spectral_radius();
  if (radius >= 1.0) {
    throw InvalidArgument("block '" + block.name + "'", "a stable system", "spectral radius " + std::to_string(radius));
  }
}

void check_size(const char* name, int expected, int got) {
  if (expected != got)
    throw InvalidArgument(name, std::to_string(expected) + " degrees of freedom", std::to_string(got));
}

}  // namespace

StyleModel::StyleModel(StyleModelParts parts) : parts_(std::move(parts)) {
  if (!(std::isfinite(parts_.frame_rate) && parts_.frame_rate > 0.0)) {
    throw InvalidArgument("frame_rate", "a positive number", std::to_string(parts_.frame_rate));
  }
  const std::string mismatch = describe_mismatch(parts_.input.skeleton(), parts_.output.skeleton());
  if (!mismatch.empty()) throw InvalidArgument("output", "the input's hierarchy", mismatch);
  check_size("input_scaling", num_dofs(), parts_.input_scaling.num_dofs());
  check_size("output_scaling", num_dofs() + 1, parts_.output_scaling.num_dofs());
  std::vector<bool> given(static_cast<std::size_t>(num_dofs()) + 1, false);
  if (parts_.context.rows() == 0) parts_.context.resize(0, num_dofs());
  check_size("context", num_dofs(), static_cast<int>(parts_.context.cols()));
  if (!parts_.context.allFinite()) throw InvalidArgument("context", "finite numbers", "NaN or infinity");
  const auto contexts = static_cast<int>(parts_.context.rows());
  for (const StyleBlock& block : parts_.blocks) check_block(block, num_dofs() + contexts, given);
  if (parts_.radial_map) {
    if (!parts_.blocks.empty()) throw InvalidArgument("blocks", "none beside a radial map", "some");
    check_radial_map(*parts_.radial_map, num_dofs(), contexts);
  }
  if (parts_.footplants && parts_.footplants->num_states() != state_size()) {
    throw InvalidArgument("footplants", std::to_string(state_size()) + " states",
                          std::to_string(parts_.footplants->num_states()));
  }
  packed_float_ = std::make_shared<const PackedModel<float>>(parts_);
  packed_double_ = std::make_shared<const PackedModel<double>>(parts_);
}

int StyleModel::state_size() const noexcept {
  return parts_.radial_map ? parts_.radial_map->basis.num_features() : num_states();
}

int StyleModel::num_states() const noexcept {
  return std::accumulate(parts_.blocks.begin(), parts_.blocks.end(), 0,
                         [](int sum, const StyleBlock& block) { return sum + block.system.num_states(); });
}

}  // namespace strut
