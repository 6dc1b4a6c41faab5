// Memory that runs out, at each allocation in turn: the call fails, nothing has changed, nothing is lost.
#include "api_scene.h"
#include "lightmap_meshes.h"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <new>

namespace {

// Allocations of this thread until one fails; none fails at zero.
thread_local int allocations_left = 0;

// Embree's own do not fail: version 3 loses memory then, and version 4 frees what it does not own.
bool is_embree(const void* caller) {
  Dl_info info;
  return dladdr(caller, &info) && info.dli_fname && std::strstr(info.dli_fname, "libembree");
}

void* allocate(std::size_t size, const void* caller) {
  if (allocations_left > 0 && !is_embree(caller) && --allocations_left == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return allocate(size, __builtin_return_address(0)); }
// Not inlined: g++ 12 would warn of what it sees then.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace bdpt_api::api_out_of_memory_test {

// Lets the first, second, third ... allocation of the call fail until the call succeeds. Returns how many failed.
int fail_each_allocation(const std::function<bdpt_result()>& call) {
  for (int n = 1; n < 10000; ++n) {
    allocations_left = n;
    const bdpt_result result = call();
    allocations_left = 0;
    if (result == BDPT_OK) return n - 1;
    EXPECT_LT(result, 0);
    EXPECT_EQ(BDPT_ERROR_OUT_OF_MEMORY, result) << bdpt_last_error();
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "memory"));
  }
  ADD_FAILURE() << "never succeeded";
  return 0;
}

TEST(ApiOutOfMemory, ObjectsAreMadeWholeOrNotAtAll) {
  const World world;
  const uint64_t before = memory_in_use(world.context.get());
  const bdpt_camera_desc camera = camera_desc();
  bdpt_cancel* cancel = nullptr;
  bdpt_builder* builder = nullptr;
  bdpt_sensor* sensor = nullptr;
  bdpt_film* film = nullptr;
  bdpt_render* render = nullptr;
  EXPECT_GT(fail_each_allocation([&] { return bdpt_cancel_create(&cancel); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_builder_create(world.context.get(), &builder); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_camera_create(world.context.get(), &camera, &sensor); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_film_create(world.sensor.get(), nullptr, &film); }), 0);
  EXPECT_GT(fail_each_allocation(
                [&] { return bdpt_render_create(world.scene.get(), world.sensor.get(), film, nullptr, &render); }),
            0);
  EXPECT_OK(advance(render, 1));
  bdpt_render_destroy(render);
  bdpt_film_release(film);
  bdpt_sensor_release(sensor);
  bdpt_builder_destroy(builder);
  bdpt_cancel_release(cancel);
  EXPECT_EQ(before, memory_in_use(world.context.get()));
}

