// SPDX-License-Identifier: Apache-2.0
#include "gltf/schema.h"

#include <algorithm>

#include "error.h"
#include "gltf/draco.h"
#include "gltf/schema_checker.h"

namespace bdpt_tool::gltf {
namespace {

constexpr int kMaxDepth = 64;
// What a file may require: what is read, and materials, which are told of where they are only come near to.
constexpr const char* kKnown[] = {"KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform",
                                  "EXT_mesh_gpu_instancing"};

// Without "[json.exception.parse_error.101] parse error at line 1, column 2: " before it.
std::string reason_of(const Json::exception& error) {
  std::string text = error.what();
  text.erase(0, text.find("] ") + 2);
  if (text.starts_with("parse error at ")) text.erase(0, text.find(": ") + 2);
  return text;
}

// tinygltf follows extensions and extras by recursion.
bool is_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      if (++depth > kMaxDepth) return true;
    } else if (!in_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return false;
}

Json parse(const std::string& path, const Container& container) {
  const std::string_view text = container.json;
  if (is_deep(text)) throw Error(Location{path, 0}, "its JSON is nested more than 64 deep");
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const int line = container.is_glb ? 0 : 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
    throw Error(Location{path, line}, "not valid JSON: " + reason_of(error));
  } catch (const Json::exception& error) {
    throw Error(Location{path, 0}, "not valid JSON: " + reason_of(error));
  }
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

const Json& elements(const Json& document, const char* name) {
  static const Json none = Json::array();
  const Json* found = member(&document, name);
  return found ? *found : none;
}

void check_version(const Checker& checker, const Json& document) {
  const Json& asset = document["asset"];
  const auto version = asset["version"].get<std::string>(), least = asset.value("minVersion", std::string("2.0"));
  if (version.starts_with("2.") && least == "2.0") return;
  checker.fail("asset.version", "is " + (least == "2.0" ? version : "at least " + least) +
                                    ", and this program reads glTF 2.0; export it anew");
}

void check_extensions(const Checker& checker, const Json& document) {
  for (const Json& required : elements(document, "extensionsRequired")) {
    const auto name = required.get<std::string>();
    const bool known =
        name.starts_with("KHR_materials_") || std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
    const bool draco = name == "KHR_draco_mesh_compression";
    if (known || (draco && kReadsDraco)) continue;
    std::string advice = "export without it";
    if (draco) advice = "install libdraco-dev and build this program anew, or write the meshes uncompressed";
    if (name == "EXT_meshopt_compression") advice = "write the buffers uncompressed";
    if (name == "KHR_texture_basisu" || name == "EXT_texture_webp") advice = "write the textures as PNG or JPEG";
    if (name == "KHR_texture_basisu") advice += ": Debian has no library for KTX2";
    checker.fail("extensionsRequired", "names " + name + ", which is not read here; " + advice);
  }
}

std::size_t base64_size(std::string_view uri) {
  std::string_view text = uri.substr(uri.find(',') + 1);
  while (text.ends_with('=')) text.remove_suffix(1);
  return text.size() * 3 / 4;
}

std::vector<ExternalBuffer> check_buffers(const Checker& checker, const std::string& path, const SceneFolder& folder,
                                          const Container& container, const Json& document) {
  std::vector<ExternalBuffer> external;
  std::size_t i = 0;
  for (const Json& buffer : elements(document, "buffers")) {
    const std::string at = "buffers[" + std::to_string(i++) + "]";
    const Json* uri = member(&buffer, "uri");
    if (!uri) {
      if (i > 1 || !container.has_binary) checker.fail(at, "has neither a uri nor the binary data of a GLB");
      continue;
    }
    const auto text = uri->get<std::string>();
    const auto length = buffer["byteLength"].get<std::size_t>();
    if (text.empty()) checker.fail(at + ".uri", "is empty");
    if (!text.starts_with("data:")) {
      external.push_back({folder.path_of(percent_decoded(text), {path, 0}), length});
    } else if (!text.starts_with("data:application/octet-stream;base64,") &&
               !text.starts_with("data:application/gltf-buffer;base64,")) {
      checker.fail(at + ".uri", "must begin with data:application/octet-stream;base64, or name a file");
    } else if (base64_size(text) != length) {
      checker.fail(at + ".uri",
                   "holds " + with_count(base64_size(text), "byte") + ", and byteLength is " + std::to_string(length));
    }
  }
  return external;
}

// tinygltf looks at no view's length before it hands out the data of an image.
void check_views(const Checker& checker, const Json& document) {
  std::size_t i = 0;
  for (const Json& view : elements(document, "bufferViews")) {
    const std::string at = "bufferViews[" + std::to_string(i++) + "]";
    const auto length = document["buffers"][view["buffer"].get<std::size_t>()]["byteLength"].get<std::size_t>();
    const auto end = view.value("byteOffset", std::size_t{0}) + view["byteLength"].get<std::size_t>();
    if (end > length) {
      checker.fail(at, "ends at byte " + std::to_string(end) + " of a buffer of " + std::to_string(length));
    }
  }
}

}  // namespace

std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low < 0) {
      text += uri[i];
    } else {
      text += static_cast<char>(16 * high + low);
      i += 2;
    }
  }
  return text;
}

std::vector<ExternalBuffer> check_document(const std::string& path, const SceneFolder& folder,
                                           const Container& container) {
  const Json document = parse(path, container);
  if (!document.is_object()) throw Error(Location{path, 0}, "its JSON must be an object, in braces");
  const Checker checker(path, document);
  for (const Rule& rule : kHeaderRules) checker.check(rule);
  check_version(checker, document);
  check_extensions(checker, document);
  for (const Rule& rule : kRules) checker.check(rule);
  for (const char* texture : kTextureInfos) {
    for (Rule rule : kTextureInfoRules) {
      const std::string path_of_rule = std::string(texture) + "." + rule.path;
      rule.path = path_of_rule.c_str();
      checker.check(rule);
    }
  }
  check_views(checker, document);
  return check_buffers(checker, path, folder, container, document);
}

}  // namespace bdpt_tool::gltf
