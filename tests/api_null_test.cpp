// Every entry point, with NULL for what must be given.
#include "api_scene.h"
#include "lightmap_meshes.h"

namespace bdpt_api::api_null_test {

#define EXPECT_INVALID(call)                                                         \
  do {                                                                               \
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, (call)) << #call;                         \
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "NULL")) << bdpt_last_error(); \
  } while (false)

// A handle that must not stay as it is when the call fails.
template <class T>
T* dirty() {
  return reinterpret_cast<T*>(uintptr_t(8));
}

TEST(ApiNull, ReleaseDestroyRetainAndCancelIgnoreIt) {
  bdpt_context_retain(nullptr);
  bdpt_context_release(nullptr);
  bdpt_cancel_retain(nullptr);
  bdpt_cancel_release(nullptr);
  bdpt_cancel_request(nullptr);
  bdpt_cancel_reset(nullptr);
  EXPECT_EQ(0u, bdpt_cancel_is_requested(nullptr));
  bdpt_builder_destroy(nullptr);
  bdpt_scene_retain(nullptr);
  bdpt_scene_release(nullptr);
  bdpt_sensor_retain(nullptr);
  bdpt_sensor_release(nullptr);
  bdpt_film_retain(nullptr);
  bdpt_film_release(nullptr);
  bdpt_render_destroy(nullptr);
}

TEST(ApiNull, ContextAndCancelCallsRefuseIt) {
  bdpt_context_info info = make<bdpt_context_info>();
  const Context context = make_context();
  EXPECT_INVALID(bdpt_context_create(BDPT_ABI, nullptr, nullptr));
  EXPECT_INVALID(bdpt_context_get_info(nullptr, &info));
  EXPECT_INVALID(bdpt_context_get_info(context.get(), nullptr));
  EXPECT_INVALID(bdpt_cancel_create(nullptr));
}

TEST(ApiNull, ColorCallsRefuseIt) {
  bdpt_color_info info = make<bdpt_color_info>();
  float rgb[3] = {};
  const Context context = make_context();
  EXPECT_INVALID(bdpt_color_get_info(nullptr, &info));
  EXPECT_INVALID(bdpt_color_get_info(context.get(), nullptr));
  EXPECT_INVALID(bdpt_color_convert(nullptr, nullptr, nullptr, rgb, 1));
  EXPECT_INVALID(bdpt_color_convert(context.get(), nullptr, nullptr, nullptr, 1));
  EXPECT_INVALID(bdpt_color_convert_chromaticities(nullptr, nullptr, nullptr, 1));
}

