#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "transport/plan.h"

#include <algorithm>
#include <limits>

using namespace bdpt;

namespace {

constexpr float kDefaultBeta = 2, kMaxBeta = 64;
constexpr uint32_t kDefaultStrata = 4, kMaxStrata = 256, kDefaultRouletteStart = 4, kMaxBlock = 65536;
constexpr uint32_t kMaxConnections = 1024, kMaxLightSamples = 1024, kMaxPoolPasses = 64, kMinPoolPixels = 16,
                   kMaxPoolPixels = 65536;
constexpr uint32_t kMaxDirect = 64, kMaxLightsInTurn = 64;

// More than any path has, so nothing is lost.
int to_int(uint32_t v) { return int(std::min(v, uint32_t(std::numeric_limits<int>::max()))); }

bool is_all(const uint32_t techniques[32]) {
  return std::all_of(techniques, techniques + 32, [](uint32_t row) { return row == 0; }) ||
         std::all_of(techniques, techniques + 32, [](uint32_t row) { return row == ~0u; });
}

const Plan* read_plan(const Subject& subject, const char* name) {
  if (!name) return kPlans[0];
  if (const Plan* plan = find_plan(name)) return plan;
  std::string names;
  for (const Plan* const* p = kPlans; *p; ++p) names += std::string(names.empty() ? "" : ", ") + (*p)->name;
  subject.refuse("plan", "is \"", name, "\": give one of ", names, ", or NULL for ", kPlans[0]->name);
}

void read_shadow_roulette(const Subject& subject, const bdpt_render_desc& desc, TransportOptions& options) {
  subject.check_enum("shadow_roulette", desc.shadow_roulette, BDPT_SHADOW_ROULETTE_EFFICIENCY);
  options.shadow_roulette = static_cast<Roulette>(desc.shadow_roulette);
  if (options.shadow_roulette != Roulette::None && options.plan->chains)
    subject.refuse("shadow_roulette", "is set, but the plan ", options.plan->name,
                   " tests all its connections: give none, or another plan");
  const bool fixed = options.shadow_roulette == Roulette::Fixed;
  if (fixed ? !(desc.shadow_threshold > 0 && std::isfinite(desc.shadow_threshold)) : desc.shadow_threshold != 0)
    subject.refuse("shadow_threshold", "is ", desc.shadow_threshold,
                   fixed ? ": give a value above 0" : ": give 0, or set shadow_roulette to fixed");
  options.shadow_threshold = desc.shadow_threshold;
}

void read_adaptive(const Subject& subject, const bdpt_render_desc& desc, TransportOptions& options) {
  subject.check_enum("adaptive", desc.adaptive, BDPT_ADAPTIVE_TWO_STAGES);
  options.adaptive = static_cast<Adaptive>(desc.adaptive);
  if (options.adaptive != Adaptive::None && options.plan->chains)
    subject.refuse("adaptive", "is set, but the plan ", options.plan->name,
                   " has chains that go all over the image: give none, or another plan");
  subject.check_reserved("reserved", desc.reserved);
}

void read_direct_lighting(const Subject& subject, const bdpt_render_desc& desc, TransportOptions& options) {
  subject.check_enum("light_selection", desc.light_selection, BDPT_LIGHT_SELECTION_EACH);
  options.light_selection = static_cast<LightSelection>(desc.light_selection);
  subject.check_range("direct_samples", desc.direct_samples, 0, kMaxDirect);
  options.direct_samples = int(desc.direct_samples == 0 ? 1 : desc.direct_samples);
  subject.check_range("direct_candidates", desc.direct_candidates, 0, kMaxDirect);
  options.direct_candidates = int(desc.direct_candidates == 0 ? 1 : desc.direct_candidates);
  const bool several =
      options.light_selection == LightSelection::Each || options.direct_samples > 1 || options.direct_candidates > 1;
  if (several && options.plan->chains)
    subject.refuse("direct_samples",
                   "direct_candidates or light_selection ask for several points on lights, but the plan ",
                   options.plan->name, " takes one: give 0 and another selection than each, or another plan");
}

TransportOptions read_transport(const Subject& subject, const bdpt_render_desc& desc) {
  TransportOptions options;
  options.max_edges = to_int(desc.max_edges);
  if (!is_all(desc.techniques)) std::copy(desc.techniques, desc.techniques + 32, options.techniques.rows.begin());
  subject.check_enum("heuristic", desc.heuristic, BDPT_HEURISTIC_NONE);
  options.heuristic = static_cast<Heuristic>(desc.heuristic);
  if (!(desc.beta >= 0 && desc.beta <= kMaxBeta))
    subject.refuse("beta", "is ", desc.beta, ": give a value above 0 and up to ", kMaxBeta, ", or 0 for ",
                   kDefaultBeta);
  options.beta = desc.beta == 0 ? kDefaultBeta : desc.beta;
  subject.check_range("cutoff", desc.cutoff, 0, 1);
  options.cutoff = desc.cutoff;
  subject.check_enum("sampler", desc.sampler, BDPT_SAMPLER_STRATIFIED);
  options.sampler = static_cast<SamplerType>(desc.sampler);
  subject.check_range("strata", desc.strata, 0, kMaxStrata);
  options.strata = int(desc.strata == 0 ? kDefaultStrata : desc.strata);
  subject.check_enum("light_start", desc.light_start, BDPT_LIGHT_START_IMPORTANCE);
  options.light_start = static_cast<StartBy>(desc.light_start);
  options.plan = read_plan(subject, desc.plan);
  subject.check_range("connections", desc.connections, 0, kMaxConnections);
  const Plan& plan = *options.plan;
  if (desc.connections != 0 && plan.default_connections == 0)
    subject.refuse("connections", "is ", desc.connections, ", but the plan ", plan.name,
                   " does not choose among light vertices: give 0, or another plan");
  options.connections = int(desc.connections);
  subject.check_range("pool_passes", desc.pool_passes, 0, kMaxPoolPasses);
  if (desc.pool_passes != 0 && plan.passes == 1)
    subject.refuse("pool_passes", "is ", desc.pool_passes, ", but the plan ", plan.name,
                   " has no pools of several passes: give 0, or another plan");
  options.pool_passes = int(desc.pool_passes);
  if (desc.pool_pixels != 0 && !plan.resizable)
    subject.refuse("pool_pixels", "is ", desc.pool_pixels, ", but the plan ", plan.name,
                   " has no pools of pixels to choose: give 0, or another plan");
  if (desc.pool_pixels != 0) subject.check_range("pool_pixels", desc.pool_pixels, kMinPoolPixels, kMaxPoolPixels);
  options.pool_pixels = int(desc.pool_pixels);
  subject.check_enum("matrix", desc.matrix, BDPT_MATRIX_ALL_LENGTHS);
  options.matrix = static_cast<Matrix>(desc.matrix);
  subject.check_enum("order", desc.order, BDPT_ORDER_NONE);
  options.order = static_cast<Order>(desc.order);
  subject.check_enum("partners", desc.partners, BDPT_PARTNERS_LATIN_HYPERCUBE);
  options.partners = static_cast<Partners>(desc.partners);
  subject.check_enum("pool_selection", desc.pool_selection, BDPT_POOL_SELECTION_IMPORTANCE);
  options.pool_selection = static_cast<PoolSelection>(desc.pool_selection);
  if (options.pool_selection != PoolSelection::Uniform && !plan.pooled)
    subject.refuse("pool_selection", "is set, but the plan ", plan.name,
                   " has no pool of a pass: give BDPT_POOL_SELECTION_UNIFORM, or the plan pooled");
  subject.check_range("correlation_aware", desc.correlation_aware, 0, 1);
  options.correlation_aware = desc.correlation_aware == 1;
  if (options.correlation_aware && (plan.chains || plan.chooses || !plan.serves(2, 2)))
    subject.refuse("correlation_aware", "is 1, but with the plan ", plan.name,
                   plan.chooses ? " weights are those of tiles: give 0, or another plan"
                                : " no two samples share an eye subpath: give 0, or another plan");
  read_shadow_roulette(subject, desc, options);
  read_adaptive(subject, desc, options);
  read_direct_lighting(subject, desc, options);
  subject.check_range("light_samples", desc.light_samples, 0, kMaxLightSamples);
  if (desc.light_samples > 1 && (plan.chains || plan.chooses))
    subject.refuse("light_samples", "is ", desc.light_samples, ", but the plan ", plan.name,
                   plan.chooses ? " chooses their number itself: give 0, or another plan"
                                : " takes one light subpath with an eye subpath: give 0 or 1, or another plan");
  options.light_samples = int(desc.light_samples == 0 ? 1 : desc.light_samples);
  options.roulette_start = to_int(desc.roulette_start == 0 ? kDefaultRouletteStart : desc.roulette_start);
  return options;
}

RenderDesc read_render(const bdpt_render_desc& desc) {
  const Subject subject("render", nullptr);
  RenderDesc render;
  render.transport = read_transport(subject, desc);
  render.seed = desc.seed;
  render.first_pass = desc.first_pass;
  subject.check_range("block_size", desc.block_size, 0, kMaxBlock);
  render.block_size = desc.block_size;
  return render;
}

void check_fit(const bdpt_scene& scene, const bdpt_sensor& sensor, const bdpt_film& film) {
  if (scene.context.get() != sensor.context.get() || scene.context.get() != film.context.get())
    fail(ErrorCode::Mismatch, "scene, sensor and film are of different contexts: create the three from one");
  const FilmDesc& desc = film.film->desc();
  if (sensor.scene && sensor.scene != scene.scene)
    fail(ErrorCode::Mismatch, "the sensor is a lightmap of another scene: create it for this one");
  if (desc.width != sensor.sensor->width() || desc.height != sensor.sensor->height())
    fail(ErrorCode::Mismatch, "the film is ", desc.width, " x ", desc.height, " pixels and the sensor ",
         sensor.sensor->width(), " x ", sensor.sensor->height(), ": create the film for this sensor");
}

void check_turns(const bdpt_scene& scene, LightSelection selection) {
  const size_t lights = scene.scene->lights().count();
  if (selection == LightSelection::Each && lights > kMaxLightsInTurn)
    Subject("render", nullptr)
        .refuse("light_selection", "is BDPT_LIGHT_SELECTION_EACH, which takes at most ", kMaxLightsInTurn,
                " lights, and the scene has ", lights, ": give BDPT_LIGHT_SELECTION_TREE");
}

// Told only to hosts that asked for a technique in so many words: with "all" nobody expects what cannot be.
void report_dropped(const Log& log, const bdpt_render_desc& desc, const Sensor& sensor, const Plan& plan) {
  if (is_all(desc.techniques)) return;
  bool unserved = false;
  for (int s = 0; s < 32; ++s)
    for (int t = 0; t < 32; ++t) unserved = unserved || ((desc.techniques[s] >> t & 1u) && !plan.serves(s, t));
  if (unserved) log.info("the techniques that the plan ", plan.name, " does not do are dropped");
  if (sensor.is_hittable()) return;
  const bool asked = std::any_of(desc.techniques + 2, desc.techniques + 32, [](uint32_t row) { return row & 1u; });
  if (asked) log.info("the techniques with t = 0 are dropped: no light path can hit a pinhole");
}

}  // namespace

