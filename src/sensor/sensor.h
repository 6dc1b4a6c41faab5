// Sensors: what is measured. A sensor starts eye subpaths, is seen by light subpaths, and maps both to measurements.
// After Veach, W_e is split into W_e^(0) (position) and W_e^(1) (direction), and the directional part is treated as a
// BSDF at z0, with densities per projected solid angle. The engine never asks which kind a sensor is, but for this:
//
//   A camera's measurements share its z0, and a direction says which pixel is meant: t = 1 and t = 0 are global, every
//   light subpath may count for every pixel.
//   Of a local sensor (texels, points, probes) each measurement has a z0 of its own: t = 1 joins light subpaths to the
//   z0 of an eye subpath, like any other vertex of it, and (1,1) is direct lighting at z0. Only t = 0 is global.
#pragma once

#include "math/rigid.h"

#include <cstdint>
#include <vector>

namespace bdpt {

// Where on the film, in pixels of the region measured; may lie outside by the filter's radius.
using FilmPosition = Vec2;

// z0 of a sensor on a surface or in space.
struct SensorPlace {
  FilmPosition film{0, 0};
  Vec3 p{0, 0, 0}, normal{0, 0, 0};  // z0, and the unit normal of the lens or the surface; zero for a point in space
  Vec3 shading{0, 0, 0};             // of a surface: its shading normal
};

// z0 and the first direction of an eye subpath.
struct EyeStart : SensorPlace {
  Vec3 direction;             // unit
  float cosine;               // of direction with normal; 1 for a point in space
  float density_position;     // P_A(z0); of a pinhole the Dirac's coefficient, 1; in a volume per volume
  float density_direction;    // P_sigma-perp(z0 -> z1)
  float weight;               // alpha_2 = W_e / (P_A P_sigma-perp)
  float weight_position = 1;  // alpha_1 = W_e^(0) / P_A
  float margin = 0;           // of a surface: see off_surface()
  bool parallel = false;  // the direction is a Dirac's: density_direction is per area across it, for z0 and z1 alike
};

// z0 as seen from a point (t = 1), or as hit by a light segment (t = 0).
struct SensorPoint : SensorPlace {
  float importance;         // W_e(x -> z0)
  float density_position;   // P_A(z0)
  float density_direction;  // P_sigma-perp(z0 -> x)
};

// A measurement, and the uniform numbers of a sample of it; the fifth for a place in a volume.
struct SamplePlace {
  int x, y;
  float u[5];
};

// A light ray within the volume of a measurement.
struct Crossing {
  uint32_t number;    // of the measurement
  double begin, end;  // along the ray, from its origin on; not clipped by what the ray hits
};

// A direction in which the z0 of a local sensor looks.
struct SensorDirection {
  float importance;  // W_e^(1)
  float density;     // P_sigma-perp
  float cosine;      // with z0's normal; 1 for a point in space
};

// A surface of the scene where light arrives, as the ray queries name it.
struct Landing {
  uint32_t instance, primitive;
  uint64_t id;  // the host's, of the instance
  float u, v;   // barycentric coordinates of the triangle's second and third vertex
  Vec3 p, ng, ns;
  Vec3 direction;  // unit, of the light
  float chance;    // uniform in [0,1), where lands_by_chance()
};

// What an output is about: light; or what the first rays of eye subpaths see, whatever light there is.
enum class Seen {
  Light,
  Openness,    // 1 where nothing is within reach
  Direction,   // the same times the direction, its three coordinates in place of colours
  Distance,    // how far it is to what is seen, reach at most; its square; and 1 where anything is nearer
  Fronts,      // 1 but for backs that absorb all light; all rays count alike, whatever they measure
  Unshadowed,  // direct light as if nothing were in its way
  // Of the surface that a camera's eye subpath meets first; nothing where there is none, or a medium scatters before.
  Albedo,    // the part of light that it sends on, whichever way, seen from there
  Normal,    // its shading normal, on the side that is seen
  Depth,     // how far off it is, see Sensor::depth, the square of that, and 1
  Position,  // in the world
  Instance,  // whose it is: coverage, and no planes
  Material,
};

inline bool is_of_surface(Seen seen) { return seen >= Seen::Albedo; }
inline bool is_coverage(Seen seen) { return seen >= Seen::Instance; }

// A part of what a measurement is asked for: some planes of the film, and the light that counts for them.
struct OutputPlanes {
  int kind = -1;  // as its sensor calls it; -1 = has no name
  Seen seen = Seen::Light;
  float reach = 3e38f;                  // of openness and distance, in lengths
  int first = 0, count = 1;             // planes; of coverage, which one, and none
  bool unfiltered = false;              // cameras: samples count for their own pixel alone
  bool direct = true, indirect = true;  // light that comes straight from where it is emitted; all else
  uint32_t direct_edges = 1;            // of the longest path that is direct; of what a camera sees, 2
  uint64_t groups = ~0ull;              // of lights, one bit each
  bool is_all() const { return seen == Seen::Light && direct && indirect && groups == ~0ull && !unfiltered; }
  bool takes(uint32_t edges, uint32_t group) const {
    return seen == Seen::Light && (edges <= direct_edges ? direct : indirect) && takes(group);
  }
  bool takes(uint32_t group) const { return groups >> group & 1; }
};

// Pixels [x0, x1) x [y0, y1), in film coordinates.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  uint64_t count() const { return uint64_t(x1 - x0) * uint64_t(y1 - y0); }
  int width() const { return x1 - x0; }
};

