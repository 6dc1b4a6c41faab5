// What the tests of the header for C++ share: a scene, what callables throw, and what errors must say.
#pragma once

#include "bdpt.hpp"

#include "api_scene.h"

#include <atomic>
#include <functional>

namespace bdpt_api {

// What callables throw: nothing that the library knows.
struct Thrown {
  int number;
};

// The call throws what a callable threw.
inline void expect_thrown(int number, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown instead of " << number;
  } catch (const Thrown& thrown) {
    EXPECT_EQ(number, thrown.number);
  }
}

// The call fails with a text that has this part.
inline void expect_error(bdpt_result code, const char* part, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "no error instead of " << bdpt_result_name(code);
  } catch (const bdpt::Error& error) {
    EXPECT_EQ(code, error.code()) << error.what();
    EXPECT_STREQ(bdpt_result_name(code), error.name());
    EXPECT_NE(nullptr, std::strstr(error.what(), part)) << '"' << part << "\" in: " << error.what();
  }
}

// Something captured, of which there is one as long as the callable lives.
class Captured {
 public:
  explicit Captured(std::atomic<int>& alive) : alive_(&alive) { ++*alive_; }
  Captured(const Captured& o) : alive_(o.alive_) { ++*alive_; }
  Captured& operator=(const Captured&) = delete;
  ~Captured() { --*alive_; }

 private:
  std::atomic<int>* alive_;
};

// The floor, lamp and ball of Contents.
struct HppContents {
  bdpt_shape_id square, ball;
  bdpt_material_id grey, lamp;

  explicit HppContents(bdpt::Builder& b) {
    square = b.add_mesh(square_desc());
    bdpt_sphere_desc sphere{};
    sphere.radius = 0.5f;
    sphere.label = "ball";
    ball = b.add_sphere(sphere);
    bdpt_material_desc material = grey_desc();
    material.struct_size = 0;  // is set for us
    grey = b.add_material(material);
    for (float& v : material.emission) v = 4;
    lamp = b.add_material(material);
    b.add_instance(instance_desc(square, grey, 3));
    b.add_instance(instance_desc(square, lamp, 0.5f, 2, true));
    b.add_instance(instance_desc(ball, grey, 1, 0.5f));
  }
};

inline bdpt_context_desc two_threads() {
  bdpt_context_desc desc{};
  desc.threads = 2;
  return desc;
}

struct HppWorld {
  bdpt::Context context;
  bdpt::Builder builder;
  HppContents contents;
  bdpt::Scene scene;
  bdpt::Sensor sensor;
  bdpt::Film film;

  explicit HppWorld(bdpt::Executor executor = {}, bdpt::Log log = {}, bdpt_context_desc desc = {})
      : context(desc, std::move(executor), std::move(log)),
        builder(context),
        contents(builder),
        scene(builder.build()),
        sensor(bdpt::Sensor::camera(context, camera_desc())),
        film(sensor) {}
  bdpt::Render render() const { return {scene, sensor, film}; }
};

}  // namespace bdpt_api
