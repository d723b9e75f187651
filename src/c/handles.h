// SPDX-License-Identifier: MIT
// What stands behind the opaque handles.
#pragma once

#include "c/axis_map.h"

#include <atomic>
#include <memory>
#include <vector>

#include <strut/math/aligned.h>
#include <strut/model/style_model.h>
#include <strut/motion/body_parts.h>
#include <strut/translate/translator.h>

struct strut_model {
  explicit strut_model(std::shared_ptr<const strut::StyleModel> learnt);

  std::shared_ptr<const strut::StyleModel> model;
  std::vector<strut::motion::BodyPart> parts;  // per joint
  mutable std::atomic<int> references{1};
};

struct strut_translator {
  strut_translator(const std::vector<std::shared_ptr<const strut::StyleModel>>& models,
                   const strut::TranslatorOptions& options, const strut::c::AxisMap& map);

  [[nodiscard]] int num_joints() const { return translator.model().skeleton().num_joints(); }
  /// A frame in strut's convention, for callers whose frames are not.
  [[nodiscard]] strut::PoseView<float> converted() { return {rotations.data(), translations.data(), num_joints()}; }

  strut::FloatTranslator translator;
  strut::c::AxisMap axes;
  std::vector<float> rotations, translations;  // of converted()
  strut::TranslatorControls controls;          // for set_controls; weights always have a number per model
};

struct strut_snapshot {
  strut::FloatTranslator translator;
};
