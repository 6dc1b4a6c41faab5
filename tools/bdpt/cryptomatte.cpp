// SPDX-License-Identifier: Apache-2.0
#include "cryptomatte.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <utility>

namespace bdpt_tool {
namespace {

std::uint32_t mix_block(std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; }

std::string hex(std::uint32_t hash) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", hash);
  return text;
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      char escape[7];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
      text += escape;
    } else {
      text += c;
    }
  }
  return text + '"';
}

}  // namespace

std::uint32_t murmur3(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  std::uint32_t h = 0;
  std::size_t i = 0;
  for (; i + 4 <= text.size(); i += 4) {
    h ^= mix_block(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
    h = std::rotl(h, 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t k = text.size(); k > i; --k) rest = rest << 8 | byte(k - 1);
  h ^= mix_block(rest);
  h ^= static_cast<std::uint32_t>(text.size());
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

std::uint32_t matte_hash(std::string_view name) {
  const std::uint32_t hash = murmur3(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

Matte make_matte(const std::string& layer, const std::vector<bdpt_coverage>& entries, std::size_t per_pixel,
                 const std::map<std::uint64_t, std::string>& names) {
  Matte matte;
  const std::size_t pixels = entries.size() / per_pixel;
  matte.ranks.resize(pixels * Matte::kRanks * 2);
  std::map<std::uint64_t, std::uint32_t> hashes;
  for (const auto& [id, name] : names) hashes[id] = matte_hash(name);
  std::vector<std::pair<float, std::uint32_t>> parts;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    parts.clear();
    for (std::size_t i = 0; i < per_pixel; ++i) {
      const bdpt_coverage& entry = entries[pixel * per_pixel + i];
      if (entry.part == 0) continue;
      const std::uint32_t hash = hashes.at(entry.id);
      const auto known = std::find_if(parts.begin(), parts.end(), [&](const auto& p) { return p.second == hash; });
      if (known == parts.end())
        parts.emplace_back(entry.part, hash);
      else
        known->first += entry.part;
    }
    std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i >= Matte::kRanks) {
        matte.left_out += static_cast<double>(parts[i].first) / static_cast<double>(pixels);
        continue;
      }
      float* rank = &matte.ranks[(pixel * Matte::kRanks + i) * 2];
      rank[0] = std::bit_cast<float>(parts[i].second);
      rank[1] = parts[i].first;
    }
  }
  std::map<std::string, std::uint32_t> manifest;
  for (const auto& [id, name] : names) manifest[name] = hashes[id];
  std::string text = "{";
  for (const auto& [name, hash] : manifest)
    text += (text.size() > 1 ? "," : "") + quoted(name) + ":\"" + hex(hash) + '"';
  const std::string key = "cryptomatte/" + hex(murmur3(layer)).substr(0, 7) + '/';
  matte.attributes = {{key + "name", layer},
                      {key + "hash", "MurmurHash3_32"},
                      {key + "conversion", "uint32_to_float32"},
                      {key + "manifest", text + "}"}};
  return matte;
}

}  // namespace bdpt_tool