TEST(ApiOutOfMemory, ABuilderStaysAsItWas) {
  const World world;
  bdpt_builder* b = world.builder.get();
  const uint64_t before = scene_hash(world.scene.get()), memory = memory_in_use(world.context.get());
  // Removed again, so that what a failure left behind would show.
  int released = 0, calls = 0;
  bdpt_mesh_desc mesh = square_desc();
  mesh.positions.ownership = BDPT_OWNERSHIP_BORROW;
  mesh.positions.user = &released;
  mesh.positions.release = [](void* user, const void*) { ++*static_cast<int*>(user); };
  const float colors[4][4] = {}, tangents[4][4] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
  mesh.colors = view(colors, 4, BDPT_FORMAT_FLOAT4);
  mesh.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
  bdpt_shape_id shape{};
  EXPECT_GT(fail_each_allocation([&] {
              ++calls;
              return bdpt_mesh_add(b, &mesh, &shape);
            }),
            0);
  EXPECT_EQ(calls - 1, released);
  EXPECT_OK(bdpt_shape_remove(b, shape));
  EXPECT_EQ(calls, released);

  const float line[2][3] = {{0, 0, 0}, {1, 0, 0}}, radius = 0.1f;
  bdpt_curves_desc curves = make<bdpt_curves_desc>();
  curves.positions = view(line, 2, BDPT_FORMAT_FLOAT3), curves.radii = view(&radius, 1, BDPT_FORMAT_FLOAT1);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_curves_add(b, &curves, &shape); }), 0);
  EXPECT_OK(bdpt_shape_remove(b, shape));

  const uint32_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}}, sides[2] = {3, 3};
  bdpt_subdivision_desc subdivision = make<bdpt_subdivision_desc>();
  subdivision.level = 2;
  subdivision.positions = view(kSquare, 4, BDPT_FORMAT_FLOAT3);
  subdivision.face_counts = view(sides, 2, BDPT_FORMAT_UINT32);
  subdivision.indices = view(faces, 6, BDPT_FORMAT_UINT32);
  subdivision.displace = [](void*, uint64_t, const float*, const float*, const float*, float*) { return int32_t(0); };
  EXPECT_GT(fail_each_allocation([&] { return bdpt_subdivision_add(b, &subdivision, &shape); }), 0);
  EXPECT_OK(bdpt_shape_remove(b, shape));

  const uint8_t texel[3] = {1, 2, 3};
  bdpt_texture_desc texture = make<bdpt_texture_desc>();
  texture.channels = 3, texture.width = texture.height = 1, texture.pixels = texel;
  bdpt_texture_id texture_id{};
  EXPECT_GT(fail_each_allocation([&] { return bdpt_texture_add(b, &texture, &texture_id); }), 0);

  bdpt_medium_desc medium = make<bdpt_medium_desc>();
  medium.label = "a label that is too long to be kept without an allocation";
  bdpt_medium_id medium_id{};
  EXPECT_GT(fail_each_allocation([&] { return bdpt_medium_add(b, &medium, &medium_id); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_medium_update(b, medium_id, &medium); }), 0);

  bdpt_texture_use uses[2] = {make<bdpt_texture_use>(), make<bdpt_texture_use>()};
  uses[0].slot = BDPT_SLOT_NORMAL, uses[1].slot = BDPT_SLOT_OPACITY;
  uses[0].texture = uses[1].texture = texture_id;
  bdpt_material_desc material = grey_desc();
  material.label = medium.label;
  material.type = BDPT_MATERIAL_DIELECTRIC;
  material.textures = uses, material.texture_count = 2;
  material.opacity_mode = BDPT_OPACITY_BLEND;
  bdpt_material_id material_id{};
  EXPECT_GT(fail_each_allocation([&] { return bdpt_material_add(b, &material, &material_id); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_material_update(b, material_id, &material); }), 0);

  bdpt_instance_desc instance = instance_desc(world.contents.square, material_id);
  instance.label = material.label;
  bdpt_instance_id instance_id{};
  EXPECT_GT(fail_each_allocation([&] { return bdpt_instance_add(b, &instance, &instance_id); }), 0);
  EXPECT_GT(fail_each_allocation([&] { return bdpt_instance_update(b, instance_id, &instance); }), 0);

  bdpt_light_desc light = make<bdpt_light_desc>();
  light.label = material.label;
  bdpt_light_id light_id{};
  EXPECT_GT(fail_each_allocation([&] { return bdpt_light_add(b, &light, &light_id); }), 0);

  EXPECT_OK(bdpt_light_remove(b, light_id));
  EXPECT_OK(bdpt_instance_remove(b, instance_id));
  EXPECT_OK(bdpt_material_remove(b, material_id));
  EXPECT_OK(bdpt_medium_remove(b, medium_id));
  EXPECT_OK(bdpt_texture_remove(b, texture_id));
  EXPECT_EQ(memory, memory_in_use(world.context.get()));
  EXPECT_EQ(before, scene_hash(build(b).get()));
}

TEST(ApiOutOfMemory, ASceneIsBuiltWholeOrNotAtAll) {
  bdpt_context_desc one_thread = make<bdpt_context_desc>();
  one_thread.threads = 1;
  const World world(&one_thread);
  const uint64_t memory = memory_in_use(world.context.get());
  bdpt_scene* scene = nullptr;
  EXPECT_GT(fail_each_allocation([&] {
              const bdpt_result result = bdpt_scene_build(world.builder.get(), nullptr, &scene);
              EXPECT_EQ(result == BDPT_OK, scene != nullptr);
              return result;
            }),
            0);
  EXPECT_EQ(scene_hash(world.scene.get()), scene_hash(scene));
  bdpt_scene_release(scene);
  EXPECT_EQ(memory, memory_in_use(world.context.get()));
}

TEST(ApiOutOfMemory, AnAdvanceThatFailedGoesOnAsIfItHadNot) {
  bdpt_context_desc one_thread = make<bdpt_context_desc>();
  one_thread.threads = 1;
  const World world(&one_thread);
  const Render whole = world.render();
  ASSERT_OK(advance(whole.get(), 2));
  const Film film = world.new_film();
  const Render render = world.render(film.get());
  fail_each_allocation([&] {
    const uint64_t done = info_of(film.get()).passes;
    return done < 2 ? advance(render.get(), 2 - done) : BDPT_OK;
  });
  EXPECT_EQ(pixels_of(world.film.get()), pixels_of(film.get()));
}

