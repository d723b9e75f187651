// SPDX-License-Identifier: MIT
#include "c/handles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <strut/model/style_model_io.h>

namespace strut::test {
namespace {

void require_ok(strut_status status) {
  if (status != STRUT_OK) throw std::runtime_error(strut_last_error());
}

float largest(const std::vector<float>& a, const std::vector<float>& b) {
  float most = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b.at(i)));
  return most;
}

}  // namespace

ModelHandle handle_of(const StyleModel& model) {
  const std::string bytes = format_style_model(model);
  strut_model* handle = nullptr;
  require_ok(strut_model_load_memory(bytes.data(), bytes.size(), nullptr, &handle));
  return ModelHandle(handle);
}

TranslatorHandle translator_of(const std::vector<const strut_model*>& models, const strut_translator_options* options) {
  strut_translator* handle = nullptr;
  require_ok(strut_translator_create(models.data(), static_cast<std::int32_t>(models.size()), options, &handle));
  return TranslatorHandle(handle);
}

strut_axes axes_of(int convention) {
  strut_axes axes;
  require_ok(strut_axes_init(&axes, sizeof axes, convention));
  return axes;
}

Frame::Frame(const Pose& pose) : Frame(static_cast<int>(pose.rotations.size())) {
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    for (int i = 0; i < 4; ++i) rotations[4 * j + i] = static_cast<float>(pose.rotations[j].coeffs()[i]);
    for (int i = 0; i < 3; ++i) translations[3 * j + i] = static_cast<float>(pose.translations[j][i]);
  }
}

FrameDifference largest_difference(const Frame& a, const Frame& b) {
  return {largest(a.rotations, b.rotations), largest(a.translations, b.translations)};
}

}  // namespace strut::test
