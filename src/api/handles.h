// What the counted handles and the render are made of. Each keeps its context, and thereby device and threads, alive.
#pragma once

#include "api/busy.h"
#include "api/counted.h"
#include "api/log.h"
#include "base/memory.h"
#include "color/color_spaces.h"
#include "film/film.h"
#include "geometry/embree.h"
#include "render/executor.h"
#include "render/render.h"
#include "scene/scene.h"
#include "sensor/sensor.h"

#include <atomic>
#include <memory>

struct bdpt_context : bdpt::Counted<bdpt_context> {
  std::unique_ptr<const bdpt::Log> log;
  std::shared_ptr<bdpt::MemoryMeter> meter;
  std::shared_ptr<bdpt::Executor> executor;
  std::shared_ptr<const bdpt::RayDevice> device;
  std::unique_ptr<const bdpt::ColorSpaces> colors;
};

struct bdpt_cancel : bdpt::Counted<bdpt_cancel> {
  std::atomic<bool> requested{false};
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may ask for a stop");
};

struct bdpt_scene : bdpt::Counted<bdpt_scene> {
  bdpt::Ref<bdpt_context> context;
  std::shared_ptr<const bdpt::Scene> scene;
  uint32_t lights = 0;
};

struct bdpt_sensor : bdpt::Counted<bdpt_sensor> {
  bdpt::Ref<bdpt_context> context;
  std::shared_ptr<const bdpt::Sensor> sensor;
  std::shared_ptr<const bdpt::Scene> scene;  // of sensors that measure a scene's surfaces; else empty
};

struct bdpt_film : bdpt::Counted<bdpt_film> {
  bdpt::Ref<bdpt_context> context;
  std::shared_ptr<bdpt::Film> film;
  bdpt::Busy busy;
};

struct bdpt_render {
  bdpt::Ref<bdpt_context> context;
  bdpt::Ref<bdpt_film> film;
  std::unique_ptr<bdpt::Render> render;
  bdpt::Busy busy;
};
