// SPDX-License-Identifier: MIT
// Any bytes as a gait model: they are read or refused with a ParseError or a VersionError, nothing else. What was read
// is written again, must read as the same bytes, and walks or refuses to.
#include <cstdint>
#include <cstdlib>
#include <string>

#include <strut/blend/gait_model_io.h>
#include <strut/blend/locomotion.h>
#include <strut/core/error.h>

namespace {

using namespace strut;

constexpr int kFrames = 3;

void require(bool holds) {
  if (!holds) std::abort();
}

/// All styles in equal parts, at a speed that the first one's examples have.
void walk(const std::shared_ptr<const blend::GaitModel>& model) {
  const auto styles = static_cast<Eigen::Index>(model->styles().size());
  blend::GaitControls controls;
  controls.weights = Eigen::VectorXd::Constant(styles, 1.0 / static_cast<double>(styles));
  controls.speed = model->styles().front().typical;
  try {
    blend::Walker walker(model, 30.0);
    for (int t = 0; t < kFrames; ++t) walker.next(controls);
  } catch (const InvalidArgument&) {
    // no gait at this speed
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::shared_ptr<const blend::GaitModel> model;
  try {
    model = blend::parse_gait_model({reinterpret_cast<const char*>(bytes), size}, "fuzz");
  } catch (const ParseError&) {
    return 0;
  } catch (const VersionError&) {
    return 0;
  }
  const std::string text = blend::format_gait_model(*model);
  require(blend::format_gait_model(*blend::parse_gait_model(text, "again")) == text);
  walk(model);
  return 0;
}
