/* SPDX-License-Identifier: MIT
 * The C interface as a program in C99 sees it, through the shared library: interface FOLDER uses the models that
 * make_models wrote there, calls every function, and provokes every status but the two that only a fault can bring.
 * Says what did not hold and fails.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <strut/c/strut.h>

#define NUM_JOINTS 6
#define NUM_FRAMES 40

static int num_faults = 0;
static const char* folder = ".";

static void check(int holds, const char* what, int line) {
  if (holds) return;
  ++num_faults;
  fprintf(stderr, "line %d: does not hold: %s (last error: %s)\n", line, what, strut_last_error());
}

#define CHECK(condition) check((condition), #condition, __LINE__)
/* A call that must fail with a status, and say `word`. */
#define REFUSED(call, status, word) \
  check((call) == (status) && strstr(strut_last_error(), (word)) != NULL, #call " is refused: " word, __LINE__)

typedef struct frame {
  float rotations[4 * NUM_JOINTS];
  float translations[3 * NUM_JOINTS];
} frame;

static strut_const_pose readable(const frame* f) {
  strut_const_pose pose = {NULL, NULL, 0, 0, NUM_JOINTS};
  pose.rotations = f->rotations;
  pose.translations = f->translations;
  return pose;
}

static strut_pose writable(frame* f) {
  strut_pose pose = {NULL, NULL, 0, 0, NUM_JOINTS};
  pose.rotations = f->rotations;
  pose.translations = f->translations;
  return pose;
}

/* A body that goes forward while its joints swing. */
static frame walking(int t) {
  frame f;
  memset(&f, 0, sizeof f);
  for (int j = 0; j < NUM_JOINTS; ++j) {
    const float angle = 0.2f * sinf(0.3f * (float)t + (float)j);
    f.rotations[4 * j] = sinf(0.5f * angle);
    f.rotations[4 * j + 3] = cosf(0.5f * angle);
    f.translations[3 * j + 1] = j == 1 ? 0.9f : 0.3f;
  }
  f.translations[5] = 0.04f * (float)t;
  return f;
}

static int is_sound(const frame* f) {
  for (int j = 0; j < NUM_JOINTS; ++j) {
    const float* q = f->rotations + 4 * j;
    const float length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(fabsf(length - 1.0f) < 1e-4f)) return 0;
    for (int i = 0; i < 3; ++i) {
      if (!isfinite(f->translations[3 * j + i])) return 0;
    }
  }
  return 1;
}

