// A block of samples on its way through the five stages:
//
//   start ──▶ extend ──▶ plan ──▶ shadow ──▶ accumulate
//
// Subpaths grow by one vertex at a time, all of the block side by side. What meets the other end's first vertex (s = 1,
// t = 1) is joined at once; what joins two inner vertices waits for the plan, which is the one reason to keep vertices.
//
// Small enough for a core's own cache, large enough for full packets of rays. One thread works on a block; its buffers
// are kept for the next one.
#pragma once

#include "material/material_store.h"
#include "scene/host_lookups.h"
#include "transport/chain.h"
#include "transport/mis.h"
#include "transport/responses.h"
#include "transport/vertex.h"

#include <algorithm>
#include <vector>

namespace bdpt {

// Subpaths of one side.
template <class Start>
struct Subpaths {
  std::vector<Start> starts;
  std::vector<Stream> streams;
  std::vector<float> times;  // of each subpath; empty where nothing moves
  std::vector<Vertex> vertices;
  MaterialStore materials;     // of vertices where a material varies
  std::vector<uint32_t> last;  // vertex of each subpath; kNoVertex where it has one vertex only
  size_t count() const { return last.size(); }
  void reset(size_t n) {
    starts.resize(n);
    streams.resize(n);
    times.clear();
    clear_vertices();
    last.assign(n, kNoVertex);
  }
  void clear_vertices() {
    vertices.clear();
    materials.clear();
  }
  float time(uint32_t subpath) const { return times.empty() ? 0 : times[subpath]; }
  size_t memory() const {
    return starts.capacity() * sizeof(Start) + streams.capacity() * sizeof(Stream) +
           vertices.capacity() * sizeof(Vertex) + times.capacity() * sizeof(float) +
           last.capacity() * sizeof(uint32_t) + materials.memory();
  }
};
using EyeSubpaths = Subpaths<EyeStart>;
using LightSubpaths = Subpaths<LightStart>;

class LightPool;

// What a technique measured, weighted.
struct Contribution {
  Rgb value;
  FilmPosition film;
  uint32_t sample, s, t;
  TechniqueShares shares;  // of an engine that tells them
};

class Block {
 public:
  explicit Block(const Engine& engine);
  // The samples of some pixels, from the first vertex into the film. With a pool, eye subpaths alone.
  void run(uint64_t pass, const PixelRect& rect, const LightPool* pool = nullptr);
  // The light subpaths [first, first + count) of a pass, kept for a pool; those ends of theirs that need no eye subpath
  // go into the film; those of a pilot's pass are kept.
  void run_light(uint64_t pass, uint64_t first, uint32_t count, LightSubpaths& kept);
  // What was kept, until the next call.
  const std::vector<Contribution>& contributions() const { return kept_; }

  const TransportStats& stats() const { return stats_; }
  TransportStats& stats() { return stats_; }
  TransportStats take_stats();
  const TechniqueTable& techniques() const { return techniques_; }  // since the block was made
  // Bytes of the buffers, with those that the plan had of its own.
  size_t memory() const;

  // For plans (plan.h).
  const Engine& engine() const { return engine_; }
  // Light subpaths [i n, (i + 1) n) are those of eye subpath i, n = light_samples.
  const EyeSubpaths& eye() const { return eye_; }
  const LightSubpaths& light() const { return light_; }
  const LightPool& light_pool() const { return *pool_; }
  // Of the eye subpaths.
  const Strategy& strategy() const { return *strategy_; }
  // For choices of a plan that belong to no subpath.
  uint64_t seed() const { return seed_; }
  Four draw_eye(uint32_t sample, uint32_t vertex, Purpose purpose) { return draw(true, sample, vertex, purpose); }
  // Calls visit(z, sample) for each eye vertex that can be joined, from each subpath's end to its start.
  template <class Visit>
  void each_eye_vertex(Visit&& visit) {
    for (uint32_t sample = 0; sample < eye_.count(); ++sample)
      for (uint32_t i = eye_.last[sample]; i != kNoVertex; i = eye_.vertices[i].previous_index) {
        if (eye_.vertices[i].is_joinable()) visit(eye_.vertices[i], sample);
        flush_if_full();
      }
  }
  // Whether a plan may join the two: their path is not too long, and its technique takes part.
  bool allows(uint32_t s, uint32_t t) const { return s + t - 1 <= engine_.max_edges() && strategy_->allows(s, t); }
  bool allows(const Vertex& y, const Vertex& z) const { return allows(y.count, z.count); }
  // The same for subpaths of one sample, which may be a chain's and then takes one technique alone.
  bool takes(uint32_t s, uint32_t t, uint32_t sample) const {
    return s + t - 1 <= max_edges_ && (engine_.belongs_to_eye(t) ? *strategy_ : engine_.strategy).allows(s, t) &&
           (!chains_ || chains_[sample].proposes(s, t));
  }
  // s >= 2, t >= 2; y is one of as many as `count` says that z meets. light: what y's links point into.
  void connect(const Vertex& y, const Vertex& z, uint32_t sample, float count, const LightSubpaths& light);
  // Bytes that a plan had for itself while it connected.
  void note_memory(size_t bytes) { plan_memory_ = std::max(plan_memory_, bytes); }
  // Tests the connections made so far, when there are many; plans call it between samples.
  void flush_if_full();

