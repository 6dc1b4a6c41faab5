/* bdpt.h: bidirectional path tracing for programs that embed it.
 *
 * SPDX-License-Identifier: Apache-2.0
 *
 * How it goes together
 *   context ─▶ builder ─▶ scene ─┐
 *                     sensor ────┼─▶ render ─▶ advance, advance, ... ─▶ film ─▶ read, save, write
 *                       film ────┘
 *   A builder collects shapes, textures, materials, lights and instances and builds an immutable scene. A sensor says
 *   what is measured, a film holds the measurements, a render joins the three and samples them, pass by pass. One pass
 *   is one sample per measurement (per pixel, for a camera).
 *   A whole program is examples/c/hello.c, of 60 lines. bdpt.hpp is the same for C++, with handles that release
 *   themselves. docs/embedding.md tells what a program can rely on that has threads, limits and logs of its own.
 *
 * Conventions
 *   Structs    Every struct passed by pointer begins with struct_size; set it to sizeof the struct. Zero is the
 *              default of every other field, so `bdpt_film_desc d = {.struct_size = sizeof d};` is complete. A struct
 *              smaller than version 1 of it, or larger with a tail that is not zero, is refused, and is not read
 *              when its size is that of no version; structs that a call fills in are no exception: zero them.
 *   Results    Every call that can fail returns a bdpt_result: zero is success, negative is an error, positive is an
 *              outcome that is no error (BDPT_CANCELLED). Outputs are the last parameters; on failure handles are set
 *              to NULL and ids to zero. A call that fails has changed nothing. bdpt_last_error() tells the rest.
 *   Units      Lengths are the scene's own unit, one for all. Radiance W/(m² sr), intensity W/sr, with m that unit.
 *              Angles are in degrees. Colours are linear RGB, scene-referred, in the context's rendering space.
 *   Matrices   3x4, row-major: {r00 r01 r02 tx, r10 r11 r12 ty, r20 r21 r22 tz}; twelve zeros mean the identity.
 *   Images     Row 0 is the top row. Pixel (x, y) covers [x, x+1) x [y, y+1).
 *   Normals    A triangle's front is the side from which its vertices turn counter-clockwise; where vertex normals are
 *              given, the side they point to. Emission leaves the front, and the outside of a dielectric is its front.
 *   Names      After Veach (1997), chapter 10: a path of k edges is made of a light subpath of s vertices and an eye
 *              subpath of t vertices, k = s + t - 1; (s,t) is the technique that made it.
 *
 * Ownership
 *   Context, scene, sensor, film and cancel token are counted: create gives one reference, retain adds one, release
 *   takes one. Children keep their parents alive, so handles may be released in any order. Builder and render are
 *   created and destroyed. Release and destroy accept NULL.
 *   Shapes, textures, materials, lights and instances are ids inside one builder; zero is no id, and an id that was
 *   removed stays invalid for ever.
 *
 * Threads
 *   "Any thread" means safe to call at any time. "One thread per object" means that calls on one object must not
 *   overlap; calls on different objects may. Contexts share nothing.
 *
 * Callbacks
 *   A callback passed to a call runs only during this call, only on the calling thread, one at a time; the exceptions
 *   are the log, a host's material and a host's texture (any thread) and the executor's body (the host's threads). It
 *   must not throw or longjmp.
 *   It returns zero to go on; any other value stops the call, which then returns BDPT_ERROR_CALLBACK_FAILED, with the
 *   callback's value in bdpt_last_error(). Inside progress and output callbacks only the functions that say so may be
 *   called on objects in use; others return BDPT_ERROR_REENTRANT.
 *
 * Determinism
 *   The same library build, instruction sets (bdpt_context_info), scene, options, seed and pass range give the same film,
 *   bit for bit, whatever the number of threads, the executor, the block size, interruptions, or the ranges that were
 *   merged.
 */
#ifndef BDPT_H
#define BDPT_H

#include <stddef.h>
#include <stdint.h>

#if defined(BDPT_STATIC)
#define BDPT_API
#elif defined(_WIN32) && defined(BDPT_BUILDING)
#define BDPT_API __declspec(dllexport)
#elif defined(_WIN32)
#define BDPT_API __declspec(dllimport)
#elif defined(__GNUC__)
#define BDPT_API __attribute__((visibility("default")))
#else
#define BDPT_API
#endif

#if defined(__GNUC__)
#define BDPT_CHECK __attribute__((warn_unused_result))
#else
#define BDPT_CHECK
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------------------------------------------------------
 * Version, results, errors
 */

/* The ABI this header describes; pass it to bdpt_context_create. Structs and functions of one ABI only ever grow. */
#define BDPT_ABI 1u

typedef int32_t bdpt_result;
#define BDPT_OK 0                        /* success */
#define BDPT_CANCELLED 1                 /* stopped by a cancel token; finished work is kept */
#define BDPT_ERROR_INVALID_ARGUMENT (-1) /* an argument or field is NULL, out of range, not finite or unknown */
#define BDPT_ERROR_INVALID_ID (-2)       /* an id is zero, stale, or of another builder */
#define BDPT_ERROR_OUT_OF_MEMORY (-3)    /* the system has no memory left */
#define BDPT_ERROR_MEMORY_LIMIT (-4)     /* the context's memory limit would be exceeded */
#define BDPT_ERROR_UNSUPPORTED (-5)      /* not in this build, or not on this machine */
#define BDPT_ERROR_ABI (-6)              /* header and library are of different ABI versions */
#define BDPT_ERROR_IO (-7)               /* a file could not be opened, read or written */
#define BDPT_ERROR_FORMAT (-8)           /* a file is damaged or of another kind */
#define BDPT_ERROR_MISMATCH (-9)         /* two objects do not fit: other scene, options, size, or overlapping passes */
#define BDPT_ERROR_IN_USE (-10)          /* the object is still referred to by another */
#define BDPT_ERROR_REENTRANT (-11)       /* called from inside a callback that does not allow it */
#define BDPT_ERROR_CALLBACK_FAILED (-12) /* a callback of the host returned a value other than zero */
#define BDPT_ERROR_INTERNAL (-13)        /* a fault of the library: please report it */

/* The library's version, packed as 0x00MMmmpp (major, minor, patch).
 * Returns: the packed version. Threads: any thread. Callbacks: allowed. Ownership: none. */
BDPT_API uint32_t bdpt_version(void);

/* The ABI the library implements; compare with BDPT_ABI.
 * Returns: the ABI number. Threads: any thread. Callbacks: allowed. Ownership: none. */
BDPT_API uint32_t bdpt_abi_version(void);

/* The name of a result code, such as "BDPT_ERROR_IO".
 * Returns: a static string; "BDPT_ERROR_UNKNOWN" for a value that is none. Threads: any thread. Callbacks: allowed.
 * Ownership: the library's, forever valid. */
BDPT_API const char *bdpt_result_name(bdpt_result result);

/* What went wrong in the last call of this thread that failed: function, field, object and value, in one sentence.
 * Returns: a text, empty when no call failed yet; never NULL. Threads: any thread; each has its own text.
 * Callbacks: allowed. Ownership: the library's, valid until the next call into it on this thread. */
BDPT_API const char *bdpt_last_error(void);

/* ---------------------------------------------------------------------------------------------------------------
 * Context: threads, memory limit, log
 */

typedef struct bdpt_context bdpt_context;

/* The host's threads. run must call body(body_user, i) once for each i in [0, n), from any threads, at the same time
 * or one after another, and return when all calls have returned. With an executor the library starts no thread.
 * drop, if not NULL, is called once when the context is gone. */
typedef struct bdpt_executor {
  uint32_t struct_size;
  uint32_t worker_count; /* how many bodies may run at once, 1 to 4096 */
  void (*run)(void *user, uint32_t n, void (*body)(void *body_user, uint32_t i), void *body_user);
  void *user;
  void (*drop)(void *user);
} bdpt_executor;

typedef int32_t bdpt_log_level;
#define BDPT_LOG_INFO 0
#define BDPT_LOG_WARNING 1

/* Receives what is worth telling and is no error, such as triangles dropped. May be called from any thread, also at
 * the same time. drop, if not NULL, is called once when the context is gone. */
typedef struct bdpt_log {
  uint32_t struct_size;
  uint32_t reserved;
  void (*write)(void *user, bdpt_log_level level, const char *text);
  void *user;
  void (*drop)(void *user);
} bdpt_log;

typedef int32_t bdpt_isa;
#define BDPT_ISA_BEST 0 /* the widest this machine has */
#define BDPT_ISA_SSE42 1
#define BDPT_ISA_AVX2 2
#define BDPT_ISA_AVX512 3
#define BDPT_ISA_NEON 4 /* of 64-bit Arm */

typedef struct bdpt_context_desc {
  uint32_t struct_size;
  uint32_t threads;              /* threads that render, the caller's included; 0 = one per core, and never more than
                                    that; at most 4096. Not together with an executor */
  const bdpt_executor *executor; /* NULL = the library's own threads */
  const bdpt_log *log;           /* NULL = silent */
  uint64_t memory_limit;         /* bytes for scenes, films and blocks together; 0 = none */
  bdpt_isa isa;                  /* of the ray queries */
  uint32_t reserved;
  const char *color_config;      /* path of an OpenColorIO configuration; NULL = none. See Colour below */
  const char *rendering_space;   /* a linear colour space; NULL = linear Rec. 709 */
} bdpt_context_desc;

/* Creates a context. abi must be BDPT_ABI; desc may be NULL for all defaults.
 * Returns: BDPT_ERROR_ABI, _INVALID_ARGUMENT (also for a rendering space that is unknown or not linear), _UNSUPPORTED
 * (an ISA, or what BDPT_ISA asks for, is not to be had), _IO (no such configuration), _FORMAT (a damaged one), _OUT_OF_MEMORY.
 * Threads: any thread. Callbacks: allowed. Ownership: the caller gets one reference. executor and log are copied;
 * their drop is called once, also when this call fails, except with BDPT_ERROR_ABI or a struct_size of no version,
 * when the structs are not read. */
BDPT_API BDPT_CHECK bdpt_result bdpt_context_create(uint32_t abi, const bdpt_context_desc *desc, bdpt_context **context);

/* Adds a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: +1; NULL is ignored. */
BDPT_API void bdpt_context_retain(bdpt_context *context);
/* Takes a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: -1; NULL is ignored. */
BDPT_API void bdpt_context_release(bdpt_context *context);

typedef struct bdpt_context_info {
  uint32_t struct_size;
  uint32_t threads;      /* bodies that may run at once */
  bdpt_isa isa;          /* of the ray queries, never BDPT_ISA_BEST */
  uint32_t embree;       /* version of Embree, as 10000 major + 100 minor + patch */
  uint64_t memory;       /* bytes in use by scenes (Embree's included), films and blocks */
  uint64_t memory_peak;  /* the most that was in use */
  bdpt_isa code_isa;     /* of the library's own code: the widest that this machine and this build have, when the library
                            was loaded; the environment variable BDPT_ISA (baseline, avx2, avx512) asks for less. Where
                            there is no AVX2, BDPT_ISA_SSE42, though the code asks for less */
  uint32_t reserved;
} bdpt_context_info;

/* Tells what the context is made of and what it uses.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies into *info. */
BDPT_API BDPT_CHECK bdpt_result bdpt_context_get_info(const bdpt_context *context, bdpt_context_info *info);

/* ---------------------------------------------------------------------------------------------------------------
 * Colour
 *
 * A context has one rendering space: a linear RGB space, linear Rec. 709 unless another is named. All colours of
 * materials, lights and films are numbers in it; textures may name a space of their own. White is (1, 1, 1) in all.
 * Spaces have names. These need no configuration, in any case of letters; in brackets other names for them:
 *   "Linear Rec.709 (sRGB)" (lin_rec709, lin_srgb)   "sRGB - Texture" (srgb_texture, sRGB)   "ACEScg" (lin_ap1)
 *   "ACES2065-1" (lin_ap0)   "Linear Rec.2020" (lin_rec2020)   "Linear P3-D65" (lin_p3d65)   "Raw" (data): no colours,
 *   never converted.
 * A configuration adds its own, and its roles and aliases; where it has one of these names, its space is meant. The
 * standard spaces are joined to its own by its role aces_interchange, or by the first standard linear space that it has
 * by name. The environment variable OCIO is not read: pass its value, if you want it.
 */

/* CIE 1931 xy. All four are needed. */
typedef struct bdpt_chromaticities {
  float red[2], green[2], blue[2];
  float white[2]; /* of (1, 1, 1), inside the triangle of the others */
} bdpt_chromaticities;

typedef struct bdpt_color_info {
  uint32_t struct_size;
  uint32_t reserved;
  const char *rendering_space;        /* its name as it was given; the context's */
  bdpt_chromaticities chromaticities; /* of the rendering space: the published ones where it is a standard space by name
                                         or by its matrix; of any other seen at the white of D65 */
  float luminance[3];                 /* Y is their product with a colour; their sum is 1 */
  uint32_t reserved2;
} bdpt_color_info;

/* Tells what the numbers of the rendering space mean.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies into *info; the name
 * is valid as long as the context. */
BDPT_API BDPT_CHECK bdpt_result bdpt_color_get_info(const bdpt_context *context, bdpt_color_info *info);

/* Converts count colours of 3 floats, packed, in place. from and to are names of spaces; NULL = the rendering space.
 * Colours that the target's primaries cannot mix become negative in some channel: nothing is clipped. A value that is
 * not finite spoils its colour alone.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a name that is unknown, and where nothing leads from one space to the
 * other), _IO (a table of the configuration is missing), _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: writes rgb. */
BDPT_API BDPT_CHECK bdpt_result bdpt_color_convert(const bdpt_context *context, const char *from, const char *to, float *rgb, uint64_t count);

/* The same for linear RGB of any primaries, such as an OpenEXR file names; NULL = Rec. 709. White stays white
 * (Bradford); CIE XYZ themselves, red (1,0), green (0,1), blue (0,0), white (1/3,1/3), are taken as seen at D65.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for primaries on a line, or white outside of them). Threads: any thread.
 * Callbacks: allowed. Ownership: writes rgb. */
BDPT_API BDPT_CHECK bdpt_result bdpt_color_convert_chromaticities(const bdpt_chromaticities *from, const bdpt_chromaticities *to, float *rgb, uint64_t count);

/* ---------------------------------------------------------------------------------------------------------------
 * Cancel token and progress
 */

typedef struct bdpt_cancel bdpt_cancel;

/* Creates a token that stops the calls it is passed to. It may outlive everything else.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: the caller gets one reference. */
BDPT_API BDPT_CHECK bdpt_result bdpt_cancel_create(bdpt_cancel **cancel);
/* Adds a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: +1; NULL is ignored. */
BDPT_API void bdpt_cancel_retain(bdpt_cancel *cancel);
/* Takes a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: -1; NULL is ignored. */
BDPT_API void bdpt_cancel_release(bdpt_cancel *cancel);
/* Asks the calls that hold the token to stop, within one block of work per thread. One atomic store.
 * Returns: nothing. Threads: any thread, and signal handlers. Callbacks: allowed. Ownership: none; NULL is ignored. */
BDPT_API void bdpt_cancel_request(bdpt_cancel *cancel);
/* Makes the token fresh again. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: none. */
BDPT_API void bdpt_cancel_reset(bdpt_cancel *cancel);
/* Returns: 1 if a stop was asked for, else 0; 0 for NULL. Threads: any thread. Callbacks: allowed. Ownership: none. */
BDPT_API uint32_t bdpt_cancel_is_requested(const bdpt_cancel *cancel);

typedef struct bdpt_progress {
  uint32_t struct_size;
  uint32_t reserved;
  double fraction;    /* work done over work asked for, in [0,1], never falling; by a time or noise limit, an estimate */
  double seconds;     /* since the call began */
  uint64_t passes;    /* whole passes done by this call */
  uint64_t samples;   /* samples (pairs of subpaths) done by this call */
} bdpt_progress;

/* Called about ten times a second on the calling thread, once at the beginning, and once at the end of a call that
 * finishes. Zero goes on; another value stops the call. */
typedef int32_t (*bdpt_progress_fn)(void *user, const bdpt_progress *progress);

/* ---------------------------------------------------------------------------------------------------------------
 * Scene building
 */

