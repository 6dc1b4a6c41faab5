#include "api/builder.h"
#include "api/desc.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <unordered_map>

using namespace bdpt;

namespace {

// Turns what the builder holds into a scene description. Only what an instance uses goes in, in the order of its first
// use, so that neither ids nor what is not seen decide anything.
class Collector {
 public:
  explicit Collector(const bdpt_builder& builder) : builder_(builder) {}

  SceneDesc collect(bdpt_medium_id outside) {
    if (outside.id != 0) desc_.outside = medium(outside.id);
    desc_.instances.reserve(builder_.instances.size());
    for (const auto& [id, instance] : builder_.instances)
      desc_.instances.push_back({instance.label, shape(instance.shape), material(instance.material), instance.transform,
                                 instance.end, instance.moves, id, instance.material, instance.invisible});
    for (const auto& [id, entry] : builder_.lights) {
      LightDesc& light = desc_.lights.emplace_back(entry.light);
      light.id = id;
      if (entry.texture) light.texture = desc_.textures[size_t(texture(entry.texture))];
    }
    return std::move(desc_);
  }

 private:
  // The index of an id; add() appends the object where it has none yet.
  template <class Add>
  static int index(std::unordered_map<uint64_t, int>& indices, uint64_t id, Add&& add) {
    const auto [place, is_new] = indices.try_emplace(id, static_cast<int>(indices.size()));
    if (is_new) add();
    return place->second;
  }
  int shape(uint64_t id) {
    return index(shapes_, id, [&] { desc_.shapes.push_back(builder_.shapes[id].shape); });
  }
  int texture(uint64_t id) {
    return index(textures_, id, [&] { desc_.textures.push_back(builder_.textures[id].texture); });
  }
  int host_texture(uint64_t id) {
    return index(host_textures_, id, [&] { desc_.host_textures.push_back(builder_.textures[id].host); });
  }
  int medium(uint64_t id) {
    return index(media_, id, [&] { desc_.media.push_back(builder_.media[id].medium); });
  }
  int material(uint64_t id) {
    const int number = index(materials_, id, [&] {
      const MaterialEntry& entry = builder_.materials[id];
      desc_.materials.push_back(entry.material);
      MaterialDesc& desc = desc_.materials.back();
      const auto id_of = [&](int number) { return entry.textures[size_t(number)]; };
      for (TextureUse& use : desc.textures)
        use.texture = use.is_hosts ? host_texture(id_of(use.texture)) : texture(id_of(use.texture));
      if (desc.opacity.texture >= 0) desc.opacity.texture = texture(id_of(desc.opacity.texture));
      if (entry.medium) desc.interior = medium(entry.medium);
    });
    if (desc_.materials[size_t(number)].type == MaterialType::Mix)
      for (int i = 0; i < 2; ++i) {
        const int part = material(builder_.materials[id].parts[i]);
        desc_.materials[size_t(number)].mixed[i] = part;
      }
    return number;
  }

  const bdpt_builder& builder_;
  SceneDesc desc_;
  std::unordered_map<uint64_t, int> shapes_, textures_, host_textures_, materials_, media_;
};

void check_contents(const bdpt_builder& builder) {
  if (builder.instances.empty() && builder.lights.empty())
    fail(ErrorCode::InvalidArgument, "the builder holds no instance and no light: add something to render");
}

// Every light, and those that shine.
struct LightCount {
  uint32_t all = 0, shining = 0;

  explicit LightCount(const SceneDesc& desc) {
    for (const LightDesc& light : desc.lights) add(light.strength());
    for (const InstanceDesc& instance : desc.instances) {
      const Rgb& emission = desc.materials[size_t(instance.material)].emission;
      if (!is_black(emission)) add(emission);
    }
  }
  void add(const Rgb& strength) {
    ++all;
    if (!is_black(strength)) ++shining;
  }
};

// What the engine asks from time to time while it builds: it may be asked on any thread.
class BuildProgress {
 public:
  BuildProgress(const bdpt_build_desc& desc, HostCalls& calls) : desc_(desc), calls_(calls) {}

  // False stops the build. Tells the host at most ten times a second, but the first time and whenever it must.
  bool operator()(double fraction, bool must_tell = false) {
    if (desc_.cancel && bdpt_cancel_is_requested(desc_.cancel)) return false;
    if (calls_.failed()) return false;
    if (!desc_.progress) return true;
    return calls_.run("desc.progress", [&]() -> int32_t {
      const auto now = std::chrono::steady_clock::now();
      if (!must_tell && now - told_ < std::chrono::milliseconds(100)) return 0;
      told_ = now;
      fraction_ = std::clamp(fraction, fraction_, 1.0);
      bdpt_progress progress{};
      progress.struct_size = sizeof progress;
      progress.fraction = fraction_;
      progress.seconds = std::chrono::duration<double>(now - begin_).count();
      return desc_.progress(desc_.user, &progress);
    });
  }

