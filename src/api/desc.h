// Reading and writing the caller's structs by their struct_size, so that old callers meet new libraries and the other
// way round. Version 1 sizes are numbers that never change; a struct grows at its end only.
#pragma once

#include "api/result.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bdpt {

template <class T>
constexpr uint32_t unlisted() {
  static_assert(sizeof(T) == 0, "give the struct a line below");
  return 0;
}
template <class T>
inline constexpr uint32_t kVersion1Size = unlisted<T>();

#define BDPT_VERSION_1_SIZE(type, size)                 \
  template <>                                           \
  inline constexpr uint32_t kVersion1Size<type> = size; \
  static_assert(sizeof(type) >= (size) && sizeof(type) % 8 == 0)

BDPT_VERSION_1_SIZE(bdpt_executor, 32);
BDPT_VERSION_1_SIZE(bdpt_log, 32);
BDPT_VERSION_1_SIZE(bdpt_context_desc, 40);
BDPT_VERSION_1_SIZE(bdpt_context_info, 32);
BDPT_VERSION_1_SIZE(bdpt_color_info, 64);
BDPT_VERSION_1_SIZE(bdpt_progress, 40);
BDPT_VERSION_1_SIZE(bdpt_mesh_desc, 296);
BDPT_VERSION_1_SIZE(bdpt_sphere_desc, 32);
BDPT_VERSION_1_SIZE(bdpt_curves_desc, 184);
BDPT_VERSION_1_SIZE(bdpt_subdivision_desc, 544);
BDPT_VERSION_1_SIZE(bdpt_texture_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_host_texture_desc, 56);
BDPT_VERSION_1_SIZE(bdpt_texture_use, 72);
BDPT_VERSION_1_SIZE(bdpt_medium_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_material_desc, 96);
BDPT_VERSION_1_SIZE(bdpt_host_material, 32);
BDPT_VERSION_1_SIZE(bdpt_light_desc, 72);
BDPT_VERSION_1_SIZE(bdpt_photometry, 40);
BDPT_VERSION_1_SIZE(bdpt_sky_desc, 40);
BDPT_VERSION_1_SIZE(bdpt_instance_desc, 80);
BDPT_VERSION_1_SIZE(bdpt_build_desc, 32);
BDPT_VERSION_1_SIZE(bdpt_scene_info, 88);
BDPT_VERSION_1_SIZE(bdpt_scene_light, 32);
BDPT_VERSION_1_SIZE(bdpt_camera_desc, 104);
BDPT_VERSION_1_SIZE(bdpt_output_desc, 24);
BDPT_VERSION_1_SIZE(bdpt_lightmap_instance, 40);
BDPT_VERSION_1_SIZE(bdpt_lightmap_desc, 72);
BDPT_VERSION_1_SIZE(bdpt_lightmap_info, 64);
BDPT_VERSION_1_SIZE(bdpt_plane_info, 40);
BDPT_VERSION_1_SIZE(bdpt_points_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_vertex_instance, 16);
BDPT_VERSION_1_SIZE(bdpt_vertices_desc, 40);
BDPT_VERSION_1_SIZE(bdpt_custom_desc, 72);
BDPT_VERSION_1_SIZE(bdpt_film_desc, 32);
BDPT_VERSION_1_SIZE(bdpt_film_info, 96);
BDPT_VERSION_1_SIZE(bdpt_memory_estimate, 40);
BDPT_VERSION_1_SIZE(bdpt_read_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_coverage_desc, 32);
BDPT_VERSION_1_SIZE(bdpt_render_desc, 184);
BDPT_VERSION_1_SIZE(bdpt_output_sink, 40);
BDPT_VERSION_1_SIZE(bdpt_advance_desc, 64);
BDPT_VERSION_1_SIZE(bdpt_advance_report, 40);
BDPT_VERSION_1_SIZE(bdpt_render_stats, 128);
BDPT_VERSION_1_SIZE(bdpt_technique_stats, 64);
BDPT_VERSION_1_SIZE(bdpt_uv_check_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_uv_maps, 72);
BDPT_VERSION_1_SIZE(bdpt_uv_report, 128);
BDPT_VERSION_1_SIZE(bdpt_lightmap_dilate_desc, 72);
BDPT_VERSION_1_SIZE(bdpt_lightmap_dilate_report, 32);
BDPT_VERSION_1_SIZE(bdpt_lightmap_seams_desc, 56);
BDPT_VERSION_1_SIZE(bdpt_lightmap_seams_report, 72);
BDPT_VERSION_1_SIZE(bdpt_lightmap_encode_desc, 80);
BDPT_VERSION_1_SIZE(bdpt_lightmap_encode_report, 24);
BDPT_VERSION_1_SIZE(bdpt_display_desc, 48);
BDPT_VERSION_1_SIZE(bdpt_exposure_desc, 24);
BDPT_VERSION_1_SIZE(bdpt_exr_desc, 32);
BDPT_VERSION_1_SIZE(bdpt_denoise_desc, 56);
#undef BDPT_VERSION_1_SIZE