typedef struct bdpt_builder bdpt_builder;
typedef struct bdpt_scene bdpt_scene;

typedef struct bdpt_shape_id { uint64_t id; } bdpt_shape_id;
typedef struct bdpt_texture_id { uint64_t id; } bdpt_texture_id;
typedef struct bdpt_material_id { uint64_t id; } bdpt_material_id;
typedef struct bdpt_light_id { uint64_t id; } bdpt_light_id;
typedef struct bdpt_instance_id { uint64_t id; } bdpt_instance_id;
typedef struct bdpt_medium_id { uint64_t id; } bdpt_medium_id;

/* Creates an empty builder.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: the caller destroys it; it keeps the context alive. */
BDPT_API BDPT_CHECK bdpt_result bdpt_builder_create(bdpt_context *context, bdpt_builder **builder);
/* Destroys a builder; scenes built from it live on. Returns: nothing. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: frees it; NULL is ignored. */
BDPT_API void bdpt_builder_destroy(bdpt_builder *builder);

typedef int32_t bdpt_format;
#define BDPT_FORMAT_NONE 0     /* allowed only in a view whose count is 0 */
#define BDPT_FORMAT_FLOAT2 1   /* two 32-bit floats */
#define BDPT_FORMAT_FLOAT3 2   /* three 32-bit floats */
#define BDPT_FORMAT_UINT16X3 3 /* a triangle's three indices */
#define BDPT_FORMAT_UINT32X3 4
#define BDPT_FORMAT_FLOAT4 5   /* four 32-bit floats */
#define BDPT_FORMAT_FLOAT1 6   /* one 32-bit float */
#define BDPT_FORMAT_UINT32 7   /* one 32-bit number */

typedef int32_t bdpt_ownership;
#define BDPT_OWNERSHIP_COPY 0   /* the library copies during the call */
#define BDPT_OWNERSHIP_BORROW 1 /* the data must stay, unchanged, until release is called */

/* A strided array. It never changes its size. release, if not NULL, is called exactly once for every view of a
 * call that was given one, whatever the call's result and the view's ownership: during the call if the data is
 * copied or the call fails, else on the thread that drops the last builder or scene that needs it. Calls that only look
 * at a mesh (bdpt_uv_instance) never call it. */
typedef struct bdpt_data {
  const void *data;         /* aligned to 4 bytes (2 for UINT16X3) */
  uint64_t count;           /* elements: vertices, or triangles for a mesh's indices; 0 = absent */
  uint64_t stride;          /* bytes from element to element; 0 = packed. A multiple of 4 (2 for UINT16X3) */
  bdpt_format format;
  bdpt_ownership ownership;
  uint64_t slack_bytes;     /* readable bytes behind the last element; with 16, positions and indices need no copy */
  void (*release)(void *user, const void *data);
  void *user;
} bdpt_data;

typedef struct bdpt_mesh_desc {
  uint32_t struct_size;
  uint32_t reserved;
  const char *label;   /* names the object in error texts; may be NULL; copied */
  bdpt_data positions; /* FLOAT3, required, finite */
  bdpt_data indices;   /* UINT16X3 or UINT32X3; absent = vertices 3i, 3i+1, 3i+2 */
  bdpt_data normals;   /* FLOAT3, as many as positions, of any length but zero; absent = flat */
  bdpt_data uv[2];     /* FLOAT2, as many as positions; set 0 for textures, set 1 for lightmaps */
  bdpt_data colors;    /* FLOAT3 or FLOAT4, as many as positions, [0,1], linear: multiply the reflectance of the instance's
                          material, and the fourth its opacity */
  bdpt_data tangents;  /* FLOAT4, as many as positions: where x of normal maps points, of any length but zero, and the sign
                          of y, 1 or -1: y = sign * normal x tangent. Absent = along u, triangle by triangle */
} bdpt_mesh_desc;

/* Adds a triangle mesh. Triangles without area are dropped and counted (bdpt_scene_info, and the log).
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (missing, misaligned or non-finite data, no triangle, index out of range),
 * _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: one thread per object. Callbacks: not for the builder in use.
 * Ownership: see bdpt_data. */
BDPT_API BDPT_CHECK bdpt_result bdpt_mesh_add(bdpt_builder *builder, const bdpt_mesh_desc *desc, bdpt_shape_id *shape);

typedef struct bdpt_sphere_desc {
  uint32_t struct_size;
  float radius; /* > 0 */
  const char *label;
  float center[3];
  uint32_t reserved;
} bdpt_sphere_desc;

/* Adds an exact sphere. Instances of it may be rotated, moved and scaled alike in all directions.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_sphere_add(bdpt_builder *builder, const bdpt_sphere_desc *desc, bdpt_shape_id *shape);

typedef int32_t bdpt_curve_basis;
#define BDPT_CURVE_LINEAR 0      /* cones that touch spheres round the control points. 2 points, and 1 for each further
                                    segment. Closed: a sphere at either end */
#define BDPT_CURVE_BEZIER 1      /* cubic: 4 points, and 3 for each further segment */
#define BDPT_CURVE_BSPLINE 2     /* cubic, uniform: 4 points, and 1 for each further segment */
#define BDPT_CURVE_CATMULL_ROM 3 /* cubic: 4 points, and 1 for each further segment; through all but a strand's ends */

/* Round curves, such as hair: strands along which a circle is swept, whose radius varies as the axis does. The cubic
 * ones are open at their ends, and their radius should be smaller than that of their bends. Texture coordinates of both
 * sets: u goes along the strand from 0 to 1, by its segments alike, v is 0; u is also the anisotropic direction. */
typedef struct bdpt_curves_desc {
  uint32_t struct_size;
  bdpt_curve_basis basis;
  const char *label;
  bdpt_data positions; /* FLOAT3, required, finite: the control points of one strand after the other */
  bdpt_data radii;     /* FLOAT1, required, as many as positions, or one for all: of the control points, >= 0, finite */
  bdpt_data counts;    /* UINT32: control points of each strand; absent = there is one */
} bdpt_curves_desc;

/* Adds curves, as a set: one for all hair of a head is better than one for each. Segments that have no length, or no
 * radius anywhere, are dropped and counted (bdpt_scene_info, and the log). Linear segments longer than 64 radii are cut
 * into shorter ones, which look the same. Instances may be placed and scaled in any way. Not for materials that emit,
 * refract, are an interface, or have a normal or bump map (bdpt_scene_build refuses these), nor for lightmaps and vertices.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (missing, misaligned or non-finite data, counts that do not add up or that the
 * basis does not have, no segment, radii below 0 or between which a spline swings below 0), _MEMORY_LIMIT, _OUT_OF_MEMORY.
 * Threads: one thread per object. Callbacks: not for the builder in use. Ownership: copies, borrowed data too.
 * Source: Embree's round curves; the normal with the curvature of the axis, which theirs leaves out. */
BDPT_API BDPT_CHECK bdpt_result bdpt_curves_add(bdpt_builder *builder, const bdpt_curves_desc *desc, bdpt_shape_id *shape);

typedef int32_t bdpt_boundary;
#define BDPT_BOUNDARY_SMOOTH 0      /* boundaries are smooth curves, round at their corners */
#define BDPT_BOUNDARY_PIN_CORNERS 1 /* smooth, but for corners of one face, which stay where they are */
#define BDPT_BOUNDARY_PIN 2         /* all of the boundary stays where it is */

/* Displaces `count` places of a surface: packed arrays of positions, unit normals and texture coordinates come in,
 * three, three and two floats each; displaced comes as the positions, and is what they become. Called on the calling
 * thread, for some thousands of places at a time; each is asked for once. Zero goes on; another value stops the call. */
typedef int32_t (*bdpt_displace_fn)(void *user, uint64_t count, const float *positions, const float *normals,
                                    const float *uv, float *displaced);

/* A Catmull-Clark surface. Its front is the side from which faces turn counter-clockwise. */
typedef struct bdpt_subdivision_desc {
  uint32_t struct_size;
  uint32_t level;           /* segments of each edge of a face, 1 to 64; even where a face has other than 4 corners */
  const char *label;
  bdpt_data positions;      /* FLOAT3, required, finite */
  bdpt_data face_counts;    /* UINT32: corners of each face, 3 to 15; absent = 4 each */
  bdpt_data indices;        /* UINT32, required: the position of each corner, face after face */
  bdpt_data uv;             /* FLOAT2: set 0, linear on each face; absent = none */
  bdpt_data uv_indices;     /* UINT32, as many as indices: the uv of each corner; absent = as indices */
  bdpt_data crease_edges;   /* UINT32, two positions for each edge that is a crease; each edge once */
  bdpt_data crease_weights; /* FLOAT1, one for each: so many steps of subdivision keep it sharp; infinity = all */
  bdpt_data corners;        /* UINT32: positions that are sharp; each once */
  bdpt_data corner_weights; /* FLOAT1, one for each, as of creases */
  bdpt_boundary boundary;
  uint32_t reserved;
  bdpt_displace_fn displace; /* may be NULL */
  void *user;                /* for displace */
} bdpt_subdivision_desc;

/* Adds a subdivision surface as a mesh of points of its limit, so all that meshes can do, it can: 2 level² triangles for
 * a face of 4 corners, n level² / 2 for one of n. The mesh is closed where the faces are; displacement moves what faces
 * share once, by the texture coordinates that it has on the first of them. Normals are the limit's, and those of the
 * triangles, averaged, where it is displaced; a crease of less than 2.6 degrees is smooth. Close to a sharp edge the
 * limit is exact to a thousandth of the face.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (missing, misaligned or non-finite data, positions beyond 1e16, counts that do not
 * add up, index out of range, level, an edge with more than two faces or with two that turn differently, faces that share
 * a position and no edge, more than 60 faces at a position), _CALLBACK_FAILED (also if displaced is not finite),
 * _MEMORY_LIMIT, _OUT_OF_MEMORY.
 * Threads: one thread per object. Callbacks: not for the builder in use. Ownership: copies, borrowed data too.
 * Source: Catmull and Clark (1978), by Embree. */
BDPT_API BDPT_CHECK bdpt_result bdpt_subdivision_add(bdpt_builder *builder, const bdpt_subdivision_desc *desc, bdpt_shape_id *shape);

/* Removes a shape that no instance uses.
 * Returns: BDPT_ERROR_INVALID_ID, _IN_USE, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: the builder's share of the data ends. */
BDPT_API BDPT_CHECK bdpt_result bdpt_shape_remove(bdpt_builder *builder, bdpt_shape_id shape);

typedef int32_t bdpt_texel;
#define BDPT_TEXEL_UINT8 0  /* 255 is 1 */
#define BDPT_TEXEL_FLOAT 1
#define BDPT_TEXEL_UINT16 2 /* 65535 is 1 */
#define BDPT_TEXEL_HALF 3

typedef int32_t bdpt_encoding;
#define BDPT_ENCODING_SRGB 0   /* texels, but for alpha, are decoded by the sRGB curve */
#define BDPT_ENCODING_LINEAR 1

typedef struct bdpt_texture_desc {
  uint32_t struct_size;
  uint32_t channels;      /* 1 to 4: grey; grey, alpha; red, green, blue; red, green, blue, alpha. Grey stands for all
                             three colours; alpha is 1 where there is none */
  const char *label;
  const void *pixels;     /* row 0 is the top, v = 1 */
  uint32_t width, height; /* 1 to 65536 */
  uint64_t row_stride;    /* bytes; 0 = packed */
  bdpt_texel texel;
  bdpt_encoding encoding;
  uint32_t mip_levels;    /* at most so many, up to 17, the image being one; each halves the one before. 0 = 1 */
  uint32_t reserved;
  const char *color_space; /* of the texels, but for alpha, instead of encoding, which must then be 0: they are converted
                              to the rendering space and kept as floats. NULL: by encoding; SRGB of three colours is then
                              "sRGB - Texture", LINEAR is left alone: numbers of the rendering space, or data */
} bdpt_texture_desc;

/* Adds an image texture. How it is looked up is said where it is used (bdpt_texture_use). Colours that are outside of the
 * rendering space have a negative channel when they are converted, which becomes 0; the log tells of how many.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for texels that are not finite, or negative where no color_space is given,
 * for a space that is unknown, and for grey that it makes a colour), _IO (a table of the configuration is missing),
 * _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: one thread per object. Callbacks: not for the builder in use.
 * Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_texture_add(bdpt_builder *builder, const bdpt_texture_desc *desc, bdpt_texture_id *texture);
/* Where a texture of yours is looked up. */
typedef struct bdpt_texture_place {
  float uv[2];               /* of the use: by its uv set and its transform, not wrapped */
  float position[3];         /* in the world */
  uint32_t reserved;
  bdpt_instance_id instance; /* of the builder that built the scene */
} bdpt_texture_place;

/* A texture of yours: a function that computes colours, for patterns and noise. look_up fills red, green, blue and alpha
 * of each of count places, count > 0; linear, in the rendering space; places and colors are valid during the call alone.
 * All places that a wave of subpaths meets come in one call, some hundreds. The function must depend on nothing but the
 * place: else techniques disagree, and no two renders are the same.
 * Zero goes on; any other value ends the call that renders with BDPT_ERROR_CALLBACK_FAILED, and the pass in hand is lost.
 * A colour that is negative, above maximum or not finite, or that was left unset, ends the subpath there: it is counted
 * as rejected (bdpt_render_stats; bdpt_film_info counts eye subpaths).
 * Not where single rays or texels are asked for: slots OPACITY and EMISSION, and lights, take images.
 * Threads: look_up is called on any thread that renders, several at a time, by bdpt_render_create and
 * bdpt_render_advance. Callbacks: render and film are closed inside of it (BDPT_ERROR_REENTRANT), but for reading. */
typedef struct bdpt_host_texture_desc {
  uint32_t struct_size;
  float maximum;   /* of all four channels, > 0; 0 = 1. Slots that take at most 1 refuse more */
  const char *label;
  int32_t (*look_up)(void *user, uint32_t count, const bdpt_texture_place *places, float (*colors)[4]);
  void *user;
  void (*drop)(void *user); /* called once when the last builder or scene that has the texture is gone, and when
                               bdpt_host_texture_add fails; may be NULL */
  uint64_t hash;   /* of all that decides your colours: films of other scenes do not merge */
  float step[2];   /* of slot BUMP: heights are compared so far to both sides in u and v, [1e-6,1]; zeros = 1/1024 */
} bdpt_host_texture_desc;

/* Adds a texture of yours. It is used like an image, but for wrap, lookup and level, which are 0.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: one thread per object. Callbacks: not for the builder in
 * use. Ownership: copies desc; drop is called also when this call fails, except for a struct_size of no version. */
BDPT_API BDPT_CHECK bdpt_result bdpt_host_texture_add(bdpt_builder *builder, const bdpt_host_texture_desc *desc, bdpt_texture_id *texture);
/* Removes a texture that no material or light uses.
 * Returns: BDPT_ERROR_INVALID_ID, _IN_USE, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: the builder's copy ends. */
BDPT_API BDPT_CHECK bdpt_result bdpt_texture_remove(bdpt_builder *builder, bdpt_texture_id texture);

/* A homogeneous medium: what fills closed surfaces, or the whole scene. */
typedef struct bdpt_medium_desc {
  uint32_t struct_size;
  uint32_t reserved;
  const char *label;
  float sigma_a[3]; /* absorption coefficient, [0,1e9], 1 / world unit: light falls by exp(-sigma_a d) */
  float sigma_s[3]; /* scattering coefficient, [0,1e9], 1 / world unit */
  float g;          /* mean cosine of the angle by which light is turned, [-0.9999,0.9999], as Henyey and Greenstein (1941)
                       have it */
  uint32_t reserved2;
} bdpt_medium_desc;

/* Adds a medium.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies. Source: Pauly et al. (2000), distances by a channel that is
 * chosen at random, each alike. */
