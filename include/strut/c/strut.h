/* SPDX-License-Identifier: MIT
 * The C interface of strut's runtime: load a learnt style, push a pose per frame, get it back in the style.
 * C99, one header, one library (libstrut); docs/c_interface.md is its guide.
 *
 * STATUS. Nearly every function returns a status and gives its result by a last argument, which it leaves alone, or
 * sets to NULL if it is a handle, where it fails. No exception leaves this library, and it never prints or ends the
 * process. A NULL argument is refused with STRUT_INVALID_ARGUMENT unless the function says what it means.
 * strut_last_error() says in words what went wrong.
 *
 * STRUCTS. The first field of a struct that may grow is struct_size; the caller sets it to sizeof(the struct), or has
 * an _init function do that. A library that knows more fields than the caller takes defaults for what lies beyond
 * struct_size; one that knows fewer refuses a struct whose unknown rest is not zero. Fields of results that the library
 * does not know are set to zero.
 *
 * THREADS. A model never changes: any number of threads may read, retain and release it at once. A translator or a
 * snapshot belongs to one thread at a time; different ones never wait for each other, whatever they share. A function
 * that takes two handles uses both. strut_last_error() is per thread. There are no locks and no global state.
 *
 * MEMORY. Buffers of poses are the caller's. What each function allocates it says; those called per frame allocate
 * nothing unless they fail.
 */
#ifndef STRUT_C_STRUT_H
#define STRUT_C_STRUT_H

#include <stddef.h>
#include <stdint.h>

#if defined(STRUT_C_BUILDING) && defined(_WIN32)
#define STRUT_C_API __declspec(dllexport)
#elif defined(STRUT_C_BUILDING)
#define STRUT_C_API __attribute__((visibility("default")))
#elif defined(_WIN32) && !defined(STRUT_C_STATIC)
#define STRUT_C_API __declspec(dllimport)
#else
#define STRUT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions ---------------------------------------------------------------------------------------------------- */

/** The version of the binary interface described here. It rises when programs must be compiled anew; new functions and
 *  new fields at the end of structs leave it as it is. */
#define STRUT_ABI_VERSION 1

/** The STRUT_ABI_VERSION of the library in use: compare it with the macro when the library is loaded by hand. */
STRUT_C_API uint32_t strut_abi_version(void);

/** The version of the library in use, "major.minor.patch". Never NULL; lives as long as the library. */
STRUT_C_API const char* strut_version(void);

/* ---- Status ------------------------------------------------------------------------------------------------------ */

/** What became of a call. Negative: it failed and, where it does not say otherwise, changed nothing. */
typedef enum strut_status {
  STRUT_OK = 0,
  STRUT_NO_OUTPUT = 1,            /**< the call worked, but gave no frame: not yet (push), or no more (flush) */
  STRUT_INVALID_ARGUMENT = -1,    /**< NULL, out of range, of the wrong size, not finite, not of unit length */
  STRUT_CANNOT_READ = -2,         /**< the file is missing, or the system does not let it be read */
  STRUT_BAD_FILE = -3,            /**< the bytes are not an intact style model */
  STRUT_UNSUPPORTED_VERSION = -4, /**< the model file is of a format that this library does not read */
  STRUT_SKELETON_MISMATCH = -5,   /**< joints or hierarchy are not the model's */
  STRUT_OUT_OF_MEMORY = -6,
  STRUT_INTERNAL_ERROR = -7 /**< a fault of strut: please report it, with strut_last_error() */
} strut_status;

/** The status' name, "STRUT_OK", ...; "unknown status" for any other number. Never NULL, never fails. */
STRUT_C_API const char* strut_status_name(int status);

/** What went wrong in this thread's latest call that failed: one line, UTF-8, at most 511 bytes, "" if none failed yet.
 *  Calls that work leave it as it is. Never NULL; valid until the next failing call in this thread. */
STRUT_C_API const char* strut_last_error(void);

/* ---- Axes and units ---------------------------------------------------------------------------------------------- */

/** Signed axes of a coordinate system. */
enum {
  STRUT_AXIS_POSITIVE_X = 1,
  STRUT_AXIS_POSITIVE_Y = 2,
  STRUT_AXIS_POSITIVE_Z = 3,
  STRUT_AXIS_NEGATIVE_X = -1,
  STRUT_AXIS_NEGATIVE_Y = -2,
  STRUT_AXIS_NEGATIVE_Z = -3
};

/** In which order the four numbers of a quaternion come. */
enum { STRUT_QUATERNION_XYZW = 0, STRUT_QUATERNION_WXYZ = 1 };