TEST(ApiNull, BuilderCallsRefuseIt) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_builder* b = dirty<bdpt_builder>();
  EXPECT_INVALID(bdpt_builder_create(nullptr, &b));
  EXPECT_EQ(nullptr, b);
  EXPECT_INVALID(bdpt_builder_create(context.get(), nullptr));

  const bdpt_mesh_desc mesh = square_desc();
  bdpt_sphere_desc sphere = make<bdpt_sphere_desc>();
  sphere.radius = 1;
  const uint8_t texel[3] = {};
  bdpt_texture_desc texture = make<bdpt_texture_desc>();
  texture.channels = 3, texture.width = texture.height = 1, texture.pixels = texel;
  bdpt_host_texture_desc pattern = make<bdpt_host_texture_desc>();
  pattern.look_up = [](void*, uint32_t, const bdpt_texture_place*, float(*)[4]) { return int32_t(0); };
  const bdpt_material_desc material = grey_desc();
  const bdpt_medium_desc medium = make<bdpt_medium_desc>();
  bdpt_light_desc light = make<bdpt_light_desc>();
  const bdpt_instance_desc instance = instance_desc(add_square(builder.get()), add_grey(builder.get()));

  const auto check = [&](auto add, const auto& desc, auto id) {
    id.id = 7;
    EXPECT_INVALID(add(nullptr, &desc, &id));
    EXPECT_EQ(0u, id.id);
    id.id = 7;
    EXPECT_INVALID(add(builder.get(), nullptr, &id));
    EXPECT_EQ(0u, id.id);
    EXPECT_INVALID(add(builder.get(), &desc, nullptr));
  };
  check(bdpt_mesh_add, mesh, bdpt_shape_id{});
  check(bdpt_sphere_add, sphere, bdpt_shape_id{});
  const float line[2][3] = {{0, 0, 0}, {1, 0, 0}}, radius = 0.1f;
  bdpt_curves_desc curves = make<bdpt_curves_desc>();
  curves.positions = view(line, 2, BDPT_FORMAT_FLOAT3), curves.radii = view(&radius, 1, BDPT_FORMAT_FLOAT1);
  check(bdpt_curves_add, curves, bdpt_shape_id{});
  const uint32_t face[] = {0, 1, 2, 3};
  bdpt_subdivision_desc subdivision = make<bdpt_subdivision_desc>();
  subdivision.level = 2;
  subdivision.positions = view(kSquare, 4, BDPT_FORMAT_FLOAT3), subdivision.indices = view(face, 4, BDPT_FORMAT_UINT32);
  check(bdpt_subdivision_add, subdivision, bdpt_shape_id{});
  check(bdpt_texture_add, texture, bdpt_texture_id{});
  check(bdpt_host_texture_add, pattern, bdpt_texture_id{});
  check(bdpt_material_add, material, bdpt_material_id{});
  check(bdpt_medium_add, medium, bdpt_medium_id{});
  check(bdpt_light_add, light, bdpt_light_id{});
  check(bdpt_instance_add, instance, bdpt_instance_id{});

  bdpt_material_desc uses = grey_desc();
  uses.texture_count = 1;
  bdpt_material_id id{};
  EXPECT_INVALID(bdpt_material_add(builder.get(), &uses, &id));
  texture.pixels = nullptr;
  bdpt_texture_id texture_id{};
  EXPECT_INVALID(bdpt_texture_add(builder.get(), &texture, &texture_id));
  pattern.look_up = nullptr;
  EXPECT_INVALID(bdpt_host_texture_add(builder.get(), &pattern, &texture_id));
}

TEST(ApiNull, UpdatesAndRemovalsRefuseIt) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const Contents contents(builder.get());
  const bdpt_material_desc material = grey_desc();
  const bdpt_light_desc light = make<bdpt_light_desc>();
  const bdpt_instance_desc instance = instance_desc(contents.square, contents.grey);
  EXPECT_INVALID(bdpt_shape_remove(nullptr, contents.square));
  EXPECT_INVALID(bdpt_texture_remove(nullptr, {1}));
  EXPECT_INVALID(bdpt_material_update(nullptr, contents.grey, &material));
  EXPECT_INVALID(bdpt_material_update(builder.get(), contents.grey, nullptr));
  EXPECT_INVALID(bdpt_material_remove(nullptr, contents.grey));
  float eta[3], k[3];
  EXPECT_INVALID(bdpt_metal_find(nullptr, eta, k));
  EXPECT_INVALID(bdpt_metal_find("Au", nullptr, k));
  EXPECT_INVALID(bdpt_metal_find("Au", eta, nullptr));
  const bdpt_medium_desc medium = make<bdpt_medium_desc>();
  EXPECT_INVALID(bdpt_medium_update(nullptr, {1}, &medium));
  EXPECT_INVALID(bdpt_medium_update(builder.get(), {1}, nullptr));
  EXPECT_INVALID(bdpt_medium_remove(nullptr, {1}));
  EXPECT_INVALID(bdpt_light_update(nullptr, {1}, &light));
  EXPECT_INVALID(bdpt_light_update(builder.get(), {1}, nullptr));
  EXPECT_INVALID(bdpt_light_remove(nullptr, {1}));
  EXPECT_INVALID(bdpt_instance_update(nullptr, contents.floor, &instance));
  EXPECT_INVALID(bdpt_instance_update(builder.get(), contents.floor, nullptr));
  EXPECT_INVALID(bdpt_instance_remove(nullptr, contents.floor));
}