BDPT_API BDPT_CHECK bdpt_result bdpt_medium_add(bdpt_builder *builder, const bdpt_medium_desc *desc, bdpt_medium_id *medium);
/* Replaces a medium's description for scenes built from now on.
 * Returns: as bdpt_medium_add, and BDPT_ERROR_INVALID_ID. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_medium_update(bdpt_builder *builder, bdpt_medium_id medium, const bdpt_medium_desc *desc);
/* Removes a medium that no material uses.
 * Returns: BDPT_ERROR_INVALID_ID, _IN_USE, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_medium_remove(bdpt_builder *builder, bdpt_medium_id medium);

typedef int32_t bdpt_material_type;
#define BDPT_MATERIAL_DIFFUSE 0    /* f = reflectance / pi; Oren-Nayar where diffuse_roughness > 0 */
#define BDPT_MATERIAL_MIRROR 1     /* perfect reflection, times reflectance */
#define BDPT_MATERIAL_CONDUCTOR 2  /* Fresnel reflection by a complex index; smooth, or GGX where roughness > 0 */
#define BDPT_MATERIAL_DIELECTRIC 3 /* Fresnel reflection and refraction; smooth, or GGX where roughness > 0 */
#define BDPT_MATERIAL_INTERFACE 4  /* the boundary of a medium, which nothing else shows: rays pass it, shadow rays too */
#define BDPT_MATERIAL_DIFFUSE_TRANSMISSION 5 /* reflectance / pi, and transmittance / pi through to the other side */
#define BDPT_MATERIAL_COATED_DIFFUSE 6   /* plastic: a dielectric coat with ior and roughness over diffuse */
#define BDPT_MATERIAL_COATED_CONDUCTOR 7 /* a conductor below a dielectric coat with coat_ior and coat_roughness */
#define BDPT_MATERIAL_PRINCIPLED 8       /* glTF 2.0's with its extensions: base colour in reflectance, and all below */
#define BDPT_MATERIAL_MIX 9              /* two others, the second with the weight mix */
#define BDPT_MATERIAL_HOST 10             /* functions of yours: bdpt_host_material */
#define BDPT_MATERIAL_BRUSHED 11         /* perfectly anisotropic reflection by grooves along u, times reflectance: all
                                            that a mirror could send to the cone round u goes evenly to all of it */

typedef int32_t bdpt_slot;
/* What a texture varies. Colours are multiplied by the texture's, numbers by one of its channels; what is 0 is refused. */
#define BDPT_SLOT_REFLECTANCE 0 /* colour */
#define BDPT_SLOT_ROUGHNESS 1   /* number, along u and v */
#define BDPT_SLOT_NORMAL 2      /* a tangent-space normal map: 2 rgb - 1, x along u, y along v; x and y times scale */
#define BDPT_SLOT_BUMP 3        /* the surface seems raised along its normal by a channel times scale, in world units */
#define BDPT_SLOT_OPACITY 4     /* number */
#define BDPT_SLOT_EMISSION 5    /* colour; on meshes alone. Such a light is sampled by its texels */
#define BDPT_SLOT_DIFFUSE_ROUGHNESS 6
#define BDPT_SLOT_TRANSMITTANCE 7 /* colour */
#define BDPT_SLOT_METALNESS 8
#define BDPT_SLOT_SPECULAR 9
#define BDPT_SLOT_SPECULAR_COLOR 10 /* colour */
#define BDPT_SLOT_COAT 11
#define BDPT_SLOT_COAT_ROUGHNESS 12
#define BDPT_SLOT_SHEEN_COLOR 13 /* colour */
#define BDPT_SLOT_SHEEN_ROUGHNESS 14
#define BDPT_SLOT_TRANSMISSION 15
#define BDPT_SLOT_DIFFUSE_TRANSMISSION 16
#define BDPT_SLOT_ANISOTROPY 17 /* as in glTF: red and green the direction, 2 rg - 1, in the frame of u; blue the number */
#define BDPT_SLOT_MIX 18
#define BDPT_SLOT_IRIDESCENCE 19
#define BDPT_SLOT_IRIDESCENCE_THICKNESS 20 /* from iridescence_thickness_minimum to iridescence_thickness */

typedef int32_t bdpt_wrap;
#define BDPT_WRAP_REPEAT 0
#define BDPT_WRAP_MIRROR 1
#define BDPT_WRAP_CLAMP 2 /* beyond the edge the last texel goes on */

typedef int32_t bdpt_lookup;
#define BDPT_LOOKUP_BILINEAR 0
#define BDPT_LOOKUP_NEAREST 1
#define BDPT_LOOKUP_BICUBIC 2 /* by B-splines: smooth, and never beyond the texels' range */

/* A texture that varies a number of a material over the surface. What it gives depends on the place alone, never on the
 * distance it is seen from: else what light subpaths see would not be what eye subpaths see. */
typedef struct bdpt_texture_use {
  uint32_t struct_size;
  bdpt_slot slot;          /* each slot once */
  bdpt_texture_id texture;
  uint32_t channel;        /* of numbers: 0 to 3 for red, green, blue, alpha; of colours and normals 0 */
  uint32_t uv_set;         /* 0 or 1. A mesh without set 0 has (0,0), (1,0), (1,1) at each triangle's corners; spheres have
                              u the angle round z, v from -z to z; curves: bdpt_curves_desc */
  float transform[6];      /* rows of a matrix: u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5, invertible; six zeros = identity */
  bdpt_wrap wrap[2];       /* of u and v */
  bdpt_lookup lookup;
  float level;             /* mip level, [0,16]; between two levels both are mixed; beyond the last it is the last */
  float scale;             /* of normal and bump; 0 = 1 */
  uint32_t reserved;
} bdpt_texture_use;

typedef int32_t bdpt_opacity_mode;
#define BDPT_OPACITY_OPAQUE 0
#define BDPT_OPACITY_MASK 1  /* there where opacity is at least the cutoff */
#define BDPT_OPACITY_BLEND 2 /* there with the probability of opacity, by a hash of the ray */

/* Where a host's material scatters. Directions are unit vectors that point away from the surface, in the shading frame: z
 * along the normal on the front, x along u. */
typedef struct bdpt_scattering_place {
  float previous[3];    /* where the subpath comes from; of an eye subpath, or a light subpath: you are not told */
  float reflectance[3]; /* of the description, times its textures */
  float roughness[2];   /* alpha, alike */
} bdpt_scattering_place;
typedef struct bdpt_scattering_value {
  float f[3];            /* >= 0, per projected solid angle, without cosines; the same with both directions exchanged */
  float density;         /* with which sample gives next, per solid angle; > 0 where f is */
  float density_reverse; /* with which it gives previous, coming from next */
} bdpt_scattering_value;

/* A material of yours. Both functions return zero and depend on nothing but their arguments; else techniques disagree, and
 * no two renders are the same. What breaks this contract (another value than zero, numbers that are negative or not
 * finite, a direction that is no unit vector) is a rejected contribution: bdpt_film_info counts them.
 * Threads: both are called on any thread that renders, several at a time. */
typedef struct bdpt_host_material {
  uint32_t struct_size;
  uint32_t transmits; /* 1: light may go through; 0: you are asked for two directions on one side only */
  void *user;
  int32_t (*evaluate)(void *user, const bdpt_scattering_place *place, const float next[3], bdpt_scattering_value *value);
  int32_t (*sample)(void *user, const bdpt_scattering_place *place, const float u[3], float next[3]);
                      /* u: uniform in [0,1); next comes as zero: left so, the light is absorbed */
  void (*drop)(void *user); /* called once when the last builder or scene that has the material is gone, and when the call
                               fails that is given it; may be NULL */
  uint64_t hash;      /* of all that decides f: films of other scenes do not merge */
} bdpt_host_material;

typedef struct bdpt_material_desc {
  uint32_t struct_size;
  bdpt_material_type type;
  const char *label;
  float reflectance[3];                /* of all but conductors, dielectrics and mixes: [0,1] per channel */
  uint32_t one_sided;                  /* 1: what meets the back is absorbed. Not where light goes through */
  bdpt_texture_id reflectance_texture; /* replaces reflectance; zero = none. Short for a use of
                                          slot REFLECTANCE, uv set 0, with reflectance (1,1,1) */
  float eta[3];                        /* conductors: real part of the index, [0,1e6]; see bdpt_metal_find */
  float k[3];                          /* conductors: imaginary part, [0,1e6]; eta and k not both zero in a channel */
  float ior;                           /* dielectric, principled: index inside over index outside; 0 = 1.5; else in
                                          [0.1, 10]; of a coated diffuse in [1, 10] */
  float roughness[2];                  /* GGX alpha along u and v, [0,1]; both 0 = smooth; one 0 is an error */
  float emission[3];                   /* radiance emitted by the front [W/(m² sr)], >= 0: an instance is a light */
  uint32_t emission_two_sided;         /* 1: the back emits too */
  uint32_t emission_group;             /* the light's group, [0,63]; see bdpt_light_desc */
  const bdpt_texture_use *textures;    /* textures that vary the numbers above; copied */
  uint32_t texture_count;
  uint32_t texture_stride;             /* bytes from one to the next; 0 = struct_size of the first */
  uint32_t perceptual_roughness;       /* 1: alpha is the square of roughness, and of its texture, as in glTF and OpenPBR */
  bdpt_opacity_mode opacity_mode;      /* rays of all kinds pass where the surface is not there. Not for what emits, nor
                                          for boundaries of media */
  float opacity;                       /* of mask and blend: [0,1] */
  float opacity_cutoff;                /* of mask: [0,1]; 0 = 0.5 */
  bdpt_medium_id interior;             /* dielectric, interface, and principled that refracts: what fills the closed
                                          surface; zero = nothing */
  uint32_t priority;                   /* of these: where several closed surfaces overlap, the one of highest priority is
                                          what is there, and of equals the one that a ray entered last. The others are no
                                          surfaces there; an index of refraction is relative to what is round it
                                          (Schmidt and Budge 2002). At most four may overlap: walks into a fifth end, and
                                          are counted as rejected */
  float emission_exponent;             /* n in [-1,10000]: what is emitted is emission cosⁿ of the angle to the normal.
                                          0 = Lambertian; -1 = the same intensity in all directions; more = a beam */
  float diffuse_roughness;             /* diffuse, coated diffuse, principled: Oren-Nayar's, [0,1]; 0 = Lambert */
  float transmittance[3];              /* [0,1]. Diffuse transmission: at most 1 together with reflectance. Principled: the
                                          colour of what goes through by diffuse_transmission */
  float coat;                          /* principled: weight of a clear coat, [0,1] */
  float coat_ior;                      /* coated conductor, principled: [1,10]; 0 = 1.5 */
  float coat_roughness;                /* alpha of the coat, [0,1]; 0 = smooth */
  float metalness;                     /* these and the following are principled's numbers, [0,1] but for what is said */
  float specular;                      /* weight of the dielectric's gloss; 0 = 1; -1 = none */
  float specular_color[3];             /* at normal incidence; zeros = (1,1,1) */
  float sheen_color[3];
  float sheen_roughness;               /* alpha; below 0.1 it is as 0.1 */
  float transmission;                  /* how much of what is no metal is clear, coloured by reflectance */
  float diffuse_transmission;          /* how much of what is diffuse goes through: leaves, paper, thin subsurface. Not
                                          with transmission unless thin_walled */
  float anisotropy;                    /* alpha along u goes to 1 with its square */
  float anisotropy_rotation;           /* of u about the normal, counter-clockwise in degrees; of brushed, too; finite */
  uint32_t thin_walled;                /* 1: what is clear does not refract: window panes, bubbles */
  uint32_t single_scattering;          /* 1: rough conductors and dielectrics lose what meets their microfacets more than
                                          once; 0: it is given back, diffusely */
  float mix;                           /* weight of parts[1], [0,1] */
  uint32_t reserved_2;
  bdpt_material_id parts[2];           /* mix: two that are no mixes or interfaces and have no emission, opacity, priority,
                                          normal or bump map. A mix encloses nothing */
  const bdpt_host_material *host;      /* host: copied */
  float iridescence;                   /* principled: weight of a thin film on the base, below coat and sheen, [0,1]. Not
                                          where ior is 1 and light refracts */
  float iridescence_ior;               /* the film's, [1,10]; 0 = 1.3 */
  float iridescence_thickness;         /* the film's, in nanometres, [0,1e5]; 0 = 400 */
  float iridescence_thickness_minimum; /* the same where a texture of slot IRIDESCENCE_THICKNESS is 0; without one 0 */
} bdpt_material_desc;

/* Adds a material. The anisotropic direction u is that of uv set 0.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _INVALID_ID (texture), _OUT_OF_MEMORY. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies; a host's drop is called also when this call fails, except for
 * a struct_size of no version.
 * Source: GGX by Walter et al. (2007), visible normals sampled after Heitz (2018); what is scattered more than once by
 * Kulla and Conty (2017); Oren-Nayar by Portsmouth, Kutz and Hill (2024); thin films after Belcour and Barla (2017). */
BDPT_API BDPT_CHECK bdpt_result bdpt_material_add(bdpt_builder *builder, const bdpt_material_desc *desc, bdpt_material_id *material);
/* Replaces a material's description for scenes built from now on.
 * Returns: as bdpt_material_add, and BDPT_ERROR_INVALID_ID. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: as bdpt_material_add. */
BDPT_API BDPT_CHECK bdpt_result bdpt_material_update(bdpt_builder *builder, bdpt_material_id material, const bdpt_material_desc *desc);
/* The complex index of a measured metal, in linear Rec.709: Ag, Al, Au or Cu.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (no such metal). Threads: any thread. Callbacks: allowed. Ownership: none.
 * Source: refractiveindex.info: Johnson and Christy (1972), Rakić (1995), weighted by D65. */
BDPT_API BDPT_CHECK bdpt_result bdpt_metal_find(const char *name, float eta[3], float k[3]);
/* Removes a material that no instance and no mix uses.
 * Returns: BDPT_ERROR_INVALID_ID, _IN_USE, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_material_remove(bdpt_builder *builder, bdpt_material_id material);

typedef int32_t bdpt_light_type;
#define BDPT_LIGHT_POINT 0
#define BDPT_LIGHT_SPOT 1        /* a point that shines into a cone, with a smooth edge */
#define BDPT_LIGHT_ENVIRONMENT 2 /* radiance from all directions: the same from each, or a picture's */
#define BDPT_LIGHT_DIRECTIONAL 3 /* light from far away: from one direction, or from a disc: a sun */

/* What a luminaire sends into each direction, as measured: the table of an IES file of type C. Linear between angles. */
typedef struct bdpt_photometry {
  uint32_t struct_size;
  uint32_t vertical_count;        /* 2 to 4096 */
  uint32_t horizontal_count;      /* 1 to 4096 */
  uint32_t reserved;
  const float *vertical_angles;   /* from the light's direction, ascending, [0,180] degrees; dark outside of them */
  const float *horizontal_angles; /* round it, ascending: 0 alone: all alike; or from 0 to 90, 180 or 360 degrees, the rest
                                     mirrored. Counted from up, counterclockwise for who looks along the direction */
  const float *intensities;       /* all vertical angles of the first horizontal one, then of the next; >= 0 */
} bdpt_photometry;

/* A rectangle through which light comes from infinitely far: a window, seen from either side. */
typedef struct bdpt_portal {
  float corner[3];
  float edge_u[3], edge_v[3]; /* from the corner, of any length but zero, at right angles */
} bdpt_portal;

/* Area lights are instances whose material emits. A scene takes any number of lights of each kind; their light adds up. */
typedef struct bdpt_light_desc {
  uint32_t struct_size;
  bdpt_light_type type;
  const char *label;
  float position[3];      /* point, spot */
  float direction[3];     /* spot, photometry: the axis; directional: the way that light goes; of any length but zero */
  float intensity[3];     /* point, spot: W/sr, on the axis; >= 0 */
  float radiance[3];      /* environment: W/(m² sr), >= 0; multiplies the texture */
  float cone_angle;       /* spot: from axis to the dark, (0,180) degrees */
  float cone_falloff;     /* spot: width of the edge inside it, [0, cone_angle] degrees: the intensity is
                             t²(3 - 2t) with t = (cos θ - cos a) / (cos(a - f) - cos a) */
  uint32_t group;         /* a number of your own, [0,63]: outputs of sensors may ask for some groups' light alone */
  uint32_t reserved;
  bdpt_texture_id texture; /* zero = none. Bilinear. environment: its picture, by longitude and latitude, what a camera
                             at rest sees, wrapped round: the middle is -z, the top edge +y, a quarter to the right +x.
                             spot: its picture, thrown onto the square round the cone, across the axis; multiplies the
                             intensity; cone_angle is at most 85 then */
  float transform[12];    /* environment: turns the picture, 3x4 row-major, without translation; may reflect and scale
                             alike, which does nothing; zeros = identity. OpenEXR's latitude-longitude maps have +z in
                             the middle: half a turn about y */
  float irradiance[3];    /* directional: of a surface that faces it, W/m², >= 0 */
  float angular_radius;   /* directional: of the disc, [0,80] degrees; the sun's is 0.2665. 0 = one direction, which no
                             camera or mirror sees */
  float up[3];            /* spot with a texture: where the picture's top is; photometry: where horizontal angles begin; of
                             any length. Zero, or along the direction: +y, or -z where that is along it, too */
  uint32_t reserved_2;
  const bdpt_photometry *photometry; /* point: multiplies the intensity; NULL = the same in all directions */
  const bdpt_portal *portals; /* environment, directional: where its light finds a way in, as rectangles in the world; copied.
                                 Hints: half of the samples go through them. A portal too many, too few or out of place
                                 costs time, and never changes what the picture converges to */
  uint32_t portal_count;      /* [0,64] */
  uint32_t reserved_3;
} bdpt_light_desc;