static const char* file(const char* name) {
  static char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static strut_model* load(const char* name) {
  strut_model* model = NULL;
  CHECK(strut_model_load(file(name), &model) == STRUT_OK && model != NULL);
  return model;
}

static void check_versions(void) {
  CHECK(strut_abi_version() == STRUT_ABI_VERSION);
  CHECK(strchr(strut_version(), '.') != NULL);
  CHECK(strcmp(strut_last_error(), "") == 0);
  CHECK(strcmp(strut_status_name(STRUT_OK), "STRUT_OK") == 0);
  CHECK(strcmp(strut_status_name(STRUT_SKELETON_MISMATCH), "STRUT_SKELETON_MISMATCH") == 0);
  CHECK(strcmp(strut_status_name(77), "unknown status") == 0);
}

static void check_loading(void) {
  strut_model* model = (strut_model*)&num_faults;
  REFUSED(strut_model_load(file("missing.strut"), &model), STRUT_CANNOT_READ, "missing.strut");
  CHECK(model == NULL);
  REFUSED(strut_model_load(file("cut.strut"), &model), STRUT_BAD_FILE, "cut.strut");
  REFUSED(strut_model_load(file("newer.strut"), &model), STRUT_UNSUPPORTED_VERSION, "version 99");
  REFUSED(strut_model_load(NULL, &model), STRUT_INVALID_ARGUMENT, "path");
  REFUSED(strut_model_load(file("radial.strut"), NULL), STRUT_INVALID_ARGUMENT, "model");
  REFUSED(strut_model_load_memory("nonsense", 8, "made-up", &model), STRUT_BAD_FILE, "made-up");
  REFUSED(strut_model_load_memory("", 0, NULL, &model), STRUT_BAD_FILE, "model");
  REFUSED(strut_model_load_memory(NULL, 0, NULL, &model), STRUT_INVALID_ARGUMENT, "bytes");
  REFUSED(strut_model_load_memory("", 0, NULL, NULL), STRUT_INVALID_ARGUMENT, "model");
  CHECK(model == NULL);
}

static void check_memory(void) {
  static char bytes[1 << 20];
  strut_model* model = NULL;
  FILE* stream = fopen(file("radial.strut"), "rb");
  CHECK(stream != NULL);
  if (stream == NULL) return;
  /* From an odd address: the bytes need no alignment. */
  const size_t size = fread(bytes + 1, 1, sizeof bytes - 1, stream);
  fclose(stream);
  CHECK(strut_model_load_memory(bytes + 1, size, NULL, &model) == STRUT_OK);
  memset(bytes, 0, sizeof bytes);
  strut_model_info info;
  info.struct_size = sizeof info;
  CHECK(strut_model_get_info(model, &info) == STRUT_OK && info.num_joints == NUM_JOINTS);
  strut_model_release(model);
}

static void check_facts(const strut_model* radial, const strut_model* linear) {
  strut_model_info info;
  info.struct_size = sizeof info;
  CHECK(strut_model_get_info(radial, &info) == STRUT_OK);
  CHECK(info.num_joints == NUM_JOINTS && info.frame_rate == 30.0 && info.method == STRUT_METHOD_RADIAL);
  CHECK(info.num_dofs > 0 && strcmp(info.provenance, "{\"made\": \"by hand\"}") == 0);
  CHECK(strut_model_get_info(linear, &info) == STRUT_OK && info.method == STRUT_METHOD_LINEAR);
  REFUSED(strut_model_get_info(NULL, &info), STRUT_INVALID_ARGUMENT, "model");
  REFUSED(strut_model_get_info(radial, NULL), STRUT_INVALID_ARGUMENT, "info");
  info.struct_size = 0;
  REFUSED(strut_model_get_info(radial, &info), STRUT_INVALID_ARGUMENT, "struct_size");
}

static void check_joints(const strut_model* model) {
  strut_joint joint;
  joint.struct_size = sizeof joint;
  CHECK(strut_model_get_joint(model, 5, NULL, &joint) == STRUT_OK);
  CHECK(joint.parent == 4 && strcmp(joint.name, "head") == 0 && joint.part >= 0 && joint.part < STRUT_NUM_PARTS);
  CHECK(fabsf(joint.offset[1] - 0.3f) < 1e-6f && joint.offset[0] == 0.0f && joint.offset[2] == 0.0f);
  strut_axes unreal;
  CHECK(strut_axes_init(&unreal, sizeof unreal, STRUT_CONVENTION_UNREAL) == STRUT_OK);
  CHECK(strut_model_get_joint(model, 5, &unreal, &joint) == STRUT_OK && fabsf(joint.offset[2] - 30.0f) < 1e-4f);
  REFUSED(strut_model_get_joint(model, 6, NULL, &joint), STRUT_INVALID_ARGUMENT, "index");
  REFUSED(strut_model_get_joint(model, -1, NULL, &joint), STRUT_INVALID_ARGUMENT, "index");
  REFUSED(strut_model_get_joint(model, 0, NULL, NULL), STRUT_INVALID_ARGUMENT, "joint");
  REFUSED(strut_model_get_joint(NULL, 0, NULL, &joint), STRUT_INVALID_ARGUMENT, "model");
  unreal.up = unreal.forward;
  REFUSED(strut_model_get_joint(model, 0, &unreal, &joint), STRUT_INVALID_ARGUMENT, "axes");
}

static void check_skeletons(const strut_model* model) {
  const char* names[NUM_JOINTS] = {"root", "pelvis", "left", "right", "spine", "head"};
  int32_t parents[NUM_JOINTS] = {-1, 0, 1, 1, 1, 4};
  CHECK(strut_model_check_skeleton(model, names, parents, NUM_JOINTS) == STRUT_OK);
  REFUSED(strut_model_check_skeleton(model, names, parents, NUM_JOINTS - 1), STRUT_SKELETON_MISMATCH, "head");
  REFUSED(strut_model_check_skeleton(model, names, parents, 0), STRUT_INVALID_ARGUMENT, "num_joints");
  REFUSED(strut_model_check_skeleton(model, NULL, parents, NUM_JOINTS), STRUT_INVALID_ARGUMENT, "names");
  REFUSED(strut_model_check_skeleton(model, names, NULL, NUM_JOINTS), STRUT_INVALID_ARGUMENT, "parents");
  REFUSED(strut_model_check_skeleton(NULL, names, parents, NUM_JOINTS), STRUT_INVALID_ARGUMENT, "model");
  parents[5] = 7;
  REFUSED(strut_model_check_skeleton(model, names, parents, NUM_JOINTS), STRUT_INVALID_ARGUMENT, "parent");
  names[5] = NULL;
  REFUSED(strut_model_check_skeleton(model, names, parents, NUM_JOINTS), STRUT_INVALID_ARGUMENT, "names");
}

static void check_creation(const strut_model* radial, const strut_model* renamed) {
  strut_translator* translator = NULL;
  const strut_model* both[2];
  both[0] = radial;
  both[1] = renamed;
  REFUSED(strut_translator_create(both, 2, NULL, &translator), STRUT_SKELETON_MISMATCH, "tail");
  CHECK(translator == NULL);
  REFUSED(strut_translator_create(both, 0, NULL, &translator), STRUT_INVALID_ARGUMENT, "num_models");
  REFUSED(strut_translator_create(both, STRUT_MOST_MODELS + 1, NULL, &translator), STRUT_INVALID_ARGUMENT, "models");
  REFUSED(strut_translator_create(NULL, 1, NULL, &translator), STRUT_INVALID_ARGUMENT, "models");
  REFUSED(strut_translator_create(both, 1, NULL, NULL), STRUT_INVALID_ARGUMENT, "translator");
  strut_translator_options options;
  CHECK(strut_translator_options_init(&options, sizeof options) == STRUT_OK);
  options.confidence = 0.0;
  REFUSED(strut_translator_create(both, 1, &options, &translator), STRUT_INVALID_ARGUMENT, "confidence");
  CHECK(strut_translator_options_init(&options, sizeof options) == STRUT_OK);
  options.generalize = 2;
  REFUSED(strut_translator_create(both, 1, &options, &translator), STRUT_INVALID_ARGUMENT, "generalize");
  CHECK(strut_translator_options_init(&options, sizeof options) == STRUT_OK && options.feet == NULL);
  strut_feet feet;
  CHECK(strut_feet_init(&feet, sizeof feet) == STRUT_OK && feet.look_ahead > 0.0);
  options.feet = &feet;
  REFUSED(strut_translator_create(both, 1, &options, &translator), STRUT_INVALID_ARGUMENT, "feet");
  REFUSED(strut_feet_init(NULL, sizeof feet), STRUT_INVALID_ARGUMENT, "feet");
  both[0] = NULL;
  REFUSED(strut_translator_create(both, 1, NULL, &translator), STRUT_INVALID_ARGUMENT, "models");
  REFUSED(strut_translator_options_init(NULL, sizeof options), STRUT_INVALID_ARGUMENT, "options");
  REFUSED(strut_translator_options_init(&options, 2), STRUT_INVALID_ARGUMENT, "struct_size");
}

static void check_refused_frames(strut_translator* translator) {
  frame in = walking(0), out;
  strut_const_pose from = readable(&in);
  strut_pose to = writable(&out);
  REFUSED(strut_translator_push(NULL, &from, &to), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_push(translator, NULL, &to), STRUT_INVALID_ARGUMENT, "input");
  REFUSED(strut_translator_push(translator, &from, NULL), STRUT_INVALID_ARGUMENT, "output");
  from.num_joints = 5;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "6 joints");
  from = readable(&in);
  to.num_joints = 7;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "6 joints");
  to = writable(&out);
  to.rotations = NULL;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "output");
  to = writable(&out);
  from.rotation_stride = 12;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "strides");
  from = readable(&in);
  in.translations[4] = NAN;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "joint 1");
  in = walking(0);
  in.rotations[8] = 1.0f;
  REFUSED(strut_translator_push(translator, &from, &to), STRUT_INVALID_ARGUMENT, "joint 2");
}

