/* bdpt.hpp: the library for C++17 and later. Handles that release themselves, exceptions, callables; nothing else.
 *
 * SPDX-License-Identifier: Apache-2.0
 *
 * bdpt.h is the manual: descriptions, ids and constants are those of C, and a function here does what the function of C
 * that it names does. What this header adds:
 *   Handles     Context, Scene, Sensor, Film and Cancel are copied by counting references; Builder and Render only
 * move. A handle that was moved from, or made from nullptr, is empty; calls on it throw INVALID_ARGUMENT. Errors      A
 * call that fails throws bdpt::Error: code() and what(). A cancelled advance is no error; what would have made an
 * object and was cancelled throws, with the code BDPT_CANCELLED. struct_size Functions here set it in the description
 * that they are given. In structs that a description points to, you do: make<bdpt_output_desc>() is zero but for its
 * size. What comes back is filled in. Callables   return nothing, or an int32_t of which zero goes on. One that throws
 * stops the call, and the exception leaves the call on the calling thread, when C has returned. Those of a single call
 * may be anything; those that the library keeps (executors, logs, textures, materials, measurements) are owned and
 * destroyed once, and are called as const, because several threads call them. Two calls of one context that fail at the
 * same time, by what is kept, may swap their exceptions. What a log throws is lost: it belongs to no call.
 *
 * All of it is inline, in the namespace bdpt::abi1: none of its names is one of the library's own (namespace bdpt), so
 * that a program may link the static library, and two parts of a program headers of two ABIs.
 */
#ifndef BDPT_HPP
#define BDPT_HPP