/* Adds a light.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _INVALID_ID (texture), _OUT_OF_MEMORY. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_light_add(bdpt_builder *builder, const bdpt_light_desc *desc, bdpt_light_id *light);
/* Replaces a light's description for scenes built from now on.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _INVALID_ID. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_light_update(bdpt_builder *builder, bdpt_light_id light, const bdpt_light_desc *desc);
/* Removes a light.
 * Returns: BDPT_ERROR_INVALID_ID, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_light_remove(bdpt_builder *builder, bdpt_light_id light);

typedef struct bdpt_sky_desc {
  uint32_t struct_size;
  uint32_t width, height; /* of the picture, 1 to 65536 */
  float turbidity;        /* of haze: 2 is very clear, 6 hazy; [1.7,10]; 0 = 3 */
  float to_sun[3];        /* of any length but zero; y >= 0 */
  float ground[3];        /* what stands below the horizon, >= 0 */
} bdpt_sky_desc;

/* Fills a picture for the texture of an environment with a clear sky, without its sun, +y up: 3 floats a pixel, linear Rec.
 * 709, packed, the top row first; luminance is in kcd/m². capacity: floats that pixels holds.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: writes to pixels.
 * Source: Preetham, Shirley and Smits (1999). */
BDPT_API BDPT_CHECK bdpt_result bdpt_sky_fill(const bdpt_sky_desc *desc, float *pixels, uint64_t capacity);

typedef struct bdpt_instance_desc {
  uint32_t struct_size;
  uint32_t invisible;  /* 1 = no ray meets it: it casts no shadow and scatters no light, but lightmaps and vertices may
                          measure what arrives at it. Must not emit. 0 = visible */
  const char *label;
  bdpt_shape_id shape;
  bdpt_material_id material;
  float transform[12]; /* object to world, invertible; twelve zeros = identity */
  float end_transform[12]; /* the same when the shutter closes, transform being that when it opens: between, all points
                              move on straight lines, the matrix being interpolated element by element, as in Embree; so
                              it must not turn by 180 degrees, and what turns by more than a few degrees gets smaller
                              meanwhile. Twelve zeros: it does not move. Not for what emits. A sample has one time, for
                              both of its subpaths; plans whose samples share light vertices have one time a pass */
} bdpt_instance_desc;

/* Places a shape, with a material, in the world.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (a transform that is singular at any time or not finite, or that makes an ellipsoid of a
 * sphere; invisible is neither 0 nor 1), _INVALID_ID, _OUT_OF_MEMORY. Threads: one thread per object. Callbacks: not for
 * the builder in use. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_instance_add(bdpt_builder *builder, const bdpt_instance_desc *desc, bdpt_instance_id *instance);
/* Replaces an instance's description for scenes built from now on.
 * Returns: as bdpt_instance_add. Threads: one thread per object. Callbacks: not for the builder in use.
 * Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_instance_update(bdpt_builder *builder, bdpt_instance_id instance, const bdpt_instance_desc *desc);
/* Removes an instance.
 * Returns: BDPT_ERROR_INVALID_ID, _INVALID_ARGUMENT. Threads: one thread per object.
 * Callbacks: not for the builder in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_instance_remove(bdpt_builder *builder, bdpt_instance_id instance);

typedef struct bdpt_build_desc {
  uint32_t struct_size;
  uint32_t reserved;
  bdpt_cancel *cancel;       /* may be NULL */
  bdpt_progress_fn progress; /* may be NULL */
  void *user;                /* for progress */
  bdpt_medium_id medium;     /* what fills the scene outside of all that encloses something; zero = nothing. Not with
                                lights that are infinitely far. Lights and cameras are in the medium of one point of
                                theirs; of sensors that are no cameras z_0 counts as outside */
} bdpt_build_desc;

/* Builds an immutable scene from what the builder holds. The builder can go on and build others. desc may be NULL.
 * A scene with no light is allowed, renders black, and says so in the log.
 * Returns: BDPT_CANCELLED, BDPT_ERROR_INVALID_ARGUMENT (no instance and no light), _MEMORY_LIMIT,
 * _OUT_OF_MEMORY, _CALLBACK_FAILED. Threads: one thread per builder. Callbacks: not for the builder in use.
 * Ownership: the caller gets one reference; the scene keeps the context and the borrowed data alive. */
BDPT_API BDPT_CHECK bdpt_result bdpt_scene_build(bdpt_builder *builder, const bdpt_build_desc *desc, bdpt_scene **scene);
/* Adds a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: +1; NULL is ignored. */
BDPT_API void bdpt_scene_retain(bdpt_scene *scene);
/* Takes a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: -1; NULL is ignored. */
BDPT_API void bdpt_scene_release(bdpt_scene *scene);

typedef struct bdpt_scene_info {
  uint32_t struct_size;
  uint32_t lights;               /* lights: emitting instances, and all that was added as a light */
  uint64_t instances;
  uint64_t triangles;            /* instanced ones counted once for each instance */
  uint64_t spheres;
  uint64_t degenerate_triangles; /* dropped, for having no area, once for each instance; segments of curves, too */
  uint64_t memory;               /* bytes, Embree's structures included */
  uint64_t memory_embree;        /* bytes of Embree's structures */
  uint64_t hash;                 /* of all that decides the picture */
  float bounds_min[3], bounds_max[3]; /* of the geometry; both zero when there is none */
  uint64_t curves;               /* segments of curves, as they were cut, once for each instance */
} bdpt_scene_info;

/* Tells what a scene holds.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies into *info. */
BDPT_API BDPT_CHECK bdpt_result bdpt_scene_get_info(const bdpt_scene *scene, bdpt_scene_info *info);

/* One of a scene's lights: a light, or an instance of a material that emits. */
typedef struct bdpt_scene_light {
  uint32_t struct_size;
  uint32_t group;            /* of the light, or of the material's emission */
  bdpt_light_id light;       /* zero for an instance */
  bdpt_instance_id instance; /* zero for a light */
  const char *label;         /* empty where it has none; the scene's, valid while it lives */
} bdpt_scene_light;

/* Tells what light `index` is, below bdpt_scene_info.lights: lights first, then instances, each in the order of adding.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed.
 * Ownership: copies into *light; the label is the scene's. */
BDPT_API BDPT_CHECK bdpt_result bdpt_scene_get_light(const bdpt_scene *scene, uint32_t index, bdpt_scene_light *light);

/* ---------------------------------------------------------------------------------------------------------------
 * Sensors
 */

typedef struct bdpt_sensor bdpt_sensor;

/* Cameras look along their own -z, with x to the right and y up. Fields that name types are for those alone, and zero
 * with others. */
typedef int32_t bdpt_camera_type;
#define BDPT_CAMERA_PERSPECTIVE 0     /* straight lines stay straight; a pinhole, or a thin lens */
#define BDPT_CAMERA_ORTHOGRAPHIC 1    /* parallel rays, from the plane through the camera, at right angles to it */
#define BDPT_CAMERA_EQUIDISTANT 2     /* fisheye in a circle that touches the image's top and bottom, black around it:
                                         the angle with the axis grows as the distance from the centre. Crop the
                                         circle for one that fills its frame */
#define BDPT_CAMERA_EQUISOLID 3       /* the same; each pixel of the circle sees the same solid angle */
#define BDPT_CAMERA_EQUIRECTANGULAR 4 /* all directions: longitude to the right, latitude upward, -z in the middle */
#define BDPT_CAMERA_CUBE 5            /* all directions, on the faces +x -x +y -y +z -z of a cube map of OpenGL, Vulkan or
                                         Direct3D: sampled by a direction in the camera's frame it tells what is seen
                                         there. Square faces in a row (width = 6 height) or a column (height = 6 width).
                                         For BDPT_FILTER_BOX of one pixel alone: wider ones would mix the faces */
#define BDPT_CAMERA_LENS 6            /* a lens by its surfaces, traced; the first lies at the camera, on its axis.
                                         Light is neither reflected nor absorbed in it, for lenses are coated */

/* A surface of a lens, as tables of patents have it, in the lens' unit. */
typedef struct bdpt_lens_surface {
  float radius;    /* of its curvature; positive where the centre is on the film's side; 0 = flat */
  float thickness; /* along the axis, to the next surface, 0 to 1e6; of the last, to the film */
  float ior;       /* behind it, 1 to 4; 0 = 1, air, as behind the last. Flat with the same on both sides: a stop */
  float aperture;  /* diameter through which light passes, above 0, to 1e6; at most 2 |radius| */
} bdpt_lens_surface;

struct bdpt_output_desc;

typedef struct bdpt_camera_desc {
  uint32_t struct_size;
  uint32_t width, height;   /* of the whole image, 1 to 65536 pixels */
  uint32_t crop[4];         /* x0, y0, x1, y1: the pixels measured, x1 and y1 outside; four zeros = all */
  float transform[12];      /* camera to world: rotation, reflection and translation; uniform scale is taken out */
  float field_of_view;      /* PERSPECTIVE: vertical, of the whole image, (0,180) degrees; 0 = 45. Fisheyes: across the
                               circle, (0,360]; 0 = 180 */
  float lens_radius;        /* PERSPECTIVE: world units; 0 = a pinhole */
  float focus_distance;     /* from the camera to the plane in focus, along the axis, > 0. PERSPECTIVE: 0 with a pinhole
                               only. LENS: the film moves until what is near the axis there is sharp; 0 = it stays where
                               the last thickness says */
  uint32_t aperture_blades; /* PERSPECTIVE, LENS: 0 = round; else 3 to 32: a regular polygon whose corners have
                               lens_radius, or lie on the rim of the stop */
  float aperture_rotation;  /* the same: degrees, counter-clockwise as seen from behind the camera; 0 = a corner on
                               the x axis */
  float shift[2];           /* all but EQUIRECTANGULAR, CUBE: the frame's centre moves right and up by these fractions of
                               its width and height */
  bdpt_camera_type type;    /* 0 = BDPT_CAMERA_PERSPECTIVE */
  float field_height;       /* ORTHOGRAPHIC: world units from the whole image's bottom to its top, > 0 */
  float focus_tilt[2];      /* PERSPECTIVE with a lens: degrees, (-90,90), by which the plane in focus leans: its right
                               side, and its top, come nearer by the tangents of these. It must not cut the lens */
  float film_height;        /* LENS: of the whole image on the film, in the lens' unit, 1e-6 to 1e6; 0 = 24 */
  float lens_unit;          /* LENS: world units in one of the lens, 1e-6 to 1e6; 0 = 0.001, millimetres in metres */
  uint32_t lens_surface_count;             /* LENS: 1 to 64 */
  uint32_t lens_surface_stride;            /* bytes from one to the next; 0 = sizeof(bdpt_lens_surface) */
  const bdpt_lens_surface *lens_surfaces;  /* LENS: from the scene to the film; copied */
  float end_transform[12];  /* like transform, when the shutter closes: between, the camera moves and turns evenly. Twelve
                               zeros: it does not move */
  uint32_t output_count;    /* beside the picture, which is plane 0 of the film: 0 to 63 */
  uint32_t output_stride;   /* bytes; 0 = struct_size of the first */
  const struct bdpt_output_desc *outputs; /* see "Outputs of cameras"; planes 1, 2 ... in this order; copied */
} bdpt_camera_desc;

/* Creates a camera. A pixel measures the radiance that arrives, averaged by the filter, and over the lens. With
 * BDPT_CAMERA_LENS it is the irradiance of the film, scaled so that a uniform radiance of 1 gives 1 in the middle of
 * the film, and less where the lens vignettes. Light hits lenses by itself (t = 0), not pinholes and orthographic ones.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a lens that cannot focus there, or that no light passes through),
 * _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed. Ownership: the caller gets one reference. */
BDPT_API BDPT_CHECK bdpt_result bdpt_camera_create(bdpt_context *context, const bdpt_camera_desc *desc, bdpt_sensor **sensor);
/* --- Sensors that are no cameras: what arrives at surfaces and points ---
 * A measurement is a texel or a point; it has one or more outputs, all sampled at once; an output is one or more planes
 * of the film, of three colours each. Every plan but mmlt measures them, with t = 0 on surfaces and in balls.
 * Directions are world directions, away from the point measured; n is the normal of the side that receives. */

typedef int32_t bdpt_output_kind;
#define BDPT_OUTPUT_IRRADIANCE 0         /* 1 plane: E = INT L max(0, w·n) dw [W/m²] */
#define BDPT_OUTPUT_IRRADIANCE_OVER_PI 1 /* 1 plane: E / pi, what a diffuse surface of albedo 1 would emit */
#define BDPT_OUTPUT_RADIANCE_SH1 2       /* 4 planes: c_lm = INT L Y_lm(w) dw for l <= 1, over the hemisphere of n (all
                                            directions, for points without normal) */
#define BDPT_OUTPUT_RADIANCE_SH2 3       /* 9 planes: l <= 2 */
#define BDPT_OUTPUT_IRRADIANCE_SH1 4     /* 4 planes: c_lm times pi, 2 pi / 3 for l = 0, 1: the irradiance of a surface
                                            with normal m is about SUM of these times Y_lm(m) */
#define BDPT_OUTPUT_IRRADIANCE_SH2 5     /* 9 planes: and times pi / 4 for l = 2 */
#define BDPT_OUTPUT_FLUENCE 6            /* 1 plane: INT L dw [W/m²] */
/* What is seen, whatever light there is. V(w) = 1 if a ray along w meets nothing within reach, else 0. */
#define BDPT_OUTPUT_OPENNESS 7           /* 1 plane: 1 / pi INT V max(0, w·n) dw, in [0,1]: ambient occlusion is one less
                                            this */
#define BDPT_OUTPUT_BENT_NORMAL 8        /* 1 plane: INT V w max(0, w·n) dw, x, y and z in place of colours; of any length */
#define BDPT_OUTPUT_OPENNESS_SH1 9       /* 4 planes: INT V Y_lm(w) dw */
#define BDPT_OUTPUT_OPENNESS_SH2 10      /* 9 planes */
#define BDPT_OUTPUT_FRONTS 11            /* 1 plane: the part of all rays that do not meet the back of a one-sided surface:
                                            near 0 inside of closed meshes */
/* Real spherical harmonics, planes in the order (0,0), (1,-1), (1,0), (1,1), (2,-2) ... (2,2), with x, y, z of w:
 * 0.282095; 0.488603 y, 0.488603 z, 0.488603 x; 1.092548 xy, 1.092548 yz, 0.315392 (3z² - 1), 1.092548 xz,
 * 0.546274 (x² - y²). */
/* Directions on a square of size x size texels, a plane each, in rows. (a, b) in [-1,1]² is the direction (a, b, c) with
 * c = 1 - |a| - |b| where that is not below 0, else ((1 - |b|) sgn a, (1 - |a|) sgn b, c); world space, z in the middle.
 * Plane j size + i has the square of a from -1 + 2 i / size on and b from -1 + 2 j / size on, 2 / size wide. Means are over
 * the exact solid angle of the square's directions; below the horizon of a normal all is 0. */
