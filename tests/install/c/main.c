/* SPDX-License-Identifier: MIT
 * Asks the C interface its version, converts a pose and reads a model file that is not there.
 */
#include <stdio.h>
#include <string.h>

#include <strut/c/strut.h>

int main(void) {
  float rotation[4] = {0.0f, 0.6f, 0.0f, 0.8f};
  float translation[3] = {1.0f, 2.0f, 3.0f};
  const strut_const_pose in = {rotation, translation, 0, 0, 1};
  const strut_pose out = {rotation, translation, 0, 0, 1};
  strut_axes unity;
  strut_model* model = NULL;
  if (strut_abi_version() != STRUT_ABI_VERSION) return 1;
  if (strut_axes_init(&unity, sizeof unity, STRUT_CONVENTION_UNITY) != STRUT_OK) return 1;
  if (strut_convert_pose(&in, NULL, &out, &unity) != STRUT_OK || rotation[1] != -0.6f || translation[0] != -1.0f) {
    return 1;
  }
  if (strut_model_load("there/is/no.strut", &model) != STRUT_CANNOT_READ || model != NULL) return 1;
  printf("strut %s: %s\n", strut_version(), strut_last_error());
  return strstr(strut_last_error(), "there/is/no.strut") != NULL ? 0 : 1;
}