TEST(ApiNull, SceneSensorFilmAndRenderCallsRefuseIt) {
  const World world;
  bdpt_scene* scene = dirty<bdpt_scene>();
  EXPECT_INVALID(bdpt_scene_build(nullptr, nullptr, &scene));
  EXPECT_EQ(nullptr, scene);
  EXPECT_INVALID(bdpt_scene_build(world.builder.get(), nullptr, nullptr));
  bdpt_scene_info scene_info = make<bdpt_scene_info>();
  EXPECT_INVALID(bdpt_scene_get_info(nullptr, &scene_info));
  EXPECT_INVALID(bdpt_scene_get_info(world.scene.get(), nullptr));

  const bdpt_camera_desc camera = camera_desc();
  bdpt_sensor* sensor = dirty<bdpt_sensor>();
  EXPECT_INVALID(bdpt_camera_create(nullptr, &camera, &sensor));
  EXPECT_EQ(nullptr, sensor);
  EXPECT_INVALID(bdpt_camera_create(world.context.get(), nullptr, &sensor));
  EXPECT_INVALID(bdpt_camera_create(world.context.get(), &camera, nullptr));

  const bdpt_lightmap_desc lightmap = make<bdpt_lightmap_desc>();
  sensor = dirty<bdpt_sensor>();
  EXPECT_INVALID(bdpt_lightmap_create(nullptr, &lightmap, &sensor));
  EXPECT_EQ(nullptr, sensor);
  EXPECT_INVALID(bdpt_lightmap_create(world.scene.get(), nullptr, &sensor));
  EXPECT_INVALID(bdpt_lightmap_create(world.scene.get(), &lightmap, nullptr));
  bdpt_lightmap_info lightmap_info = make<bdpt_lightmap_info>();
  EXPECT_INVALID(bdpt_lightmap_get_info(nullptr, &lightmap_info));
  EXPECT_INVALID(bdpt_lightmap_read_texels(nullptr, nullptr, nullptr, 0));
  EXPECT_INVALID(bdpt_lightmap_read_buried(nullptr, nullptr, 0));
  bdpt_plane_info plane = make<bdpt_plane_info>();
  EXPECT_INVALID(bdpt_sensor_get_plane(nullptr, 0, &plane));
  EXPECT_INVALID(bdpt_sensor_get_plane(world.sensor.get(), 0, nullptr));
  bdpt_scene_light light = make<bdpt_scene_light>();
  EXPECT_INVALID(bdpt_scene_get_light(nullptr, 0, &light));
  EXPECT_INVALID(bdpt_scene_get_light(world.scene.get(), 0, nullptr));
  const bdpt_points_desc points = make<bdpt_points_desc>();
  sensor = dirty<bdpt_sensor>();
  EXPECT_INVALID(bdpt_points_create(nullptr, &points, &sensor));
  EXPECT_EQ(nullptr, sensor);
  EXPECT_INVALID(bdpt_points_create(world.context.get(), nullptr, &sensor));
  EXPECT_INVALID(bdpt_points_create(world.context.get(), &points, nullptr));

  const bdpt_vertices_desc vertices = make<bdpt_vertices_desc>();
  sensor = dirty<bdpt_sensor>();
  EXPECT_INVALID(bdpt_vertices_create(nullptr, &vertices, &sensor));
  EXPECT_EQ(nullptr, sensor);
  EXPECT_INVALID(bdpt_vertices_create(world.scene.get(), nullptr, &sensor));
  EXPECT_INVALID(bdpt_vertices_create(world.scene.get(), &vertices, nullptr));
  float area = 0;
  EXPECT_INVALID(bdpt_vertices_read_areas(nullptr, &area, 1));
  EXPECT_INVALID(bdpt_vertices_solve(nullptr, 1, &area, 1));

  const bdpt_custom_desc custom = make<bdpt_custom_desc>();
  sensor = dirty<bdpt_sensor>();
  EXPECT_INVALID(bdpt_custom_create(nullptr, &custom, &sensor));
  EXPECT_EQ(nullptr, sensor);
  EXPECT_INVALID(bdpt_custom_create(world.context.get(), nullptr, &sensor));
  EXPECT_INVALID(bdpt_custom_create(world.context.get(), &custom, nullptr));

  bdpt_film* film = dirty<bdpt_film>();
  EXPECT_INVALID(bdpt_film_create(nullptr, nullptr, &film));
  EXPECT_EQ(nullptr, film);
  EXPECT_INVALID(bdpt_film_create(world.sensor.get(), nullptr, nullptr));

  bdpt_render* render = dirty<bdpt_render>();
  EXPECT_INVALID(bdpt_render_create(nullptr, world.sensor.get(), world.film.get(), nullptr, &render));
  EXPECT_EQ(nullptr, render);
  EXPECT_INVALID(bdpt_render_create(world.scene.get(), nullptr, world.film.get(), nullptr, &render));
  EXPECT_INVALID(bdpt_render_create(world.scene.get(), world.sensor.get(), nullptr, nullptr, &render));
  EXPECT_INVALID(bdpt_render_create(world.scene.get(), world.sensor.get(), world.film.get(), nullptr, nullptr));

  const Render good = world.render();
  const bdpt_advance_desc one = passes(1);
  bdpt_render_stats stats = make<bdpt_render_stats>();
  EXPECT_INVALID(bdpt_render_advance(nullptr, &one, nullptr));
  EXPECT_INVALID(bdpt_render_advance(good.get(), nullptr, nullptr));
  EXPECT_INVALID(bdpt_render_get_stats(nullptr, &stats));
  EXPECT_INVALID(bdpt_render_get_stats(good.get(), nullptr));
}