#include "bdpt.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bdpt {
inline namespace abi1 {

static_assert(BDPT_ABI == 1, "the inline namespace is named after the ABI");

// All defaults.
template <class T>
T make() {
  T desc{};
  desc.struct_size = static_cast<uint32_t>(sizeof desc);
  return desc;
}

class Error : public std::runtime_error {
 public:
  Error(bdpt_result code, const char* text) : std::runtime_error(text), code_(code) {}
  bdpt_result code() const noexcept { return code_; }
  const char* name() const noexcept { return bdpt_result_name(code_); }  // such as "BDPT_ERROR_IO"

 private:
  bdpt_result code_;
};

// Throws if a call of C failed; for those that are called without this header.
inline bdpt_result check(bdpt_result result) {
  if (result < 0) throw Error(result, bdpt_last_error());
  return result;
}

namespace detail {

// Does a class have a member of this name?
#define BDPT_HPP_DETECT(name)                     \
  template <class T>                              \
  auto has_##name(int)->decltype(&T::name, true); \
  template <class T>                              \
  char has_##name(...);                           \
  template <class T>                              \
  inline constexpr bool k_##name = std::is_same_v<bool, decltype(has_##name<T>(0))>;
BDPT_HPP_DETECT(struct_size)
BDPT_HPP_DETECT(begin)
BDPT_HPP_DETECT(end)
BDPT_HPP_DETECT(density)
BDPT_HPP_DETECT(respond)
BDPT_HPP_DETECT(land)
#undef BDPT_HPP_DETECT

// A description on its way to C, its size set.
template <class T>
struct In {
  T desc;
  explicit In(const T& d) : desc(d) { desc.struct_size = static_cast<uint32_t>(sizeof desc); }
  operator const T*() const { return &desc; }
};

// Carries the first exception of callables past C.
class Fault {
 public:
  // What the callable answers; another value than zero if it throws.
  template <class F, class... A>
  int32_t call(F&& f, A&&... a) noexcept {
    using Answer = std::invoke_result_t<F, A...>;
    static_assert(std::is_void_v<Answer> || (std::is_integral_v<Answer> && !std::is_same_v<Answer, bool>),
                  "a callable returns nothing, or an int32_t of which zero goes on");
    try {
      if constexpr (std::is_void_v<Answer>)
        return f(std::forward<A>(a)...), 0;
      else
        return f(std::forward<A>(a)...);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      return 1;
    }
  }
  void rethrow() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::exception_ptr thrown = std::exchange(thrown_, nullptr);
    lock.unlock();
    if (thrown) std::rethrow_exception(thrown);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr thrown_;
};
using SharedFault = std::shared_ptr<Fault>;

// Throws if a call failed: what the host's objects threw, if they are why.
inline bdpt_result check(bdpt_result result, const SharedFault& fault) {
  if (result == BDPT_ERROR_CALLBACK_FAILED && fault) fault->rethrow();
  return abi1::check(result);
}

// Calls a function of C that makes or fills its last parameter, and returns that. There is none after a cancel either.
template <class Out, class F, class... A>
Out call(const SharedFault& fault, F* function, const A&... arguments) {
  Out out{};
  if constexpr (k_struct_size<Out>) out = make<Out>();
  if (check(function(arguments..., &out), fault) == BDPT_CANCELLED) throw Error(BDPT_CANCELLED, "cancelled");
  return out;
}

// What the library keeps of the host's, and drops once.
struct Kept {
  virtual ~Kept() = default;
  bool* dropped = nullptr;
  static void drop(void* user) {
    auto* kept = static_cast<Kept*>(user);
    if (kept->dropped) *kept->dropped = true;
    delete kept;
  }
};
template <class F>
struct KeptOf final : Kept {
  KeptOf(F function, SharedFault f) : value(std::move(function)), fault(std::move(f)) {}
  const F value;
  SharedFault fault;
  // Calls f(value).
  template <class Call>
  static int32_t call(void* user, Call f) noexcept {
    auto* kept = static_cast<KeptOf*>(static_cast<Kept*>(user));
    return kept->fault->call([&] { return f(kept->value); });
  }
};

// Gives something to the library for the time of a call. Afterwards it is the library's, or was dropped by it, or the
// library did not get as far as to see it, and it is destroyed here.
class Handover {
 public:
  explicit Handover(std::unique_ptr<Kept> kept) : kept_(kept.release()) {
    if (kept_) kept_->dropped = &dropped_;
  }
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() {
    if (!kept_ || dropped_) return;
    kept_->dropped = nullptr;
    if (!taken_) delete kept_;
  }
  void* user() const { return kept_; }
  bdpt_result taken_if_ok(bdpt_result result) { return taken_ = result == BDPT_OK, result; }

 private:
  Kept* kept_;
  bool dropped_ = false, taken_ = false;
};

// A handle that is copied by counting.
template <class T, void (*Retain)(T*), void (*Release)(T*)>
class Counted {
 public:
  Counted(std::nullptr_t = nullptr) noexcept {}
  // Takes over a reference, as a create function of C gives it.
  explicit Counted(T* owned, SharedFault fault = nullptr) noexcept : handle_(owned), fault_(std::move(fault)) {}
  Counted(const Counted& o) noexcept : handle_(o.handle_), fault_(o.fault_) { Retain(handle_); }
  Counted(Counted&& o) noexcept : handle_(std::exchange(o.handle_, nullptr)), fault_(std::move(o.fault_)) {}
  Counted& operator=(Counted o) noexcept {
    std::swap(handle_, o.handle_);
    std::swap(fault_, o.fault_);
    return *this;
  }
  ~Counted() { Release(handle_); }
  T* get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ != nullptr; }
  const SharedFault& fault() const noexcept { return fault_; }

 protected:
  template <class Out, class F, class... A>
  Out call(F* function, const A&... arguments) const {
    return detail::call<Out>(fault_, function, handle_, arguments...);
  }

 private:
  T* handle_ = nullptr;
  SharedFault fault_;  // of the context
};

template <class T, void (*Destroy)(T*)>
struct Destroyer {
  void operator()(T* handle) const noexcept { Destroy(handle); }
};

struct None {};  // in place of a callable

// Puts a progress callable into a description, if there is one.
template <class Progress>
struct ProgressCall {
  Progress& progress;
  Fault& fault;
  static int32_t call(void* user, const bdpt_progress* p) {
    auto* self = static_cast<ProgressCall*>(user);
    return self->fault.call(self->progress, *p);
  }
  void put(bdpt_progress_fn& function, void*& user) {
    if constexpr (!std::is_same_v<std::decay_t<Progress>, None>) function = call, user = this;
  }
};

template <class Sink>
struct SinkCall {
  Sink& sink;
  Fault& fault;
  static SinkCall& self(void* user) { return *static_cast<SinkCall*>(user); }
  bdpt_output_sink c(uint32_t every) {
    auto result = make<bdpt_output_sink>();
    result.every = every;
    result.user = this;
    result.tile = [](void* user, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1, const float* pixels) {
      return self(user).fault.call([&] { return self(user).sink.tile(x0, y0, x1, y1, pixels); });
    };
    if constexpr (k_begin<Sink>)
      result.begin = [](void* user, uint32_t width, uint32_t height, uint64_t passes) {
        return self(user).fault.call([&] { return self(user).sink.begin(width, height, passes); });
      };
    if constexpr (k_end<Sink>)
      result.end = [](void* user, bdpt_result r) { self(user).fault.call([&] { self(user).sink.end(r); }); };
    return result;
  }
};

}  // namespace detail

