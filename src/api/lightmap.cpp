#include "bake/lightmap.h"

#include "api/film_desc.h"
#include "api/handles.h"
#include "api/host_array.h"
#include "api/named_instances.h"
#include "api/output_desc.h"
#include "api/parallel.h"
#include "api/read_rect.h"

#include <algorithm>
#include <numeric>

using namespace bdpt;

namespace {

AtlasStack read_size(const Subject& subject, const bdpt_lightmap_desc& desc) {
  subject.check_range("width", desc.width, 1, kMaxImageSide);
  subject.check_range("height", desc.height, 1, kMaxImageSide);
  const uint32_t atlases = desc.atlas_count == 0 ? 1 : desc.atlas_count;
  if (uint64_t(atlases) * desc.height > kMaxImageSide)
    subject.refuse("atlas_count", "is ", atlases, ": ", atlases, " atlases of ", desc.height, " rows are more than ",
                   kMaxImageSide, " rows: bake them in several lightmaps");
  return {int(desc.width), int(desc.height), int(atlases)};
}

LightmapInstance read_instance(const bdpt_lightmap_instance& desc, uint32_t number, const Scene& scene,
                               const NamedInstances& named, const AtlasStack& size) {
  const std::string name = "instance " + std::to_string(number);
  const Subject subject(name.c_str(), nullptr);
  const uint32_t index = named.find(name, desc.instance.id);
  const std::string& label = scene.instance_label(index);
  const std::string told = label.empty() ? name : name + ", \"" + label + '"';
  const Mesh* mesh = scene.mesh(index);
  if (!mesh)
    fail(ErrorCode::InvalidArgument, told, " is a sphere or of curves, which have no texture coordinates: give meshes");
  subject.check_range("uv_set", desc.uv_set, 0, 1);
  subject.check_range("atlas", desc.atlas, 0, size.count - 1);
  subject.check_flag("flip", desc.flip);
  subject.check_finite("scale", desc.scale, 2);
  subject.check_finite("offset", desc.offset, 2);
  LightmapInstance instance;
  instance.instance = index;
  instance.atlas = int(desc.atlas);
  instance.uv_set = desc.uv_set == 0 ? 1 : 0;
  if (mesh->uv[instance.uv_set].empty())
    fail(ErrorCode::InvalidArgument, told, " has no uv set ", instance.uv_set,
         ": give its mesh one, or leave the instance out (it casts shadows all the same)");
  if (desc.scale[0] != 0 || desc.scale[1] != 0) instance.scale = {desc.scale[0], desc.scale[1]};
  instance.offset = {desc.offset[0], desc.offset[1]};
  instance.flip = desc.flip != 0;
  return instance;
}

std::vector<LightmapInstance> read_instances(const Subject& subject, const bdpt_lightmap_desc& desc, const Scene& scene,
                                             const AtlasStack& size) {
  if (desc.instance_count == 0) subject.refuse("instance_count", "is 0: name the instances to bake");
  require(desc.instances, "instances");
  check_stride(subject, "instance_stride", desc.instance_stride, kVersion1Size<bdpt_lightmap_instance>, 8);
  NamedInstances named(scene);
  std::vector<LightmapInstance> instances;
  for (uint32_t i = 0; i < desc.instance_count; ++i) {
    const bdpt_lightmap_instance d = read_struct(&element(desc.instances, i, desc.instance_stride), "instances");
    instances.push_back(read_instance(d, i, scene, named, size));
    named.take(subject, instances.back().instance, i, "give it one place in the atlas");
  }
  return instances;
}

const Lightmap& lightmap_of(const bdpt_sensor* sensor) {
  const auto* lightmap = dynamic_cast<const Lightmap*>(require(sensor, "sensor").sensor.get());
  if (!lightmap) fail(ErrorCode::InvalidArgument, "sensor is no lightmap: give one of bdpt_lightmap_create");
  return *lightmap;
}

constexpr float kBackfaceTolerance = 0.5f;

BurialDesc read_burial(const Subject& subject, const bdpt_lightmap_desc& desc, Executor& executor) {
  BurialDesc burial;
  subject.check_range("buried_rays", desc.buried_rays, 0, 4096);
  subject.check_range("backface_tolerance", desc.backface_tolerance, 0, 0x1.fffffep-1);
  subject.check_flag("all_backs", desc.all_backs);
  if (desc.buried_rays == 0 && (desc.backface_tolerance != 0 || desc.all_backs != 0))
    subject.refuse(desc.all_backs != 0 ? "all_backs" : "backface_tolerance",
                   "is set although buried_rays is 0, and nothing is looked for: give buried_rays, such as 16");
  burial.rays = int(desc.buried_rays);
  burial.tolerance = desc.backface_tolerance != 0 ? desc.backface_tolerance : kBackfaceTolerance;
  burial.all_backs = desc.all_backs != 0;
  burial.parallel = [&executor, cancel = desc.cancel](uint32_t n, const std::function<void(uint32_t)>& body) {
    run_parallel(executor, n, [&](uint32_t i) {
      if (bdpt_cancel_is_requested(cancel)) throw RayScene::Cancelled();
      body(i);
    });
  };
  return burial;
}

[[noreturn]] void refuse_empty(const Subject& subject, const bdpt_lightmap_desc& desc, const TexelMap::Report& report) {
  if (report.buried > 0)
    subject.refuse("instances", "cover ", report.buried, " texels", desc.rect[2] ? " of rect" : "",
                   ", and all are buried: see to the sides of the surfaces round them, flip, and backface_tolerance");
  subject.refuse("instances", "cover no texel", desc.rect[2] ? " of rect" : "",
                 ": see to their texture coordinates, scale and offset");
}

void report_unmeasured(const Log& log, const TexelMap::Report& report) {
  if (report.unmapped > 0)
    log.warning("lightmap: ", report.unmapped, " triangles have no area in the atlas and are not measured");
  if (report.outside > 0)
    log.warning("lightmap: ", report.outside, " triangles reach out of the atlas; what lies outside is not measured");
  if (report.shared > 0)
    log.warning("lightmap: ", report.shared, " texels are shared by several instances, and measure the mean of all");
}

LightmapDesc read_lightmap(const Subject& subject, const bdpt_lightmap_desc& desc, const bdpt_scene& scene) {
  LightmapDesc result;
  result.size = read_size(subject, desc);
  result.subset = read_rect(subject, "rect", desc.rect, result.size.width, result.size.height * result.size.count);
  subject.check_flag("geometric_normals", desc.geometric_normals);
  result.geometric_normals = desc.geometric_normals != 0;
  subject.check_flag("film_of_rect", desc.film_of_rect);
  subject.check_reserved("reserved", desc.reserved);
  result.film_of_rect = desc.film_of_rect != 0;
  result.burial = read_burial(subject, desc, *scene.context->executor);
  result.instances = read_instances(subject, desc, *scene.scene, result.size);
  return result;
}

// The largest sum of `height` rows in a row, of the `count` from `first` on.
uint64_t most_of_window(const std::vector<uint64_t>& rows, uint64_t first, uint64_t count, uint64_t height) {
  uint64_t sum = 0, most = 0;
  for (uint64_t i = 0; i < count; ++i) {
    sum += rows[first + i];
    if (i >= height) sum -= rows[first + i - height];
    most = std::max(most, sum);
  }
  return most;
}

// One number of each texel, in rows; numbers may be NULL.
template <class Of>
void read_each(const TexelMap& texels, float* numbers, uint64_t capacity, Of&& of) {
  const uint64_t needed = uint64_t(texels.width()) * uint64_t(texels.height());
  if (capacity < needed) fail(ErrorCode::InvalidArgument, "capacity is ", capacity, " floats: ", needed, " are needed");
  if (!numbers) return;
  for (int y = 0; y < texels.height(); ++y)
    for (int x = 0; x < texels.width(); ++x) *numbers++ = of(x, y);
}

}  // namespace

