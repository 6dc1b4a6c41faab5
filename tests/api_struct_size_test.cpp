// Old callers, new callers, and callers that never set struct_size.
#include "api_scene.h"
#include "lightmap_meshes.h"
#include "temp_folder.h"

#include <cstdlib>
#include <functional>

namespace bdpt_api::api_struct_size_test {

// In a block of exactly this many bytes, so that a sanitizer sees what is read beyond it.
template <class T>
bdpt_result call_with(const T& valid, uint32_t block_size, uint32_t struct_size, unsigned char tail,
                      const std::function<bdpt_result(T*)>& call) {
  auto* block = static_cast<unsigned char*>(std::malloc(block_size));
  std::memset(block, tail, block_size);
  std::memcpy(block, &valid, std::min<size_t>(block_size, sizeof valid));
  std::memcpy(block, &struct_size, sizeof struct_size);
  const bdpt_result result = call(reinterpret_cast<T*>(block));
  std::free(block);
  return result;
}

template <class T>
void check(const char* name, uint32_t version_1, const T& valid, const std::function<bdpt_result(T*)>& call) {
  SCOPED_TRACE(name);
  constexpr uint32_t own = sizeof(T);
  EXPECT_OK(call_with<T>(valid, version_1, version_1, 0, call));
  EXPECT_OK(call_with<T>(valid, own, own, 0, call));
  EXPECT_OK(call_with<T>(valid, own + 16, own + 16, 0, call));
  const auto refused = [&](uint32_t block, uint32_t size, unsigned char tail) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, call_with<T>(valid, block, size, tail, call)) << size;
  };
  refused(version_1, version_1 - 1, 0);
  refused(own, 0, 0);
  refused(own + 16, own + 16, 0xA5);
  refused(own, 0xFFFFFFFFu, 0);
  refused(own, 0x80000000u, 0);
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "struct_size")) << bdpt_last_error();
}

TEST(ApiStructSize, ContextStructsAreReadBySize) {
  const auto create = [](const bdpt_context_desc* desc) {
    bdpt_context* context = nullptr;
    const bdpt_result result = bdpt_context_create(BDPT_ABI, desc, &context);
    EXPECT_EQ(result == BDPT_OK, context != nullptr);
    bdpt_context_release(context);
    return result;
  };
  check<bdpt_context_desc>("bdpt_context_desc", 40, make<bdpt_context_desc>(), create);
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = [](void*, uint32_t n, void (*body)(void*, uint32_t), void* user) {
    for (uint32_t i = 0; i < n; ++i) body(user, i);
  };
  check<bdpt_executor>("bdpt_executor", 32, executor, [&](bdpt_executor* e) {
    bdpt_context_desc desc = make<bdpt_context_desc>();
    desc.executor = e;
    return create(&desc);
  });
  bdpt_log log = make<bdpt_log>();
  log.write = [](void*, bdpt_log_level, const char*) {};
  check<bdpt_log>("bdpt_log", 32, log, [&](bdpt_log* l) {
    bdpt_context_desc desc = make<bdpt_context_desc>();
    desc.log = l;
    return create(&desc);
  });
  const Context context = make_context();
  check<bdpt_context_info>("bdpt_context_info", 32, make<bdpt_context_info>(),
                           [&](bdpt_context_info* info) { return bdpt_context_get_info(context.get(), info); });
  check<bdpt_color_info>("bdpt_color_info", 64, make<bdpt_color_info>(),
                         [&](bdpt_color_info* info) { return bdpt_color_get_info(context.get(), info); });
}