TEST(ApiNull, FilmDataCallsRefuseIt) {
  const World world;
  bdpt_film_info info = make<bdpt_film_info>();
  EXPECT_INVALID(bdpt_film_get_info(nullptr, &info));
  EXPECT_INVALID(bdpt_film_get_info(world.film.get(), nullptr));
  const bdpt_read_desc read = make<bdpt_read_desc>();
  float pixels[3] = {};
  EXPECT_INVALID(bdpt_film_read(nullptr, &read, pixels, sizeof pixels));
  EXPECT_INVALID(bdpt_film_read(world.film.get(), nullptr, pixels, sizeof pixels));
  EXPECT_INVALID(bdpt_film_read(world.film.get(), &read, nullptr, 1 << 20));
  const bdpt_coverage_desc coverage = make<bdpt_coverage_desc>();
  bdpt_coverage entry{};
  EXPECT_INVALID(bdpt_film_read_coverage(nullptr, &coverage, &entry, 1, nullptr));
  EXPECT_INVALID(bdpt_film_read_coverage(world.film.get(), nullptr, &entry, 1, nullptr));
  EXPECT_INVALID(bdpt_film_read_coverage(world.film.get(), &coverage, nullptr, 1, nullptr));
  EXPECT_INVALID(bdpt_film_clear(nullptr));
  EXPECT_INVALID(bdpt_film_merge(nullptr, world.film.get()));
  EXPECT_INVALID(bdpt_film_merge(world.film.get(), nullptr));
  EXPECT_INVALID(bdpt_film_save(nullptr, "film"));
  EXPECT_INVALID(bdpt_film_save(world.film.get(), nullptr));
  bdpt_film* film = dirty<bdpt_film>();
  EXPECT_INVALID(bdpt_film_load(nullptr, "film", &film));
  EXPECT_EQ(nullptr, film);
  EXPECT_INVALID(bdpt_film_load(world.context.get(), nullptr, &film));
  EXPECT_INVALID(bdpt_film_load(world.context.get(), "film", nullptr));
}