const char* bdpt_plan_name(uint32_t index) {
  const Plan* plan = plan_at(index);
  return plan ? plan->name : nullptr;
}

const char* bdpt_plan_summary(uint32_t index) {
  const Plan* plan = plan_at(index);
  return plan ? plan->summary : nullptr;
}

bdpt_result bdpt_render_create(bdpt_scene* scene, bdpt_sensor* sensor, bdpt_film* film, const bdpt_render_desc* desc,
                               bdpt_render** render) {
  return guard(__func__, [&] {
    reset_output(render);
    require(scene, "scene");
    require(sensor, "sensor");
    require(film, "film").busy.check("film");
    const bdpt_render_desc d = read_optional_struct(desc, "desc");
    require(render, "render");
    const RenderDesc options = read_render(d);
    check_fit(*scene, *sensor, *film);
    check_turns(*scene, options.transport.light_selection);
    const Busy::Mark film_mark(film->busy);  // pilots ask the host's functions
    auto object = std::make_unique<bdpt_render>();
    object->context = scene->context;
    object->film = Ref<bdpt_film>(film);
    object->render = std::make_unique<Render>(scene->scene, sensor->sensor, film->film, scene->context->executor,
                                              scene->context->meter, options);
    report_dropped(*scene->context->log, d, *sensor->sensor, *options.transport.plan);
    *render = object.release();
  });
}

