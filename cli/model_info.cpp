// SPDX-License-Identifier: MIT
#include "model_info.h"

#include "learn_report.h"

#include <fmt/core.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

Json blocks_as_json(const StyleModel& model) {
  Json blocks = Json::array();
  for (const StyleBlock& block : model.blocks()) {
    blocks.push_back({{"name", block.name},
                      {"num_inputs", block.system.num_inputs()},
                      {"num_outputs", block.system.num_outputs()},
                      {"num_states", block.system.num_states()},
                      {"spectral_radius", block.system.spectral_radius()}});
  }
  return blocks;
}

/// Nothing where the model is linear systems.
Json radial_map_as_json(const StyleModel& model) {
  const auto& map = model.radial_map();
  if (!map) return nullptr;
  return {{"num_centres", map->basis.num_centres()},
          {"width", map->basis.width()},
          {"lags_frames", map->lags},
          {"smoothing_frames", map->smoothing},
          {"fast_detail", map->fast}};
}

void print_sources(const Json& provenance) {
  for (const char* side : {"inputs", "outputs"}) {
    if (!provenance.is_object() || !provenance.contains(side) || !provenance[side].is_array()) continue;
    fmt::print("  {:<10} {} clips\n", side, provenance[side].size());
    for (const Json& file : provenance[side]) {
      if (file.is_object()) fmt::print("    {}\n", file.value("file", std::string("?")));
    }
  }
}

}  // namespace

Json provenance_as_json(const std::string& provenance) {
  Json parsed = Json::parse(provenance, nullptr, false);
  return parsed.is_discarded() ? Json(provenance) : parsed;
}

Json model_as_json(const std::string& path, const StyleModel& model) {
  return {{"file", path},
          {"kind", "style model"},
          {"frame_rate", model.frame_rate()},
          {"num_joints", model.skeleton().num_joints()},
          {"num_contexts", model.context().rows()},
          {"radial_map", radial_map_as_json(model)},
          {"num_states", model.num_states()},
          {"tells_footplants", model.footplants().has_value()},
          {"blocks", blocks_as_json(model)},
          {"provenance", provenance_as_json(model.provenance())}};
}

void print_model(const std::string& path, const StyleModel& model) {
  fmt::print("{}\n", path);
  fmt::print("  style model at {:g} frames/s, {} joints, pelvis '{}'\n", model.frame_rate(),
             model.skeleton().num_joints(), model.skeleton().joint(model.skeleton().pelvis()).name);
  const Json provenance = provenance_as_json(model.provenance());
  print_sources(provenance);
  const auto report = report_from_json(provenance.is_object() ? provenance.value("report", Json()) : Json());
  if (report) {
    print_report(*report, model);
  } else {
    fmt::print("  {}; it does not say how it was learnt\n", model_in_words(model));
  }
}

}  // namespace strut::cli