TEST(ApiNull, ImageCallsRefuseIt) {
  const float pixels[3] = {};
  bdpt_exr_desc exr = make<bdpt_exr_desc>();
  exr.width = exr.height = exr.layer_count = 1;
  float stops;
  bdpt_exposure_desc exposure = make<bdpt_exposure_desc>();
  EXPECT_INVALID(bdpt_exposure_stops(nullptr, &stops));
  EXPECT_INVALID(bdpt_exposure_stops(&exposure, nullptr));
  EXPECT_INVALID(bdpt_image_display(nullptr, nullptr, 1, 1));
  EXPECT_INVALID(bdpt_image_write_exr(nullptr, &exr));
  EXPECT_INVALID(bdpt_image_write_exr("image.exr", nullptr));
  EXPECT_INVALID(bdpt_image_write_exr("image.exr", &exr));
  const bdpt_image_layer layer{nullptr, nullptr};
  exr.layers = &layer;
  EXPECT_INVALID(bdpt_image_write_exr("image.exr", &exr));
  EXPECT_INVALID(bdpt_denoise(nullptr));
  bdpt_denoise_desc denoise = make<bdpt_denoise_desc>();
  denoise.width = denoise.height = 1, denoise.color = pixels;
  EXPECT_INVALID(bdpt_denoise(&denoise));
  EXPECT_INVALID(bdpt_image_write_png(nullptr, pixels, 1, 1));
  EXPECT_INVALID(bdpt_image_write_png("image.png", nullptr, 1, 1));
}

TEST(ApiNull, LightmapCallsRefuseIt) {
  LightmapMesh mesh;
  add_quad(mesh, {8, 8}, 1, 1, 7, 7, 1);
  const bdpt_mesh_desc mesh_desc = mesh.desc();
  const bdpt_uv_instance instance = uv_instance(mesh_desc), none{};
  bdpt_uv_check_desc check = make<bdpt_uv_check_desc>();
  bdpt_uv_report report = make<bdpt_uv_report>();
  check.instance_count = 1, check.width = check.height = 8;
  EXPECT_INVALID(bdpt_uv_check(nullptr, nullptr, &report));
  EXPECT_INVALID(bdpt_uv_check(&check, nullptr, &report));
  check.instances = &none;
  EXPECT_INVALID(bdpt_uv_check(&check, nullptr, &report));
  check.instances = &instance;
  EXPECT_INVALID(bdpt_uv_check(&check, nullptr, nullptr));
  EXPECT_OK(bdpt_uv_check(&check, nullptr, &report));

  std::vector<float> pixels(64);
  std::vector<uint8_t> mask(64);
  bdpt_lightmap_dilate_desc dilate = make<bdpt_lightmap_dilate_desc>();
  dilate.width = dilate.height = 8, dilate.channels = 1;
  dilate.pixels_capacity = 256, dilate.mask_capacity = 64;
  EXPECT_INVALID(bdpt_lightmap_dilate(nullptr, nullptr));
  dilate.mask = mask.data();
  EXPECT_INVALID(bdpt_lightmap_dilate(&dilate, nullptr));
  dilate.pixels = pixels.data(), dilate.mask = nullptr;
  EXPECT_INVALID(bdpt_lightmap_dilate(&dilate, nullptr));

  bdpt_lightmap_image image{nullptr, 256, nullptr, 0, 8, 8};
  bdpt_lightmap_seams_desc seams = make<bdpt_lightmap_seams_desc>();
  seams.instance_count = seams.image_count = seams.channels = 1;
  seams.instances = &instance;
  EXPECT_INVALID(bdpt_lightmap_fix_seams(nullptr, nullptr));
  EXPECT_INVALID(bdpt_lightmap_fix_seams(&seams, nullptr));
  seams.images = &image;
  EXPECT_INVALID(bdpt_lightmap_fix_seams(&seams, nullptr));
  image.pixels = pixels.data();
  seams.instances = nullptr;
  EXPECT_INVALID(bdpt_lightmap_fix_seams(&seams, nullptr));

  bdpt_lightmap_encode_desc encode = make<bdpt_lightmap_encode_desc>();
  encode.channels = encode.texels = 1;
  encode.pixels_capacity = encode.encoded_capacity = 256;
  EXPECT_INVALID(bdpt_lightmap_encode(nullptr, nullptr));
  EXPECT_INVALID(bdpt_lightmap_encode(&encode, nullptr));
  encode.pixels = pixels.data();
  EXPECT_INVALID(bdpt_lightmap_encode(&encode, nullptr));
}

}  // namespace bdpt_api::api_null_test