/** Conventions of well-known systems; all have quaternions x, y, z, w. */
enum {
  STRUT_CONVENTION_STRUT = 0,  /**< strut's own: right-handed, Y up, +Z forward, metres */
  STRUT_CONVENTION_GLTF = 1,   /**< the same */
  STRUT_CONVENTION_UNITY = 2,  /**< left-handed, Y up, +Z forward, metres */
  STRUT_CONVENTION_UNREAL = 3, /**< left-handed, Z up, +X forward, centimetres */
  STRUT_CONVENTION_BLENDER = 4 /**< right-handed, Z up, -Y forward, metres (its files keep quaternions w, x, y, z) */
};

/** How an engine writes poses. Handedness follows from the three axes. Every joint's transform is taken to be written
 *  along these axes, as it is when a whole skeleton is brought from one convention to another. */
typedef struct strut_axes {
  uint32_t struct_size;
  int32_t right;            /**< which axis points to a character's right, STRUT_AXIS_... */
  int32_t up;               /**< which points up, */
  int32_t forward;          /**< and which to where a character looks; the three differ */
  int32_t quaternion_order; /**< STRUT_QUATERNION_... */
  float metres_per_unit;    /**< [m], 1e-6 to 1e6: 0.01 for centimetres */
} strut_axes;

/** Fills `axes`, of `struct_size` bytes, with a convention (STRUT_CONVENTION_...), to be changed where it differs. */
STRUT_C_API strut_status strut_axes_init(strut_axes* axes, size_t struct_size, int32_t convention);

/* ---- Poses ------------------------------------------------------------------------------------------------------- */

/** One frame to be read, kept wherever the caller keeps it: every joint's transform in its parent's frame (the root's:
 *  in the world). Strides let joints lie inside larger structs. This struct never grows. */
typedef struct strut_const_pose {
  const float* rotations;    /**< of joint 0: a unit quaternion (4 numbers) */
  const float* translations; /**< of joint 0 (3 numbers) */
  size_t rotation_stride;    /**< from joint to joint [bytes], 16 or more, a multiple of 4; 0: 16 */
  size_t translation_stride; /**< the same for translations, 12 or more; 0: 12 */
  int32_t num_joints;
} strut_const_pose;

/** One frame to be written. This struct never grows. */
typedef struct strut_pose {
  float* rotations;
  float* translations;
  size_t rotation_stride;
  size_t translation_stride;
  int32_t num_joints;
} strut_pose;

/** Rewrites a pose from one convention to another (NULL: strut's own). `output` may be `input`; they must not overlap
 *  otherwise. Numbers are not looked at: what is not finite stays so. Any number of joints, the same in both.
 *  Allocates nothing. Cost: O(joints). */
STRUT_C_API strut_status strut_convert_pose(const strut_const_pose* input, const strut_axes* from,
                                            const strut_pose* output, const strut_axes* to);

/* ---- Models ------------------------------------------------------------------------------------------------------ */

/** A learnt style. Immutable, counted by references; translators hold their own. */
typedef struct strut_model strut_model;

/** How a style was learnt. */
enum {
  STRUT_METHOD_RADIAL = 0, /**< a radial basis map */
  STRUT_METHOD_LINEAR = 1  /**< linear systems per joint */
};

/** Parts of a body: of joints, and places in strut_controls.parts. */
enum {
  STRUT_PART_TRUNK = 0,
  STRUT_PART_HEAD = 1,
  STRUT_PART_LEFT_ARM = 2,
  STRUT_PART_RIGHT_ARM = 3,
  STRUT_PART_LEFT_LEG = 4,
  STRUT_PART_RIGHT_LEG = 5,
  STRUT_NUM_PARTS = 6
};

/** Facts about a model. */
typedef struct strut_model_info {
  uint32_t struct_size;
  int32_t num_joints;
  double frame_rate;      /**< of its examples, and of the frames to be pushed [frames/s] */
  int32_t num_dofs;       /**< degrees of freedom it sees */
  int32_t method;         /**< STRUT_METHOD_... */
  const char* provenance; /**< JSON, UTF-8: files, options, figures; may be "". Lives as long as the model */
} strut_model_info;

/** A joint of a model's skeleton. */
typedef struct strut_joint {
  uint32_t struct_size;
  int32_t parent;   /**< index, less than its own; -1: the root */
  const char* name; /**< UTF-8; may be "" or repeated. Lives as long as the model */
  float offset[3];  /**< rest position in its parent's frame, in the axes asked for */
  int32_t part;     /**< of the body, STRUT_PART_... */
} strut_joint;

/** Reads a style model file (.strut). `path`: as the system's file functions take it. `*model` is to be released.
 *  Fails with STRUT_CANNOT_READ, STRUT_BAD_FILE, STRUT_UNSUPPORTED_VERSION. Cost: milliseconds; not for a frame. */
