// SPDX-License-Identifier: MIT
// Any bytes as a style model: they are read or refused with a ParseError or a VersionError, nothing else. What was read
// is written again, must read as the same bytes, and steps without harm.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <strut/core/error.h>
#include <strut/model/model_step.h>
#include <strut/model/style_model_io.h>

namespace {

constexpr int kSteps = 3;

void require(bool holds) {
  if (!holds) std::abort();
}

void step(const std::shared_ptr<const strut::StyleModel>& model) {
  strut::ModelStep<double> translator(model);
  const Eigen::RowVectorXd input = Eigen::RowVectorXd::Ones(model->num_dofs());
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  for (int t = 0; t < kSteps; ++t) translator.step(input, output);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::shared_ptr<const strut::StyleModel> model;
  try {
    model = strut::parse_style_model({reinterpret_cast<const char*>(bytes), size}, "fuzz");
  } catch (const strut::ParseError&) {
    return 0;
  } catch (const strut::VersionError&) {
    return 0;
  }
  const std::string text = strut::format_style_model(*model);
  require(strut::format_style_model(*strut::parse_style_model(text, "again")) == text);
  step(model);
  return 0;
}