void bdpt_render_destroy(bdpt_render* render) {
  if (!render) return;
  // To free what a call in progress works on would be worse than to leave it to its owner.
  if (render->busy.is_set())
    return set_last_error(__func__, "the render is in use by the call that runs this callback");
  delete render;
}

bdpt_result bdpt_render_get_stats(const bdpt_render* render, bdpt_render_stats* stats) {
  return guard(__func__, [&] {
    const Render& r = *require(render, "render").render;
    check_output_struct(stats, "stats");
    const TransportStats& from = r.stats();
    bdpt_render_stats result{};
    result.passes = r.passes();
    result.samples = from.samples;
    result.eye_rays = from.eye_rays;
    result.light_rays = from.light_rays;
    result.shadow_rays = from.shadow_rays;
    result.shadow_rays_blocked = from.shadow_rays_blocked;
    result.connections = from.connections;
    result.rejected = from.rejected;
    result.seconds = r.seconds();
    result.seconds_start = from.start;
    result.seconds_extend = from.extend;
    result.seconds_extend_rays = from.extend_rays;
    result.seconds_connect = from.connect;
    result.seconds_shadow = from.shadow;
    result.seconds_accumulate = from.accumulate;
    result.shadow_rays_skipped = from.shadow_rays_skipped;
    result.mutations = from.mutations;
    result.accepted = from.accepted;
    result.light_samples = uint32_t(r.engine().options.light_samples);
    result.share_path = r.engine().share(kPath);
    result.share_two_way = r.engine().share(*find_plan("two-way"));
    result.share_one_to_one = r.engine().share(*find_plan("one-to-one"));
    result.share_matrix = r.engine().share(*find_plan("matrix"));
    write_struct(result, stats);
  });
}