bdpt_result bdpt_lightmap_create(bdpt_scene* scene, const bdpt_lightmap_desc* desc, bdpt_sensor** sensor) {
  return guard(__func__, [&] {
    reset_output(sensor);
    require(scene, "scene");
    const bdpt_lightmap_desc d = read_struct(desc, "desc");
    require(sensor, "sensor");
    const Subject subject("lightmap", nullptr);
    const LightmapDesc lightmap_desc = read_lightmap(subject, d, *scene);
    const auto outputs = read_outputs(subject, d.outputs, d.output_count, d.output_stride, OutputKind::Irradiance);
    const auto lightmap = std::make_shared<const Lightmap>(scene->scene, lightmap_desc, outputs, scene->context->meter);
    if (lightmap->count() == 0) refuse_empty(subject, d, lightmap->texels().report());
    report_unmeasured(*scene->context->log, lightmap->texels().report());
    auto object = std::make_unique<bdpt_sensor>();
    object->context = scene->context;
    object->sensor = lightmap;
    object->scene = scene->scene;
    *sensor = object.release();
  });
}

bdpt_result bdpt_lightmap_estimate(bdpt_scene* scene, const bdpt_lightmap_desc* desc, const bdpt_film_desc* film,
                                   uint64_t budget, bdpt_memory_estimate* estimate) {
  return guard(__func__, [&] {
    const bdpt_scene& s = require(scene, "scene");
    const bdpt_lightmap_desc d = read_struct(desc, "desc");
    const bdpt_film_desc f = read_optional_struct(film, "film");
    check_output_struct(estimate, "estimate");
    const Subject subject("lightmap", nullptr);
    LightmapDesc lightmap = read_lightmap(subject, d, s);
    const auto outputs = read_outputs(subject, d.outputs, d.output_count, d.output_stride, OutputKind::Irradiance);
    const bool with_chi = lightmap.burial.rays > 0;
    const auto bytes_of = [&](const PixelRect& window, uint64_t fragments) {
      const SensorShape shape{window.width(), window.y1 - window.y0, FilmPlanes(Outputs(outputs).planes()), 0, true};
      const FilmDesc film_desc = read_film(f, shape);
      bdpt_memory_estimate e{};
      e.sensor = TexelMap::bytes_for(window.count(), fragments, with_chi);
      e.film = Film::bytes_for(film_desc);
      e.render = Render::bytes_of_blocks(*s.context->executor, film_desc);
      e.total = e.sensor + e.film + e.render;
      return e;
    };
    const std::vector<uint64_t> rows = TexelMap::count_fragments(*s.scene, lightmap);
    bdpt_memory_estimate result = bytes_of(lightmap.window(), std::accumulate(rows.begin(), rows.end(), uint64_t(0)));

    // The most rows of a band that fit, wherever it begins.
    const MemoryMeter& meter = *s.context->meter;
    if (budget == 0) budget = meter.limit() == 0 ? ~uint64_t(0) : meter.limit() - std::min(meter.limit(), meter.used());
    const PixelRect& rect = lightmap.subset;
    const uint64_t first = uint64_t(rect.y0 - lightmap.window().y0);
    const auto fits = [&](uint32_t height) {
      return bytes_of({rect.x0, 0, rect.x1, int(height)},
                      most_of_window(rows, first, uint64_t(rect.y1 - rect.y0), height))
                 .total <= budget;
    };
    uint32_t low = 0, high = uint32_t(rect.y1 - rect.y0);
    while (low < high) {
      const uint32_t middle = low + (high - low + 1) / 2;
      if (fits(middle))
        low = middle;
      else
        high = middle - 1;
    }
    result.band_rows = low;
    write_struct(result, estimate);
  });
}

