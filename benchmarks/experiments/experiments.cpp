// SPDX-License-Identifier: Apache-2.0
#include "experiment.h"

#include "rows/rows.h"

namespace bdpt_experiments {
namespace {

const Experiment kExperiments[] = {
    {"veach-10.3", "Veach (1997), 10.5", "The room with the glass egg",
     "In the same time bidirectional path tracing (25 samples a pixel) shows far less noise than path tracing (56).",
     veach_egg_room},
    {"veach-10.4", "Veach (1997), 10.4", "Russian roulette on shadow rays",
     "Efficiency-optimised roulette has the highest efficiency, without a threshold picked by hand.", veach_roulette},
    {"veach-10.7", "Veach (1997), 10.7", "A lit patch that shrinks",
     "The variance of path tracing grows without bound as the directly lit part of the ceiling shrinks; that of "
     "bidirectional path tracing hardly changes.",
     veach_shrinking_patch},
    {"adamsen-14", "Adamsen (2009), 8", "Cornell box, light down and turned up",
     "Light down: bidirectional path tracing is a little noisier in the same time. Light up: it is unchanged, and path "
     "tracing far worse.",
     adamsen_light_up},
    {"adamsen-15", "Adamsen (2009), 8", "Cornell box with a glass sphere",
     "Bidirectional path tracing shows a clean caustic where path tracing in the same time shows noise.",
     adamsen_glass_sphere},
    {"matrix-4", "Chaitanya et al. (2018), 4", "The connection matrix as a picture",
     "Ordered by the metric the matrix is far smoother than as sampled.", matrix_picture},
    {"matrix-5", "Chaitanya et al. (2018), 6", "Cornell box, technique by technique",
     "Matrix beats bidirectional path tracing where inner vertices are joined, and ties at t = 1.", matrix_techniques},
    {"matrix-7", "Chaitanya et al. (2018), 6", "A door ajar and ten lamps in vain",
     "Matrix reaches the same error 2 to 3 times faster than bidirectional path tracing, and before MMLT.",
     matrix_door},
    {"matrix-10", "Chaitanya et al. (2018), 6", "Stacked houses",
     "Matrix reaches the same error 2 to 3 times faster than bidirectional path tracing, and before MMLT.",
     matrix_houses},
    {"matrix-11", "Chaitanya et al. (2018), 7", "The room with the glass egg",
     "Matrix is on a par with bidirectional path tracing; MMLT does not outperform it.", matrix_egg_room},
    {"matrix-12", "Chaitanya et al. (2018), 7", "A bathroom, with more connections",
     "More light vertices m for each eye vertex correlate, and lose.", matrix_connections},
    {"two-way-1", "Brown (2011)", "Spheres under a small lamp", "Caustics are clean at about the cost of path tracing.",
     two_way_spheres},
    {"two-way-2", "Brown (2011)", "The floor of a Cornell box as a lightmap",
     "All four techniques of each path length contribute.", two_way_lightmap},
    {"two-way-3", "Brown (2011)", "Meshes under a small lamp", "Caustics are clean at about the cost of path tracing.",
     two_way_meshes},
    {"course-1", "course project", "A box with two spheres",
     "In the same time bidirectional path tracing is less noisy than path tracing, most so with the lights occluded.",
     course_two_spheres},
    {"course-2", "course project", "Direct light and its weights",
     "Multiple importance sampling removes the noise that averaging the techniques adds.", course_weights},
    {"own-plans", "this library", "Every plan on every scene", "No paper tells which plan to pick.", own_plans},
    {"own-adaptive", "this library", "More samples where the noise is", "", own_adaptive},
    {"own-light-start", "this library", "Light subpaths by importance",
     "Veach (1997), 10.7: light subpaths that start where they matter to the picture.", own_light_start},
    {"own-pool", "this library", "Pools: vertices by importance, weights that know of correlation",
     "Grittmann et al. (2021): weights should count samples that share a subpath as fewer.", own_pool},
    {"own-lights", "this library", "From one lamp to 10,000", "", own_lights},
    {"own-triangles", "this library", "From ten thousand triangles to 50 million", "", own_triangles},
    {"own-pixels", "this library", "Small pictures and large", "", own_pixels},
    {"own-threads", "this library", "Threads", "", own_threads},
    {"own-length", "this library", "Short paths and long", "", own_length},
    {"own-automatic", "this library", "The plan that chooses",
     "The automatic plan has at least 0.95 of the efficiency of the best plan it may choose, on every scene.",
     own_automatic},
    {"own-bake", "this library", "Lightmaps by plans",
     "Plans with light subpaths have at least 5 times the efficiency of eye-only baking where light comes through a "
     "gap, "
     "50 times in a caustic; the automatic plan has 0.95 of it where eye-only baking is best.",
     own_bake},
};

}  // namespace

std::span<const Experiment> experiments() { return kExperiments; }

}  // namespace bdpt_experiments