// The library writes these; version 1 is the only one so far.
static_assert(sizeof(bdpt_progress) == kVersion1Size<bdpt_progress>);
// Arrays and parts of other structs carry no size of their own: these can never change.
static_assert(sizeof(bdpt_texture_place) == 32);
static_assert(sizeof(bdpt_scattering_place) == 32 && sizeof(bdpt_scattering_value) == 20);
static_assert(sizeof(bdpt_coverage) == 16 && sizeof(bdpt_data) == 56 && sizeof(bdpt_image_layer) == 16 &&
              sizeof(bdpt_point) == 32 && sizeof(bdpt_portal) == 36 && sizeof(bdpt_lens_surface) == 16 &&
              sizeof(bdpt_measurement_start) == 56 && sizeof(bdpt_measurement_place) == 48 &&
              sizeof(bdpt_measurement_landing) == 56 && sizeof(bdpt_measurement_landed) == 32);
static_assert(sizeof(bdpt_chromaticities) == 32);
static_assert(sizeof(bdpt_uv_instance) == 80 && sizeof(bdpt_lightmap_image) == 40);

// No struct will be longer. A larger number is memory that was never set, and how far to read is unknown.
inline constexpr uint32_t kMaxStructSize = 4096;

// Throws unless struct_size is one that this library can take.
void check_struct_size(const void* data, uint32_t version_1, uint32_t own, const char* name);

// Whether the fields of version 1 are there to be read, though the struct may be refused for its tail. What the caller
// handed over with them (callbacks that release) is then honoured.
template <class T>
bool is_readable(const T* caller) {
  return caller && caller->struct_size >= kVersion1Size<T> && caller->struct_size <= kMaxStructSize;
}

// As much as the caller's struct has, zero for the rest. Only where is_readable().
template <class T>
T copy_readable(const T& caller) {
  T copy{};
  std::memcpy(&copy, &caller, caller.struct_size < sizeof(T) ? caller.struct_size : sizeof(T));
  return copy;
}

// The caller's struct, checked; name is the parameter's.
template <class T>
T read_struct(const T* caller, const char* name) {
  check_struct_size(&require(caller, name), kVersion1Size<T>, sizeof(T), name);
  return copy_readable(*caller);
}

// The same where NULL means all defaults.
template <class T>
T read_optional_struct(const T* caller, const char* name) {
  return caller ? read_struct(caller, name) : T{};
}

// Throws unless the caller's struct can be written.
template <class T>
void check_output_struct(const T* caller, const char* name) {
  check_struct_size(&require(caller, name), kVersion1Size<T>, sizeof(T), name);
}

// Writes as much as the caller's struct has room for; struct_size stays the caller's.
template <class T>
void write_struct(T value, T* caller) {
  value.struct_size = caller->struct_size;
  std::memcpy(caller, &value, caller->struct_size < sizeof(T) ? caller->struct_size : sizeof(T));
}

}  // namespace bdpt