#define BDPT_OUTPUT_RADIANCE_OCTAHEDRAL 12   /* size² planes: the mean of L over the texel's directions */
#define BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL 13 /* size² planes: INT L max(0, w·m) dw, m the direction of the middle */
#define BDPT_OUTPUT_DISTANCE_OCTAHEDRAL 14   /* size² planes; in place of colours the means of d, d² and 1 - V, d the
                                                distance of what is seen, or reach where that is less */
#define BDPT_OUTPUT_UNSHADOWED 15        /* 1 plane: the direct part of E as if nothing were in its way [W/m²], whatever
                                            paths says; of all kinds of lights, by direct lighting alone, whatever
                                            techniques take part: it costs no ray. A shadow mask of group g is IRRADIANCE
                                            with BDPT_LIGHT_PATHS_DIRECT over this, both of group g; 1 where both are 0 */
/* Outputs of cameras, of the same samples as the picture. A plane each, but for those of coverage. All plans but mmlt
 * measure them. What eye subpaths meet first is a surface that opacity lets them meet, seen by every technique, whatever
 * light there is, and through no mirror and no glass; a sample counts 0 where there is none, or a medium scatters
 * before. Means are over the pixel's samples, as the film's filter weighs them. */
#define BDPT_OUTPUT_RADIANCE 16          /* the part of the picture that paths and groups name. DIRECT is light of at most
                                            two edges: that of lights that are seen, and that of one reflection */
#define BDPT_OUTPUT_ALBEDO 17            /* the part of light, in [0,1], that the surface sends on, reflected or transmitted,
                                            for the direction from which it is seen: of a diffuse surface its reflectance */
#define BDPT_OUTPUT_NORMAL 18            /* x, y, z: the shading normal, in the world, on the side that is seen */
#define BDPT_OUTPUT_DEPTH 19             /* in place of colours the means of d, d² and 1: d the distance from the camera
                                            along its axis; of fisheyes and panoramas, the distance from the point.
                                            The first over the third is the mean of what is seen */
#define BDPT_OUTPUT_POSITION 20          /* x, y, z in the world */
#define BDPT_OUTPUT_INSTANCE_COVERAGE 21 /* no plane: whose surfaces the samples met, bdpt_instance_id; see
                                            bdpt_film_read_coverage */
#define BDPT_OUTPUT_MATERIAL_COVERAGE 22 /* the same, bdpt_material_id. Of each of these two a camera has one at most */
#define BDPT_OUTPUT_NONE (-1)            /* bdpt_plane_info: a camera's pixels, or a measurement of your own */

typedef int32_t bdpt_light_paths;
#define BDPT_LIGHT_PATHS_ALL 0
#define BDPT_LIGHT_PATHS_DIRECT 1   /* light that comes straight from where it is emitted to what is measured or seen */
#define BDPT_LIGHT_PATHS_INDIRECT 2 /* all other */

typedef struct bdpt_output_desc {
  uint32_t struct_size;
  bdpt_output_kind kind;
  bdpt_light_paths paths;
  float reach;     /* of openness: lengths beyond which nothing counts, >= 0; 0 = without end. Of distances: the largest,
                      > 0 */
  uint64_t groups; /* bit g: the light of group g counts (see bdpt_light_desc); 0 = all groups */
  uint32_t size;   /* of octahedral outputs: texels along a side, [1,32]; 0 = 8. Of others: 0 */
  uint32_t unfiltered; /* of cameras' planes: 1 = a sample counts for its own pixel alone, whatever the film's filter, as
                          denoisers need it (see bdpt_denoise); 0 = filtered like the picture. Of others: 0 */
} bdpt_output_desc;

/* What a plane of the film measures. With bdpt_scene_get_light it tells which lights are in it: those whose group's bit
 * is set in groups. A host that draws them at run time must not add them again. */
typedef struct bdpt_plane_info {
  uint32_t struct_size;
  bdpt_output_kind kind;  /* BDPT_OUTPUT_NONE for a sensor without outputs, and a camera's picture */
  bdpt_light_paths paths;
  float reach;            /* of openness; 0 = without end */
  uint64_t groups;        /* bit g: light of group g; 0: of none, as for openness */
  uint32_t output;        /* of those asked for; 0 for a camera's picture, too */
  uint32_t coefficient;   /* plane within the output, as of spherical harmonics */
  uint64_t reserved;
} bdpt_plane_info;

/* Tells what plane `plane` of a sensor's films measures.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies into *info. */
BDPT_API BDPT_CHECK bdpt_result bdpt_sensor_get_plane(const bdpt_sensor *sensor, uint32_t plane, bdpt_plane_info *info);

/* An instance and its place in an atlas. */
typedef struct bdpt_lightmap_instance {
  uint32_t struct_size;
  uint32_t atlas;            /* below atlas_count */
  bdpt_instance_id instance; /* of the builder that built the scene; a mesh that has the uv set */
  uint32_t uv_set;           /* 0 = set 1; 1 = set 0 */
  uint32_t flip;             /* 1: the back receives, not the front */
  float scale[2], offset[2]; /* uv of the atlas = uv * scale + offset; scale (0,0) = (1,1). [0,1]² is the atlas, v = 1
                                its top row */
} bdpt_lightmap_instance;

typedef struct bdpt_lightmap_desc {
  uint32_t struct_size;
  uint32_t width, height;    /* texels of an atlas, 1 to 65536 */
  uint32_t atlas_count;      /* 0 = 1; the film has atlas a in rows a * height to (a + 1) * height, at most 65536 rows */
  uint32_t instance_count;   /* at least 1; each instance once */
  uint32_t instance_stride;  /* bytes from one to the next; 0 = sizeof(bdpt_lightmap_instance) */
  const bdpt_lightmap_instance *instances;
  uint32_t output_count;     /* 0 = irradiance alone */
  uint32_t output_stride;    /* bytes; 0 = struct_size of the first */
  const bdpt_output_desc *outputs;
  uint32_t rect[4];          /* x0, y0, x1, y1 in the film: only these texels are baked; four zeros = all. A plan without
                                light subpaths gives them the bits of the whole bake; with light subpaths, of which a
                                pass has one for each texel, the same measurements but other noise */
  uint32_t geometric_normals; /* 1: n is the triangle's normal; 0: the interpolated vertex normal, where there is one */
  uint32_t buried_rays;      /* 0 = off; else [1,4096], 16 will do: so many rays from each of 8 x 8 cells of each texel
                                find what is buried, inside of geometry; it is not measured at all: no part of E_j
                                and A_j */
  float backface_tolerance;  /* a cell is buried where more than this part of its rays, spread by the cosine, meets the
                                back of a surface first: (0,1); 0 = 0.5 */
  uint32_t all_backs;        /* whose backs: 0: of one-sided surfaces; 1: of all but dielectrics */
  const bdpt_cancel *cancel; /* stops the search for what is buried, which takes some ten seconds for 1024 x 1024
                                texels on two cores; may be NULL */
  uint32_t film_of_rect;     /* 1: film and sensor hold the texels of rect alone, (0,0) being (x0,y0), so that a map is
                                baked in bands, with the same bits as with 0 */
  uint32_t reserved;
} bdpt_lightmap_desc;

/* Creates a lightmap. A texel measures the mean over all of the surface that it covers, by area: E_j = 1/A_j INT E dA, so
 * that the sum of A_j E_j (with geometric normals) is the light that falls on the surface, to the last ray. Where several
 * surfaces share a texel the mean is over all of them. Triangles without area in the atlas, and what lies outside of it,
 * are not measured, but cast shadows and scatter light; bdpt_lightmap_info and the log tell of them. With buried_rays,
 * floors that run on under walls are not darkened there: whether a cell counts is found once, and holds for eye and
 * light subpaths alike.
 * Returns: BDPT_CANCELLED; BDPT_ERROR_INVALID_ARGUMENT (no mesh, a mesh without the uv set, an instance twice, no
 * texel covered, all of them buried), _INVALID_ID, _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: the caller gets one reference; the sensor keeps the scene alive. A render takes it with this scene only.
 * Source: Veach (1997), 10.6; the measurement functions are those of docs/baking.md. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_create(bdpt_scene *scene, const bdpt_lightmap_desc *desc, bdpt_sensor **sensor);

typedef struct bdpt_lightmap_info {
  uint32_t struct_size;
  uint32_t width, height;      /* of the film: of all atlases together, or of rect with film_of_rect */
  uint32_t reserved;
  uint64_t texels;             /* that cover some surface: samples of a pass */
  uint64_t texels_shared;      /* of these, by more than one instance */
  uint64_t triangles_unmapped; /* without area in the atlas */
  uint64_t triangles_outside;  /* that reach out of the atlas */
  double area;                 /* of the surface measured, in the world */
  double area_outside;         /* of what lies outside of the atlas */
  uint64_t texels_buried;      /* that cover surface, but all of it buried: not among texels */
  double area_buried;          /* of what is left out for being buried, in the world */
} bdpt_lightmap_info;

/* Tells what a lightmap covers.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a sensor of another kind). Threads: any thread. Callbacks: allowed.
 * Ownership: copies into *info. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_get_info(const bdpt_sensor *sensor, bdpt_lightmap_info *info);

/* Reads, for each texel in rows, the part of it that its surfaces cover, by area in the atlas (above 1 where they overlap;
 * 0 where nothing is measured), and the area of these surfaces in the world. Either may be NULL; capacity, in floats, is
 * that of each.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_read_texels(const bdpt_sensor *sensor, float *coverage, float *area, uint64_t capacity);

/* Reads, for each texel in rows, the part of it whose surfaces are buried, by area in the atlas;
 * bdpt_lightmap_read_texels tells of what is left. Zeros where desc.buried_rays was 0. capacity is in floats.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_read_buried(const bdpt_sensor *sensor, float *buried, uint64_t capacity);

typedef struct bdpt_point {
  float position[3];
  float normal[3]; /* of any length: light from its side counts; zero: light from everywhere does */
  float radius;    /* 0, or 1e-9 to 1e9 world units: the mean over a disk across the normal, or without one over a ball,
                      of at least 1/10000 of its largest coordinate; 0 = the point itself */
  float cone;      /* with a normal: only light within so many degrees of it counts, (0,90], as if all else were black;
                      0 = 90. Without one: 0 */
} bdpt_point;

typedef struct bdpt_points_desc {
  uint32_t struct_size;
  uint32_t output_count;     /* 0 = irradiance if the first point has a normal, else fluence */
  uint64_t count;            /* of points, [1, 2^32) */
  uint64_t point_stride;     /* bytes; 0 = sizeof(bdpt_point) */
  const bdpt_point *points;
  const bdpt_output_desc *outputs; /* irradiance of points without normal is an error */
  uint32_t output_stride;    /* bytes; 0 = struct_size of the first */
  float offset;              /* points with a normal may lie on surfaces: their rays start so far off, along the normal;
                                0 = 16 ulps of the largest coordinate of all points, which is enough unless a triangle
                                there is larger than that */
} bdpt_points_desc;

/* Creates a sensor of points in space. The film has them in rows, in order: a packed read of it begins with the points,
 * one after another. Light subpaths do not hit points or disks by chance: of these t = 0 is left out. They do cross
 * balls, and are measured there by the length of their way (t = 0): what comes through glass from small lamps is found.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: copies; the caller gets one reference. */
BDPT_API BDPT_CHECK bdpt_result bdpt_points_create(bdpt_context *context, const bdpt_points_desc *desc, bdpt_sensor **sensor);

/* An instance whose vertices are measured. */
typedef struct bdpt_vertex_instance {
  uint32_t struct_size;
  uint32_t flip;             /* 1: the back receives, not the front */
  bdpt_instance_id instance; /* of the builder that built the scene; a mesh */
} bdpt_vertex_instance;

typedef struct bdpt_vertices_desc {
  uint32_t struct_size;
  uint32_t instance_count;    /* at least 1; each instance once */
  const bdpt_vertex_instance *instances;
  const bdpt_output_desc *outputs;
  uint32_t output_count;      /* 0 = irradiance alone */
  uint32_t output_stride;     /* bytes; 0 = struct_size of the first */
  uint32_t instance_stride;   /* bytes; 0 = struct_size of the first */
  uint32_t geometric_normals; /* 1: n is the triangle's normal; 0: the interpolated vertex normal, where there is one */
} bdpt_vertices_desc;

/* Creates a sensor of the vertices of meshes. Vertex j measures the mean E_j = INT h_j E dA / A_j, A_j = INT h_j dA, with
 * the hat function h_j: 1 at the vertex, 0 at all others, linear on each triangle. The sum of A_j E_j (with geometric
 * normals) is the light that falls on the surface. The film has vertices in rows, in order, those of the first instance
 * first: a packed read of it begins with them, one after another. Vertices of one place and several indices measure
 * apart; those of no triangle are not measured.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (no mesh, an instance twice, no triangle with an area), _INVALID_ID,
 * _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: the caller gets one reference; the sensor keeps the scene alive. A render takes it with this scene only.
 * Source: Veach (1997), 10.6. */
BDPT_API BDPT_CHECK bdpt_result bdpt_vertices_create(bdpt_scene *scene, const bdpt_vertices_desc *desc, bdpt_sensor **sensor);

/* Reads A_j of each vertex, in square world units; 0 where nothing is measured. capacity, in floats, is at least the
 * number of vertices.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a sensor of another kind). Threads: any thread. Callbacks: allowed.
 * Ownership: copies. */
BDPT_API BDPT_CHECK bdpt_result bdpt_vertices_read_areas(const bdpt_sensor *sensor, float *areas, uint64_t capacity);

/* Turns means by hat functions, as a film of the sensor has them, into values at the vertices, in place: of all functions
 * linear on each triangle the one nearest to what was measured, by least squares over the surface. Interpolated between
 * vertices, these are the picture; the means themselves would blur it. channels floats to a vertex, 1 to 4096; capacity
 * in floats. Values of vertices that are not measured stay. The same input gives the same bits.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a sensor of another kind, and values that are not finite),
 * _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed. Ownership: writes values. */
BDPT_API BDPT_CHECK bdpt_result bdpt_vertices_solve(const bdpt_sensor *sensor, uint32_t channels, float *values, uint64_t capacity);

/* --- Measurements of your own ---
 * Measurement j, plane c, is I = INT INT W(x) R_c(x,w) L(x,w) dw' dA: x in space or on a surface, w away from it, dw' the
 * projected solid angle with the normal at x (the solid angle where there is none), L the light that arrives at x from w.
 * start samples x and w, density tells how, respond is R, and land says where light subpaths count that land on a surface
 * (t = 0). What is left NULL leaves just those techniques out that need it: land t = 0, density t = 1 and t = 0.
 * The functions are called from all threads that render, at the same time, each with n >= 1 at once. They must be pure:
 * their results depend on nothing but their arguments. They return 0; any other value stops the call, which returns
 * BDPT_ERROR_CALLBACK_FAILED, and the pass in hand is lost. What is not finite, a density that is not above 0, or a
 * direction that is not unit or points away from its normal, is counted in bdpt_film_info.rejected and left out;
 * BDPT_LAYER_REJECTED tells of which measurements. */

/* Where a measurement begins. */
typedef struct bdpt_measurement_start {
  float position[3];
  float normal[3];         /* unit; zero for a point in space */
  float direction[3];      /* unit, on the normal's side */
  float weight;            /* W(position) / density_position; any sign */
  float density_position;  /* per area; 1 for a fixed point */
  float density_direction; /* per projected solid angle, or solid angle without normal: what density tells of it */
  float offset;            /* rays start so far off, along the normal; on a surface, more than rounding */
  uint32_t reserved;
} bdpt_measurement_start;

/* A point of a measurement and a direction there. */
typedef struct bdpt_measurement_place {
  uint64_t measurement;
  float position[3];
  float normal[3];
  float direction[3]; /* unit: where light comes from; on the normal's side */
  uint32_t reserved;
} bdpt_measurement_place;

/* Light that lands on a surface of the scene. */
typedef struct bdpt_measurement_landing {
  bdpt_instance_id instance;
  uint32_t triangle;  /* of the mesh, without those that have no area; segment of curves; 0 for a sphere */
  float u, v;         /* barycentric coordinates of its second and third vertex */
  float position[3];
  float normal[3];    /* geometric, of the front */
  float direction[3]; /* unit: where the light comes from */
} bdpt_measurement_landing;