TEST(ApiOutOfMemory, AContextIsMadeWholeOrNotAtAllAndDropsOnce) {
  struct Drops {
    int executor = 0, log = 0;
  } drops;
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = [](void*, uint32_t n, void (*body)(void*, uint32_t), void* user) {
    for (uint32_t i = 0; i < n; ++i) body(user, i);
  };
  executor.user = &drops.executor;
  executor.drop = [](void* user) { ++*static_cast<int*>(user); };
  bdpt_log log = make<bdpt_log>();
  log.write = [](void*, bdpt_log_level, const char*) {};
  log.user = &drops.log;
  log.drop = executor.drop;
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.executor = &executor;
  desc.log = &log;
  bdpt_context* context = nullptr;
  const int failed = fail_each_allocation([&] { return bdpt_context_create(BDPT_ABI, &desc, &context); });
  EXPECT_GT(failed, 0);
  EXPECT_EQ(failed, drops.executor);
  EXPECT_EQ(failed, drops.log);
  bdpt_context_release(context);
  EXPECT_EQ(failed + 1, drops.executor);
  EXPECT_EQ(failed + 1, drops.log);
}

TEST(ApiOutOfMemory, LightmapCallsWriteAllOrNothing) {
  LightmapMesh mesh;
  add_quad(mesh, {16, 8}, 1, 1, 5, 7, 1);
  add_quad(mesh, {16, 8}, 9, 1, 13, 7, 1, 4);
  const bdpt_mesh_desc mesh_desc = mesh.desc();
  const bdpt_uv_instance instance = uv_instance(mesh_desc);
  std::vector<float> pixels(128, 1);
  std::vector<uint8_t> mask(128);
  std::vector<uint32_t> charts(128, 77);
  for (size_t i = 0; i < 64; ++i) pixels[i / 8 * 16 + i % 8] = 2;
  mask[20] = mask[30] = 1;
  const std::vector<float> before = pixels;
  const std::vector<uint8_t> mask_before = mask;
  // Calls until one succeeds; until then nothing must change.
  const auto fails_cleanly = [&](const auto& call) {
    EXPECT_GT(fail_each_allocation([&] {
                const bdpt_result result = call();
                if (result != BDPT_OK) {
                  EXPECT_EQ(before, pixels);
                  EXPECT_EQ(mask_before, mask);
                  EXPECT_EQ(std::vector<uint32_t>(128, 77), charts);
                }
                return result;
              }),
              0);
  };
  bdpt_lightmap_image image{pixels.data(), 512, nullptr, 0, 16, 8};
  bdpt_lightmap_seams_desc seams = make<bdpt_lightmap_seams_desc>();
  seams.instance_count = seams.image_count = seams.channels = 1;
  seams.instances = &instance, seams.images = &image;
  bdpt_lightmap_seams_report seams_report = make<bdpt_lightmap_seams_report>();
  fails_cleanly([&] { return bdpt_lightmap_fix_seams(&seams, &seams_report); });
  EXPECT_EQ(1u, seams_report.seams);
  EXPECT_NE(before, pixels);
  pixels = before;

  bdpt_lightmap_dilate_desc dilate = make<bdpt_lightmap_dilate_desc>();
  dilate.width = 16, dilate.height = 8, dilate.channels = 1;
  dilate.pixels = pixels.data(), dilate.pixels_capacity = 512, dilate.mask = mask.data(), dilate.mask_capacity = 128;
  fails_cleanly([&] { return bdpt_lightmap_dilate(&dilate, nullptr); });
  EXPECT_NE(mask_before, mask);
  pixels = before, mask = mask_before;

  bdpt_uv_check_desc check = make<bdpt_uv_check_desc>();
  check.instance_count = 1, check.instances = &instance, check.width = 16, check.height = 8;
  bdpt_uv_report report = make<bdpt_uv_report>();
  bdpt_uv_maps maps = make<bdpt_uv_maps>();
  maps.texel_charts = charts.data(), maps.texel_charts_capacity = 512;
  fails_cleanly([&] { return bdpt_uv_check(&check, &maps, &report); });
  EXPECT_EQ(2u, report.charts);
}

}  // namespace bdpt_api::api_out_of_memory_test