  // For plans that choose their samples themselves (Plan::run). Nothing goes into the film: the contributions are
  // returned, and stand until the next call.
  //
  // One sample of each pixel of a pass, paths of at most max_edges.
  const std::vector<Contribution>& sample_pixels(uint64_t pass, const PixelRect& rect, uint32_t max_edges);
  // Samples all over the film.
  const std::vector<Contribution>& sample_film(const std::vector<StreamPair>& streams);
  // A pilot's: so many of its passes at once, in this order: pass, row, column.
  const std::vector<Contribution>& sample_pilot(uint32_t passes, const PixelRect& rect, const LightPool* pool);
  // The same in parts: all but the inner connections, and those, by any plan and any number of times.
  const std::vector<Contribution>& sample_pilot_ends(uint32_t passes, const PixelRect& rect);
  const std::vector<Contribution>& join_pilot(const Plan& plan);
  // What chains propose, each with its own technique alone: at most one contribution of each.
  const std::vector<Contribution>& sample_chains(std::vector<Chain>& chains);

 private:
  // The front end of a subpath: about to find its next vertex.
  struct Walker {
    Vec3 origin;   // the last vertex, not moved off its surface
    Vec3 normal;   // its Receiver's, for the density of direct lighting
    float cosine;  // at it, with its geometric normal; 1 for points; unused where infinite
    Vec3 direction;
    float projected;  // P_sigma-perp of direction
    Rgb throughput;   // alpha at the next vertex
    float density;    // P_A of the last vertex
    float sums;       // || u, rev v || of the last vertex
    float outer;      // light side: the same without the techniques that join inner vertices
    float direct;
    uint32_t vertex;  // the last vertex; kNoVertex for y_0 and z_0
    uint32_t count;   // vertices so far
    uint32_t most;    // vertices that the subpath may have
    uint32_t sample;  // number of the subpath within its side
    bool eye, specular, infinite, start_hittable, start_finite;
    uint8_t group;           // light side: of y_0's light
    bool in_medium = false;  // the last vertex
    Interior interior;       // what encloses the front end
    Passage passage;         // from the last vertex on, as far as the ray has passed boundaries
  };
  // A vertex that was just made.
  struct Arrival {
    uint32_t vertex, sample;
    bool eye;
  };
  // An eye sample: the one that a render with rates of one takes of this pixel in this pass.
  struct PixelSample {
    uint64_t pass;
    int x, y;
  };
  struct Connection {
    Rgb contribution;
    FilmPosition film;  // t = 1 of a camera
    uint32_t sample, s, t;
    uint8_t group;  // of the light
  };
  // How the connecting edge, and what it changes beyond, is sampled from both sides; see path_weight.
  struct Edge {
    double light_at_z = 0, light_before_z = 0;  // x_s and x_{s+1} by the light's side
    double eye_at_y = 0, eye_before_y = 0;      // x_{s-1} and x_{s-2} by the eye's side
  };