/* --- Data of meshes --- */

// A view of an array, to be copied during the call.
inline bdpt_data data(const void* array, uint64_t count, bdpt_format format) {
  bdpt_data result{};
  result.data = array, result.count = count, result.format = format;
  return result;
}
// A view of an array that the library keeps: `owner` keeps it alive until the last builder or scene that needs it is
// gone. To be given to one call: it is leaked if it is given to none.
inline bdpt_data borrow(std::shared_ptr<const void> owner, const void* array, uint64_t count, bdpt_format format) {
  bdpt_data result = data(array, count, format);
  result.ownership = BDPT_OWNERSHIP_BORROW;
  result.user = new std::shared_ptr<const void>(std::move(owner));
  result.release = [](void* user, const void*) { delete static_cast<std::shared_ptr<const void>*>(user); };
  return result;
}

/* --- Context --- */

// The work that an executor is asked for: body(i) for each i below n.
class Body {
 public:
  Body(void (*body)(void*, uint32_t), void* user) : body_(body), user_(user) {}
  void operator()(uint32_t i) const { body_(user_, i); }

 private:
  void (*body_)(void*, uint32_t);
  void* user_;
};

// The host's threads: run(n, body) returns when body(i) has returned for each i. It may throw when no body runs any
// more.
class Executor {
 public:
  Executor() = default;  // none: the library's own threads
  template <class Run>
  Executor(uint32_t worker_count, Run run) : c_(make<bdpt_executor>()), fault_(std::make_shared<detail::Fault>()) {
    using Kept = detail::KeptOf<Run>;
    c_.worker_count = worker_count;
    c_.run = [](void* user, uint32_t n, void (*body)(void*, uint32_t), void* body_user) {
      Kept::call(user, [&](const Run& f) { f(n, Body(body, body_user)); });
    };
    c_.drop = detail::Kept::drop;
    kept_ = std::make_unique<Kept>(std::move(run), fault_);
  }

 private:
  friend class Context;
  bdpt_executor c_{};
  detail::SharedFault fault_;
  std::unique_ptr<detail::Kept> kept_;
};

// write(level, text)
class Log {
 public:
  Log() = default;  // silent
  template <class Write>
  explicit Log(Write write) : c_(make<bdpt_log>()) {
    using Kept = detail::KeptOf<Write>;
    c_.write = [](void* user, bdpt_log_level level, const char* text) {
      Kept::call(user, [&](const Write& f) { f(level, text); });
    };
    c_.drop = detail::Kept::drop;
    kept_ = std::make_unique<Kept>(std::move(write), std::make_shared<detail::Fault>());
  }

 private:
  friend class Context;
  bdpt_log c_{};
  std::unique_ptr<detail::Kept> kept_;
};

class Context : public detail::Counted<bdpt_context, bdpt_context_retain, bdpt_context_release> {
 public:
  using Counted::Counted;
  Context() : Context(bdpt_context_desc{}) {}
  explicit Context(bdpt_context_desc desc, Executor executor = {}, Log log = {})
      : Context(create(desc, std::move(executor), std::move(log))) {}
  bdpt_context_info info() const { return call<bdpt_context_info>(bdpt_context_get_info); }
  bdpt_color_info color_info() const { return call<bdpt_color_info>(bdpt_color_get_info); }
  void convert(const char* from, const char* to, float* rgb, uint64_t count) const {
    check(bdpt_color_convert(get(), from, to, rgb, count));
  }