STRUT_C_API strut_status strut_model_load(const char* path, strut_model** model);

/** The same from memory, which is free to go afterwards and needs no alignment. `name`: what errors call it; NULL:
 *  "model". Anything may stand in the bytes: they are checked before they are followed. */
STRUT_C_API strut_status strut_model_load_memory(const void* bytes, size_t size, const char* name, strut_model** model);

/** Counts one more owner. Any thread. */
STRUT_C_API strut_status strut_model_retain(const strut_model* model);

/** Counts one owner less; the last one frees the model, but what translators need of it lives on. NULL does nothing.
 *  Any thread. */
STRUT_C_API void strut_model_release(const strut_model* model);

/** Fills `info`, whose struct_size is set. Any thread. */
STRUT_C_API strut_status strut_model_get_info(const strut_model* model, strut_model_info* info);

/** Fills `joint`, whose struct_size is set, with joint `index` (from 0). `axes`: what its offset is written in; NULL:
 *  strut's own. Any thread. */
STRUT_C_API strut_status strut_model_get_joint(const strut_model* model, int32_t index, const strut_axes* axes,
                                               strut_joint* joint);

/** Whether a skeleton of `num_joints` joints is the model's: names and parents (-1: the root) in the same order; bones
 *  may have other lengths. Fails with STRUT_SKELETON_MISMATCH, naming up to five joints that do not fit, or with
 *  STRUT_INVALID_ARGUMENT if the parents are no tree in which parents precede their children. Allocates. Any thread. */
STRUT_C_API strut_status strut_model_check_skeleton(const strut_model* model, const char* const* names,
                                                    const int32_t* parents, int32_t num_joints);

/* ---- Controls ---------------------------------------------------------------------------------------------------- */

/** Most models that one translator blends. */
#define STRUT_MOST_MODELS 16

/** What may be moved while a style is translated. Every factor goes from 0 (the input as it is) over 1 (the style) to
 *  1.5 (half as much again); their product is what counts, at most 1.5. */
typedef struct strut_controls {
  uint32_t struct_size;
  int32_t num_weights;               /**< numbers in weights: as many as models, or 0: equal shares */
  double strength;                   /**< of everything */
  double pose;                       /**< of how the body is held on average */
  double movement;                   /**< of how it moves about that, speed and timing included */
  double parts[STRUT_NUM_PARTS];     /**< of the joints of each part; the root goes with the trunk */
  double weights[STRUT_MOST_MODELS]; /**< share of each model, 0 or more, not all 0; only their ratios count */
} strut_controls;

/** Fills `controls`, of `struct_size` bytes, with the defaults: factors of 1, equal shares. */
STRUT_C_API strut_status strut_controls_init(strut_controls* controls, size_t struct_size);

/* ---- Translators ------------------------------------------------------------------------------------------------- */

/** A stream of frames being translated: one per character. */
typedef struct strut_translator strut_translator;

/** A translator's state, kept. */
typedef struct strut_snapshot strut_snapshot;

/** How planted feet are held (docs/footskate.md). */
typedef struct strut_feet {
  uint32_t struct_size;
  double look_ahead;     /**< latency, over which corrections are blended in and out [s], above 0 to 2, 0.3 */
  double shortest_plant; /**< shorter footplants are ignored [s], 0 to 0.5, 0.05 */
  double shortest_gap;   /**< shorter gaps in footplants are closed [s], 0 to 0.5, 0.13 */
  double max_stretch;    /**< of a leg's bones, instead of a straight knee [share], 0 to 0.1, 0.02 */
  double reach;        /**< longest leg of a held foot, unless it was longer [share of the straight], 0.5 to 1, 0.99 */
  double body_follows; /**< time in which the body is shifted after the feet it stands on [s], 0 to 10, 0.1 */
  double max_drag;     /**< a foot dragged farther is let go [leg lengths], above 0 to 1, 0.15 */
} strut_feet;

/** Fills `feet`, of `struct_size` bytes, with the defaults named above. */
STRUT_C_API strut_status strut_feet_init(strut_feet* feet, size_t struct_size);

/** What is fixed for a translator's life. */
typedef struct strut_translator_options {
  uint32_t struct_size;
  int32_t generalize;             /**< 1: input unlike the examples passes through; 0: it is translated all the same */
  double confidence;              /**< above 0: how far from the examples translation is trusted [deviations], 4 */
  double preference;              /**< above 0: how strongly doubtful input is translated, 8 */
  double fade;                    /**< reach of the smoothing of that blend over time [s], 0 or more, 0.1 */
  double glide;                   /**< reach of the smoothing of controls that are moved [s], 0 or more, 0.08 */
  const strut_controls* controls; /**< what the controls are at first; NULL: defaults. Copied */
  const strut_axes* axes;         /**< how poses are written; NULL: strut's own. Copied */
  const strut_feet* feet;         /**< how planted feet are held, at the cost of latency; NULL: they are not. Copied */
} strut_translator_options;

