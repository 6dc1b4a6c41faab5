// Samples that a plan chooses itself (Plan::run): they go through the same stages, and their contributions back to it.
#include "transport/block.h"
#include "transport/stage_timer.h"

#include <cmath>
#include <limits>

namespace bdpt {

// A film position for two numbers in [0,1).
FilmPosition Block::spread(const Four& u) const {
  const PixelRect& b = engine_.bounds;
  const auto within = [](int begin, int end, float v) {
    return std::min(float(begin) + v * float(end - begin),
                    std::nextafter(float(end), -std::numeric_limits<float>::infinity()));
  };
  return {within(b.x0, b.x1, u[0]), within(b.y0, b.y1, u[1])};
}

template <class Work>
const std::vector<Contribution>& Block::keep(Work&& work) {
  keeps_ = true;
  kept_.clear();
  work();
  keeps_ = false;
  return kept_;
}

const std::vector<Contribution>& Block::measure() {
  return keep([&] {
    extend();
    join_inner(*strategy_->plan);
  });
}

const std::vector<Contribution>& Block::sample_pixels(uint64_t pass, const PixelRect& rect, uint32_t max_edges) {
  max_edges_ = std::min(max_edges, engine_.max_edges());
  start_pixels(pass, 1, rect);
  measure();
  max_edges_ = engine_.max_edges();
  return kept_;
}

void Block::start_pilot(uint32_t passes, const PixelRect& rect, const LightPool* pool) {
  pool_ = pool;
  seed_ = hash_values(engine_.seed, 5, kPilotPass, rect.x0, rect.y0);
  start_pixels(kPilotPass, passes, rect);
}

const std::vector<Contribution>& Block::sample_pilot(uint32_t passes, const PixelRect& rect, const LightPool* pool) {
  start_pilot(passes, rect, pool);
  return measure();
}

const std::vector<Contribution>& Block::sample_pilot_ends(uint32_t passes, const PixelRect& rect) {
  start_pilot(passes, rect, nullptr);
  return keep([&] { extend(); });
}

const std::vector<Contribution>& Block::join_pilot(const Plan& plan) {
  return keep([&] { join_inner(plan); });
}

EyeStart Block::start_anywhere(const Four& u, float time) const {
  if (!engine_.local) return engine_.start_eye(spread(u), u.u + 2, time);
  const uint64_t count = engine_.sensor.count();
  const double place = double(u[0]) * double(count);
  const uint64_t number = std::min(uint64_t(place), count - 1);
  int x, y;
  engine_.sensor.find(number, x, y);
  const float within[4] = {std::min(float(place - double(number)), 0x1.fffffep-1f), u[1], u[2], u[3]};
  return engine_.sensor.start_at(x, y, within);
}

const std::vector<Contribution>& Block::sample_film(const std::vector<StreamPair>& streams) {
  {
    StageTimer timer(stats_.start);
    const bool lights = engine_.max_light > 0;
    start(streams.size(), lights ? streams.size() : 0);
    if (engine_.moves) share_time(0);
    for (uint32_t i = 0; i < streams.size(); ++i) {
      eye_.streams[i] = streams[i].eye;
      if (engine_.moves) set_time(i, draw_time(i));
      const Four u = draw(true, i, 0, Purpose::Start);
      start_eye(i, start_anywhere(u, eye_.time(i)), engine_.max_eye);
      if (!lights) continue;
      light_.streams[i] = streams[i].light;
      start_light(i, engine_.max_light);
    }
  }
  return measure();
}

const std::vector<Contribution>& Block::sample_chains(std::vector<Chain>& chains) {
  chains_ = chains.data();
  {
    StageTimer timer(stats_.start);
    start(chains.size(), chains.size());
    if (engine_.moves) share_time(0);
    for (uint32_t i = 0; i < chains.size(); ++i) {
      if (engine_.moves) set_time(i, draw_time(i));
      const Technique technique = chains[i].technique();
      light_.starts[i].y0.light = -1;
      // With t = 1 and s = 1 the other side takes a fresh vertex to this one's subpath.
      if (technique.t >= 2) {
        const Four u = draw(true, i, 0, Purpose::Start);
        start_eye(i, start_anywhere(u, eye_.time(i)), technique.t);
      }
      if (technique.s >= 2 || technique.t == 1) start_light(i, technique.s);
    }
  }
  measure();
  chains_ = nullptr;
  return kept_;
}

}  // namespace bdpt