 private:
  static Context create(bdpt_context_desc desc, Executor executor, Log log) {
    auto fault = executor.fault_ ? std::move(executor.fault_) : std::make_shared<detail::Fault>();
    detail::Handover run(std::move(executor.kept_)), write(std::move(log.kept_));
    if (run.user()) executor.c_.user = run.user(), desc.executor = &executor.c_;
    if (write.user()) log.c_.user = write.user(), desc.log = &log.c_;
    bdpt_context* made = nullptr;
    check(write.taken_if_ok(run.taken_if_ok(bdpt_context_create(BDPT_ABI, detail::In(desc), &made))));
    return Context(made, std::move(fault));
  }
};

// A token that stops the calls that it is given to: desc.cancel = token.get().
class Cancel : public detail::Counted<bdpt_cancel, bdpt_cancel_retain, bdpt_cancel_release> {
 public:
  using Counted::Counted;
  Cancel() : Cancel(detail::call<bdpt_cancel*>(nullptr, bdpt_cancel_create)) {}
  void request() const noexcept { bdpt_cancel_request(get()); }  // also from signal handlers
  void reset() const noexcept { bdpt_cancel_reset(get()); }
  bool is_requested() const noexcept { return bdpt_cancel_is_requested(get()) != 0; }
};

/* --- Scenes --- */

class Scene : public detail::Counted<bdpt_scene, bdpt_scene_retain, bdpt_scene_release> {
 public:
  using Counted::Counted;
  bdpt_scene_info info() const { return call<bdpt_scene_info>(bdpt_scene_get_info); }
  bdpt_scene_light light(uint32_t index) const { return call<bdpt_scene_light>(bdpt_scene_get_light, index); }
  bdpt_memory_estimate estimate(const bdpt_lightmap_desc& lightmap, const bdpt_film_desc& film = {},
                                uint64_t budget = 0) const {
    return call<bdpt_memory_estimate>(bdpt_lightmap_estimate, detail::In(lightmap), detail::In(film), budget);
  }
};

class Builder {
 public:
  Builder(std::nullptr_t) noexcept {}
  explicit Builder(const Context& context)
      : handle_(detail::call<bdpt_builder*>(nullptr, bdpt_builder_create, context.get())), fault_(context.fault()) {}
  bdpt_builder* get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

  bdpt_shape_id add_mesh(const bdpt_mesh_desc& d) { return add<bdpt_shape_id>(bdpt_mesh_add, d); }
  bdpt_shape_id add_sphere(const bdpt_sphere_desc& d) { return add<bdpt_shape_id>(bdpt_sphere_add, d); }
  bdpt_shape_id add_curves(const bdpt_curves_desc& d) { return add<bdpt_shape_id>(bdpt_curves_add, d); }
  bdpt_shape_id add_subdivision(const bdpt_subdivision_desc& d) { return add<bdpt_shape_id>(bdpt_subdivision_add, d); }
  // displace(count, positions, normals, uv, displaced)
  template <class Displace>
  bdpt_shape_id add_subdivision(bdpt_subdivision_desc desc, Displace&& displace) {
    detail::Fault fault;
    auto call = [&](uint64_t n, const float* p, const float* normals, const float* uv, float* displaced) {
      return fault.call(displace, n, p, normals, uv, displaced);
    };
    desc.user = &call;
    desc.displace = [](void* user, uint64_t n, const float* p, const float* normals, const float* uv, float* d) {
      return (*static_cast<decltype(call)*>(user))(n, p, normals, uv, d);
    };
    bdpt_shape_id id{};
    const bdpt_result result = bdpt_subdivision_add(get(), detail::In(desc), &id);
    fault.rethrow();
    check(result);
    return id;
  }
  bdpt_texture_id add_texture(const bdpt_texture_desc& d) { return add<bdpt_texture_id>(bdpt_texture_add, d); }
  // look_up(count, places, colors), as const, on any thread that renders.
  template <class LookUp>
  bdpt_texture_id add_host_texture(bdpt_host_texture_desc desc, LookUp look_up) {
    using Kept = detail::KeptOf<LookUp>;
    detail::Handover kept(std::make_unique<Kept>(std::move(look_up), fault_));
    desc.look_up = [](void* user, uint32_t n, const bdpt_texture_place* places, float(*colors)[4]) {
      return Kept::call(user, [&](const LookUp& f) { return f(n, places, colors); });
    };
    desc.user = kept.user(), desc.drop = detail::Kept::drop;
    bdpt_texture_id id{};
    check(kept.taken_if_ok(bdpt_host_texture_add(get(), detail::In(desc), &id)));
    return id;
  }
  bdpt_medium_id add_medium(const bdpt_medium_desc& d) { return add<bdpt_medium_id>(bdpt_medium_add, d); }
  bdpt_material_id add_material(const bdpt_material_desc& d) { return add<bdpt_material_id>(bdpt_material_add, d); }
  // And an object with the functions of bdpt_host_material, without `user` and const: evaluate and sample, on any
  // thread that renders. `host` has the rest. What they throw is a rejected contribution, like an answer other than
  // zero.
  template <class Material>
  bdpt_material_id add_host_material(bdpt_material_desc desc, bdpt_host_material host, Material material) {
    using Kept = detail::KeptOf<Material>;
    using Place = bdpt_scattering_place;
    detail::Handover kept(std::make_unique<Kept>(std::move(material), std::make_shared<detail::Fault>()));
    host.evaluate = [](void* user, const Place* place, const float next[3], bdpt_scattering_value* value) {
      return Kept::call(user, [&](const Material& m) { return m.evaluate(*place, next, *value); });
    };
    host.sample = [](void* user, const Place* place, const float u[3], float next[3]) {
      return Kept::call(user, [&](const Material& m) { return m.sample(*place, u, next); });
    };
    host.user = kept.user(), host.drop = detail::Kept::drop;
    const detail::In<bdpt_host_material> in(host);
    desc.type = BDPT_MATERIAL_HOST;
    desc.host = in;
    bdpt_material_id id{};
    check(kept.taken_if_ok(bdpt_material_add(get(), detail::In(desc), &id)));
    return id;
  }
  bdpt_light_id add_light(const bdpt_light_desc& d) { return add<bdpt_light_id>(bdpt_light_add, d); }
  bdpt_instance_id add_instance(const bdpt_instance_desc& d) { return add<bdpt_instance_id>(bdpt_instance_add, d); }