  // The numbers of a subpath: its stream's, or its chain's.
  Four draw(bool eye, uint32_t subpath, uint32_t vertex, Purpose purpose) {
    if (chains_) return chains_[subpath].draw(engine_, eye, vertex, purpose);
    return engine_.draw((eye ? eye_.streams : light_.streams)[subpath], vertex, purpose);
  }
  void start(size_t eyes, size_t lights);
  void choose_samples(uint64_t pass, uint64_t passes, const PixelRect& rect);
  void start_pixels(uint64_t pass, uint64_t passes, const PixelRect& rect);
  void start_eye(uint32_t sample, const EyeStart& start, uint32_t most);
  // The z_0 of a local sensor.
  Vertex sensor_vertex(uint32_t sample) const;
  // f_s at z for light from w (unit) and so far away, and the cosine there.
  bool scatter_to_eye(const Vertex& z, uint32_t sample, const Vec3& w, float distance, Scattering& scattering,
                      float& cosine) const;
  // The density of z_0 along the way of light that comes from there; 1 where z_0 is in no volume.
  float along_way(const EyeStart& z0, const Vec3& w, float distance) const;
  void start_light(uint32_t light, uint32_t most);
  FilmPosition spread(const Four& u) const;
  EyeStart start_anywhere(const Four& u, float time) const;
  // One time for all subpaths of a pass; or for an eye subpath and those that go with it, by its numbers.
  void share_time(float time);
  void set_time(uint32_t sample, float time) {
    eye_.times[sample] = time;
    if (!light_.times.empty()) light_.times[sample] = time;
  }
  float draw_time(uint32_t sample) { return draw(true, sample, 0, Purpose::Direction)[1]; }
  // The contributions of some work, kept instead of added to the film.
  template <class Work>
  const std::vector<Contribution>& keep(Work&& work);
  const std::vector<Contribution>& measure();
  void start_pilot(uint32_t passes, const PixelRect& rect, const LightPool* pool);
  // Else subpaths leave nothing behind but their front end.
  bool keeps_vertices() const { return !engine_.running_sums || strategy_->joins_inner(); }
  void join_inner(const Plan& plan);
  void extend();
  void trace();
  // Asks the host's textures for all hits of the wave.
  void ask_host();
  // What textures make of what a walker hit. False where the host's broke their promise: then the walk is rejected.
  bool shade(size_t walker, Surface& surface);
  void push_walker(std::vector<Walker>& walkers, std::vector<Ray>& rays, const Walker& walker, const Vec3& from);
  void arrive(size_t walker);
  // The same of a walker where media count.
  void travel(size_t walker);
  void arrive_on(const Walker& walker, const Hit& hit, const Surface& surface);
  void arrive_in(const Walker& walker, const Medium& medium, const Vec3& p);
  // Ends the walker's way after one more stretch, with its throughput; false where nothing comes so far.
  bool end_passage(Walker& walker, const Medium* medium, float length, bool in_medium) const;
  // A vertex at p, but for what it lies on; nullptr where its density is none.
  Vertex* add_vertex(const Walker& walker, const Vec3& p, float geometry, bool in_medium);
  void weigh_vertex(const Walker& walker, Vertex& vertex);
  // The media on the way along a shadow ray that begins within `interior`. False where the way is blocked, if rays had
  // to be traced to find out; then the shadow ray is spent, and has no length any more.
  bool passes(Interior interior, Ray& ray, float length, Passage& passage);
  // What encloses the way from a vertex along w.
  Interior interior_toward(const Vertex& v, const Vec3& w) const;
  void escape(const Walker& walker);
  // What the first ray of an eye subpath sees, for outputs that are not about light.
  void see(const Walker& walker, const Ray& ray, const Hit& hit);
  // What surface it meets first, for outputs of cameras.
  void see_surface(const Walker& walker, const Hit& hit, const Surface& surface);
  Rgb estimate_albedo(const Walker& walker, const Surface& surface);
  void hit_sensor(const Walker& walker, const Ray& ray, float tmax, const Medium* medium = nullptr);
  void cross_sensor(const Walker& walker, const Ray& ray, float tmax);
  void land(const Walker& walker, const Hit& hit, const Vertex& y);
  // t = 0 at z_0, with the edge of the light subpath there and its density.
  void add_arrival(const Walker& walker, const SensorPoint& z0, float geometry, float density);
  void hit_light(const Walker& walker, const Vertex& z, const LightPoint& x0, const Rgb& radiance);
  void continue_walk(const Walker& walker, Vertex& vertex);
  bool survives_roulette(const Vertex& vertex, float local, float u, Rgb& factor) const;
  // How a walk leaves a vertex: projected densities of its direction and of the way back, and its cosine.
  struct Leaving {
    float projected, reverse, cosine;
  };
  void walk_on(const Walker& walker, Vertex& vertex, const Vec3& next, const Rgb& factor, const Leaving& leaving,
               const Interior& interior);
  void connect_ends();
  // s = 1: joins z to fresh light vertices.
  void connect_to_light(const Vertex& z, uint32_t sample);
  // Number `number` of the four random numbers that they take.
  Four draw_direct(const Vertex& z, uint32_t sample, uint32_t number);
  // The contribution of one of them, but for its weight, its visibility and their number.
  Rgb direct_throughput(const Vertex& z, uint32_t sample, const DirectLight& light, Scattering& at_z, float& geometry);
  // The same weighted, and what media leave of it; and its shadow ray.
  Rgb direct_contribution(const Vertex& z, uint32_t sample, const DirectLight& light, Ray& ray);
  // (1,1) of a local sensor as if nothing were in the way, for outputs that ask for it.
  void measure_unshadowed(uint32_t sample);
  // t = 1: joins y to a fresh sensor vertex.
  void connect_to_sensor(const Vertex& y, uint32_t light);
  // t = 1 of a local sensor: joins y to the z_0 of the eye subpath that it belongs to.
  void connect_to_own_start(const Vertex& y, uint32_t light);
  // (1,1): joins y_0 to a fresh sensor vertex.
  void connect_start_to_sensor(uint32_t light);
  void shadow();
  void accumulate();

