// SPDX-License-Identifier: Apache-2.0
#include "gltf/schema_rules.h"

#include <numbers>

namespace bdpt_tool::gltf {
namespace {

constexpr double kMaxBytes = 9007199254740992.0;  // 2^53
constexpr double kMaxCount = 4294967295.0;
constexpr double kMaxInt = 2147483647.0;
constexpr bool kRequired = true;

constexpr Rule object(const char* path, bool required = false) { return {path, Kind::kObject, required}; }
constexpr Rule array(const char* path, bool required = false) { return {path, Kind::kArray, required}; }
constexpr Rule text(const char* path, bool required = false) { return {path, Kind::kText, required}; }
constexpr Rule texts(const char* path) { return {path, Kind::kTexts}; }
constexpr Rule boolean(const char* path) { return {path, Kind::kBoolean}; }
constexpr Rule integer(const char* path, double low, double high, bool required = false) {
  return {path, Kind::kInteger, required, "", 0, low, high};
}
constexpr Rule number(const char* path, double low = -FLT_MAX, double high = FLT_MAX, bool required = false) {
  return {path, Kind::kNumber, required, "", 0, low, high};
}
constexpr Rule numbers(const char* path, std::size_t count, double low = -FLT_MAX, double high = FLT_MAX) {
  return {path, Kind::kNumbers, false, "", count, low, high};
}
constexpr Rule index(const char* path, const char* of, bool required = false) {
  return {path, Kind::kIndex, required, of};
}
constexpr Rule indices(const char* path, const char* of, bool required = false) {
  return {path, Kind::kIndices, required, of};
}

constexpr Rule kHeader[] = {
    object("asset", kRequired), text("asset.version", kRequired), text("asset.minVersion"),
    texts("extensionsUsed"),    texts("extensionsRequired"),      object("extensions"),
};

constexpr Rule kBody[] = {
    text("buffers[].uri"),
    integer("buffers[].byteLength", 1, kMaxBytes, kRequired),
    index("bufferViews[].buffer", "buffers", kRequired),
    integer("bufferViews[].byteOffset", 0, kMaxBytes),
    integer("bufferViews[].byteLength", 1, kMaxBytes, kRequired),
    integer("bufferViews[].byteStride", 4, 252),

    index("accessors[].bufferView", "bufferViews"),
    integer("accessors[].byteOffset", 0, kMaxBytes),
    integer("accessors[].componentType", 5120, 5126, kRequired),
    boolean("accessors[].normalized"),
    integer("accessors[].count", 1, kMaxCount, kRequired),
    text("accessors[].type", kRequired),
    integer("accessors[].sparse.count", 1, kMaxInt, kRequired),
    object("accessors[].sparse.indices", kRequired),
    index("accessors[].sparse.indices.bufferView", "bufferViews", kRequired),
    integer("accessors[].sparse.indices.byteOffset", 0, kMaxInt),
    integer("accessors[].sparse.indices.componentType", 5121, 5125, kRequired),
    object("accessors[].sparse.values", kRequired),
    index("accessors[].sparse.values.bufferView", "bufferViews", kRequired),
    integer("accessors[].sparse.values.byteOffset", 0, kMaxInt),

    text("meshes[].name"),
    array("meshes[].primitives", kRequired),
    object("meshes[].primitives[].attributes", kRequired),
    index("meshes[].primitives[].attributes.*", "accessors"),
    index("meshes[].primitives[].indices", "accessors"),
    index("meshes[].primitives[].material", "materials"),
    integer("meshes[].primitives[].mode", 0, 6),
    index("meshes[].primitives[].targets[].*", "accessors"),
    object("meshes[].primitives[].extensions"),
    object("meshes[].primitives[].extensions.KHR_draco_mesh_compression"),
    index("meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", "bufferViews", kRequired),
    object("meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", kRequired),
    integer("meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes.*", 0, kMaxInt),
    numbers("meshes[].weights", 0),

    text("nodes[].name"),
    indices("nodes[].children", "nodes"),
    index("nodes[].mesh", "meshes"),
    index("nodes[].camera", "cameras"),
    index("nodes[].skin", "skins"),
    numbers("nodes[].matrix", 16),
    numbers("nodes[].translation", 3),
    numbers("nodes[].rotation", 4, -1.01, 1.01),
    numbers("nodes[].scale", 3),
    numbers("nodes[].weights", 0),
    index("nodes[].extensions.KHR_lights_punctual.light", "extensions.KHR_lights_punctual.lights", kRequired),
    object("nodes[].extensions.EXT_mesh_gpu_instancing.attributes", kRequired),
    index("nodes[].extensions.EXT_mesh_gpu_instancing.attributes.*", "accessors"),
    index("scene", "scenes"),
    text("scenes[].name"),
    indices("scenes[].nodes", "nodes"),

    text("materials[].name"),
    boolean("materials[].doubleSided"),
    text("materials[].alphaMode"),
    numbers("materials[].emissiveFactor", 3, 0),
    number("materials[].alphaCutoff", 0),
    number("materials[].normalTexture.scale"),
    numbers("materials[].pbrMetallicRoughness.baseColorFactor", 4, 0, 1),
    number("materials[].pbrMetallicRoughness.metallicFactor", 0, 1),
    number("materials[].pbrMetallicRoughness.roughnessFactor", 0, 1),
    object("materials[].extensions"),
    object("materials[].extensions.KHR_materials_unlit"),
    number("materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", 0),
    number("materials[].extensions.KHR_materials_ior.ior", 0),
    number("materials[].extensions.KHR_materials_transmission.transmissionFactor", 0, 1),
    number("materials[].extensions.KHR_materials_volume.thicknessFactor", 0),
    number("materials[].extensions.KHR_materials_volume.attenuationDistance", 1e-30),
    numbers("materials[].extensions.KHR_materials_volume.attenuationColor", 3, 0, 1),
    number("materials[].extensions.KHR_materials_dispersion.dispersion", 0),
    number("materials[].extensions.KHR_materials_clearcoat.clearcoatFactor", 0, 1),
    number("materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor", 0, 1),
    number("materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture.scale"),
    numbers("materials[].extensions.KHR_materials_sheen.sheenColorFactor", 3, 0, 1),
    number("materials[].extensions.KHR_materials_sheen.sheenRoughnessFactor", 0, 1),
    number("materials[].extensions.KHR_materials_specular.specularFactor", 0, 1),
    numbers("materials[].extensions.KHR_materials_specular.specularColorFactor", 3, 0),
    number("materials[].extensions.KHR_materials_iridescence.iridescenceFactor", 0, 1),
    number("materials[].extensions.KHR_materials_iridescence.iridescenceIor", 1),
    number("materials[].extensions.KHR_materials_iridescence.iridescenceThicknessMinimum", 0),
    number("materials[].extensions.KHR_materials_iridescence.iridescenceThicknessMaximum", 0),
    number("materials[].extensions.KHR_materials_anisotropy.anisotropyStrength", 0, 1),
    number("materials[].extensions.KHR_materials_anisotropy.anisotropyRotation"),

    text("textures[].name"),
    index("textures[].source", "images"),
    index("textures[].sampler", "samplers"),
    text("images[].name"),
    text("images[].uri"),
    index("images[].bufferView", "bufferViews"),
    integer("samplers[].magFilter", 0, kMaxInt),
    integer("samplers[].wrapS", 0, kMaxInt),
    integer("samplers[].wrapT", 0, kMaxInt),

    text("cameras[].name"),
    text("cameras[].type", kRequired),
    number("cameras[].perspective.yfov", 1e-4, 0.9999 * std::numbers::pi, kRequired),
    number("cameras[].perspective.aspectRatio", 1e-4, 1e4),
    number("cameras[].orthographic.xmag", 1e-9, 1e9, kRequired),
    number("cameras[].orthographic.ymag", 1e-9, 1e9, kRequired),
    array("extensions.KHR_lights_punctual.lights", kRequired),
    text("extensions.KHR_lights_punctual.lights[].name"),
    text("extensions.KHR_lights_punctual.lights[].type", kRequired),
    numbers("extensions.KHR_lights_punctual.lights[].color", 3, 0),
    number("extensions.KHR_lights_punctual.lights[].intensity", 0),
    number("extensions.KHR_lights_punctual.lights[].range", 0),
    number("extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", 0, std::numbers::pi / 2),
    number("extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", 1e-6, std::numbers::pi / 2 + 1e-6),

    array("animations"),
    indices("skins[].joints", "nodes", kRequired),
    index("skins[].inverseBindMatrices", "accessors"),
};

constexpr const char* kTextures[] = {
    "materials[].emissiveTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].extensions.KHR_materials_transmission.transmissionTexture",
    "materials[].extensions.KHR_materials_volume.thicknessTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture",
    "materials[].extensions.KHR_materials_sheen.sheenColorTexture",
    "materials[].extensions.KHR_materials_sheen.sheenRoughnessTexture",
    "materials[].extensions.KHR_materials_specular.specularTexture",
    "materials[].extensions.KHR_materials_specular.specularColorTexture",
    "materials[].extensions.KHR_materials_iridescence.iridescenceTexture",
    "materials[].extensions.KHR_materials_iridescence.iridescenceThicknessTexture",
    "materials[].extensions.KHR_materials_anisotropy.anisotropyTexture",
};

constexpr Rule kTextureInfo[] = {
    index("index", "textures", kRequired),
    integer("texCoord", 0, kMaxInt),
    object("extensions.KHR_texture_transform"),
    numbers("extensions.KHR_texture_transform.offset", 2),
    numbers("extensions.KHR_texture_transform.scale", 2),
    number("extensions.KHR_texture_transform.rotation"),
    integer("extensions.KHR_texture_transform.texCoord", 0, kMaxInt),
};

}  // namespace

constinit const std::span<const Rule> kHeaderRules = kHeader;
constinit const std::span<const Rule> kRules = kBody;
constinit const std::span<const char* const> kTextureInfos = kTextures;
constinit const std::span<const Rule> kTextureInfoRules = kTextureInfo;

}  // namespace bdpt_tool::gltf
