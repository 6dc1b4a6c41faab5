#include "bake/custom.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/host_calls.h"
#include "film/film.h"
#include "render/float_mode.h"

using namespace bdpt;

namespace {

constexpr uint64_t kMaxMeasurements = uint64_t(1) << 32;

void copy(const Vec3& from, float to[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

// The host's functions as the engine calls them. Instances are told by the builder's ids.
class HostMeasurement final : public Measurement {
 public:
  HostMeasurement(const bdpt_custom_desc& desc, FinalCall drop) : desc_(desc), drop_(std::move(drop)) {}

  bool has_density() const override { return desc_.density; }
  bool has_response() const override { return desc_.respond; }
  bool has_landing() const override { return desc_.land; }

  void start(uint32_t n, const uint64_t* measurements, const float (*numbers)[4], EyeStart* starts) const override {
    std::vector<bdpt_measurement_start> given(n);
    call("start", [&] { return desc_.start(desc_.user, n, measurements, numbers, given.data()); });
    for (uint32_t i = 0; i < n; ++i) {
      const bdpt_measurement_start& g = given[i];
      EyeStart& s = starts[i];
      s = EyeStart{};
      s.p = to_vec3(g.position), s.normal = to_vec3(g.normal), s.direction = to_vec3(g.direction);
      s.weight_position = g.weight;
      s.density_position = g.density_position, s.density_direction = g.density_direction;
      s.margin = g.offset;
    }
  }
  float density(uint64_t measurement, const SensorPlace& place, const Vec3& w) const override {
    const bdpt_measurement_place p = place_of(measurement, place, w);
    float density = 0;
    call("density", [&] { return desc_.density(desc_.user, 1, &p, &density); });
    return density;
  }
  void respond(uint64_t measurement, const SensorPlace& place, const Vec3& w, float* response) const override {
    const bdpt_measurement_place p = place_of(measurement, place, w);
    call("respond", [&] { return desc_.respond(desc_.user, 1, &p, response); });
  }
  bool land(const Landing& landing, uint64_t& measurement, SensorPoint& z0) const override {
    bdpt_measurement_landing l{};
    l.instance.id = landing.id;
    l.triangle = landing.primitive, l.u = landing.u, l.v = landing.v;
    copy(landing.p, l.position), copy(landing.ng, l.normal), copy(-landing.direction, l.direction);
    bdpt_measurement_landed landed{};
    call("land", [&] { return desc_.land(desc_.user, 1, &l, &landed); });
    if (landed.measurement >= desc_.measurements) return false;
    measurement = landed.measurement;
    z0.normal = to_vec3(landed.normal);
    z0.importance = landed.weight;
    z0.density_position = landed.density_position;
    return true;
  }

 private:
  template <class Call>
  static void call(const char* name, Call&& function) {
    const HostFloatMode mode;
    if (const int32_t result = function(); result != 0)
      fail(ErrorCode::CallbackFailed, "the measurement's function ", name, " returned ", result);
  }
  static bdpt_measurement_place place_of(uint64_t measurement, const SensorPlace& place, const Vec3& w) {
    bdpt_measurement_place p{};
    p.measurement = measurement;
    copy(place.p, p.position), copy(place.normal, p.normal), copy(w, p.direction);
    return p;
  }

  bdpt_custom_desc desc_;
  FinalCall drop_;
};

}  // namespace

bdpt_result bdpt_custom_create(bdpt_context* context, const bdpt_custom_desc* desc, bdpt_sensor** sensor) {
  return guard(__func__, [&] {
    reset_output(sensor);
    FinalCall drop = is_readable(desc) ? FinalCall(desc->drop, desc->user) : FinalCall();
    require(context, "context");
    bdpt_custom_desc d = read_struct(desc, "desc");
    require(sensor, "sensor");
    const Subject subject("measurement", nullptr);
    subject.check_range("planes", d.planes, 0, kMaxPlanes);
    if (d.measurements == 0 || d.measurements >= kMaxMeasurements)
      subject.refuse("measurements", "is ", d.measurements, ": give 1 to ", kMaxMeasurements - 1);
    if (!d.start) subject.refuse("start", "is NULL: eye subpaths need it");
    if (d.land && !d.density) subject.refuse("density", "is NULL although land is given: the weights of t = 0 need it");
    auto object = std::make_unique<bdpt_sensor>();
    object->context = Ref<bdpt_context>(context);
    object->sensor = std::make_shared<const Custom>(std::make_shared<const HostMeasurement>(d, std::move(drop)),
                                                    d.measurements, int(d.planes == 0 ? 1 : d.planes), d.hash);
    *sensor = object.release();
  });
}