bdpt_result bdpt_lightmap_get_info(const bdpt_sensor* sensor, bdpt_lightmap_info* info) {
  return guard(__func__, [&] {
    const Lightmap& lightmap = lightmap_of(sensor);
    check_output_struct(info, "info");
    const TexelMap::Report& report = lightmap.texels().report();
    bdpt_lightmap_info i{};
    i.width = uint32_t(lightmap.width());
    i.height = uint32_t(lightmap.height());
    i.texels = report.texels;
    i.texels_shared = report.shared;
    i.triangles_unmapped = report.unmapped;
    i.triangles_outside = report.outside;
    i.area = report.area;
    i.area_outside = report.area_outside;
    i.texels_buried = report.buried;
    i.area_buried = report.area_buried;
    write_struct(i, info);
  });
}

bdpt_result bdpt_lightmap_read_texels(const bdpt_sensor* sensor, float* coverage, float* area, uint64_t capacity) {
  return guard(__func__, [&] {
    const TexelMap& texels = lightmap_of(sensor).texels();
    read_each(texels, coverage, capacity, [&](int x, int y) { return texels.coverage(x, y); });
    read_each(texels, area, capacity, [&](int x, int y) { return texels.area(x, y); });
  });
}

bdpt_result bdpt_lightmap_read_buried(const bdpt_sensor* sensor, float* buried, uint64_t capacity) {
  return guard(__func__, [&] {
    const TexelMap& texels = lightmap_of(sensor).texels();
    require(buried, "buried");
    read_each(texels, buried, capacity, [&](int x, int y) { return texels.buried(x, y); });
  });
}