 private:
  const bdpt_build_desc& desc_;
  HostCalls& calls_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), told_ = begin_;
  double fraction_ = 0;
};

bdpt_build_desc read_build_desc(const bdpt_build_desc* caller) {
  const bdpt_build_desc desc = read_optional_struct(caller, "desc");
  if (desc.reserved != 0) fail(ErrorCode::InvalidArgument, "desc.reserved is ", desc.reserved, ": it must be 0");
  return desc;
}

// Builds on the executor's threads; throws RayScene::Cancelled, or CallbackFailed.
std::shared_ptr<const Scene> build(const bdpt_context& context, SceneDesc desc, const bdpt_build_desc& options) {
  HostCalls calls;
  BuildProgress progress(options, calls);
  std::shared_ptr<const Scene> scene;
  std::exception_ptr thrown;
  bool going = progress(0, true);
  if (going) {
    // What is thrown must not cross the executor, which may be the host's.
    context.executor->isolate([&] {
      try {
        scene = std::make_shared<const Scene>(std::move(desc), context.device, context.meter,
                                              [&](double fraction) { return progress(fraction); });
      } catch (...) {
        thrown = std::current_exception();
      }
    });
    if (!thrown) going = progress(1, true);
  }
  calls.check();
  if (thrown) std::rethrow_exception(thrown);
  if (!going) throw RayScene::Cancelled();
  return scene;
}

}  // namespace

bdpt_result bdpt_scene_build(bdpt_builder* builder, const bdpt_build_desc* desc, bdpt_scene** scene) {
  return guard(__func__, [&] {
    reset_output(scene);
    bdpt_builder& b = writable(builder);
    const bdpt_build_desc d = read_build_desc(desc);
    require(scene, "scene");
    check_contents(b);
    const Busy::Mark mark(b.busy);
    const Ref<bdpt_cancel> cancel(d.cancel);  // the host's callbacks may release theirs
    if (d.medium.id != 0) b.media.at(d.medium.id, "desc.medium");
    SceneDesc contents = Collector(b).collect(d.medium);
    const LightCount lights(contents);
    auto object = std::make_unique<bdpt_scene>();
    object->context = b.context;
    object->lights = lights.all;
    object->scene = build(*b.context, std::move(contents), d);
    if (lights.shining == 0) b.context->log->warning("the scene has no light and renders black");
    *scene = object.release();
  });
}

void bdpt_scene_retain(bdpt_scene* scene) {
  if (scene) scene->retain();
}

void bdpt_scene_release(bdpt_scene* scene) {
  if (scene) scene->release();
}

bdpt_result bdpt_scene_get_info(const bdpt_scene* scene, bdpt_scene_info* info) {
  return guard(__func__, [&] {
    require(scene, "scene");
    check_output_struct(info, "info");
    const SceneInfo& from = scene->scene->info();
    bdpt_scene_info result{};
    result.lights = scene->lights;
    result.instances = from.instances;
    result.triangles = from.triangles;
    result.spheres = from.spheres;
    result.degenerate_triangles = from.degenerate;
    result.memory = from.memory;
    result.memory_embree = from.memory_embree;
    result.hash = from.hash;
    result.curves = from.curves;
    for (int axis = 0; axis < 3; ++axis) {
      result.bounds_min[axis] = from.bounds_min[axis];
      result.bounds_max[axis] = from.bounds_max[axis];
    }
    write_struct(result, info);
  });
}

bdpt_result bdpt_scene_get_light(const bdpt_scene* scene, uint32_t index, bdpt_scene_light* light) {
  return guard(__func__, [&] {
    const bdpt_scene& s = require(scene, "scene");
    check_output_struct(light, "light");
    if (index >= s.lights)
      fail(ErrorCode::InvalidArgument, "index is ", index, ": the scene has ", s.lights, " lights");
    const Scene& from = *s.scene;
    bdpt_scene_light result{};
    if (index < from.light_descs().size()) {
      const LightDesc& desc = from.light_descs()[index];
      result.group = desc.group;
      result.light.id = desc.id;
      result.label = desc.label.c_str();
    } else {
      uint64_t left = index - from.light_descs().size();
      uint32_t i = 0;
      while (is_black(from.material(i).emission) || left-- > 0) ++i;
      result.group = from.material(i).emission_group;
      result.instance.id = from.instance_id(i);
      result.label = from.instance_label(i).c_str();
    }
    write_struct(result, light);
  });
}
