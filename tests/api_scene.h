// A small lit scene, by the C ABI alone, and what tests need round it.
#pragma once

#include "bdpt.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#define EXPECT_OK(call) EXPECT_EQ(BDPT_OK, (call)) << bdpt_last_error()
#define ASSERT_OK(call) ASSERT_EQ(BDPT_OK, (call)) << bdpt_last_error()

namespace bdpt_api {

// All defaults.
template <class T>
T make() {
  T desc{};
  desc.struct_size = sizeof desc;
  return desc;
}

template <class T, void (*Release)(T*)>
struct Releaser {
  void operator()(T* handle) const { Release(handle); }
};
template <class T, void (*Release)(T*)>
using Handle = std::unique_ptr<T, Releaser<T, Release>>;

using Context = Handle<bdpt_context, bdpt_context_release>;
using Cancel = Handle<bdpt_cancel, bdpt_cancel_release>;
using Builder = Handle<bdpt_builder, bdpt_builder_destroy>;
using Scene = Handle<bdpt_scene, bdpt_scene_release>;
using Sensor = Handle<bdpt_sensor, bdpt_sensor_release>;
using Film = Handle<bdpt_film, bdpt_film_release>;
using Render = Handle<bdpt_render, bdpt_render_destroy>;

inline Context make_context(const bdpt_context_desc* desc = nullptr) {
  bdpt_context_desc two_threads = make<bdpt_context_desc>();
  two_threads.threads = 2;
  bdpt_context* context = nullptr;
  EXPECT_OK(bdpt_context_create(BDPT_ABI, desc ? desc : &two_threads, &context));
  return Context(context);
}

inline Builder make_builder(bdpt_context* context) {
  bdpt_builder* builder = nullptr;
  EXPECT_OK(bdpt_builder_create(context, &builder));
  return Builder(builder);
}

inline Cancel make_cancel() {
  bdpt_cancel* cancel = nullptr;
  EXPECT_OK(bdpt_cancel_create(&cancel));
  return Cancel(cancel);
}

inline bdpt_data view(const void* data, uint64_t count, bdpt_format format) {
  bdpt_data result{};
  result.data = data;
  result.count = count;
  result.format = format;
  return result;
}

// A square in the xz plane round the origin whose front looks up.
inline constexpr float kSquare[4][3] = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
inline constexpr uint32_t kSquareIndices[2][3] = {{0, 1, 2}, {0, 2, 3}};
inline constexpr float kSquareUv[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};

inline bdpt_mesh_desc square_desc() {
  bdpt_mesh_desc desc = make<bdpt_mesh_desc>();
  desc.label = "square";
  desc.positions = view(kSquare, 4, BDPT_FORMAT_FLOAT3);
  desc.indices = view(kSquareIndices, 2, BDPT_FORMAT_UINT32X3);
  desc.uv[1] = view(kSquareUv, 4, BDPT_FORMAT_FLOAT2);
  return desc;
}

inline bdpt_shape_id add_square(bdpt_builder* builder) {
  const bdpt_mesh_desc desc = square_desc();
  bdpt_shape_id shape{};
  EXPECT_OK(bdpt_mesh_add(builder, &desc, &shape));
  return shape;
}

inline bdpt_shape_id add_sphere(bdpt_builder* builder) {
  bdpt_sphere_desc desc = make<bdpt_sphere_desc>();
  desc.radius = 0.5f;
  desc.label = "ball";
  bdpt_shape_id shape{};
  EXPECT_OK(bdpt_sphere_add(builder, &desc, &shape));
  return shape;
}

inline bdpt_material_desc grey_desc() {
  bdpt_material_desc desc = make<bdpt_material_desc>();
  desc.label = "grey";
  for (float& v : desc.reflectance) v = 0.5f;
  return desc;
}

inline bdpt_material_id add_grey(bdpt_builder* builder, float emission = 0) {
  bdpt_material_desc desc = grey_desc();
  for (float& v : desc.emission) v = emission;
  bdpt_material_id material{};
  EXPECT_OK(bdpt_material_add(builder, &desc, &material));
  return material;
}

// Scaled by s, moved up by y; turned over where down is set.
inline bdpt_instance_desc instance_desc(bdpt_shape_id shape, bdpt_material_id material, float s = 1, float y = 0,
                                        bool down = false) {
  bdpt_instance_desc desc = make<bdpt_instance_desc>();
  desc.shape = shape;
  desc.material = material;
  const float turn = down ? -s : s;
  const float transform[12] = {s, 0, 0, 0, 0, turn, 0, y, 0, 0, turn, 0};
  std::memcpy(desc.transform, transform, sizeof transform);
  return desc;
}

inline bdpt_instance_id add_instance(bdpt_builder* builder, bdpt_shape_id shape, bdpt_material_id material, float s = 1,
                                     float y = 0, bool down = false) {
  const bdpt_instance_desc desc = instance_desc(shape, material, s, y, down);
  bdpt_instance_id instance{};
  EXPECT_OK(bdpt_instance_add(builder, &desc, &instance));
  return instance;
}

// A ball on a floor under a lamp.
struct Contents {
  bdpt_shape_id square, ball;
  bdpt_material_id grey, lamp;
  bdpt_instance_id floor, light, thing;

