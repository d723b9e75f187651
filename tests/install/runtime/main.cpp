// SPDX-License-Identifier: MIT
// Steps a linear system and reads a model file that is not there: touches the runtime from its model file down.
#include <cstdio>

#include <strut/core/error.h>
#include <strut/model/style_model_io.h>
#include <strut/sysid/lti_system.h>
#include <strut/translate/translator.h>

int main() {
  const Eigen::MatrixXd half = Eigen::MatrixXd::Constant(1, 1, 0.5);
  const strut::sysid::LtiSystem system(half, half, half, half);
  const strut::FrameMatrix response = strut::sysid::simulate(system, strut::FrameMatrix::Ones(3, 1));
  if (response(0, 0) != 0.5 || response(1, 0) != 0.75) return 1;
  try {
    strut::read_style_model("there/is/no.strut");
  } catch (const strut::FileError& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  return 1;
}