/* What it counts for. */
typedef struct bdpt_measurement_landed {
  uint64_t measurement;   /* BDPT_NO_MEASUREMENT: for none */
  float normal[3];        /* that start would have given there */
  float weight;           /* W(position) */
  float density_position; /* that start would have had for it */
  uint32_t reserved;
} bdpt_measurement_landed;
#define BDPT_NO_MEASUREMENT UINT64_MAX

typedef struct bdpt_custom_desc {
  uint32_t struct_size;
  uint32_t planes;       /* [1,1024]; 0 = 1 */
  uint64_t measurements; /* [1, 2^32) */
  uint64_t hash;         /* of all that your functions decide: films of other hashes do not merge */
  int32_t (*start)(void *user, uint32_t n, const uint64_t *measurements, const float (*numbers)[4],
                   bdpt_measurement_start *starts); /* numbers: 4 uniform ones in [0,1) for each; starts are zero */
  int32_t (*density)(void *user, uint32_t n, const bdpt_measurement_place *places, float *densities); /* may be NULL */
  int32_t (*respond)(void *user, uint32_t n, const bdpt_measurement_place *places, float *responses);
      /* n x planes numbers, any sign; NULL: 1 in all planes */
  int32_t (*land)(void *user, uint32_t n, const bdpt_measurement_landing *landings, bdpt_measurement_landed *landed);
      /* may be NULL; landed is zero */
  void *user;
  void (*drop)(void *user); /* called once when the sensor is gone, and when this call fails; may be NULL */
} bdpt_custom_desc;

/* Creates a sensor from functions. The film has measurements in rows, in order, as for bdpt_points_create.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: copies desc; the caller gets one reference. Source: Veach (1997), 10.6. */
BDPT_API BDPT_CHECK bdpt_result bdpt_custom_create(bdpt_context *context, const bdpt_custom_desc *desc, bdpt_sensor **sensor);

/* Adds a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: +1; NULL is ignored. */
BDPT_API void bdpt_sensor_retain(bdpt_sensor *sensor);
/* Takes a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: -1; NULL is ignored. */
BDPT_API void bdpt_sensor_release(bdpt_sensor *sensor);

/* ---------------------------------------------------------------------------------------------------------------
 * Film: the measurements
 */

typedef struct bdpt_film bdpt_film;

typedef int32_t bdpt_filter;
#define BDPT_FILTER_BOX 0             /* radius 0.5 by default */
#define BDPT_FILTER_TENT 1            /* radius 1 */
#define BDPT_FILTER_GAUSSIAN 2        /* radius 1.5, standard deviation a (0 = 0.5), shifted to reach zero */
#define BDPT_FILTER_MITCHELL 3        /* radius 2, with b and c (both 0 = 1/3 each); has negative lobes */
#define BDPT_FILTER_BLACKMAN_HARRIS 4 /* radius 2 */

typedef int32_t bdpt_normalization;
#define BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED 0 /* the eye image is divided by its sum of weights, Veach (10.11):
                                                      less noise, a slight bias; the two agree for a box of 0.5 */
#define BDPT_NORMALIZATION_SAMPLE_COUNT 1          /* divided by the number of samples, Veach (10.10): unbiased */

typedef struct bdpt_film_desc {
  uint32_t struct_size;
  bdpt_filter filter;
  float filter_radius;     /* pixels, [0.5, 8]; 0 = the filter's own */
  float filter_a;          /* Gaussian: standard deviation in pixels; Mitchell: B */
  float filter_b;          /* Mitchell: C */
  bdpt_normalization normalization;
  uint32_t groups;         /* independent groups of passes, pass p belongs to group p mod groups: [1,16]; 0 = 2. The
                              estimate of variance needs two. Memory: 112 bytes per pixel and group, and once more; 48
                              for each plane of a sensor that is no camera; with outputs of a camera 32, and 96 for
                              each plane; and 272 bytes per pixel for each output of coverage */
  uint32_t pyramid_edges;  /* keep an image of each technique (s,t) of paths of up to so many edges: [0,15];
                              96 bytes per pixel and technique, of which k edges have k + 2. 0 = none */
} bdpt_film_desc;

/* Creates an empty film for a sensor. desc may be NULL.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: the caller gets one reference; the film keeps the sensor's size, not the sensor. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_create(bdpt_sensor *sensor, const bdpt_film_desc *desc, bdpt_film **film);
/* Adds a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: +1; NULL is ignored. */
BDPT_API void bdpt_film_retain(bdpt_film *film);
/* Takes a reference. Returns: nothing. Threads: any thread. Callbacks: allowed. Ownership: -1; NULL is ignored. */
BDPT_API void bdpt_film_release(bdpt_film *film);

/* Bytes, as the context's memory_limit counts them. */
typedef struct bdpt_memory_estimate {
  uint32_t struct_size;
  uint32_t band_rows; /* of bdpt_lightmap_estimate */
  uint64_t sensor;    /* of a sensor that is not there yet */
  uint64_t film;
  uint64_t render;    /* of a render with default options; plans with a pool, and the light tree, take more */
  uint64_t total;
} bdpt_memory_estimate;

/* Tells what a film and its render will take, before there is one. desc may be NULL. sensor of the estimate is 0: it is
 * there.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: copies into *estimate. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_estimate(const bdpt_sensor *sensor, const bdpt_film_desc *desc,
                                                   bdpt_memory_estimate *estimate);

/* The same for a lightmap that is not there yet, and its film; film may be NULL. band_rows: bake the map in bands of so
 * many rows of desc.rect, each a lightmap with film_of_rect, and no band needs more than budget bytes, wherever it
 * begins; all rows if all fit, 0 if one is too many. budget 0 = what is left of the context's memory_limit. Cuts all
 * triangles into texels once, which takes time but no memory.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _INVALID_ID, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: copies into *estimate. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_estimate(bdpt_scene *scene, const bdpt_lightmap_desc *desc,
                                                       const bdpt_film_desc *film, uint64_t budget,
                                                       bdpt_memory_estimate *estimate);

typedef struct bdpt_film_info {
  uint32_t struct_size;
  uint32_t width, height;  /* of the region measured: that of the crop window */
  uint32_t groups;
  uint32_t pyramid_edges;
  bdpt_filter filter;
  float filter_radius;
  bdpt_normalization normalization;
  uint64_t passes;         /* whole passes in the film */
  uint64_t first_pass;     /* the lowest of them */
  uint64_t next_pass;      /* one past the highest of them: where a render would go on */
  uint64_t seed;           /* of the render that filled it; 0 while empty */
  uint64_t scene_hash;     /* 0 while empty */
  uint64_t options_hash;   /* of sensor, film and render options; 0 while empty */
  uint64_t rejected;       /* contributions that were not finite or too large for the film, and were left out; in its
                              passes, those of the render's statistics included. BDPT_LAYER_REJECTED tells where */
  double relative_error;   /* square root of the relative variance, averaged over the measurements of plane 0:
                              var / (mean² + 0.01 M²) with M the mean of the image; -1 while unknown (fewer than two
                              groups hold passes) */
  uint64_t measured;       /* measurements: pixels, or texels that cover some surface */
  uint32_t planes;         /* of three colours; 1 for a camera without outputs */
  uint32_t coverages;      /* outputs of coverage */
} bdpt_film_info;

/* Tells what a film holds. relative_error takes as long as reading the image.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: one thread per object. Callbacks: allowed.
 * Ownership: copies into *info. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_get_info(const bdpt_film *film, bdpt_film_info *info);

typedef int32_t bdpt_layer;
#define BDPT_LAYER_COLOR 0     /* 3 channels: the image, eye image plus light image */
#define BDPT_LAYER_EYE 1       /* 3 channels: t >= 2 */
#define BDPT_LAYER_LIGHT 2     /* 3 channels: t <= 1 */
#define BDPT_LAYER_VARIANCE 3  /* 3 channels: the variance of COLOR (of the mean, not of one sample), from the groups;
                                  with two groups it has one degree of freedom: average it over a neighbourhood */
#define BDPT_LAYER_TECHNIQUE 4 /* 3 channels: the weighted contribution of technique (s,t) of the pyramid */
#define BDPT_LAYER_REJECTED 5  /* 3 channels alike: how many contributions to the pixel, in any plane, were left out, not
                                  being finite or being too large; a start that cannot be used counts as one */
#define BDPT_LAYER_SAMPLES 6   /* 3 channels alike: the eye samples of the pixel. Of cameras with outputs */

typedef struct bdpt_read_desc {
  uint32_t struct_size;
  bdpt_layer layer;
  uint32_t s, t;             /* for BDPT_LAYER_TECHNIQUE */
  uint32_t rect[4];          /* x0, y0, x1, y1 within the film; four zeros = all */
  uint64_t row_stride;       /* bytes from row to row in the destination; 0 = packed */
  uint32_t flip;             /* 1: the bottom row first */
  uint32_t include_partial;  /* 1: with the blocks of a pass that a cancel interrupted, each weighed as if the pass were
                                whole; 0: whole passes only */
  uint32_t plane;            /* of the sensor's outputs, one after another; of a camera 0 is the picture */
  uint32_t reserved;
} bdpt_read_desc;

/* Reads a layer as 32-bit floats, 3 to a pixel. An empty film reads as zero.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also when capacity, in bytes, is too small, or the film has no such layer).
 * Threads: one thread per object. Callbacks: allowed. Ownership: copies into pixels. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_read(const bdpt_film *film, const bdpt_read_desc *desc, float *pixels, uint64_t capacity);

/* Which ids to read, and where. */
typedef struct bdpt_coverage_desc {
  uint32_t struct_size;
  uint32_t coverage;        /* of the camera's outputs of coverage, in their order: 0 or 1 */
  uint32_t rect[4];         /* x0, y0, x1, y1 within the film; four zeros = all */
  uint32_t ranks;           /* for each pixel, 1 to 8 */
  uint32_t include_partial; /* as in bdpt_read_desc */
} bdpt_coverage_desc;

typedef struct bdpt_coverage {
  uint64_t id; /* 0 where part is 0 */
  float part;  /* of the pixel's samples, [0,1] */
  uint32_t reserved;
} bdpt_coverage;

/* Reads the ids of each pixel, by rows, `ranks` for each, those with the largest parts first. Samples count for their own
 * pixel, whatever the filter. A film keeps 8 ids of a pixel, with all their samples: of more, those whose hashes come
 * first, so that neither threads nor merging decide which. *lost, unless NULL, is set to the part of all samples of
 * these pixels whose ids were left out, by this limit or by ranks. Entries: capacity of them, at least ranks for each
 * pixel.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a film without such an output). Threads: one thread per object.
 * Callbacks: allowed. Ownership: copies into entries and *lost. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_read_coverage(const bdpt_film *film, const bdpt_coverage_desc *desc,
                                                        bdpt_coverage *entries, uint64_t capacity, double *lost);

/* Empties a film, so that another scene or other options may fill it.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _IN_USE (a render holds the film), _REENTRANT. Threads: one thread per object.
 * Callbacks: not for a film in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_clear(bdpt_film *film);
/* Adds the passes of source to destination, exactly: the merge of [0,k) and [k,n) is the render of [0,n).
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for one film twice), _MISMATCH (other scene, seed or options, or
 * overlapping passes; an empty film takes all), _IN_USE (a render holds the destination), _REENTRANT. Threads: one thread per object, both.
 * Callbacks: not for a film in use. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_merge(bdpt_film *destination, const bdpt_film *source);
/* Writes the film's whole state to a file, first under another name, so that path holds the old file or the new one.
 * Blocks of an interrupted pass are not saved.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _IO. Threads: one thread per object. Callbacks: allowed. Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_save(const bdpt_film *film, const char *path);
/* Reads a film that bdpt_film_save wrote.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _IO, _FORMAT, _MEMORY_LIMIT, _OUT_OF_MEMORY. Threads: any thread.
 * Callbacks: allowed. Ownership: the caller gets one reference. */
BDPT_API BDPT_CHECK bdpt_result bdpt_film_load(bdpt_context *context, const char *path, bdpt_film **film);

/* ---------------------------------------------------------------------------------------------------------------
 * Render
 */

typedef struct bdpt_render bdpt_render;

typedef int32_t bdpt_heuristic;
#define BDPT_HEURISTIC_POWER 0    /* Veach (9.11): w = p^beta / sum p^beta */
#define BDPT_HEURISTIC_BALANCE 1  /* the power heuristic with beta = 1 */
#define BDPT_HEURISTIC_CUTOFF 2   /* Veach (9.10): balance among the techniques with p >= cutoff * p_max */
#define BDPT_HEURISTIC_MAXIMUM 3  /* the technique with the greatest p takes all */
#define BDPT_HEURISTIC_AVERAGE 4  /* all techniques that can make the path, alike; the variance may be infinite */
#define BDPT_HEURISTIC_NONE 5     /* no weights: every technique in full. The image is no estimate; its pyramid shows
                                     each technique alone */

typedef int32_t bdpt_sampler;
#define BDPT_SAMPLER_SOBOL 0       /* Owen-scrambled Sobol points, fixed dimensions for each vertex */
#define BDPT_SAMPLER_INDEPENDENT 1
#define BDPT_SAMPLER_STRATIFIED 2  /* Veach 10.3.1: each pixel in n x n strata, the rest independent */

typedef int32_t bdpt_shadow_roulette;
#define BDPT_SHADOW_ROULETTE_NONE 0       /* every connection that carries light is tested for visibility */
#define BDPT_SHADOW_ROULETTE_FIXED 1      /* with probability min(1, c / threshold), c the contribution's largest channel */
#define BDPT_SHADOW_ROULETTE_EFFICIENCY 2 /* Veach (1997), 10.4: the threshold of each region of the image is the standard
                                             deviation of a sample per ray, found by a pilot of some thousand samples
                                             at the start of the first call of bdpt_render_advance */

typedef int32_t bdpt_adaptive;
#define BDPT_ADAPTIVE_NONE 0       /* one eye sample of each pixel in each pass */
#define BDPT_ADAPTIVE_TWO_STAGES 1 /* Veach (1997), 10.3.6: as many in all, but more of them where they are noisy in relation
                                      to the picture: a pixel gets r in a pass, in the mean, r in quarters from 1/2 to 4,
                                      and each counts 1/r times. A pilot of some thousand samples at the start of the
                                      first call of bdpt_render_advance finds r for each region of the image, before any
                                      sample is taken: no bias. In one pass alone some pixels get none; it is at its
                                      best in multiples of four passes for each of the film's groups */

typedef int32_t bdpt_light_start;
#define BDPT_LIGHT_START_POWER 0      /* light subpaths start by emitted power */
#define BDPT_LIGHT_START_UNIFORM 1    /* every light alike */
#define BDPT_LIGHT_START_IMPORTANCE 2 /* by what each light's subpaths bring to this view, and a tenth by power: Veach
                                         (1997), 10.7. bdpt_render_create traces a pilot of 8192 to 65536 samples to
                                         find it; they count in the statistics */

/* How direct lighting (s = 1) chooses a light for the point that is lit. A light is one that was added, or an
 * instance that emits. */
typedef int32_t bdpt_light_selection;
#define BDPT_LIGHT_SELECTION_POWER 0   /* one light, by emitted power; a point on it by area */
#define BDPT_LIGHT_SELECTION_UNIFORM 1 /* one light, every light alike */
#define BDPT_LIGHT_SELECTION_TREE 2    /* one light, or triangle of a light, by what it may send to the point: a tree of
                                          lights, for many of them. Infinite lights take half */
#define BDPT_LIGHT_SELECTION_EACH 3    /* every light in turn, at most 64 lights */

typedef int32_t bdpt_order;
#define BDPT_ORDER_METRIC 0  /* by the sum of the squares of a subpath's edges: Chaitanya et al. (2018), 4.2 */
#define BDPT_ORDER_HILBERT 1 /* by the place of the last vertex on a Hilbert curve */
#define BDPT_ORDER_NONE 2    /* as they were sampled */

typedef int32_t bdpt_partners;
#define BDPT_PARTNERS_SOBOL 0           /* a (0,2) sequence over the ordered matrix: neighbours differ */
#define BDPT_PARTNERS_LATIN_HYPERCUBE 1 /* Chaitanya et al. */

