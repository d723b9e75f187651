// SPDX-License-Identifier: MIT
// Any bytes as an effort model: they are read or refused with a ParseError or a VersionError, nothing else. What was
// read is written again, must read as the same bytes, and chooses a blend or refuses to.
#include <cstdint>
#include <cstdlib>
#include <string>

#include <strut/core/error.h>
#include <strut/effort/blend_choice.h>
#include <strut/effort/effort_model_io.h>

namespace {

using namespace strut;

void require(bool holds) {
  if (!holds) std::abort();
}

void choose(const std::shared_ptr<const effort::EffortModel>& model) {
  effort::ChoiceOptions options;
  options.num_candidates = 2;
  try {
    const effort::BlendChooser chooser(model);
    (void)chooser.choose(0, {0.2, effort::kNotRated, -0.4}, options);
  } catch (const Error&) {
    // nothing there can be blended
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::shared_ptr<const effort::EffortModel> model;
  try {
    model = effort::parse_effort_model({reinterpret_cast<const char*>(bytes), size}, "fuzz");
  } catch (const ParseError&) {
    return 0;
  } catch (const VersionError&) {
    return 0;
  }
  const std::string text = effort::format_effort_model(*model);
  require(effort::format_effort_model(*effort::parse_effort_model(text, "again")) == text);
  choose(model);
  return 0;
}