static void check_controls(strut_translator* translator) {
  strut_controls controls;
  CHECK(strut_controls_init(&controls, sizeof controls) == STRUT_OK && controls.strength == 1.0);
  controls.strength = 0.25;
  controls.parts[STRUT_PART_HEAD] = 1.5;
  CHECK(strut_translator_set_controls(translator, &controls) == STRUT_OK);
  strut_controls now;
  now.struct_size = sizeof now;
  CHECK(strut_translator_get_controls(translator, &now) == STRUT_OK);
  CHECK(now.strength == 0.25 && now.parts[STRUT_PART_HEAD] == 1.5 && now.num_weights == 1 && now.weights[0] == 1.0);
  controls.strength = 1.6;
  REFUSED(strut_translator_set_controls(translator, &controls), STRUT_INVALID_ARGUMENT, "strength");
  controls.strength = NAN;
  REFUSED(strut_translator_set_controls(translator, &controls), STRUT_INVALID_ARGUMENT, "strength");
  CHECK(strut_translator_get_controls(translator, &now) == STRUT_OK && now.strength == 0.25);
  controls.strength = 1.0;
  controls.num_weights = 2;
  REFUSED(strut_translator_set_controls(translator, &controls), STRUT_INVALID_ARGUMENT, "num_weights");
  REFUSED(strut_translator_set_controls(translator, NULL), STRUT_INVALID_ARGUMENT, "controls");
  REFUSED(strut_translator_set_controls(NULL, &controls), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_get_controls(translator, NULL), STRUT_INVALID_ARGUMENT, "controls");
  REFUSED(strut_translator_get_controls(NULL, &now), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_controls_init(NULL, sizeof controls), STRUT_INVALID_ARGUMENT, "controls");
}