/* How the pooled plan chooses the light vertices that an eye vertex meets, among all of the pass. */
typedef int32_t bdpt_pool_selection;
#define BDPT_POOL_SELECTION_UNIFORM 0    /* each alike */
#define BDPT_POOL_SELECTION_IMPORTANCE 1 /* half by the light that arrives at them, half alike */
typedef int32_t bdpt_matrix_kind;
#define BDPT_MATRIX_PER_TECHNIQUE 0 /* one for each (s,t) */
#define BDPT_MATRIX_ALL_LENGTHS 1   /* one for all lengths, each row with as many columns as make about as many
                                       connections: Chaitanya et al. (2018), 7 */

typedef struct bdpt_render_desc {
  uint32_t struct_size;
  uint32_t max_edges;           /* longest path, k edges; 0 = no limit */
  uint64_t seed;
  uint64_t first_pass;          /* passes count up from here */
  uint32_t techniques[32];      /* bit t of techniques[s] allows (s,t); 31 stands for 31 and more, in both. All zero =
                                   all. Path tracing: [0] = [1] = ~0; light tracing: [s] = 3 for all s */
  bdpt_heuristic heuristic;
  float beta;                   /* power heuristic's exponent, (0, 64]; 0 = 2 */
  float cutoff;                 /* cutoff heuristic's threshold, [0,1] */
  bdpt_sampler sampler;
  uint32_t strata;              /* stratified: n, [1,256]; 0 = 4 */
  bdpt_light_start light_start;
  uint32_t roulette_start;      /* a subpath's first vertex at which Russian roulette may end it; 0 = 4; at least 1 */
  uint32_t block_size;          /* samples in a block of work, [1,65536]; 0 = chosen. Changes no bit of the result */
  const char *plan;             /* name of a connection plan, see bdpt_plan_name; NULL = "one-to-one" */
  uint32_t connections;         /* m: light vertices that each eye vertex meets (pooled; matrix: of each length),
                                   [1,1024]; 0 = the plan's own number, and all that other plans take */
  uint32_t light_samples;       /* light subpaths for each eye subpath, [1,1024]; 0 = 1, and all that mmlt and automatic
                                   take */
  uint32_t pool_passes;         /* matrix, mmlt, automatic: passes rendered at once, [1,64]; 0 = 8 (mmlt: 16).
                                   first_pass and the number of passes must be multiples of it */
  bdpt_order order;             /* matrix: how subpaths are put in order */
  bdpt_partners partners;       /* matrix: how light subpaths are chosen in that order */
  bdpt_shadow_roulette shadow_roulette;
  float shadow_threshold;       /* fixed roulette: in units of a pixel's value, above 0; else 0 */
  bdpt_light_selection light_selection; /* of direct lighting; light_start is how light subpaths start */
  uint32_t direct_samples;      /* points on lights that direct lighting takes at each eye vertex, with
                                   BDPT_LIGHT_SELECTION_EACH on each light; [1,64]; 0 = 1 */
  uint32_t direct_candidates;   /* each of them is chosen among so many by what it would contribute without shadows,
                                   [1,64]; 0 = 1 */
  bdpt_adaptive adaptive;       /* sampling of the image plane; none with mmlt */
  bdpt_pool_selection pool_selection; /* pooled: how light vertices are chosen; else 0 */
  uint32_t correlation_aware;   /* 1: the weights count connections that share an eye subpath as fewer than they are:
                                   Grittmann et al. (2021); one-to-one, pooled, matrix, combinatorial; costs time */
  uint32_t pool_pixels;         /* matrix: pixels of a pool, [16,65536], in a square whose side is rounded; 0 = 256. A
                                   worker holds a pool of pool_pixels x pool_passes samples: their memory is booked */
  bdpt_matrix_kind matrix;      /* matrix: one for each technique, or one for all */
  uint32_t reserved;            /* 0 */
} bdpt_render_desc;

/* Connection plans say which light vertices meet which eye vertices, s >= 2 and t >= 2; all plans measure the same.
 * one-to-one     an eye subpath and its own light subpath, every prefix with every suffix: Veach (1997), 10.1
 * two-way        none of them: s < 2 or t < 2, and nothing is stored of a path: Brown (2011)
 * pooled         every eye vertex and some of all light vertices of the pass: light vertex cache
 * matrix         every eye vertex and one light vertex of each length, stratified over pools of pool_passes passes in
 *                squares of pool_pixels: Chaitanya et al. (2018)
 * combinatorial  every pair within pools of 64 samples: Pajot et al. (2011); slow, to measure others by
 * mmlt           multiplexed Metropolis light transport, Hachisuka et al. (2014): Markov chains of paths, each of a pool
 *                of pool_passes passes in a square of 1024 pixels; a pass has as many mutations as it has pixels. Chains
 *                measure all over the film, so that its image is normalised by the number of samples, whatever the
 *                film's normalization. Unbiased; to compare with
 * automatic      path tracing, two-way, one-to-one or matrix in each square of 16 x 16 pixels, and 0, 1, 2 or 4 light
 *                subpaths for each eye subpath all over the image, as a short pilot at the start of the first call
 *                advises. All passes of a seed have the same choice; bdpt_render_stats tells it. As without bias as the
 *                other plans: what does not find all paths of this scene is not chosen
 * Returns: the name of plan number `index`; NULL past the last. Threads: any thread. Callbacks: allowed.
 * Ownership: the library's, for ever. */
BDPT_API const char *bdpt_plan_name(uint32_t index);
/* A line about plan number `index`. Returns: it; NULL past the last. Threads: any thread. Callbacks: allowed.
 * Ownership: the library's, for ever. */
BDPT_API const char *bdpt_plan_summary(uint32_t index);

/* Joins a scene, a sensor and a film. The film must be empty or have been filled with the same scene, sensor, options
 * and seed; it then goes on, and passes that it holds already are not rendered again. desc may be NULL. A technique
 * that the sensor cannot serve (t = 0 with a pinhole) or the plan does not do is dropped, the weights know of it, and
 * the log says so. Pooled plans trace some light subpaths at once, which count in the statistics, and book their pool's
 * memory.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _MISMATCH, _IN_USE (the film is in another render), _MEMORY_LIMIT,
 * _OUT_OF_MEMORY, _CALLBACK_FAILED (a texture of the host's). Threads: any thread. Callbacks: not for a film in use.
 * Ownership: the caller destroys the render; it keeps scene, sensor and film alive. */
BDPT_API BDPT_CHECK bdpt_result bdpt_render_create(bdpt_scene *scene, bdpt_sensor *sensor, bdpt_film *film,
                                                   const bdpt_render_desc *desc, bdpt_render **render);
/* Destroys a render; the film keeps its whole passes. Returns: nothing. Threads: one thread per object.
 * Callbacks: not for the render in use. Ownership: frees it; NULL is ignored. */
BDPT_API void bdpt_render_destroy(bdpt_render *render);

/* Receives the image of the whole passes so far, tile by tile: begin once, tile for each, end once with the result of
 * the sending. An image just sent is not sent again at the end of the call; after a callback that failed nothing is. */
typedef struct bdpt_output_sink {
  uint32_t struct_size;
  uint32_t every; /* send the image after every so many passes, and at the end of the call; 0 = only at the end */
  int32_t (*begin)(void *user, uint32_t width, uint32_t height, uint64_t passes); /* may be NULL */
  int32_t (*tile)(void *user, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1, const float *pixels);
      /* 3 floats to a pixel, packed; valid during the call only */
  void (*end)(void *user, bdpt_result result); /* may be NULL; called whenever begin was */
  void *user;
} bdpt_output_sink;

typedef struct bdpt_advance_desc {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t passes;              /* stop after so many passes; 0 = no such limit */
  double seconds;               /* stop at the first whole pass after this time; 0 = no such limit */
  double noise;                 /* stop when bdpt_film_info's relative_error is at most this; 0 = no such limit */
  bdpt_cancel *cancel;          /* may be NULL */
  bdpt_progress_fn progress;    /* may be NULL */
  void *progress_user;
  const bdpt_output_sink *sink; /* may be NULL */
} bdpt_advance_desc;

typedef int32_t bdpt_stop_reason;
#define BDPT_STOP_PASSES 0
#define BDPT_STOP_TIME 1
#define BDPT_STOP_NOISE 2
#define BDPT_STOP_CANCELLED 3
#define BDPT_STOP_CALLBACK 4

typedef struct bdpt_advance_report {
  uint32_t struct_size;
  bdpt_stop_reason reason;
  uint64_t passes;        /* whole passes finished by this call */
  uint64_t next_pass;     /* the first pass that is not finished */
  double seconds;
  double relative_error;  /* of the film now, where the call has a limit of noise; else, and while unknown, -1:
                             bdpt_film_info has it */
} bdpt_advance_report;

/* Samples passes until a limit is reached; the first one reached counts, and at least one must be set. It blocks, with
 * the caller's thread at work too. A cancelled call keeps the blocks that were finished; the next call completes the
 * pass, and the film is then what it would have been without the cancel.
 * Returns: BDPT_OK, BDPT_CANCELLED, BDPT_ERROR_INVALID_ARGUMENT, _CALLBACK_FAILED, _OUT_OF_MEMORY, _REENTRANT,
 * _MEMORY_LIMIT (a block's paths were so long that they took more than was booked; the pass in hand is lost).
 * report may be NULL; it is written when progress or sink failed, too. Threads: one thread per object, render and
 * film. Callbacks: not for the render in use.
 * Ownership: none. */
BDPT_API BDPT_CHECK bdpt_result bdpt_render_advance(bdpt_render *render, const bdpt_advance_desc *desc, bdpt_advance_report *report);

typedef struct bdpt_render_stats {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t passes;            /* whole passes by this render */
  uint64_t samples;           /* eye subpaths; as many light subpaths where light subpaths are traced. mmlt: one for each
                                 pixel and pass, whatever its chains trace */
  uint64_t eye_rays;          /* rays that extended an eye subpath */
  uint64_t light_rays;        /* rays that extended a light subpath */
  uint64_t shadow_rays;       /* rays that tested a connection */
  uint64_t shadow_rays_blocked;
  uint64_t connections;       /* connections weighed; those with nothing to carry cost no shadow ray */
  uint64_t rejected;          /* contributions not finite or too large, left out */
  double seconds;             /* inside bdpt_render_advance */
  double seconds_start;       /* thread-seconds by stage: first vertices */
  double seconds_extend;      /*   scattering and, with it, s = 0 and t = 0 */
  double seconds_extend_rays; /*   of which inside the ray queries */
  double seconds_connect;     /*   connections and their weights */
  double seconds_shadow;      /*   shadow rays */
  double seconds_accumulate;  /*   into the film */
  uint64_t shadow_rays_skipped; /* by the shadow rays' roulette */
  uint64_t mutations;         /* of Markov chains (mmlt): proposals, and how many became the state */
  uint64_t accepted;
  uint32_t light_samples;     /* light subpaths for each eye subpath; automatic: its choice */
  float share_path;           /* automatic, after its pilot: parts of the image by path tracing, */
  float share_two_way;        /*   two-way, */
  float share_one_to_one;     /*   one-to-one */
  float share_matrix;         /*   and matrix; together 1. Else all 0 */
  uint32_t reserved_2;
} bdpt_render_stats;

/* Tells what a render has done so far.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: one thread per object. Callbacks: allowed.
 * Ownership: copies into *stats. */
BDPT_API BDPT_CHECK bdpt_result bdpt_render_get_stats(const bdpt_render *render, bdpt_render_stats *stats);

typedef struct bdpt_technique_stats {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t contributions;       /* connections that carried light, before their visibility was known */
  uint64_t shadow_rays;
  uint64_t shadow_rays_blocked;
  uint64_t shadow_rays_skipped; /* by the shadow rays' roulette */
  double energy;                /* share of the sum of all contributions, [0,1] */
  double squares;               /* share of the sum of their squares, [0,1]: where noise comes from */
  double seconds;               /* thread-seconds of connecting and of shadow rays, in proportion to contributions and
                                   rays */
} bdpt_technique_stats;

/* Tells what technique (s,t) has done so far; 31 stands for 31 and more. Colours count by their largest channel.
 * During bdpt_render_advance, blocks that are not done are left out.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (s or t above 31, or no such technique: s + t < 2). Threads: one thread per
 * object. Callbacks: allowed. Ownership: copies into *stats. */
BDPT_API BDPT_CHECK bdpt_result bdpt_render_get_technique_stats(const bdpt_render *render, uint32_t s, uint32_t t,
                                                                bdpt_technique_stats *stats);

/* ---------------------------------------------------------------------------------------------------------------
 * Lightmaps: work on buffers. These need no context.
 *
 *   Atlas      Row 0 is the top, where v = 1: (u, v) is the point (u width, (1 - v) height) of the atlas. Texel (x, y)
 *              covers [x, x+1) x [y, y+1), its value sits at its centre, and lookups between centres are bilinear.
 *   Buffers    are the caller's, packed, row by row. A capacity is a buffer's size in bytes; one too small is refused.
 *   Not finite A texel with a value that is NaN or infinite is counted and has no value: it spreads to no other.
 *   The same input gives the same output to the bit. A call that fails has changed no buffer.
 */

/* A mesh in the world and in an atlas. An array's element: it will not grow, see the strides. */
typedef struct bdpt_uv_instance {
  const bdpt_mesh_desc *mesh; /* uv[1] is required, and read during the call only: no release is called. Triangles
                                 without area are allowed */
  float transform[12];        /* object to world, invertible; twelve zeros = identity */
  float uv_scale[2];          /* uv[1] times uv_scale */
  float uv_offset[2];         /*   plus uv_offset is the place in the atlas: that of [0,1] x [0,1] is the instance's
                                 rectangle. Two zeros for the scale = 1; a negative one turns it over */
  uint32_t atlas;             /* which atlas it is in, from 0 */
  uint32_t reserved;
} bdpt_uv_instance;

typedef struct bdpt_uv_check_desc {
  uint32_t struct_size;
  uint32_t instance_count;           /* at least 1 */
  const bdpt_uv_instance *instances;
  uint32_t instance_stride;          /* bytes from instance to instance; 0 = sizeof(bdpt_uv_instance) */
  uint32_t atlas;                    /* the one to look at: instances in others are passed over */
  uint32_t width, height;            /* of the atlas, 1 to 65536 texels, and at most 2^28 together */
  uint32_t padding_reach;            /* look for charts that are so many texels apart, [1,1024]; 0 = 16 */
  uint32_t reserved;
  uint64_t max_overlaps;             /* stop looking after so many pairs; 0 = 1,000,000 */
} bdpt_uv_check_desc;

/* Where bdpt_uv_check leaves its maps; each buffer may be NULL. */
typedef struct bdpt_uv_maps {
  uint32_t struct_size;
  uint32_t reserved;
  uint32_t *triangle_charts;         /* chart of each triangle, from 1, instance after instance; 0 in other atlases */
  uint64_t triangle_charts_capacity;
  uint32_t *texel_charts;            /* the chart with the largest part of the texel; 0 = none */
  uint64_t texel_charts_capacity;
  uint32_t *texel_claims;            /* how many charts touch the texel */
  uint64_t texel_claims_capacity;
  uint32_t *texel_overlaps;          /* how many pairs of triangles overlap in the texel */
  uint64_t texel_overlaps_capacity;
} bdpt_uv_maps;

typedef struct bdpt_uv_report {
  uint32_t struct_size;
  int32_t padding;               /* fewest free texels between two charts, along rows, columns or diagonals; 0 if charts
                                    touch or share a texel; -1 = no two charts within padding_reach */
  uint64_t triangles;
  uint64_t charts;               /* triangles of an instance are of one chart if they share a vertex: the same point in
                                    the world and in the atlas, whatever its index */
  uint64_t outside_rect;         /* triangles that leave their instance's rectangle by more than 1/1000 texel */
  uint64_t outside_atlas;        /*   and the atlas */
  uint64_t zero_area_uv;         /* triangles of less than a millionth of a texel */
  uint64_t zero_area_world;      /* triangles without area in the world, but for rounding */
  uint64_t mirrored;             /* triangles that show the atlas mirrored when seen from the front */
  uint64_t texels_claimed;       /* texels that a chart touches, further in than 1/1000 texel */
  uint64_t texels_shared;        /* texels that two charts or more touch: light leaks from one to the other */
  uint64_t overlaps_within;      /* pairs of triangles of one chart that share more than 1/1000 of the smaller one's area
                                    and more than 1/100000 texel: a chart that folds over */
  uint64_t overlaps_between;     /* pairs of triangles of two charts that do */
  double overlap_area_within;    /* what they share, texels, added up over the pairs */
  double overlap_area_between;
  float density_min;             /* texels per world unit: root of the ratio of areas, over triangles that have both; */
  float density_mean;            /*   of the sums of both areas; */
  float density_max;             /*   all 0 where no triangle has */
  uint32_t overlaps_cut;         /* 1: there are more pairs than max_overlaps */
} bdpt_uv_report;