/** Fills `options`, of `struct_size` bytes, with the defaults named above, and NULL. */
STRUT_C_API strut_status strut_translator_options_init(strut_translator_options* options, size_t struct_size);

/** Makes a translator of one model, or of several that are blended: of one hierarchy and frame rate, 1 to
 *  STRUT_MOST_MODELS. `options`: NULL for the defaults. `*translator` is to be freed; it may outlive the models'
 *  handles. Fails with STRUT_INVALID_ARGUMENT, also if feet are to be held and a model has no footplants or its body no
 *  legs, or with STRUT_SKELETON_MISMATCH. Allocates all that its frames will need. */
STRUT_C_API strut_status strut_translator_create(const strut_model* const* models, int32_t num_models,
                                                 const strut_translator_options* options,
                                                 strut_translator** translator);

/** Frees a translator; NULL does nothing. */
STRUT_C_API void strut_translator_free(strut_translator* translator);

/** Translates the next frame: the input is the frame that just came, the output the oldest that is ready, which is
 *  strut_translator_get_latency() frames older. The first output stands where the first input stands; bones are the
 *  input's. `output` may be `input`; they must not overlap otherwise.
 *  Gives STRUT_OK, or STRUT_NO_OUTPUT while the stream has not run for its latency: then what stands in `output` is no
 *  frame. Fails with STRUT_INVALID_ARGUMENT, before anything changes,
 *  if a number of joints is not the model's, or the input has a number that is not finite, a translation of 10,000 km
 *  or a rotation that is not of unit length (within 1e-3).
 *  Allocates nothing and takes no lock (unless it fails: then it allocates its error). Cost: docs/performance.md. */
STRUT_C_API strut_status strut_translator_push(strut_translator* translator, const strut_const_pose* input,
                                               const strut_pose* output);

/** Gives a frame that is still held back when no more input will come, the oldest first: to be called until it gives
 *  STRUT_NO_OUTPUT. A push afterwards begins a new stream for the feet. Allocates nothing. */
STRUT_C_API strut_status strut_translator_flush(strut_translator* translator, const strut_pose* output);

/** By how many frames the output is behind the input: 0, or strut_feet.look_ahead where feet are held. Fixed for a
 *  translator's life. */
STRUT_C_API strut_status strut_translator_get_latency(const strut_translator* translator, int32_t* frames);

/** Forgets everything pushed; controls arrive where they were going. Allocates nothing. */
STRUT_C_API strut_status strut_translator_reset(strut_translator* translator);

/** Moves the controls: they glide there over the next frames; before the first frame they are there at once.
 *  Allocates nothing. */
STRUT_C_API strut_status strut_translator_set_controls(strut_translator* translator, const strut_controls* controls);

/** Fills `controls`, whose struct_size is set, with where the controls are going; weights are always given in full.
 *  Allocates nothing. */
STRUT_C_API strut_status strut_translator_get_controls(const strut_translator* translator, strut_controls* controls);

/** How long the latest frame that was pushed lasts in the style [frames], 1/20 to 20, for callers that re-time by
 *  themselves; 1 before any. */
STRUT_C_API strut_status strut_translator_get_time_warp(const strut_translator* translator, double* frames);

/** How much of the input was blended into the latest frame that was pushed because it is unlike the examples, 0 to 1.
 */
STRUT_C_API strut_status strut_translator_get_input_share(const strut_translator* translator, double* share);

/* ---- Snapshots --------------------------------------------------------------------------------------------------- */

/** Keeps a translator's state: what it remembers of the stream, its controls and options, but not its axes.
 *  `*snapshot` is to be freed. Allocates as much as the translator holds. */
STRUT_C_API strut_status strut_snapshot_create(const strut_translator* translator, strut_snapshot** snapshot);

/** Frees a snapshot; NULL does nothing. */
STRUT_C_API void strut_snapshot_free(strut_snapshot* snapshot);

/** Keeps a translator's state in a snapshot that there is already, made of it or of one of the same models. Fails with
 *  STRUT_INVALID_ARGUMENT if the models are others, or the latency is. Allocates nothing. */
STRUT_C_API strut_status strut_snapshot_save(strut_snapshot* snapshot, const strut_translator* translator);

/** Puts a translator back into the state that was kept; one snapshot serves any number of times, and any translator of
 *  the same models and latency; others fail with STRUT_INVALID_ARGUMENT. Allocates nothing. */
STRUT_C_API strut_status strut_translator_restore(strut_translator* translator, const strut_snapshot* snapshot);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* STRUT_C_STRUT_H */