static void check_nulls_of_queries(strut_translator* translator) {
  double number = 0.0;
  int32_t frames = 0;
  frame out;
  const strut_pose to = writable(&out);
  REFUSED(strut_translator_get_latency(NULL, &frames), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_get_latency(translator, NULL), STRUT_INVALID_ARGUMENT, "frames");
  REFUSED(strut_translator_get_time_warp(NULL, &number), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_get_time_warp(translator, NULL), STRUT_INVALID_ARGUMENT, "frames");
  REFUSED(strut_translator_get_input_share(NULL, &number), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_get_input_share(translator, NULL), STRUT_INVALID_ARGUMENT, "share");
  REFUSED(strut_translator_flush(NULL, &to), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_translator_flush(translator, NULL), STRUT_INVALID_ARGUMENT, "output");
  REFUSED(strut_translator_reset(NULL), STRUT_INVALID_ARGUMENT, "translator");
  strut_translator_free(NULL);
  strut_snapshot_free(NULL);
  strut_model_release(NULL);
  REFUSED(strut_model_retain(NULL), STRUT_INVALID_ARGUMENT, "model");
}

/* Pushes the frames [begin, NUM_FRAMES), the last of which `out` holds afterwards. */
static void stream(strut_translator* translator, int begin, frame* out) {
  for (int t = begin; t < NUM_FRAMES; ++t) {
    const frame in = walking(t);
    const strut_const_pose from = readable(&in);
    const strut_pose to = writable(out);
    CHECK(strut_translator_push(translator, &from, &to) == STRUT_OK && is_sound(out));
  }
}

static void check_stream(strut_translator* translator) {
  frame first, second;
  double number = 0.0;
  int32_t frames = -1;
  CHECK(strut_translator_get_time_warp(translator, &number) == STRUT_OK && number == 1.0);
  stream(translator, 0, &first);
  CHECK(strut_translator_get_time_warp(translator, &number) == STRUT_OK && number > 0.0);
  CHECK(strut_translator_get_input_share(translator, &number) == STRUT_OK && number >= 0.0 && number <= 1.0);
  CHECK(strut_translator_get_latency(translator, &frames) == STRUT_OK && frames == 0);
  strut_pose to = writable(&second);
  CHECK(strut_translator_flush(translator, &to) == STRUT_NO_OUTPUT);
  to.num_joints = 3;
  REFUSED(strut_translator_flush(translator, &to), STRUT_INVALID_ARGUMENT, "6 joints");
  CHECK(strut_translator_reset(translator) == STRUT_OK);
  stream(translator, 0, &second);
  CHECK(memcmp(&first, &second, sizeof first) == 0);
}

