#include "lightmap/padding.h"

#include "lightmap/neighbors.h"

namespace bdpt {

// All charts grow by a ring of texels at a time. Where two of them meet, their rings tell how far apart they were.
std::optional<uint32_t> smallest_padding(const Claims& claims, const Atlas& atlas, uint32_t reach) {
  std::vector<uint32_t> owner = claims.charts;
  std::vector<uint16_t> ring(atlas.texels());
  std::vector<size_t> front, next;
  for (size_t i = 0; i < owner.size(); ++i) {
    if (claims.counts[i] > 1) return 0;
    if (owner[i]) front.push_back(i);
  }
  uint32_t least = reach + 1;
  for (uint32_t r = 0; !front.empty(); ++r) {
    for (const size_t texel : front)
      for_each_neighbor(texel, atlas.width, atlas.height, [&](size_t n) {
        if (owner[n] && owner[n] != owner[texel]) least = std::min(least, r + ring[n]);
      });
    // Rings r + 1 and r would be the next to meet.
    if (least <= 2 * r + 1 || 2 * r + 1 > reach) break;
    next.clear();
    for (const size_t texel : front)
      for_each_neighbor(texel, atlas.width, atlas.height, [&](size_t n) {
        if (owner[n]) return;
        owner[n] = owner[texel];
        ring[n] = uint16_t(r + 1);
        next.push_back(n);
      });
    front.swap(next);
  }
  if (least > reach) return std::nullopt;
  return least;
}

}  // namespace bdpt
