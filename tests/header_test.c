/* Compiled, never run: bdpt.h is a complete header in C99 and later and C++98 and later, needs no other include before
 * it, and its structs have the sizes and offsets that other languages rely on. */
#include <bdpt.h>

#include <bdpt.h> /* twice does no harm */

#define HOLDS(name, condition) typedef char name[(condition) ? 1 : -1]

HOLDS(ids_are_64_bits, sizeof(bdpt_shape_id) == 8 && sizeof(bdpt_texture_id) == 8 && sizeof(bdpt_material_id) == 8 &&
                           sizeof(bdpt_light_id) == 8 && sizeof(bdpt_instance_id) == 8 && sizeof(bdpt_medium_id) == 8);
HOLDS(enums_are_32_bits, sizeof(bdpt_result) == 4 && sizeof(bdpt_view) == 4 && sizeof(bdpt_layer) == 4);

/* Every struct that is passed by pointer begins with its size. */
HOLDS(executor_size_first, offsetof(bdpt_executor, struct_size) == 0);
HOLDS(log_size_first, offsetof(bdpt_log, struct_size) == 0);
HOLDS(context_desc_size_first, offsetof(bdpt_context_desc, struct_size) == 0);
HOLDS(context_info_size_first, offsetof(bdpt_context_info, struct_size) == 0);
HOLDS(color_info_size_first, offsetof(bdpt_color_info, struct_size) == 0);
HOLDS(progress_size_first, offsetof(bdpt_progress, struct_size) == 0);
HOLDS(mesh_desc_size_first, offsetof(bdpt_mesh_desc, struct_size) == 0);
HOLDS(sphere_desc_size_first, offsetof(bdpt_sphere_desc, struct_size) == 0);
HOLDS(texture_desc_size_first, offsetof(bdpt_texture_desc, struct_size) == 0);
HOLDS(texture_use_size_first, offsetof(bdpt_texture_use, struct_size) == 0);
HOLDS(medium_desc_size_first, offsetof(bdpt_medium_desc, struct_size) == 0);
HOLDS(material_desc_size_first, offsetof(bdpt_material_desc, struct_size) == 0);
HOLDS(light_desc_size_first, offsetof(bdpt_light_desc, struct_size) == 0);
HOLDS(instance_desc_size_first, offsetof(bdpt_instance_desc, struct_size) == 0);
HOLDS(build_desc_size_first, offsetof(bdpt_build_desc, struct_size) == 0);
HOLDS(scene_info_size_first, offsetof(bdpt_scene_info, struct_size) == 0);
HOLDS(scene_light_size_first, offsetof(bdpt_scene_light, struct_size) == 0);
HOLDS(plane_info_size_first, offsetof(bdpt_plane_info, struct_size) == 0);
HOLDS(memory_estimate_size_first, offsetof(bdpt_memory_estimate, struct_size) == 0);
HOLDS(camera_desc_size_first, offsetof(bdpt_camera_desc, struct_size) == 0);
HOLDS(film_desc_size_first, offsetof(bdpt_film_desc, struct_size) == 0);
HOLDS(film_info_size_first, offsetof(bdpt_film_info, struct_size) == 0);
HOLDS(read_desc_size_first, offsetof(bdpt_read_desc, struct_size) == 0);
HOLDS(render_desc_size_first, offsetof(bdpt_render_desc, struct_size) == 0);
HOLDS(output_sink_size_first, offsetof(bdpt_output_sink, struct_size) == 0);
HOLDS(advance_desc_size_first, offsetof(bdpt_advance_desc, struct_size) == 0);
HOLDS(advance_report_size_first, offsetof(bdpt_advance_report, struct_size) == 0);
HOLDS(render_stats_size_first, offsetof(bdpt_render_stats, struct_size) == 0);
HOLDS(uv_check_desc_size_first, offsetof(bdpt_uv_check_desc, struct_size) == 0);
HOLDS(uv_maps_size_first, offsetof(bdpt_uv_maps, struct_size) == 0);
HOLDS(uv_report_size_first, offsetof(bdpt_uv_report, struct_size) == 0);
HOLDS(lightmap_dilate_desc_size_first, offsetof(bdpt_lightmap_dilate_desc, struct_size) == 0);
HOLDS(lightmap_dilate_report_size_first, offsetof(bdpt_lightmap_dilate_report, struct_size) == 0);
HOLDS(lightmap_seams_desc_size_first, offsetof(bdpt_lightmap_seams_desc, struct_size) == 0);
HOLDS(lightmap_seams_report_size_first, offsetof(bdpt_lightmap_seams_report, struct_size) == 0);
HOLDS(lightmap_encode_desc_size_first, offsetof(bdpt_lightmap_encode_desc, struct_size) == 0);
HOLDS(lightmap_encode_report_size_first, offsetof(bdpt_lightmap_encode_report, struct_size) == 0);
HOLDS(display_desc_size_first, offsetof(bdpt_display_desc, struct_size) == 0);
HOLDS(exr_desc_size_first, offsetof(bdpt_exr_desc, struct_size) == 0);

/* What version 1 did not have follows it, without a hole. */
HOLDS(mesh_desc_grows_at_its_end, offsetof(bdpt_mesh_desc, colors) == 296);
HOLDS(texture_desc_grows_at_its_end, offsetof(bdpt_texture_desc, mip_levels) == 48);
HOLDS(material_desc_grows_at_its_end, offsetof(bdpt_material_desc, textures) == 96);
HOLDS(build_desc_grows_at_its_end, offsetof(bdpt_build_desc, medium) == 32);

/* Results go into variables of the header's own types, without a cast. */
bdpt_result check(bdpt_context **context);
bdpt_result check(bdpt_context **context) {
  bdpt_context_desc desc;
  desc.struct_size = sizeof desc;
  desc.isa = BDPT_ISA_BEST;
  return bdpt_context_create(BDPT_ABI, &desc, context);
}