/* Tells what is wrong with the lightmap coordinates of an atlas, and what they are like. maps may be NULL.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for triangles that cover the atlas more than 256 times: coordinates that
 * are not for lightmaps), _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: reads the meshes during the call; writes *report and the maps. */
BDPT_API BDPT_CHECK bdpt_result bdpt_uv_check(const bdpt_uv_check_desc *desc, const bdpt_uv_maps *maps, bdpt_uv_report *report);

typedef struct bdpt_lightmap_dilate_desc {
  uint32_t struct_size;
  uint32_t width, height;   /* 1 to 65536 texels, and at most 2^28 together */
  uint32_t channels;        /* floats to a texel, 1 to 4096 */
  uint32_t steps;           /* rings of texels to fill; 0 = 4. Bilinear lookups need 1, bicubic ones 2, m mipmaps 2^m,
                               blocks of 4 x 4 need 4 */
  uint32_t reserved;
  float *pixels;
  uint64_t pixels_capacity;
  uint8_t *mask;            /* a byte to a texel: 0 = no value. Becomes 1 where one is filled in, and 0 where the value
                               that was there is not finite and is not replaced */
  uint64_t mask_capacity;
  uint32_t *charts;         /* chart of each texel: values spread within their chart only. A texel without value that
                               is of chart 0 takes the chart of most of its neighbours, the lowest of equals. NULL = no
                               difference is made */
  uint64_t charts_capacity;
} bdpt_lightmap_dilate_desc;

typedef struct bdpt_lightmap_dilate_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t filled;     /* texels */
  uint64_t not_finite; /* texels that had a value by the mask, but not a finite one */
  uint64_t left;       /* texels that are still without a value */
} bdpt_lightmap_dilate_report;

/* Fills gutters, in place: in each step every texel without a value that has neighbours with one, among the eight round
 * it, takes their mean in every channel. report may be NULL.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: writes pixels, mask, charts and *report. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_dilate(const bdpt_lightmap_dilate_desc *desc, bdpt_lightmap_dilate_report *report);

/* An atlas' pixels. An array's element: it will not grow. */
typedef struct bdpt_lightmap_image {
  float *pixels;          /* channels floats to a texel */
  uint64_t capacity;
  const uint8_t *mask;    /* a byte to a texel: 0 = no value; NULL = all have one */
  uint64_t mask_capacity;
  uint32_t width, height; /* 1 to 65536 texels, and at most 2^28 together */
} bdpt_lightmap_image;

typedef struct bdpt_lightmap_seams_desc {
  uint32_t struct_size;
  uint32_t instance_count;           /* at least 1 */
  const bdpt_uv_instance *instances;
  uint32_t instance_stride;          /* bytes from instance to instance; 0 = sizeof(bdpt_uv_instance) */
  uint32_t image_count;              /* at least 1 */
  const bdpt_lightmap_image *images; /* instances name them by their atlas */
  uint32_t image_stride;             /* bytes from image to image; 0 = sizeof(bdpt_lightmap_image) */
  uint32_t channels;                 /* of all images, 1 to 4096 */
  float position_tolerance;          /* world units along each axis, within which two corners are one; 0 = 1/100000 of
                                        the diagonal of all that is there */
  float angle;                       /* normals of both sides that differ by more leave the edge as it is, [0,180]
                                        degrees; 0 = 15. Of vertices where the mesh has normals, else of triangles */
  float lambda;                      /* how much texels resist: the less, the closer the two sides get, (0, 1e6];
                                        0 = 0.01 */
  uint32_t max_iterations;           /* of conjugate gradients, for each channel; 0 = 1000 */
} bdpt_lightmap_seams_desc;

typedef struct bdpt_lightmap_seams_report {
  uint32_t struct_size;
  uint32_t iterations;      /* the most that a channel took */
  uint64_t seams;           /* edges that are one in the world and two in the atlas */
  uint64_t samples;         /* points along them where both sides were compared */
  uint64_t samples_skipped; /* points left out: outside the atlas, or beside a texel without a value: dilate first */
  uint64_t not_finite;      /* texels near seams that have a value by the mask, but not a finite one */
  uint64_t texels;          /* that were free to change */
  double error_before;      /* root of the mean square difference of the two sides, over samples and channels */
  double error_after;
  uint32_t converged;       /* 0: max_iterations was reached in a channel; what it had is kept */
  uint32_t reserved;
} bdpt_lightmap_seams_report;

/* Makes the two sides of every seam agree, within and between meshes, instances and atlases, in place: the texels T that
 * bilinear lookups along seams read minimise  sum w (B_a T - B_b T)² + lambda |T - T_0|²  over samples half a texel
 * apart, w being the length they stand for in texels, B_a T and B_b T the lookups on both sides, T_0 the values given.
 * All other texels keep their bits. Edges are joined whole, corner to corner. report may be NULL.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: reads the meshes during the call; writes pixels and *report. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_fix_seams(const bdpt_lightmap_seams_desc *desc, bdpt_lightmap_seams_report *report);

/* Encodings, each of a texel:
 * HALF      channels 16-bit floats, rounded to nearest; clipped to +-65504
 * RGBM      4 bytes R, G, B, M of an RGB colour: range M/255 (R, G, B)/255; clipped to [0, range], of which each channel
 *           keeps an error of at most 1/510 of range M/255
 * RGBD      4 bytes R, G, B, D of an RGB colour, D at least 1: range/D (R, G, B)/255; clipped to [0, range]; an error of
 *           at most 1/510 of range/D, so of 1/255 of the largest channel where that is at least range/255
 * The others take coefficients c of spherical harmonics, RGB each, in the order 1; y, z, x; xy, yz, 3z²-1, xz, x²-y²
 * with the factors 0.282095; 0.488603; 1.092548, 1.092548, 0.315392, 1.092548, 0.546274. They give 32-bit floats that
 * say what the irradiance E(n) is for a surface of normal n; E is in W/m², not divided by pi:
 * DOMINANT  7 floats from 4 coefficients: E(d) as RGB, by bands 0 and 1; d, the direction of the luminance's band 1, or
 *           zeros; s, how much of the light comes from there: 0 if it is even, 1 if all does
 * MONO_SH   6 floats from 4 coefficients: E_0, the mean of E(n) over all directions, as RGB; v, of the luminance,
 *           clipped to |v| <= 1: E(n) = E_0 (1 + 2 v·n), which is what bands 0 and 1 say where the light is grey
 * H4, H6    4 or 6 RGB coefficients, from 9 in the surface's own frame (z is its normal): E(n) = sum h_i H_i(n) for
 *           n_z >= 0, with H = (1/2pi)^½; (3/2pi)^½ times y, 2z-1, x; (15/2pi)^½ times xy, (x²-y²)/2: the basis of
 *           Habel and Wimmer (2010), orthonormal on the hemisphere; the fit is that of least squares there */
typedef int32_t bdpt_lightmap_encoding;
#define BDPT_LIGHTMAP_ENCODING_HALF 0
#define BDPT_LIGHTMAP_ENCODING_RGBM 1
#define BDPT_LIGHTMAP_ENCODING_RGBD 2
#define BDPT_LIGHTMAP_ENCODING_DOMINANT 3
#define BDPT_LIGHTMAP_ENCODING_MONO_SH 4
#define BDPT_LIGHTMAP_ENCODING_H4 5
#define BDPT_LIGHTMAP_ENCODING_H6 6

typedef int32_t bdpt_sh;
#define BDPT_SH_RADIANCE 0   /* c_lm = integral of L Y_lm over directions; E(n) = sum A_l c_lm Y_lm(n) with A = pi,
                                2pi/3, pi/4 */
#define BDPT_SH_IRRADIANCE 1 /* those times A_l: E(n) = sum c_lm Y_lm(n) */

typedef struct bdpt_lightmap_encode_desc {
  uint32_t struct_size;
  bdpt_lightmap_encoding encoding;
  bdpt_sh sh;               /* what the coefficients are; 0 where there are none */
  uint32_t channels;        /* HALF: floats to a texel, 1 to 4096; else 0 */
  uint64_t texels;          /* 1 to 2^32 */
  const float *pixels;
  uint64_t pixels_capacity;
  uint64_t texel_stride;    /* floats from texel to texel; 0 = packed; at most 65536 */
  uint64_t plane_stride;    /* coefficients: floats from one of a texel to its next, 3 to 2^40; 0 = 3. Three times
                               texels for images behind one another, each of one coefficient; else 0 */
  void *encoded;            /* packed; aligned to 2 bytes for HALF, to 4 for floats; does not overlap pixels */
  uint64_t encoded_capacity;
  float range;              /* RGBM: 0 = 8; RGBD: 0 = 255; else 0 */
  uint32_t reserved;
} bdpt_lightmap_encode_desc;

typedef struct bdpt_lightmap_encode_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t clipped;    /* texels with a value that was clipped */
  uint64_t not_finite; /* texels with a value that is not finite: encoded as 0 in all channels */
} bdpt_lightmap_encode_report;

/* Encodes texels. report may be NULL.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed.
 * Ownership: reads pixels, writes encoded and *report. */
BDPT_API BDPT_CHECK bdpt_result bdpt_lightmap_encode(const bdpt_lightmap_encode_desc *desc, bdpt_lightmap_encode_report *report);

/* ---------------------------------------------------------------------------------------------------------------
 * Images: display transform and files. These need no context.
 */

typedef int32_t bdpt_view;
#define BDPT_VIEW_SRGB 0 /* the sRGB curve, clipped: what numbers look like */
#define BDPT_VIEW_ACES 1 /* ACES 1.0 SDR video output transform: highlights roll off */
#define BDPT_VIEW_OCIO 2 /* a display and view of a configuration file */

typedef struct bdpt_display_desc {
  uint32_t struct_size;
  bdpt_view view;
  float exposure;          /* stops; the pixels are multiplied by 2^exposure first */
  uint32_t reserved;
  const char *config;      /* BDPT_VIEW_OCIO: path of a configuration; NULL = that of context, which must have one */
  const char *color_space; /* BDPT_VIEW_OCIO: of the pixels, a name that the configuration has; NULL = the rendering
                              space of context; without one, the role scene_linear, which in many configurations is not
                              Rec. 709 */
  const char *display;     /* BDPT_VIEW_OCIO: NULL = the configuration's default */
  const char *ocio_view;   /* BDPT_VIEW_OCIO: NULL = the display's default */
  const bdpt_context *context; /* whose rendering space the pixels are in; NULL = linear Rec. 709 */
} bdpt_display_desc;

/* Turns linear pixels (3 floats each, packed) into display values in [0,1], in place, by OpenColorIO. What is not a
 * number counts as 0. desc may be NULL for sRGB.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for names the configuration does not have), _IO (no such configuration, or
 * a table of it is missing), _FORMAT (a damaged one).
 * Threads: any thread. Callbacks: allowed. Ownership: writes pixels. */
BDPT_API BDPT_CHECK bdpt_result bdpt_image_display(const bdpt_display_desc *desc, float *pixels, uint32_t width, uint32_t height);

/* How a photographer exposes. */
typedef struct bdpt_exposure_desc {
  uint32_t struct_size;
  float iso;          /* 1 to 1e7; 0 = 100 */
  float shutter_time; /* seconds, 1e-7 to 1e7 */
  float f_number;     /* 0.1 to 1000 */
  float ev100;        /* instead of the three above, which then are 0: the exposure value at ISO 100, -64 to 64 */
  uint32_t reserved;
} bdpt_exposure_desc;

/* The exposure for bdpt_display_desc.exposure, in stops: for pictures whose numbers are luminances in candela per square
 * metre (lights in lux, candela or nit). What is brighter than 1.2 2^EV100, EV100 = log2(f_number^2 / shutter_time 100 /
 * iso), goes beyond white: ISO 12232 by saturation, for a lens that lets 0.65 of the light through. Films hold
 * radiance, whatever the exposure.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT. Threads: any thread. Callbacks: allowed. Ownership: writes *stops. */
BDPT_API BDPT_CHECK bdpt_result bdpt_exposure_stops(const bdpt_exposure_desc *desc, float *stops);

/* --- Denoising, by Open Image Denoise, if its library (libOpenImageDenoise, version 1.4 or 2) is there at run time --- */

/* Whether it is there: 1 or 0; the first call looks for it. Returns: that. Threads: any thread. Callbacks: allowed.
 * Ownership: none. */
BDPT_API int32_t bdpt_has_denoiser(void);

/* Images of 3 floats to a pixel, packed, row 0 the top. The denoiser takes neighbouring pixels' noise for independent,
 * which a filter that spreads samples over several pixels makes untrue: feed it planes with `unfiltered`, or those of a
 * film with the box filter of half a pixel. RADIANCE with the light image is right (t <= 1 falls into one pixel each). */
typedef struct bdpt_denoise_desc {
  uint32_t struct_size;
  uint32_t width, height;
  uint32_t clean;      /* 1: albedo and normal are free of noise, and every detail of them is kept; 0: they are noisy */
  const float *color;  /* linear radiance, any range; as BDPT_OUTPUT_RADIANCE */
  const float *albedo; /* as BDPT_OUTPUT_ALBEDO, or NULL */
  const float *normal; /* as BDPT_OUTPUT_NORMAL, or NULL; needs albedo */
  float *output;       /* may be color */
  uint32_t threads;    /* 0 = one per core; they are the denoiser's own */
  uint32_t reserved;
} bdpt_denoise_desc;

/* Removes the noise of a picture, on the processor. What it makes is a guess: biased, and pleasing.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _UNSUPPORTED (Open Image Denoise is not there, or too old), _OUT_OF_MEMORY,
 * _INTERNAL (it failed; the message is its own). Threads: any thread. Callbacks: not allowed.
 * Ownership: reads color, albedo and normal, writes output. */
BDPT_API BDPT_CHECK bdpt_result bdpt_denoise(const bdpt_denoise_desc *desc);

/* One layer of an image file: 3 floats to a pixel, packed, row 0 the top. */
typedef struct bdpt_image_layer {
  const char *name;    /* NULL or "" for the main one, channels R, G, B; else name.R, name.G, name.B */
  const float *pixels;
} bdpt_image_layer;

typedef struct bdpt_exr_desc {
  uint32_t struct_size;
  uint32_t width, height;
  uint32_t layer_count;           /* at least 1 */
  const bdpt_image_layer *layers; /* layer_count of them */
  uint32_t half;                  /* 1: 16-bit floats, finite values clipped to +-65504; 0: 32-bit */
  uint32_t layer_stride;          /* bytes from layer to layer; 0 = sizeof(bdpt_image_layer) */
  const bdpt_chromaticities *chromaticities; /* of the pixels, written beside them; NULL = Rec. 709. A film's are those
                                                of bdpt_color_info */
} bdpt_exr_desc;

/* Writes an OpenEXR file (scanlines, ZIP), first under another name, so that path holds the old file or the new one.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT, _IO, _OUT_OF_MEMORY. Threads: any thread. Callbacks: allowed.
 * Ownership: reads pixels. */
BDPT_API BDPT_CHECK bdpt_result bdpt_image_write_exr(const char *path, const bdpt_exr_desc *desc);

/* Writes display values as an 8-bit PNG, in the same safe way. Values are clipped to [0,1] and rounded.
 * Returns: BDPT_ERROR_INVALID_ARGUMENT (also for a value that is not a number), _IO, _OUT_OF_MEMORY.
 * Threads: any thread. Callbacks: allowed. Ownership: reads pixels. */
BDPT_API BDPT_CHECK bdpt_result bdpt_image_write_png(const char *path, const float *pixels, uint32_t width, uint32_t height);

#ifdef __cplusplus
}
#endif

#endif /* BDPT_H */
