// SPDX-License-Identifier: Apache-2.0
#include "scene_upload.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "gltf/scene_reader.h"
#include "pbrt/scene_reader.h"
#include "scene_colors.h"

namespace bdpt_tool {
namespace {

// Bytes the library wants to be able to read behind the last element.
constexpr std::size_t kSlack = 16;

template <class T>
void release_vector(void* user, const void*) {
  delete static_cast<std::vector<T>*>(user);
}

// The vector lives on the heap until the library lets go of it.
template <class T>
bdpt_data lend(std::vector<T>&& values, std::size_t components, bdpt_format format) {
  bdpt_data data{};
  if (values.empty()) return data;
  data.count = values.size() / components;
  values.resize(values.size() + kSlack / sizeof(T));
  auto* owner = new std::vector<T>(std::move(values));
  data.data = owner->data();
  data.format = format;
  data.ownership = BDPT_OWNERSHIP_BORROW;
  data.slack_bytes = kSlack;
  data.release = release_vector<T>;
  data.user = owner;
  return data;
}

class Uploader {
 public:
  Uploader(bdpt_context* context, SceneDescription& description)
      : description_(description), builder_(make<Builder>("the scene", bdpt_builder_create, context)) {}

  Scene build(bdpt_cancel* cancel) {
    for (ShapeDescription& shape : description_.shapes) shapes_.push_back(add(shape));
    for (TextureDescription& texture : description_.textures) textures_.push_back(add(texture));
    for (const MaterialDescription& material : description_.materials) materials_.push_back(add(material));
    for (InstanceDescription& instance : description_.instances) add(instance);
    for (const LightDescription& light : description_.lights) add(light);
    auto desc = sized<bdpt_build_desc>();
    desc.cancel = cancel;
    bdpt_scene* scene = nullptr;
    check(bdpt_scene_build(builder_.get(), &desc, &scene), description_.path);
    return Scene(scene);
  }

 private:
  bdpt_shape_id add(ShapeDescription& shape) {
    bdpt_shape_id id{};
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
      auto desc = sized<bdpt_sphere_desc>();
      desc.radius = sphere->radius;
      desc.label = shape.label.c_str();
      check(bdpt_sphere_add(builder_.get(), &desc, &id), shape.where);
      return id;
    }
    auto& mesh = std::get<TriangleMesh>(shape.geometry);
    auto desc = sized<bdpt_mesh_desc>();
    desc.label = shape.label.c_str();
    desc.positions = lend(std::move(mesh.positions), 3, BDPT_FORMAT_FLOAT3);
    desc.indices = lend(std::move(mesh.indices), 3, BDPT_FORMAT_UINT32X3);
    desc.normals = lend(std::move(mesh.normals), 3, BDPT_FORMAT_FLOAT3);
    desc.uv[0] = lend(std::move(mesh.uv), 2, BDPT_FORMAT_FLOAT2);
    desc.uv[1] = lend(std::move(mesh.uv_lightmap), 2, BDPT_FORMAT_FLOAT2);
    check(bdpt_mesh_add(builder_.get(), &desc, &id), shape.where);
    return id;
  }

  bdpt_texture_id add(TextureDescription& texture) {
    auto desc = sized<bdpt_texture_desc>();
    desc.label = texture.label.c_str();
    if (const auto* bytes = std::get_if<ByteImage>(&texture.image)) {
      desc.channels = bytes->channels;
      desc.pixels = bytes->pixels.data();
      desc.width = bytes->width;
      desc.height = bytes->height;
      desc.texel = BDPT_TEXEL_UINT8;
      desc.encoding = BDPT_ENCODING_SRGB;
    } else {
      const auto& image = std::get<Image>(texture.image);
      desc.channels = 3;
      desc.pixels = image.pixels.data();
      desc.width = image.width;
      desc.height = image.height;
      desc.texel = BDPT_TEXEL_FLOAT;
      desc.color_space = "lin_rec709";
    }
    bdpt_texture_id id{};
    check(bdpt_texture_add(builder_.get(), &desc, &id), texture.where);
    texture.image = ByteImage();  // copied
    return id;
  }

  bdpt_material_id add(const MaterialDescription& material) {
    auto desc = sized<bdpt_material_desc>();
    desc.type = material.type;
    desc.label = material.label.c_str();
    std::copy_n(material.reflectance.data(), 3, desc.reflectance);
    if (material.texture >= 0) desc.reflectance_texture = textures_[static_cast<std::size_t>(material.texture)];
    std::copy_n(material.eta.data(), 3, desc.eta);
    std::copy_n(material.k.data(), 3, desc.k);
    desc.ior = material.ior;
    std::copy_n(material.roughness.data(), 2, desc.roughness);
    std::copy_n(material.emission.data(), 3, desc.emission);
    desc.emission_two_sided = material.emission_two_sided;
    desc.one_sided = material.one_sided;
    bdpt_material_id id{};
    check(bdpt_material_add(builder_.get(), &desc, &id), material.where);
    return id;
  }

  void add(InstanceDescription& instance) {
    const auto shape = static_cast<std::size_t>(instance.shape);
    auto desc = sized<bdpt_instance_desc>();
    desc.label = instance.label.c_str();
    desc.shape = shapes_[shape];
    desc.material = materials_[static_cast<std::size_t>(instance.material)];
    std::copy_n(instance.transform.data(), 12, desc.transform);
    check(bdpt_instance_add(builder_.get(), &desc, &instance.id), instance.where);
  }

  void add(const LightDescription& light) {
    auto desc = sized<bdpt_light_desc>();
    desc.type = light.type;
    std::copy_n(light.position.data(), 3, desc.position);
    std::copy_n(light.direction.data(), 3, desc.direction);
    std::copy_n(light.value.data(), 3, light.type == BDPT_LIGHT_ENVIRONMENT ? desc.radiance : desc.intensity);
    desc.cone_angle = light.cone_angle;
    desc.cone_falloff = light.cone_falloff;
    bdpt_light_id id{};
    check(bdpt_light_add(builder_.get(), &desc, &id), light.where);
  }

  SceneDescription& description_;
  Builder builder_;
  std::vector<bdpt_shape_id> shapes_;
  std::vector<bdpt_texture_id> textures_;
  std::vector<bdpt_material_id> materials_;
};

}  // namespace

SceneDescription read_scene(const std::string& path, Diagnostics& diagnostics) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".pbrt") return read_pbrt_scene(path, diagnostics);
  if (extension == ".gltf" || extension == ".glb") return read_gltf_scene(path, diagnostics);
  throw Error(Location{path, 0},
              "not a scene this program can read; it reads pbrt-v4 files, named *.pbrt, and glTF 2.0 files, named "
              "*.gltf or *.glb");
}

Scene build_scene(bdpt_context* context, SceneDescription& description, bdpt_cancel* cancel) {
  convert_colors(context, description);
  return Uploader(context, description).build(cancel);
}

}  // namespace bdpt_tool
