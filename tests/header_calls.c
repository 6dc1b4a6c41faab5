/* Calls every function of bdpt.h from C, built without optimisation, so that each must really be there to be linked,
 * and prints the name of each; tests/header_test.sh compares these with the header. With NULL for all that is asked
 * for, each has a defined answer.
 * SPDX-License-Identifier: Apache-2.0 */
#include <bdpt.h>
#include <stdio.h>
#include <string.h>

static int failures;

static void called(const char* name, int as_expected) {
  puts(name);
  if (!as_expected) {
    ++failures;
    fprintf(stderr, "%s does not answer as it should: %s\n", name, bdpt_last_error());
  }
}

/* NULL is refused, and the text names the function. */
#define REFUSED(function, arguments)                                     \
  called(#function, function arguments == BDPT_ERROR_INVALID_ARGUMENT && \
                        strncmp(bdpt_last_error(), #function, strlen(#function)) == 0)
/* NULL is ignored. */
#define IGNORED(function, arguments) (function arguments, called(#function, 1))
#define ANSWERS(function, arguments, condition) called(#function, function arguments condition)

static void errors_and_context(void) {
  ANSWERS(bdpt_version, (), > 0);
  ANSWERS(bdpt_abi_version, (), == BDPT_ABI);
  ANSWERS(bdpt_last_error, (), [0] == '\0');
  ANSWERS(bdpt_result_name, (BDPT_OK), != NULL);
  REFUSED(bdpt_context_create, (BDPT_ABI, NULL, NULL));
  IGNORED(bdpt_context_retain, (NULL));
  IGNORED(bdpt_context_release, (NULL));
  REFUSED(bdpt_context_get_info, (NULL, NULL));
  REFUSED(bdpt_color_get_info, (NULL, NULL));
  REFUSED(bdpt_color_convert, (NULL, NULL, NULL, NULL, 1));
  REFUSED(bdpt_color_convert_chromaticities, (NULL, NULL, NULL, 1));
  REFUSED(bdpt_cancel_create, (NULL));
  IGNORED(bdpt_cancel_retain, (NULL));
  IGNORED(bdpt_cancel_release, (NULL));
  IGNORED(bdpt_cancel_request, (NULL));
  IGNORED(bdpt_cancel_reset, (NULL));
  ANSWERS(bdpt_cancel_is_requested, (NULL), == 0);
}

static void scene(void) {
  const bdpt_shape_id shape = {1};
  const bdpt_texture_id texture = {1};
  const bdpt_medium_id medium = {1};
  const bdpt_material_id material = {1};
  const bdpt_light_id light = {1};
  const bdpt_instance_id instance = {1};
  REFUSED(bdpt_builder_create, (NULL, NULL));
  IGNORED(bdpt_builder_destroy, (NULL));
  REFUSED(bdpt_mesh_add, (NULL, NULL, NULL));
  REFUSED(bdpt_sphere_add, (NULL, NULL, NULL));
  REFUSED(bdpt_curves_add, (NULL, NULL, NULL));
  REFUSED(bdpt_subdivision_add, (NULL, NULL, NULL));
  REFUSED(bdpt_shape_remove, (NULL, shape));
  REFUSED(bdpt_texture_add, (NULL, NULL, NULL));
  REFUSED(bdpt_host_texture_add, (NULL, NULL, NULL));
  REFUSED(bdpt_texture_remove, (NULL, texture));
  REFUSED(bdpt_medium_add, (NULL, NULL, NULL));
  REFUSED(bdpt_medium_update, (NULL, medium, NULL));
  REFUSED(bdpt_medium_remove, (NULL, medium));
  REFUSED(bdpt_material_add, (NULL, NULL, NULL));
  REFUSED(bdpt_material_update, (NULL, material, NULL));
  REFUSED(bdpt_material_remove, (NULL, material));
  REFUSED(bdpt_metal_find, (NULL, NULL, NULL));
  REFUSED(bdpt_light_add, (NULL, NULL, NULL));
  REFUSED(bdpt_light_update, (NULL, light, NULL));
  REFUSED(bdpt_light_remove, (NULL, light));
  REFUSED(bdpt_sky_fill, (NULL, NULL, 0));
  REFUSED(bdpt_instance_add, (NULL, NULL, NULL));
  REFUSED(bdpt_instance_update, (NULL, instance, NULL));
  REFUSED(bdpt_instance_remove, (NULL, instance));
  REFUSED(bdpt_scene_build, (NULL, NULL, NULL));
  IGNORED(bdpt_scene_retain, (NULL));
  IGNORED(bdpt_scene_release, (NULL));
  REFUSED(bdpt_scene_get_info, (NULL, NULL));
  REFUSED(bdpt_scene_get_light, (NULL, 0, NULL));
}

static void sensors(void) {
  REFUSED(bdpt_camera_create, (NULL, NULL, NULL));
  REFUSED(bdpt_sensor_get_plane, (NULL, 0, NULL));
  REFUSED(bdpt_lightmap_create, (NULL, NULL, NULL));
  REFUSED(bdpt_lightmap_get_info, (NULL, NULL));
  REFUSED(bdpt_lightmap_read_texels, (NULL, NULL, NULL, 0));
  REFUSED(bdpt_lightmap_read_buried, (NULL, NULL, 0));
  REFUSED(bdpt_points_create, (NULL, NULL, NULL));
  REFUSED(bdpt_vertices_create, (NULL, NULL, NULL));
  REFUSED(bdpt_vertices_read_areas, (NULL, NULL, 0));
  REFUSED(bdpt_vertices_solve, (NULL, 1, NULL, 0));
  REFUSED(bdpt_custom_create, (NULL, NULL, NULL));
  IGNORED(bdpt_sensor_retain, (NULL));
  IGNORED(bdpt_sensor_release, (NULL));
}

static void film_and_render(void) {
  REFUSED(bdpt_film_create, (NULL, NULL, NULL));
  IGNORED(bdpt_film_retain, (NULL));
  IGNORED(bdpt_film_release, (NULL));
  REFUSED(bdpt_film_estimate, (NULL, NULL, NULL));
  REFUSED(bdpt_lightmap_estimate, (NULL, NULL, NULL, 0, NULL));
  REFUSED(bdpt_film_get_info, (NULL, NULL));
  REFUSED(bdpt_film_read, (NULL, NULL, NULL, 0));
  REFUSED(bdpt_film_read_coverage, (NULL, NULL, NULL, 0, NULL));
  REFUSED(bdpt_film_clear, (NULL));
  REFUSED(bdpt_film_merge, (NULL, NULL));
  REFUSED(bdpt_film_save, (NULL, NULL));
  REFUSED(bdpt_film_load, (NULL, NULL, NULL));
  ANSWERS(bdpt_plan_name, (0), != NULL);
  ANSWERS(bdpt_plan_summary, (UINT32_MAX), == NULL);
  REFUSED(bdpt_render_create, (NULL, NULL, NULL, NULL, NULL));
  IGNORED(bdpt_render_destroy, (NULL));
  REFUSED(bdpt_render_advance, (NULL, NULL, NULL));
  REFUSED(bdpt_render_get_stats, (NULL, NULL));
  REFUSED(bdpt_render_get_technique_stats, (NULL, 1, 1, NULL));
}

static void buffers(void) {
  REFUSED(bdpt_uv_check, (NULL, NULL, NULL));
  REFUSED(bdpt_lightmap_dilate, (NULL, NULL));
  REFUSED(bdpt_lightmap_fix_seams, (NULL, NULL));
  REFUSED(bdpt_lightmap_encode, (NULL, NULL));
  REFUSED(bdpt_image_display, (NULL, NULL, 1, 1));
  REFUSED(bdpt_exposure_stops, (NULL, NULL));
  ANSWERS(bdpt_has_denoiser, (), >= 0);
  REFUSED(bdpt_denoise, (NULL));
  REFUSED(bdpt_image_write_exr, (NULL, NULL));
  REFUSED(bdpt_image_write_png, (NULL, NULL, 1, 1));
}

int main(void) {
  errors_and_context();
  scene();
  sensors();
  film_and_render();
  buffers();
  return failures != 0;
}