static void check_snapshots(strut_translator* translator, strut_translator* of_other_model) {
  strut_snapshot* snapshot = NULL;
  frame first, second;
  CHECK(strut_translator_reset(translator) == STRUT_OK);
  CHECK(strut_snapshot_create(translator, &snapshot) == STRUT_OK && snapshot != NULL);
  stream(translator, 0, &first);
  CHECK(strut_translator_restore(translator, snapshot) == STRUT_OK);
  stream(translator, 0, &second);
  CHECK(memcmp(&first, &second, sizeof first) == 0);
  CHECK(strut_snapshot_save(snapshot, translator) == STRUT_OK);
  stream(translator, NUM_FRAMES - 1, &first);
  CHECK(strut_translator_restore(translator, snapshot) == STRUT_OK);
  stream(translator, NUM_FRAMES - 1, &second);
  CHECK(memcmp(&first, &second, sizeof first) == 0);
  REFUSED(strut_translator_restore(of_other_model, snapshot), STRUT_INVALID_ARGUMENT, "snapshot");
  REFUSED(strut_snapshot_save(snapshot, of_other_model), STRUT_INVALID_ARGUMENT, "snapshot");
  REFUSED(strut_translator_restore(translator, NULL), STRUT_INVALID_ARGUMENT, "snapshot");
  REFUSED(strut_translator_restore(NULL, snapshot), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_snapshot_save(NULL, translator), STRUT_INVALID_ARGUMENT, "snapshot");
  REFUSED(strut_snapshot_save(snapshot, NULL), STRUT_INVALID_ARGUMENT, "translator");
  REFUSED(strut_snapshot_create(translator, NULL), STRUT_INVALID_ARGUMENT, "snapshot");
  strut_snapshot_free(snapshot);
  REFUSED(strut_snapshot_create(NULL, &snapshot), STRUT_INVALID_ARGUMENT, "translator");
  CHECK(snapshot == NULL);
}

static void check_axes(void) {
  strut_axes axes;
  frame in = walking(3), out;
  strut_const_pose from = readable(&in);
  strut_pose to = writable(&out);
  REFUSED(strut_axes_init(NULL, sizeof axes, STRUT_CONVENTION_UNITY), STRUT_INVALID_ARGUMENT, "axes");
  REFUSED(strut_axes_init(&axes, sizeof axes, 5), STRUT_INVALID_ARGUMENT, "convention");
  CHECK(strut_axes_init(&axes, sizeof axes, STRUT_CONVENTION_UNITY) == STRUT_OK);
  CHECK(strut_convert_pose(&from, NULL, &to, &axes) == STRUT_OK);
  CHECK(out.rotations[0] == in.rotations[0] && out.translations[5] == in.translations[5]);
  REFUSED(strut_convert_pose(NULL, NULL, &to, &axes), STRUT_INVALID_ARGUMENT, "input");
  REFUSED(strut_convert_pose(&from, NULL, NULL, &axes), STRUT_INVALID_ARGUMENT, "output");
  axes.quaternion_order = 2;
  REFUSED(strut_convert_pose(&from, &axes, &to, NULL), STRUT_INVALID_ARGUMENT, "quaternion_order");
  axes.quaternion_order = 0;
  axes.metres_per_unit = 0.0f;
  REFUSED(strut_convert_pose(&from, &axes, &to, NULL), STRUT_INVALID_ARGUMENT, "metres_per_unit");
  axes.metres_per_unit = 1.0f;
  axes.right = 0;
  REFUSED(strut_convert_pose(&from, &axes, &to, NULL), STRUT_INVALID_ARGUMENT, "right");
  to.num_joints = 1;
  REFUSED(strut_convert_pose(&from, NULL, &to, NULL), STRUT_INVALID_ARGUMENT, "6 joints");
}

int main(int argc, char** argv) {
  if (argc == 2) folder = argv[1];
  check_versions();
  check_loading();
  check_memory();
  check_axes();
  strut_model* radial = load("radial.strut");
  strut_model* linear = load("linear.strut");
  strut_model* renamed = load("renamed.strut");
  check_facts(radial, linear);
  check_joints(radial);
  check_skeletons(radial);
  check_creation(radial, renamed);
  const strut_model* const models[2] = {radial, linear};
  strut_translator* translator = NULL;
  strut_translator* other = NULL;
  CHECK(strut_translator_create(models, 1, NULL, &translator) == STRUT_OK);
  CHECK(strut_translator_create(models + 1, 1, NULL, &other) == STRUT_OK);
  CHECK(strut_model_retain(radial) == STRUT_OK);
  strut_model_release(radial);
  strut_model_release(radial); /* the translators go on without the handles */
  strut_model_release(linear);
  strut_model_release(renamed);
  check_refused_frames(translator);
  check_stream(translator);
  check_stream(other);
  check_controls(translator);
  check_snapshots(translator, other);
  check_nulls_of_queries(translator);
  strut_translator_free(translator);
  strut_translator_free(other);
  if (num_faults > 0) fprintf(stderr, "%d faults\n", num_faults);
  return num_faults == 0 ? 0 : 1;
}