  void update(bdpt_medium_id id, const bdpt_medium_desc& d) { check(bdpt_medium_update(get(), id, detail::In(d))); }
  void update(bdpt_material_id id, const bdpt_material_desc& d) {
    check(bdpt_material_update(get(), id, detail::In(d)));
  }
  void update(bdpt_light_id id, const bdpt_light_desc& d) { check(bdpt_light_update(get(), id, detail::In(d))); }
  void update(bdpt_instance_id id, const bdpt_instance_desc& d) {
    check(bdpt_instance_update(get(), id, detail::In(d)));
  }

  void remove(bdpt_shape_id id) { check(bdpt_shape_remove(get(), id)); }
  void remove(bdpt_texture_id id) { check(bdpt_texture_remove(get(), id)); }
  void remove(bdpt_medium_id id) { check(bdpt_medium_remove(get(), id)); }
  void remove(bdpt_material_id id) { check(bdpt_material_remove(get(), id)); }
  void remove(bdpt_light_id id) { check(bdpt_light_remove(get(), id)); }
  void remove(bdpt_instance_id id) { check(bdpt_instance_remove(get(), id)); }

  // progress(const bdpt_progress&)
  template <class Progress = detail::None>
  Scene build(bdpt_build_desc desc = {}, Progress&& progress = {}) {
    detail::Fault fault;
    detail::ProgressCall<Progress> call{progress, fault};
    call.put(desc.progress, desc.user);
    bdpt_scene* made = nullptr;
    const bdpt_result result = bdpt_scene_build(get(), detail::In(desc), &made);
    Scene scene(made, fault_);
    fault.rethrow();
    if (detail::check(result, fault_) == BDPT_CANCELLED) throw Error(result, "cancelled");
    return scene;
  }

 private:
  template <class Id, class Add, class Desc>
  Id add(Add* function, const Desc& desc) {
    return detail::call<Id>(fault_, function, get(), detail::In(desc));
  }

  std::unique_ptr<bdpt_builder, detail::Destroyer<bdpt_builder, bdpt_builder_destroy>> handle_;
  detail::SharedFault fault_;
};

/* --- Sensors --- */

