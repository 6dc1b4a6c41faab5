// The functions of the table in experiments.cpp, a file for each paper.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

namespace bdpt_experiments {

void veach_egg_room(Report& report);
void veach_shrinking_patch(Report& report);
void veach_roulette(Report& report);

void adamsen_light_up(Report& report);
void adamsen_glass_sphere(Report& report);

void matrix_picture(Report& report);
void matrix_techniques(Report& report);
void matrix_door(Report& report);
void matrix_houses(Report& report);
void matrix_egg_room(Report& report);
void matrix_connections(Report& report);

void two_way_spheres(Report& report);
void two_way_meshes(Report& report);
void two_way_lightmap(Report& report);

void course_two_spheres(Report& report);
void course_weights(Report& report);

void own_lights(Report& report);
void own_triangles(Report& report);
void own_pixels(Report& report);
void own_threads(Report& report);
void own_length(Report& report);
void own_automatic(Report& report);
void own_plans(Report& report);
void own_adaptive(Report& report);
void own_light_start(Report& report);
void own_pool(Report& report);
void own_bake(Report& report);

}  // namespace bdpt_experiments
