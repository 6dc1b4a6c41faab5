// A block of samples on its way through the five stages:
//
//   start ──▶ extend ──▶ plan ──▶ shadow ──▶ accumulate
//
// Small enough for a core's own cache, large enough for full packets of rays. One thread works on a block; its buffers
// are kept for the next one.
#pragma once

#include "transport/engine.h"
#include "transport/vertex.h"

#include <vector>

namespace bdpt {

// The pixels of a block, within Engine::bounds.
struct BlockRect {
  int x0, y0, x1, y1;
};

// The subpaths of a block. Sample i has an eye subpath, a light subpath, or both.
struct SubpathPool {
  std::vector<EyeStart> eye_starts;
  std::vector<LightStart> light_starts;
  std::vector<uint8_t> has_light;
  std::vector<Stream> eye_streams, light_streams;
  std::vector<Vertex> eye, light;
  std::vector<uint32_t> last_eye, last_light;  // of each sample; kNoVertex where a subpath has one vertex only
  size_t samples() const { return last_eye.size(); }
};

class Block {
 public:
  explicit Block(const Engine& engine) : engine_(engine) {}
  void run(uint64_t pass, const BlockRect& rect);

  const TransportStats& stats() const { return stats_; }
  TransportStats take_stats();
  // Bytes of the buffers.
  size_t memory() const;

  // For plans (plan.h).
  const Engine& engine() const { return engine_; }
  const SubpathPool& pool() const { return pool_; }
  // s = 1: joins z to a fresh light vertex.
  void connect_to_light(const Vertex& z, uint32_t sample);
  // s >= 2, t >= 2.
  void connect(const Vertex& y, const Vertex& z, uint32_t sample);
  // t = 1: joins y to a fresh sensor vertex.
  void connect_to_sensor(const Vertex& y, uint32_t sample);
  // (1,1): joins y_0 to a fresh sensor vertex.
  void connect_start_to_sensor(uint32_t sample);
  // Tests the connections made so far, when there are many; plans call it between samples.
  void flush_if_full();

 private:
  // The front end of a subpath: about to find its next vertex.
  struct Walker {
    Vec3 origin;   // the last vertex, not moved off its surface
    float cosine;  // at it, with its geometric normal; 1 for points; unused where infinite
    Vec3 direction;
    float projected;  // P_sigma-perp of direction
    Rgb throughput;   // alpha at the next vertex
    float density;    // P_A of the last vertex
    float sums;       // || u, rev v || of the last vertex
    float direct;
    uint32_t vertex;  // the last vertex; kNoVertex for y_0 and z_0
    uint32_t count;   // vertices so far
    uint32_t sample;
    bool eye, specular, infinite, start_hittable, start_finite;
  };
  struct Connection {
    Rgb contribution;
    FilmPosition film;  // t = 1
    uint32_t sample, s, t;
  };
  // How the connecting edge, and what it changes beyond, is sampled from both sides; see path_weight.
  struct Edge {
    double light_at_z = 0, light_before_z = 0;  // x_s and x_{s+1} by the light's side
    double eye_at_y = 0, eye_before_y = 0;      // x_{s-1} and x_{s-2} by the eye's side
  };

  void start(uint64_t pass, const BlockRect& rect);
  void start_eye(uint64_t pass, uint64_t number, float x, float y, uint32_t sample);
  void start_light(uint64_t pass, uint64_t number, uint32_t sample);
  void extend();
  void trace();
  void push_walker(std::vector<Walker>& walkers, std::vector<Ray>& rays, const Walker& walker, const Vec3& from);
  void arrive(const Walker& walker, const Ray& ray, const Hit& hit);
  void escape(const Walker& walker);
  void hit_sensor(const Walker& walker, const Ray& ray, float tmax);
  void hit_light(const Walker& walker, const Vertex& z, const LightPoint& x0, const Rgb& radiance);
  void continue_walk(const Walker& walker, Vertex& vertex, uint32_t index);
  void shadow();
  void accumulate();

  float technique(const Walker& walker, const Vertex& vertex) const;
  void add_eye(uint32_t sample, uint32_t s, uint32_t t, const Rgb& value);
  void add_light(const FilmPosition& film, uint32_t s, uint32_t t, const Rgb& value);
  void push_connection(const Ray& ray, const Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t,
                       const FilmPosition& film = {0, 0});
  // The weight by the plain loop; y or z is nullptr where that side has fewer than two vertices.
  float path_weight(const Vertex* y, const Vertex* z, uint32_t s, uint32_t t, const Edge& edge, PathVertex start_light,
                    PathVertex start_eye, double direct, bool s0_exists, bool corner_exists);

  const Engine& engine_;
  SubpathPool pool_;
  std::vector<Rgb> eye_sums_;
  std::vector<Walker> walkers_, next_walkers_;
  std::vector<Ray> rays_, next_rays_;
  std::vector<Hit> hits_;
  std::vector<Ray> shadow_rays_;
  std::vector<Connection> connections_;
  std::vector<uint8_t> blocked_;
  std::vector<PathVertex> path_;
  TransportStats stats_;
};

}  // namespace bdpt