TEST(ApiStructSize, BuilderStructsAreReadBySize) {
  const Context context = make_context();
  const Builder owner = make_builder(context.get());
  bdpt_builder* b = owner.get();
  const Contents contents(b);
  bdpt_shape_id shape{};
  check<bdpt_mesh_desc>("bdpt_mesh_desc", 296, square_desc(),
                        [&](bdpt_mesh_desc* d) { return bdpt_mesh_add(b, d, &shape); });
  bdpt_sphere_desc sphere = make<bdpt_sphere_desc>();
  sphere.radius = 1;
  check<bdpt_sphere_desc>("bdpt_sphere_desc", 32, sphere,
                          [&](bdpt_sphere_desc* d) { return bdpt_sphere_add(b, d, &shape); });
  const float line[2][3] = {{0, 0, 0}, {1, 0, 0}}, radius = 0.1f;
  bdpt_curves_desc curves = make<bdpt_curves_desc>();
  curves.positions = view(line, 2, BDPT_FORMAT_FLOAT3), curves.radii = view(&radius, 1, BDPT_FORMAT_FLOAT1);
  check<bdpt_curves_desc>("bdpt_curves_desc", 184, curves,
                          [&](bdpt_curves_desc* d) { return bdpt_curves_add(b, d, &shape); });
  const uint32_t face[] = {0, 1, 2, 3};
  bdpt_subdivision_desc subdivision = make<bdpt_subdivision_desc>();
  subdivision.level = 2;
  subdivision.positions = view(kSquare, 4, BDPT_FORMAT_FLOAT3), subdivision.indices = view(face, 4, BDPT_FORMAT_UINT32);
  check<bdpt_subdivision_desc>("bdpt_subdivision_desc", 544, subdivision,
                               [&](bdpt_subdivision_desc* d) { return bdpt_subdivision_add(b, d, &shape); });
  const uint8_t texel[3] = {1, 2, 3};
  bdpt_texture_desc texture = make<bdpt_texture_desc>();
  texture.channels = 3, texture.width = texture.height = 1, texture.pixels = texel;
  bdpt_texture_id texture_id{};
  check<bdpt_texture_desc>("bdpt_texture_desc", 48, texture,
                           [&](bdpt_texture_desc* d) { return bdpt_texture_add(b, d, &texture_id); });
  bdpt_host_texture_desc pattern = make<bdpt_host_texture_desc>();
  pattern.look_up = [](void*, uint32_t, const bdpt_texture_place*, float(*)[4]) { return int32_t(0); };
  check<bdpt_host_texture_desc>("bdpt_host_texture_desc", 56, pattern,
                                [&](bdpt_host_texture_desc* d) { return bdpt_host_texture_add(b, d, &texture_id); });
  bdpt_material_id material{};
  check<bdpt_material_desc>("bdpt_material_desc", 96, grey_desc(),
                            [&](bdpt_material_desc* d) { return bdpt_material_add(b, d, &material); });
  bdpt_host_material host = make<bdpt_host_material>();
  host.evaluate = [](void*, const bdpt_scattering_place*, const float*, bdpt_scattering_value*) { return int32_t(0); };
  host.sample = [](void*, const bdpt_scattering_place*, const float*, float*) { return int32_t(0); };
  check<bdpt_host_material>("bdpt_host_material", 32, host, [&](bdpt_host_material* h) {
    bdpt_material_desc d = make<bdpt_material_desc>();
    d.type = BDPT_MATERIAL_HOST;
    d.host = h;
    return bdpt_material_add(b, &d, &material);
  });
  check<bdpt_material_desc>("bdpt_material_update", 96, grey_desc(),
                            [&](bdpt_material_desc* d) { return bdpt_material_update(b, contents.grey, d); });
  ASSERT_OK(bdpt_texture_add(b, &texture, &texture_id));
  bdpt_texture_use use = make<bdpt_texture_use>();
  use.texture = texture_id;
  check<bdpt_texture_use>("bdpt_texture_use", 72, use, [&](bdpt_texture_use* u) {
    bdpt_material_desc d = grey_desc();
    d.textures = u, d.texture_count = 1;
    return bdpt_material_add(b, &d, &material);
  });
  bdpt_medium_id medium{}, first_medium{};
  const bdpt_medium_desc fog = make<bdpt_medium_desc>();
  ASSERT_OK(bdpt_medium_add(b, &fog, &first_medium));
  check<bdpt_medium_desc>("bdpt_medium_desc", 48, fog,
                          [&](bdpt_medium_desc* d) { return bdpt_medium_add(b, d, &medium); });
  check<bdpt_medium_desc>("bdpt_medium_update", 48, fog,
                          [&](bdpt_medium_desc* d) { return bdpt_medium_update(b, first_medium, d); });
  bdpt_light_id light{}, first_light{};
  const bdpt_light_desc point = make<bdpt_light_desc>();
  ASSERT_OK(bdpt_light_add(b, &point, &first_light));
  check<bdpt_light_desc>("bdpt_light_desc", 72, point,
                         [&](bdpt_light_desc* d) { return bdpt_light_add(b, d, &light); });
  check<bdpt_light_desc>("bdpt_light_update", 72, point,
                         [&](bdpt_light_desc* d) { return bdpt_light_update(b, first_light, d); });
  const float vertical[] = {0, 90}, horizontal[] = {0}, intensities[] = {1, 2};
  bdpt_photometry photometry = make<bdpt_photometry>();
  photometry.vertical_count = 2, photometry.horizontal_count = 1;
  photometry.vertical_angles = vertical, photometry.horizontal_angles = horizontal;
  photometry.intensities = intensities;
  check<bdpt_photometry>("bdpt_photometry", 40, photometry, [&](bdpt_photometry* p) {
    bdpt_light_desc d = point;
    d.direction[1] = -1;
    d.photometry = p;
    return bdpt_light_add(b, &d, &light);
  });
  bdpt_sky_desc sky = make<bdpt_sky_desc>();
  sky.width = sky.height = 1, sky.to_sun[1] = 1;
  float pixel[3];
  check<bdpt_sky_desc>("bdpt_sky_desc", 40, sky, [&](bdpt_sky_desc* d) { return bdpt_sky_fill(d, pixel, 3); });
  bdpt_instance_id instance{};
  const bdpt_instance_desc place = instance_desc(contents.square, contents.grey);
  check<bdpt_instance_desc>("bdpt_instance_desc", 80, place,
                            [&](bdpt_instance_desc* d) { return bdpt_instance_add(b, d, &instance); });
  check<bdpt_instance_desc>("bdpt_instance_update", 80, place,
                            [&](bdpt_instance_desc* d) { return bdpt_instance_update(b, contents.floor, d); });
  check<bdpt_build_desc>("bdpt_build_desc", 32, make<bdpt_build_desc>(), [&](bdpt_build_desc* d) {
    bdpt_scene* scene = nullptr;
    const bdpt_result result = bdpt_scene_build(b, d, &scene);
    bdpt_scene_release(scene);
    return result;
  });
}