class Sensor {
 public:
  virtual ~Sensor() = default;

  virtual int width() const = 0;  // of the region measured
  virtual int height() const = 0;
  // Whether light subpaths can hit the sensor by chance (t = 0).
  virtual bool is_hittable() const = 0;
  virtual uint64_t hash() const = 0;
  // Whether pixels side by side see what is not: filters must not mix them.
  virtual bool has_seams() const { return false; }

  // --- Cameras ---
  // Starts an eye subpath at a film position with two uniform numbers for the lens. The film positions of a pass lie
  // evenly in `bounds`, which enters W_e and the density of directions: a pixel's value is the mean over its filter.
  // weight = 0: nothing is seen there.
  virtual EyeStart start(const FilmPosition&, const float[2], const PixelRect&) const { return {}; }
  // How far off a point of the scene is: along the axis, or from a camera that looks all around, the distance.
  virtual float depth(const Vec3&) const { return 0; }
  // Chooses z0 for t = 1; false where x is not in the picture.
  virtual bool sample_toward(const Vec3&, const float[2], const PixelRect&, SensorPoint&) const { return false; }
  // t = 0: whether the segment from origin along the unit direction, up to tmax, passes through the sensor.
  virtual bool hit(const Vec3&, const Vec3&, float, const PixelRect&, SensorPoint&) const { return false; }

  // Whether the camera moves: all of the above is of time 0, and motion() takes it to where it is later.
  virtual bool moves() const { return false; }
  virtual Rigid motion(float) const { return {}; }

  // --- What is measured: planes of the film. `start` measures the base; outputs are multiples of it. ---
  int planes() const {
    int planes = 0;
    for (const OutputPlanes& o : outputs()) planes += o.count;
    return planes;
  }
  virtual const std::vector<OutputPlanes>& outputs() const { return kOne; }
  // Whether there is one plane, and it is the base.
  bool is_plain() const {
    return outputs().size() == 1 && outputs()[0].is_all() && outputs()[0].count == 1 && !responds();
  }
  virtual bool responds() const { return false; }
  // W_e of each plane for light from direction w (unit, from z0), over that of the base.
  virtual void respond(const SensorPlace&, const Vec3&, float* response) const { *response = 1; }

  // --- Local sensors ---
  virtual bool is_local() const { return false; }
  // Measurements that are no pixels need not fill the film. The number of those before this one; -1 for none here.
  virtual int64_t number(int x, int y) const { return int64_t(y) * width() + x; }
  virtual uint64_t count() const { return uint64_t(width()) * uint64_t(height()); }
  // By which its random numbers are named: of a part of a whole, its place in the whole.
  virtual uint64_t place(int x, int y) const { return uint64_t(y) * uint64_t(width()) + uint64_t(x); }
  // The place of measurement `number`, below count().
  virtual void find(uint64_t number, int& x, int& y) const {
    x = int(number % uint64_t(width())), y = int(number / uint64_t(width()));
  }
  // Starts an eye subpath of one of them with uniform numbers: place 2, direction 2, and one more for a place in a
  // volume.
  virtual EyeStart start_at(int, int, const float[5]) const { return {}; }
  virtual void start_many(size_t n, const SamplePlace* places, EyeStart* starts) const {
    for (size_t i = 0; i < n; ++i) starts[i] = start_at(places[i].x, places[i].y, places[i].u);
  }
  // Whether directions can be asked for: without look() there is no t = 1.
  virtual bool can_look() const { return true; }
  // W_e^(1) of z0 and the density in a direction w (unit); false where nothing is measured.
  virtual bool look(const EyeStart&, const Vec3&, SensorDirection&) const { return false; }
  // t = 0 on a surface of the scene.
  virtual bool is_surface() const { return false; }
  virtual bool land(const Landing&, SensorPoint&) const { return false; }
  // Whether several measurements share a place, and land() chooses one of them.
  virtual bool lands_by_chance() const { return false; }
  // t = 0 in space: z0 is uniform in a volume, and light that passes through is measured at one point of its way,
  // uniform along the chord. Densities of position are per volume then; the light's, per area across its ray, is
  // divided by the chord's length.
  virtual bool is_volume() const { return false; }
  // One over the length of that chord, for light that comes to z0 along -w (unit) from so far away; 0 where z0 is in
  // none.
  virtual float chord_density(const EyeStart&, const Vec3&, float) const { return 0; }
  // Adds the measurements whose volumes a ray crosses before tmax.
  virtual void cross(const Vec3&, const Vec3&, float, std::vector<Crossing>&) const {}
  // A point of the volume of a measurement, for t = 0: with W_e and densities per volume.
  virtual SensorPoint point_in(uint32_t, const Vec3&) const { return {}; }

 private:
  inline static const std::vector<OutputPlanes> kOne{OutputPlanes{}};
};

}  // namespace bdpt