class Sensor : public detail::Counted<bdpt_sensor, bdpt_sensor_retain, bdpt_sensor_release> {
 public:
  using Counted::Counted;
  static Sensor camera(const Context& c, const bdpt_camera_desc& d) { return create(bdpt_camera_create, c, d); }
  static Sensor points(const Context& c, const bdpt_points_desc& d) { return create(bdpt_points_create, c, d); }
  static Sensor lightmap(const Scene& s, const bdpt_lightmap_desc& d) { return create(bdpt_lightmap_create, s, d); }
  static Sensor vertices(const Scene& s, const bdpt_vertices_desc& d) { return create(bdpt_vertices_create, s, d); }
  static Sensor custom(const Context& c, const bdpt_custom_desc& d) { return create(bdpt_custom_create, c, d); }
  // An object with the functions of bdpt_custom_desc, without `user` and const: start, and density, respond and land
  // where it has them. They are called from all threads that render. `desc` has the rest.
  template <class M>
  static Sensor custom(const Context& context, bdpt_custom_desc desc, M measurement) {
    using Kept = detail::KeptOf<M>;
    using Place = bdpt_measurement_place;
    detail::Handover kept(std::make_unique<Kept>(std::move(measurement), context.fault()));
    desc.start = [](void* user, uint32_t n, const uint64_t* which, const float(*u)[4], bdpt_measurement_start* starts) {
      return Kept::call(user, [&](const M& m) { return m.start(n, which, u, starts); });
    };
    if constexpr (detail::k_density<M>)
      desc.density = [](void* user, uint32_t n, const Place* places, float* densities) {
        return Kept::call(user, [&](const M& m) { return m.density(n, places, densities); });
      };
    if constexpr (detail::k_respond<M>)
      desc.respond = [](void* user, uint32_t n, const Place* places, float* responses) {
        return Kept::call(user, [&](const M& m) { return m.respond(n, places, responses); });
      };
    if constexpr (detail::k_land<M>)
      desc.land = [](void* user, uint32_t n, const bdpt_measurement_landing* from, bdpt_measurement_landed* landed) {
        return Kept::call(user, [&](const M& m) { return m.land(n, from, landed); });
      };
    desc.user = kept.user(), desc.drop = detail::Kept::drop;
    bdpt_sensor* made = nullptr;
    check(kept.taken_if_ok(bdpt_custom_create(context.get(), detail::In(desc), &made)));
    return Sensor(made, context.fault());
  }

  bdpt_plane_info plane(uint32_t index) const { return call<bdpt_plane_info>(bdpt_sensor_get_plane, index); }
  bdpt_memory_estimate estimate(const bdpt_film_desc& film = {}) const {
    return call<bdpt_memory_estimate>(bdpt_film_estimate, detail::In(film));
  }
  bdpt_lightmap_info lightmap_info() const { return call<bdpt_lightmap_info>(bdpt_lightmap_get_info); }
  // Capacities are in floats.
  void read_texels(float* coverage, float* area, uint64_t capacity) const {
    check(bdpt_lightmap_read_texels(get(), coverage, area, capacity));
  }
  void read_buried(float* buried, uint64_t capacity) const {
    check(bdpt_lightmap_read_buried(get(), buried, capacity));
  }
  void read_areas(float* areas, uint64_t capacity) const { check(bdpt_vertices_read_areas(get(), areas, capacity)); }
  void solve(uint32_t channels, float* values, uint64_t capacity) const {
    check(bdpt_vertices_solve(get(), channels, values, capacity));
  }

 private:
  template <class Create, class Parent, class Desc>
  static Sensor create(Create* function, const Parent& parent, const Desc& desc) {
    return Sensor(detail::call<bdpt_sensor*>(parent.fault(), function, parent.get(), detail::In(desc)), parent.fault());
  }
};

/* --- Film --- */