// What stands behind the end of an older struct is not read, whatever it is.
TEST(ApiStructSize, FieldsThatAnOlderCallerDidNotHaveAreZero) {
  const Context context = make_context();
  const Builder owner = make_builder(context.get());
  bdpt_builder* b = owner.get();
  const auto older = [](auto valid, uint32_t size) {
    std::memset(reinterpret_cast<unsigned char*>(&valid) + size, 0xA5, sizeof valid - size);
    valid.struct_size = size;
    return valid;
  };
  const bdpt_mesh_desc mesh = older(square_desc(), 296);
  const uint8_t texel[3] = {1, 2, 3};
  bdpt_texture_desc valid_texture = make<bdpt_texture_desc>();
  valid_texture.channels = 3, valid_texture.width = valid_texture.height = 1, valid_texture.pixels = texel;
  const bdpt_texture_desc texture = older(valid_texture, 48);
  const bdpt_material_desc material = older(grey_desc(), 96);
  const bdpt_build_desc build_desc = older(make<bdpt_build_desc>(), 32);
  bdpt_shape_id shape{};
  bdpt_texture_id texture_id{};
  bdpt_material_id material_id{};
  ASSERT_OK(bdpt_mesh_add(b, &mesh, &shape));
  ASSERT_OK(bdpt_texture_add(b, &texture, &texture_id));
  ASSERT_OK(bdpt_material_add(b, &material, &material_id));
  add_instance(b, shape, material_id);
  bdpt_scene* scene = nullptr;
  ASSERT_OK(bdpt_scene_build(b, &build_desc, &scene));
  const Scene old(scene);
  const Builder other = make_builder(context.get());
  add_instance(other.get(), add_square(other.get()), add_grey(other.get()));
  EXPECT_EQ(scene_hash(build(other.get()).get()), scene_hash(old.get()));
}