bdpt_result bdpt_render_get_technique_stats(const bdpt_render* render, uint32_t s, uint32_t t,
                                            bdpt_technique_stats* stats) {
  return guard(__func__, [&] {
    const Render& r = *require(render, "render").render;
    check_output_struct(stats, "stats");
    if (s > 31 || t > 31 || s + t < 2)
      fail(ErrorCode::InvalidArgument, "there is no technique (", s, ",", t,
           "): give s and t up to 31 whose sum is at least 2");
    const TransportStats whole = r.stats();
    const TechniqueTable table = r.techniques();
    TechniqueStats all;
    for (uint32_t i = 0; i < 32; ++i)
      for (uint32_t j = 0; j < 32; ++j) all += table.at(i, j);
    const TechniqueStats& own = table.at(s, t);
    const auto share = [](double part, double of) { return of > 0 ? part / of : 0; };
    bdpt_technique_stats result{};
    result.contributions = own.contributions;
    result.shadow_rays = own.shadow_rays;
    result.shadow_rays_blocked = own.shadow_rays_blocked;
    result.shadow_rays_skipped = own.shadow_rays_skipped;
    result.energy = share(own.sum, all.sum);
    result.squares = share(own.squares, all.squares);
    result.seconds = whole.connect * share(double(own.contributions), double(all.contributions)) +
                     whole.shadow * share(double(own.shadow_rays), double(all.shadow_rays));
    write_struct(result, stats);
  });
}