  float technique(const Walker& walker, const Vertex& vertex) const;
  // w: from z_0 to where the light comes from, if that is not the eye subpath's first direction.
  void add_eye(uint32_t sample, uint32_t s, uint32_t t, const Rgb& contribution, uint32_t group,
               const Vec3* w = nullptr);
  void add_light(uint32_t light, const FilmPosition& film, uint32_t s, uint32_t t, const Rgb& contribution,
                 uint32_t group, const SensorPlace* z0 = nullptr, const Vec3* w = nullptr);
  void count(uint32_t s, uint32_t t, const Rgb& value);
  // Counts a subpath that cannot go on.
  void reject_walk(const Walker& walker);
  // Counts a contribution, or a whole sample, that is left out.
  void reject(const FilmPosition& film);
  void push_connection(const Ray& ray, const Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t, uint32_t group,
                       const FilmPosition& film = {0, 0});
  // The shadow ray's roulette; the contribution of a survivor grows.
  bool survives(Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t, const FilmPosition& film);
  // The weight by the plain loop; y or z is nullptr where that side has fewer than two vertices.
  float path_weight(const Vertex* y, const Vertex* z, uint32_t s, uint32_t t, const Edge& edge, PathVertex start_light,
                    PathVertex start_eye, double direct, bool s0_exists, bool corner_exists, const LightSubpaths& light,
                    const Strategy& strategy);

  const Engine& engine_;
  const Strategy* strategy_;  // of the eye subpaths in hand
  EyeSubpaths eye_;
  LightSubpaths light_;
  const LightPool* pool_ = nullptr;
  uint32_t max_edges_;       // of the paths in hand
  Chain* chains_ = nullptr;  // of the samples in hand, if they are chains'
  bool keeps_ = false;       // contributions, instead of adding them to the film
  std::vector<Contribution> kept_;
  uint64_t seed_ = 0;
  std::vector<PixelSample> pixel_samples_;
  std::vector<SamplePlace> places_;  // of the samples of a local sensor
  size_t plan_memory_ = 0;
  Responses responses_;
  std::vector<Rgb> eye_sums_;  // samples x planes
  std::vector<float> eye_weights_;
  std::vector<Walker> walkers_, next_walkers_;
  std::vector<Ray> rays_, next_rays_;
  std::vector<Hit> hits_;
  HostLookups host_lookups_;  // of the hits
  std::vector<Arrival> arrivals_;
  std::vector<Ray> shadow_rays_;
  std::vector<Connection> connections_;
  std::vector<uint8_t> blocked_;
  std::vector<Crossing> crossings_;
  TechniqueShares shares_;                          // of the contribution in hand
  std::vector<TechniqueShares> connection_shares_;  // of an engine that tells them
  std::vector<PathVertex> path_;
  uint64_t roulette_key_ = ~0ull;  // the vertex that played last, and how often it did before
  uint32_t roulette_number_ = 0;
  TransportStats stats_;
  TechniqueTable techniques_;
};

}  // namespace bdpt