TEST(ApiStructSize, SceneSensorAndFilmStructsAreReadBySize) {
  const World world;
  check<bdpt_scene_info>("bdpt_scene_info", 88, make<bdpt_scene_info>(),
                         [&](bdpt_scene_info* info) { return bdpt_scene_get_info(world.scene.get(), info); });
  check<bdpt_camera_desc>("bdpt_camera_desc", 104, camera_desc(), [&](bdpt_camera_desc* d) {
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_camera_create(world.context.get(), d, &sensor);
    bdpt_sensor_release(sensor);
    return result;
  });
  bdpt_lightmap_instance floor = make<bdpt_lightmap_instance>();
  floor.instance = world.contents.floor;
  bdpt_output_desc output = make<bdpt_output_desc>();
  bdpt_lightmap_desc lightmap = make<bdpt_lightmap_desc>();
  lightmap.width = lightmap.height = 4, lightmap.instance_count = lightmap.output_count = 1;
  lightmap.instances = &floor, lightmap.outputs = &output;
  Sensor kept;
  const auto create_lightmap = [&](const bdpt_lightmap_desc* d) {
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_lightmap_create(world.scene.get(), d, &sensor);
    if (sensor) kept.reset(sensor);
    return result;
  };
  check<bdpt_lightmap_desc>("bdpt_lightmap_desc", 72, lightmap, create_lightmap);
  check<bdpt_lightmap_instance>("bdpt_lightmap_instance", 40, floor, [&](bdpt_lightmap_instance* i) {
    bdpt_lightmap_desc d = lightmap;
    d.instances = i;
    return create_lightmap(&d);
  });
  check<bdpt_output_desc>("bdpt_output_desc", 24, output, [&](bdpt_output_desc* o) {
    bdpt_lightmap_desc d = lightmap;
    d.outputs = o;
    return create_lightmap(&d);
  });
  check<bdpt_lightmap_info>("bdpt_lightmap_info", 64, make<bdpt_lightmap_info>(),
                            [&](bdpt_lightmap_info* info) { return bdpt_lightmap_get_info(kept.get(), info); });
  check<bdpt_plane_info>("bdpt_plane_info", 40, make<bdpt_plane_info>(),
                         [&](bdpt_plane_info* info) { return bdpt_sensor_get_plane(kept.get(), 0, info); });
  check<bdpt_scene_light>("bdpt_scene_light", 32, make<bdpt_scene_light>(),
                          [&](bdpt_scene_light* l) { return bdpt_scene_get_light(world.scene.get(), 0, l); });
  check<bdpt_memory_estimate>("bdpt_memory_estimate", 40, make<bdpt_memory_estimate>(), [&](bdpt_memory_estimate* e) {
    return bdpt_lightmap_estimate(world.scene.get(), &lightmap, nullptr, 0, e);
  });
  const bdpt_point point{{0, 1, 0}, {0, 1, 0}, 0, 0};
  bdpt_points_desc points = make<bdpt_points_desc>();
  points.count = 1, points.points = &point;
  check<bdpt_points_desc>("bdpt_points_desc", 48, points, [&](bdpt_points_desc* d) {
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_points_create(world.context.get(), d, &sensor);
    bdpt_sensor_release(sensor);
    return result;
  });
  bdpt_vertex_instance placed = make<bdpt_vertex_instance>();
  placed.instance = world.contents.floor;
  bdpt_vertices_desc vertices = make<bdpt_vertices_desc>();
  vertices.instance_count = vertices.output_count = 1, vertices.instances = &placed, vertices.outputs = &output;
  const auto create_vertices = [&](const bdpt_vertices_desc* d) {
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_vertices_create(world.scene.get(), d, &sensor);
    bdpt_sensor_release(sensor);
    return result;
  };
  check<bdpt_vertices_desc>("bdpt_vertices_desc", 40, vertices, create_vertices);
  check<bdpt_vertex_instance>("bdpt_vertex_instance", 16, placed, [&](bdpt_vertex_instance* i) {
    bdpt_vertices_desc d = vertices;
    d.instances = i;
    return create_vertices(&d);
  });
  bdpt_custom_desc custom = make<bdpt_custom_desc>();
  custom.measurements = 1;
  custom.start = [](void*, uint32_t, const uint64_t*, const float(*)[4], bdpt_measurement_start*) { return 0; };
  check<bdpt_custom_desc>("bdpt_custom_desc", 72, custom, [&](bdpt_custom_desc* d) {
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_custom_create(world.context.get(), d, &sensor);
    bdpt_sensor_release(sensor);
    return result;
  });
  check<bdpt_film_desc>("bdpt_film_desc", 32, make<bdpt_film_desc>(), [&](bdpt_film_desc* d) {
    bdpt_film* film = nullptr;
    const bdpt_result result = bdpt_film_create(world.sensor.get(), d, &film);
    bdpt_film_release(film);
    return result;
  });
  check<bdpt_film_info>("bdpt_film_info", 96, make<bdpt_film_info>(),
                        [&](bdpt_film_info* info) { return bdpt_film_get_info(world.film.get(), info); });
  std::vector<float> pixels(24 * 16 * 3);
  check<bdpt_read_desc>("bdpt_read_desc", 48, make<bdpt_read_desc>(), [&](bdpt_read_desc* d) {
    return bdpt_film_read(world.film.get(), d, pixels.data(), pixels.size() * sizeof(float));
  });
}