class Film : public detail::Counted<bdpt_film, bdpt_film_retain, bdpt_film_release> {
 public:
  using Counted::Counted;
  Film() = default;
  explicit Film(const Sensor& sensor, const bdpt_film_desc& desc = {})
      : Film(detail::call<bdpt_film*>(nullptr, bdpt_film_create, sensor.get(), detail::In(desc))) {}
  static Film load(const Context& context, const std::string& path) {
    return Film(detail::call<bdpt_film*>(nullptr, bdpt_film_load, context.get(), path.c_str()));
  }
  void save(const std::string& path) const { check(bdpt_film_save(get(), path.c_str())); }
  void clear() const { check(bdpt_film_clear(get())); }
  void merge(const Film& source) const { check(bdpt_film_merge(get(), source.get())); }
  bdpt_film_info info() const { return call<bdpt_film_info>(bdpt_film_get_info); }
  // Three floats to a pixel, in rows; capacity in bytes.
  void read(const bdpt_read_desc& desc, float* pixels, uint64_t capacity) const {
    check(bdpt_film_read(get(), detail::In(desc), pixels, capacity));
  }
  std::vector<float> read(const bdpt_read_desc& desc = {}) const {
    std::vector<float> pixels(value_count(desc.rect, 3, desc.row_stride / sizeof(float)));
    read(desc, pixels.data(), pixels.size() * sizeof(float));
    return pixels;
  }
  // desc.ranks entries to a pixel.
  std::vector<bdpt_coverage> read_coverage(const bdpt_coverage_desc& desc, double* lost = nullptr) const {
    std::vector<bdpt_coverage> entries(value_count(desc.rect, (std::min)(desc.ranks, 8u), 0));
    check(bdpt_film_read_coverage(get(), detail::In(desc), entries.data(), entries.size(), lost));
    return entries;
  }

 private:
  // Of a rectangle, in rows of `row` values unless that is 0. What is not in the film is for C to refuse.
  size_t value_count(const uint32_t rect[4], uint64_t values, uint64_t row) const {
    const bdpt_film_info film = info();
    const auto side = [](uint32_t first, uint32_t end, uint32_t whole) {
      return end == 0 ? whole : end < first ? 0 : (std::min)(end - first, whole);
    };
    const uint64_t width = side(rect[0], rect[2], film.width) * values;
    if (row >> 32) row = width;  // which C refuses, too
    return static_cast<size_t>(side(rect[1], rect[3], film.height) * (std::max)(width, row));
  }
};

/* --- Render --- */

class Render {
 public:
  Render(std::nullptr_t) noexcept {}
  Render(const Scene& scene, const Sensor& sensor, const Film& film, const bdpt_render_desc& desc = {})
      : fault_(scene.fault() ? scene.fault() : sensor.fault()) {
    handle_.reset(detail::call<bdpt_render*>(fault_, bdpt_render_create, scene.get(), sensor.get(), film.get(),
                                             detail::In(desc)));
  }
  bdpt_render* get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

  bdpt_advance_report advance(uint64_t passes) {
    bdpt_advance_desc desc{};
    desc.passes = passes;
    return advance(desc);
  }
  // progress(const bdpt_progress&). A cancel shows in the report's reason.
  template <class Progress = detail::None>
  bdpt_advance_report advance(const bdpt_advance_desc& desc, Progress&& progress = {}) {
    detail::Fault fault;
    return advance_by(desc, progress, fault);
  }
  // And an object with the functions of bdpt_output_sink, without `user`: tile, and begin and end where it has them.
  template <class Progress, class Sink>
  bdpt_advance_report advance(bdpt_advance_desc desc, Progress&& progress, Sink&& sink, uint32_t every = 0) {
    detail::Fault fault;
    detail::SinkCall<std::remove_reference_t<Sink>> call{sink, fault};
    const bdpt_output_sink c = call.c(every);
    desc.sink = &c;
    return advance_by(desc, progress, fault);
  }
  bdpt_render_stats stats() const { return detail::call<bdpt_render_stats>(nullptr, bdpt_render_get_stats, get()); }
  bdpt_technique_stats technique_stats(uint32_t s, uint32_t t) const {
    return detail::call<bdpt_technique_stats>(nullptr, bdpt_render_get_technique_stats, get(), s, t);
  }

 private:
  template <class Progress>
  bdpt_advance_report advance_by(bdpt_advance_desc desc, Progress& progress, detail::Fault& fault) {
    detail::ProgressCall<Progress> call{progress, fault};
    call.put(desc.progress, desc.progress_user);
    auto report = make<bdpt_advance_report>();
    const bdpt_result result = bdpt_render_advance(get(), detail::In(desc), &report);
    fault.rethrow();
    detail::check(result, fault_);
    return report;
  }

  std::unique_ptr<bdpt_render, detail::Destroyer<bdpt_render, bdpt_render_destroy>> handle_;
  detail::SharedFault fault_;
};

}  // namespace abi1
}  // namespace bdpt

#endif  // BDPT_HPP
