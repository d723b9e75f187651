/* SPDX-License-Identifier: MIT
 * The same as the fourth example from C, as an engine embeds it: one header, one shared library, poses in the engine's
 * own axes and buffers. Reads the model the third example wrote; the frames are a puppet's, swung by sines.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <strut/c/strut.h>

#define MOST_JOINTS 128

/* How this engine keeps a joint: strut reads and writes it where it is. */
typedef struct transform {
  float position[3];
  float rotation[4]; /* x, y, z, w */
  float scale[3];
} transform;

static void require(strut_status status) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", strut_status_name(status), strut_last_error());
  exit(1);
}

/* The model's skeleton as a puppet at time `t` [s] that walks ahead: arms and legs swing against each other. */
static void pose_puppet(const strut_model* model, const strut_axes* axes, int num_joints, double t, transform* joints) {
  for (int j = 0; j < num_joints; ++j) {
    strut_joint joint;
    joint.struct_size = sizeof joint;
    require(strut_model_get_joint(model, j, axes, &joint));
    const double side = joint.part == STRUT_PART_LEFT_LEG || joint.part == STRUT_PART_RIGHT_ARM   ? 1.0
                        : joint.part == STRUT_PART_RIGHT_LEG || joint.part == STRUT_PART_LEFT_ARM ? -1.0
                                                                                                  : 0.0;
    const double half = 0.5 * side * 0.2 * sin(6.0 * t); /* of an angle about Unity's X, to the right [rad] */
    const transform posed = {{joint.offset[0], joint.offset[1], joint.offset[2]},
                             {(float)sin(half), 0.0f, 0.0f, (float)cos(half)},
                             {1.0f, 1.0f, 1.0f}};
    joints[j] = posed;
  }
  joints[0].position[2] += (float)(1.2 * t);
}

int main(int argc, char** argv) {
  /* 1. One model for all characters. */
  strut_model* model = NULL;
  strut_model_info info = {sizeof info, 0, 0.0, 0, 0, NULL};
  require(strut_model_load(argc > 1 ? argv[1] : "limp.strut", &model));
  require(strut_model_get_info(model, &info));
  if (info.num_joints > MOST_JOINTS) return 1;
  printf("strut %s: %d joints, %g frames a second\n", strut_version(), (int)info.num_joints, info.frame_rate);

  /* 2. One translator per character, in the engine's axes: here Unity's. */
  strut_axes axes;
  strut_translator_options options;
  strut_translator* translator = NULL;
  const strut_model* models[1];
  require(strut_axes_init(&axes, sizeof axes, STRUT_CONVENTION_UNITY));
  require(strut_translator_options_init(&options, sizeof options));
  options.axes = &axes;
  models[0] = model;
  require(strut_translator_create(models, 1, &options, &translator));

  /* 3. A frame in, a frame out, in place. Nothing is allocated here. */
  transform joints[MOST_JOINTS];
  const strut_const_pose in = {joints[0].rotation, joints[0].position, sizeof joints[0], sizeof joints[0],
                               info.num_joints};
  const strut_pose out = {joints[0].rotation, joints[0].position, sizeof joints[0], sizeof joints[0], info.num_joints};
  for (int t = 0; t < 150; ++t) {
    double share = 0.0;
    pose_puppet(model, &axes, info.num_joints, t / info.frame_rate, joints);
    const strut_status status = strut_translator_push(translator, &in, &out);
    require(status);
    if (status == STRUT_NO_OUTPUT || t % 30 != 0) continue; /* there is none yet where feet are held */
    require(strut_translator_get_input_share(translator, &share));
    printf("frame %3d: root at %.3f %.3f %.3f, %.0f %% of it as it came\n", t, joints[0].position[0],
           joints[0].position[1], joints[0].position[2], 100.0 * share);
  }

  strut_translator_free(translator);
  strut_model_release(model);
  return 0;
}