TEST(ApiStructSize, RenderAndImageStructsAreReadBySize) {
  const World world;
  check<bdpt_render_desc>("bdpt_render_desc", 184, make<bdpt_render_desc>(), [&](bdpt_render_desc* d) {
    bdpt_render* render = nullptr;
    const bdpt_result result = bdpt_render_create(world.scene.get(), world.sensor.get(), world.film.get(), d, &render);
    bdpt_render_destroy(render);
    return result;
  });
  const Render render = world.render();
  check<bdpt_advance_desc>("bdpt_advance_desc", 64, passes(1),
                           [&](bdpt_advance_desc* d) { return bdpt_render_advance(render.get(), d, nullptr); });
  bdpt_advance_desc one = passes(1);
  check<bdpt_advance_report>("bdpt_advance_report", 40, make<bdpt_advance_report>(),
                             [&](bdpt_advance_report* r) { return bdpt_render_advance(render.get(), &one, r); });
  bdpt_output_sink sink = make<bdpt_output_sink>();
  sink.tile = [](void*, uint32_t, uint32_t, uint32_t, uint32_t, const float*) { return int32_t(0); };
  check<bdpt_output_sink>("bdpt_output_sink", 40, sink, [&](bdpt_output_sink* s) {
    one.sink = s;
    return bdpt_render_advance(render.get(), &one, nullptr);
  });
  check<bdpt_render_stats>("bdpt_render_stats", 128, make<bdpt_render_stats>(),
                           [&](bdpt_render_stats* s) { return bdpt_render_get_stats(render.get(), s); });
  check<bdpt_technique_stats>("bdpt_technique_stats", 64, make<bdpt_technique_stats>(), [&](bdpt_technique_stats* s) {
    return bdpt_render_get_technique_stats(render.get(), 1, 2, s);
  });
  float pixel[3] = {0.5f, 0.5f, 0.5f};
  bdpt_exposure_desc exposure = make<bdpt_exposure_desc>();
  exposure.ev100 = 12;
  check<bdpt_exposure_desc>("bdpt_exposure_desc", 24, exposure, [](bdpt_exposure_desc* d) {
    float stops;
    return bdpt_exposure_stops(d, &stops);
  });
  check<bdpt_display_desc>("bdpt_display_desc", 48, make<bdpt_display_desc>(),
                           [&](bdpt_display_desc* d) { return bdpt_image_display(d, pixel, 1, 1); });
  bdpt_output_desc ids = make<bdpt_output_desc>();
  ids.kind = BDPT_OUTPUT_INSTANCE_COVERAGE;
  check<bdpt_output_desc>("bdpt_output_desc of a camera", 24, ids, [&](bdpt_output_desc* d) {
    bdpt_camera_desc camera = camera_desc();
    camera.outputs = d, camera.output_count = 1;
    bdpt_sensor* created = nullptr;
    const bdpt_result result = bdpt_camera_create(world.context.get(), &camera, &created);
    bdpt_sensor_release(created);
    return result;
  });
  bdpt_camera_desc camera = camera_desc(1, 1);
  camera.outputs = &ids, camera.output_count = 1;
  const Sensor counting = make_camera(world.context.get(), camera);
  const Film counts = make_film(counting.get());
  bdpt_coverage_desc coverage = make<bdpt_coverage_desc>();
  coverage.ranks = 1;
  bdpt_coverage entry{};
  check<bdpt_coverage_desc>("bdpt_coverage_desc", 32, coverage, [&](bdpt_coverage_desc* d) {
    return bdpt_film_read_coverage(counts.get(), d, &entry, 1, nullptr);
  });
  bdpt_denoise_desc denoise = make<bdpt_denoise_desc>();
  denoise.width = denoise.height = 1, denoise.color = denoise.output = pixel;
  if (bdpt_has_denoiser())
    check<bdpt_denoise_desc>("bdpt_denoise_desc", 56, denoise, [&](bdpt_denoise_desc* d) { return bdpt_denoise(d); });
  const bdpt::TempFolder folder;
  const bdpt_image_layer layer{nullptr, pixel};
  bdpt_exr_desc exr = make<bdpt_exr_desc>();
  exr.width = exr.height = exr.layer_count = 1, exr.layers = &layer;
  check<bdpt_exr_desc>("bdpt_exr_desc", 32, exr,
                       [&](bdpt_exr_desc* d) { return bdpt_image_write_exr(folder.file("a.exr").c_str(), d); });
}