  explicit Contents(bdpt_builder* b)
      : square(add_square(b)),
        ball(add_sphere(b)),
        grey(add_grey(b)),
        lamp(add_grey(b, 4)),
        floor(add_instance(b, square, grey, 3)),
        light(add_instance(b, square, lamp, 0.5f, 2, true)),
        thing(add_instance(b, ball, grey, 1, 0.5f)) {}
};

inline Scene build(bdpt_builder* builder) {
  bdpt_scene* scene = nullptr;
  EXPECT_OK(bdpt_scene_build(builder, nullptr, &scene));
  return Scene(scene);
}

inline uint64_t scene_hash(const bdpt_scene* scene) {
  bdpt_scene_info info = make<bdpt_scene_info>();
  EXPECT_OK(bdpt_scene_get_info(scene, &info));
  return info.hash;
}

inline bdpt_camera_desc camera_desc(uint32_t width = 24, uint32_t height = 16) {
  bdpt_camera_desc desc = make<bdpt_camera_desc>();
  desc.width = width;
  desc.height = height;
  const float transform[12] = {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 4};
  std::memcpy(desc.transform, transform, sizeof transform);
  return desc;
}

inline Sensor make_camera(bdpt_context* context, const bdpt_camera_desc& desc = camera_desc()) {
  bdpt_sensor* sensor = nullptr;
  EXPECT_OK(bdpt_camera_create(context, &desc, &sensor));
  return Sensor(sensor);
}

inline Film make_film(bdpt_sensor* sensor, const bdpt_film_desc* desc = nullptr) {
  bdpt_film* film = nullptr;
  EXPECT_OK(bdpt_film_create(sensor, desc, &film));
  return Film(film);
}

inline Render make_render(bdpt_scene* scene, bdpt_sensor* sensor, bdpt_film* film,
                          const bdpt_render_desc* desc = nullptr) {
  bdpt_render* render = nullptr;
  EXPECT_OK(bdpt_render_create(scene, sensor, film, desc, &render));
  return Render(render);
}

inline bdpt_advance_desc passes(uint64_t n) {
  bdpt_advance_desc desc = make<bdpt_advance_desc>();
  desc.passes = n;
  return desc;
}

inline bdpt_result advance(bdpt_render* render, uint64_t n) {
  const bdpt_advance_desc desc = passes(n);
  return bdpt_render_advance(render, &desc, nullptr);
}

inline bdpt_film_info info_of(const bdpt_film* film) {
  bdpt_film_info info = make<bdpt_film_info>();
  EXPECT_OK(bdpt_film_get_info(film, &info));
  return info;
}

inline std::vector<float> pixels_of(const bdpt_film* film, bdpt_layer layer = BDPT_LAYER_COLOR, uint32_t plane = 0) {
  const bdpt_film_info info = info_of(film);
  std::vector<float> pixels(size_t(info.width) * info.height * 3);
  bdpt_read_desc desc = make<bdpt_read_desc>();
  desc.layer = layer;
  desc.plane = plane;
  EXPECT_OK(bdpt_film_read(film, &desc, pixels.data(), pixels.size() * sizeof(float)));
  return pixels;
}

inline bdpt_context_info info_of(const bdpt_context* context) {
  bdpt_context_info info = make<bdpt_context_info>();
  EXPECT_OK(bdpt_context_get_info(context, &info));
  return info;
}
inline uint64_t memory_in_use(const bdpt_context* context) { return info_of(context).memory; }

// All it takes to render.
struct World {
  Context context;
  Builder builder;
  Contents contents;
  Scene scene;
  Sensor sensor;
  Film film;

  explicit World(const bdpt_context_desc* desc = nullptr)
      : context(make_context(desc)),
        builder(make_builder(context.get())),
        contents(builder.get()),
        scene(build(builder.get())),
        sensor(make_camera(context.get())),
        film(make_film(sensor.get())) {}
  Film new_film() const { return make_film(sensor.get()); }
  Render render(const bdpt_render_desc* desc = nullptr) const {
    return make_render(scene.get(), sensor.get(), film.get(), desc);
  }
  Render render(bdpt_film* into, const bdpt_render_desc* desc = nullptr) const {
    return make_render(scene.get(), sensor.get(), into, desc);
  }
};

}  // namespace bdpt_api