TEST(ApiStructSize, LightmapStructsAreReadBySize) {
  LightmapMesh mesh;
  add_quad(mesh, {8, 8}, 1, 1, 7, 7, 1);
  bdpt_mesh_desc mesh_desc = mesh.desc();
  bdpt_uv_instance instance = uv_instance(mesh_desc);
  bdpt_uv_check_desc uv_check = make<bdpt_uv_check_desc>();
  uv_check.instance_count = 1, uv_check.instances = &instance, uv_check.width = uv_check.height = 8;
  bdpt_uv_report uv_report = make<bdpt_uv_report>();
  check<bdpt_uv_check_desc>("bdpt_uv_check_desc", 48, uv_check,
                            [&](bdpt_uv_check_desc* d) { return bdpt_uv_check(d, nullptr, &uv_report); });
  check<bdpt_uv_maps>("bdpt_uv_maps", 72, make<bdpt_uv_maps>(),
                      [&](bdpt_uv_maps* m) { return bdpt_uv_check(&uv_check, m, &uv_report); });
  check<bdpt_uv_report>("bdpt_uv_report", 128, make<bdpt_uv_report>(),
                        [&](bdpt_uv_report* r) { return bdpt_uv_check(&uv_check, nullptr, r); });
  check<bdpt_mesh_desc>("bdpt_mesh_desc of an instance", 296, mesh_desc, [&](bdpt_mesh_desc* m) {
    instance.mesh = m;
    return bdpt_uv_check(&uv_check, nullptr, &uv_report);
  });
  instance.mesh = &mesh_desc;

  std::vector<float> pixels(64);
  std::vector<uint8_t> mask(64);
  bdpt_lightmap_dilate_desc dilate = make<bdpt_lightmap_dilate_desc>();
  dilate.width = dilate.height = 8, dilate.channels = 1;
  dilate.pixels = pixels.data(), dilate.pixels_capacity = 256, dilate.mask = mask.data(), dilate.mask_capacity = 64;
  check<bdpt_lightmap_dilate_desc>("bdpt_lightmap_dilate_desc", 72, dilate,
                                   [&](bdpt_lightmap_dilate_desc* d) { return bdpt_lightmap_dilate(d, nullptr); });
  check<bdpt_lightmap_dilate_report>("bdpt_lightmap_dilate_report", 32, make<bdpt_lightmap_dilate_report>(),
                                     [&](bdpt_lightmap_dilate_report* r) { return bdpt_lightmap_dilate(&dilate, r); });

  const bdpt_lightmap_image image{pixels.data(), 256, nullptr, 0, 8, 8};
  bdpt_lightmap_seams_desc seams = make<bdpt_lightmap_seams_desc>();
  seams.instance_count = seams.image_count = seams.channels = 1;
  seams.instances = &instance, seams.images = &image;
  check<bdpt_lightmap_seams_desc>("bdpt_lightmap_seams_desc", 56, seams,
                                  [&](bdpt_lightmap_seams_desc* d) { return bdpt_lightmap_fix_seams(d, nullptr); });
  check<bdpt_lightmap_seams_report>("bdpt_lightmap_seams_report", 72, make<bdpt_lightmap_seams_report>(),
                                    [&](bdpt_lightmap_seams_report* r) { return bdpt_lightmap_fix_seams(&seams, r); });

  std::vector<uint16_t> encoded(64);
  bdpt_lightmap_encode_desc encode = make<bdpt_lightmap_encode_desc>();
  encode.channels = 1, encode.texels = 64;
  encode.pixels = pixels.data(), encode.pixels_capacity = 256;
  encode.encoded = encoded.data(), encode.encoded_capacity = 128;
  check<bdpt_lightmap_encode_desc>("bdpt_lightmap_encode_desc", 80, encode,
                                   [&](bdpt_lightmap_encode_desc* d) { return bdpt_lightmap_encode(d, nullptr); });
  check<bdpt_lightmap_encode_report>("bdpt_lightmap_encode_report", 24, make<bdpt_lightmap_encode_report>(),
                                     [&](bdpt_lightmap_encode_report* r) { return bdpt_lightmap_encode(&encode, r); });
}

TEST(ApiStructSize, AnOutputStructIsWrittenOnlyAsFarAsItReaches) {
  const Context context = make_context();
  struct {
    bdpt_context_info info;
    uint64_t behind;
  } block{make<bdpt_context_info>(), 0};
  block.info.struct_size = sizeof block;
  EXPECT_OK(bdpt_context_get_info(context.get(), &block.info));
  EXPECT_EQ(sizeof block, block.info.struct_size);
  EXPECT_EQ(0u, block.behind);
  EXPECT_EQ(2u, block.info.threads);
}

}  // namespace bdpt_api::api_struct_size_test
