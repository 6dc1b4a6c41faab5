// Reads a file by tinygltf, and turns what that says into a document.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"

#include <algorithm>
#include <cstdint>
#include <fstream>  // for tinygltf, which forgets it
#include <limits>
#include <string_view>
#include <utility>

#include "file_data.h"
#include "gltf/draco.h"
#include "gltf/schema.h"

#define TINYGLTF_IMPLEMENTATION
#include "gltf/tinygltf.h"

namespace bdpt_tool::gltf {

std::string place(const char* array, std::size_t index, const std::string& name) {
  std::string text = std::string(array) + "[" + std::to_string(index) + "]";
  if (!name.empty()) text += " '" + name + "'";
  return text;
}

namespace {

// An accessor without data is all zero, and costs its file nothing: there may be so many elements, or as many as
// another has data for.
constexpr std::size_t kMaxZeroElements = std::size_t{1} << 16;

// The buffers in files of their own, in the order in which tinygltf asks for them.
struct Supply {
  std::vector<ExternalBuffer> buffers;
  std::size_t next = 0;
  Location from;
};

bool read_buffer(std::vector<unsigned char>* bytes, std::string*, const std::string&, void* user) {
  auto& supply = *static_cast<Supply*>(user);
  const ExternalBuffer& buffer = supply.buffers.at(supply.next++);
  const FileData file(buffer.path, supply.from);
  if (file.text().size() < buffer.length) {
    throw Error(supply.from, "'" + buffer.path + "' has " + std::to_string(file.text().size()) + " bytes of " +
                                 std::to_string(buffer.length) + "; it is cut off, or another file");
  }
  bytes->assign(file.text().begin(), file.text().begin() + static_cast<std::ptrdiff_t>(buffer.length));
  return true;
}

// An image of a data URI stays as its file has it; one in a buffer view stays there.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

// Later versions of tinygltf want all of these, and one more.
template <class Callbacks>
Callbacks file_callbacks(Supply& supply) {
  Callbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = read_buffer;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
      *size = 0;
      return true;
    };
  }
  callbacks.user_data = &supply;
  return callbacks;
}

// Without the bytes of a data URI, and what follows.
std::string first_line(const std::string& text) {
  return text.substr(0, std::min(text.find('\n'), text.find("data:")));
}

tinygltf::Model load(const std::string& path, const SceneFolder& folder) {
  const Location where{path, 0};
  const FileData file(path);
  std::string_view data = file.text();
  if (data.size() > std::numeric_limits<std::int32_t>::max()) {
    throw Error(where, "larger than 2 GiB; put its data into buffers of their own");
  }
  const Container container = open_container(path, data);
  Supply supply{check_document(path, folder, container), 0, where};
  std::string changed;
  if (kReadsDraco && container.json.find("KHR_draco_mesh_compression") != std::string_view::npos)
    data = changed = with_json(data, container, with_packed_indices_apart(container.json));
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>(supply));
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(data.size());
  const bool loaded = container.is_glb
                          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(data.data()), size)
                          : loader.LoadASCIIFromString(&model, &error, &warning, data.data(), size, "");
  if (!loaded) throw Error(where, "damaged glTF: " + (error.empty() ? "it cannot be read" : first_line(error)));
  return model;
}

class Converter {
 public:
  Converter(const std::string& path, const SceneFolder& folder, const std::string& scene, tinygltf::Model&& model)
      : where_{path, 0}, folder_(folder), scene_(scene), model_(std::move(model)) {}

  Document convert() {
    convert_data();
    for (const tinygltf::Material& material : model_.materials) document_.materials.push_back(read_material(material));
    for (const tinygltf::Texture& texture : model_.textures) document_.textures.push_back(converted(texture));
    for (std::size_t i = 0; i < model_.meshes.size(); ++i) {
      document_.meshes.push_back(converted(model_.meshes[i], place("meshes", i)));
    }
    for (const tinygltf::Camera& camera : model_.cameras) document_.cameras.push_back(converted(camera));
    for (const tinygltf::Light& light : model_.lights) document_.lights.push_back(converted(light));
    for (const tinygltf::Skin& skin : model_.skins) document_.skins.push_back(converted(skin));
    for (const tinygltf::Node& node : model_.nodes) document_.nodes.push_back(converted(node));
    choose_scene(scene_);
    document_.extensions = model_.extensionsUsed;
    document_.has_animations = !model_.animations.empty();
    return std::move(document_);
  }

 private:
  [[noreturn]] void fail(const std::string& at, const std::string& text) const { throw Error(where_, at + " " + text); }

  void convert_data() {
    for (tinygltf::Buffer& buffer : model_.buffers) document_.storage.push_back(std::move(buffer.data));
    find_packed();
    for (const tinygltf::Accessor& accessor : model_.accessors) {
      if (accessor.bufferView >= 0) max_zero_elements_ = std::max(max_zero_elements_, accessor.count);
    }
    for (std::size_t i = 0; i < model_.accessors.size(); ++i) {
      document_.accessors.push_back(converted(model_.accessors[i], is_packed_[i], place("accessors", i)));
    }
    for (tinygltf::Image& image : model_.images) {
      Image converted;
      converted.name = image.name;
      if (image.bufferView >= 0) {
        const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(image.bufferView)];
        converted.data = data_of(view);
        converted.size = view.byteLength;
      } else if (!image.uri.empty()) {
        // tinygltf leaves a data URI of a kind it does not know as it is; without bytes it is no image.
        if (!image.uri.starts_with("data:")) converted.path = folder_.path_of(percent_decoded(image.uri), where_);
      } else {
        document_.storage.push_back(std::move(image.image));
        converted.data = document_.storage.back().data();
        converted.size = document_.storage.back().size();
      }
      document_.images.push_back(std::move(converted));
    }
  }

  // The moved vectors keep their memory.
  const unsigned char* data_of(const tinygltf::BufferView& view) const {
    return document_.storage[static_cast<std::size_t>(view.buffer)].data() + view.byteOffset;
  }

  Component component(int type, const std::string& at) const {
    if (type == TINYGLTF_COMPONENT_TYPE_INT) fail(at, "has components of the unknown type 5124");
    return static_cast<Component>(type);
  }

  static std::size_t size_of(Component type) {
    if (type == Component::kByte || type == Component::kUbyte) return 1;
    return type == Component::kShort || type == Component::kUshort ? 2 : 4;
  }

  // `count` elements of `size` bytes, `stride` apart, from `offset` on.
  const unsigned char* checked(int view_index, std::size_t offset, std::size_t count, std::size_t stride,
                               std::size_t size, const std::string& at) const {
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(view_index)];
    if (stride < size) fail(at, "has elements of " + std::to_string(size) + " bytes in steps of fewer");
    const std::size_t end = offset + (count - 1) * stride + size;
    if (end > view.byteLength) {
      fail(at, "ends at byte " + std::to_string(end) + " of a view of " + std::to_string(view.byteLength));
    }
    return data_of(view) + offset;
  }

  Accessor converted(const tinygltf::Accessor& from, bool is_packed, const std::string& at) const {
    Accessor to;
    to.count = from.count;
    to.type = component(from.componentType, at);
    to.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
    to.normalized = from.normalized;
    const std::size_t size = size_of(to.type) * static_cast<std::size_t>(to.components);
    to.stride = size;
    if (from.bufferView >= 0) {
      const std::size_t stride = model_.bufferViews[static_cast<std::size_t>(from.bufferView)].byteStride;
      if (stride > 0) to.stride = stride;
      to.data = checked(from.bufferView, from.byteOffset, to.count, to.stride, size, at);
    } else if (to.count > max_zero_elements_ && !is_packed) {
      fail(at, "has no data for its " + std::to_string(to.count) + " elements");
    }
    if (from.sparse.isSparse) convert_sparse(from, size, at + ".sparse", to);
    return to;
  }

  void convert_sparse(const tinygltf::Accessor& from, std::size_t size, const std::string& at, Accessor& to) const {
    const auto& indices = from.sparse.indices;
    const auto& values = from.sparse.values;
    to.sparse.count = static_cast<std::size_t>(from.sparse.count);
    to.sparse.index_type = component(indices.componentType, at);
    if (to.sparse.index_type != Component::kUbyte && to.sparse.index_type != Component::kUshort &&
        to.sparse.index_type != Component::kUint) {
      fail(at + ".indices", "must be unsigned integers");
    }
    const std::size_t index_size = size_of(to.sparse.index_type);
    to.sparse.indices = checked(indices.bufferView, static_cast<std::size_t>(indices.byteOffset), to.sparse.count,
                                index_size, index_size, at + ".indices");
    to.sparse.values = checked(values.bufferView, static_cast<std::size_t>(values.byteOffset), to.sparse.count, size,
                               size, at + ".values");
  }

  Texture converted(const tinygltf::Texture& from) const {
    Texture to;
    to.image = from.source;
    for (const auto& [name, value] : from.extensions) {
      if (to.image < 0 && value.Has("source")) to.unread = name;
    }
    if (from.sampler >= 0) {
      const tinygltf::Sampler& sampler = model_.samplers[static_cast<std::size_t>(from.sampler)];
      to.wrap = {wrap(sampler.wrapS), wrap(sampler.wrapT)};
      to.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return to;
  }

  static Wrap wrap(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::kClamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::kMirror : Wrap::kRepeat;
  }

  static const tinygltf::Value* draco_of(const tinygltf::Primitive& primitive) {
    return kReadsDraco ? extension(primitive.extensions, "KHR_draco_mesh_compression") : nullptr;
  }

  // The accessors whose data Draco has; when all meshes are unpacked, it had as much as they say.
  void find_packed() {
    is_packed_.resize(model_.accessors.size());
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const tinygltf::Value* draco = draco_of(primitive);
        if (!draco) continue;
        if (draco->Has("indices")) is_packed_[static_cast<std::size_t>(draco->Get("indices").GetNumberAsInt())] = true;
        for (const std::string& name : draco->Get("attributes").Keys()) {
          const auto found = primitive.attributes.find(name);
          if (found != primitive.attributes.end()) is_packed_[static_cast<std::size_t>(found->second)] = true;
        }
      }
    }
  }

  void unpack(const tinygltf::Value& draco, const std::string& at, Primitive& primitive) {
    const auto& view = model_.bufferViews[static_cast<std::size_t>(draco.Get("bufferView").GetNumberAsInt())];
    if (draco.Has("indices")) primitive.indices = draco.Get("indices").GetNumberAsInt();
    const tinygltf::Value& attributes = draco.Get("attributes");
    std::map<std::string, int> ids;
    for (const std::string& name : attributes.Keys()) ids[name] = attributes.Get(name).GetNumberAsInt();
    unpack_draco({data_of(view), view.byteLength}, ids, where_, at, document_, primitive);
  }

  Mesh converted(const tinygltf::Mesh& from, const std::string& at) {
    Mesh to;
    to.name = from.name;
    for (const tinygltf::Primitive& primitive : from.primitives) {
      to.primitives.push_back({static_cast<Mode>(primitive.mode), primitive.indices, primitive.material,
                               primitive.attributes, primitive.targets});
      if (const tinygltf::Value* draco = draco_of(primitive))
        unpack(*draco, place((at + ".primitives").c_str(), to.primitives.size() - 1), to.primitives.back());
    }
    to.weights = from.weights;
    return to;
  }

  static Skin converted(const tinygltf::Skin& from) { return {from.joints, from.inverseBindMatrices}; }

  Camera converted(const tinygltf::Camera& from) const {
    const bool perspective = from.type == "perspective";
    const tinygltf::OrthographicCamera& parallel = from.orthographic;
    return {from.name, perspective, from.perspective.yfov,
            perspective ? from.perspective.aspectRatio : parallel.xmag / parallel.ymag, parallel.ymag};
  }

  static Light converted(const tinygltf::Light& from) {
    Light to;
    to.name = from.name;
    to.type = from.type;
    if (from.color.size() == 3) std::copy_n(from.color.begin(), 3, to.color.begin());
    to.intensity = from.intensity;
    to.has_range = from.range > 0;
    to.inner_angle = from.spot.innerConeAngle;
    to.outer_angle = from.spot.outerConeAngle;
    return to;
  }

  static Node converted(const tinygltf::Node& from) {
    Node to;
    to.name = from.name;
    to.children = from.children;
    to.mesh = from.mesh;
    to.camera = from.camera;
    to.skin = from.skin;
    to.weights = from.weights;
    if (from.matrix.size() == 16) std::copy_n(from.matrix.begin(), 16, to.matrix.emplace().begin());
    if (from.translation.size() == 3) std::copy_n(from.translation.begin(), 3, to.translation.begin());
    if (from.rotation.size() == 4) std::copy_n(from.rotation.begin(), 4, to.rotation.begin());
    if (from.scale.size() == 3) std::copy_n(from.scale.begin(), 3, to.scale.begin());
    if (const tinygltf::Value* light = extension(from.extensions, "KHR_lights_punctual")) {
      to.light = light->Get("light").GetNumberAsInt();
    }
    if (const tinygltf::Value* instancing = extension(from.extensions, "EXT_mesh_gpu_instancing")) {
      const tinygltf::Value& attributes = instancing->Get("attributes");
      for (const std::string& name : attributes.Keys()) {
        to.instancing[name] = attributes.Get(name).GetNumberAsInt();
      }
    }
    return to;
  }

  void choose_scene(const std::string& wanted) {
    document_.scene_count = model_.scenes.size();
    if (model_.scenes.empty()) throw Error(where_, "there is no scene in it");
    std::size_t chosen = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    if (!wanted.empty()) chosen = scene_named(wanted);
    document_.roots = model_.scenes[chosen].nodes;
  }

  std::size_t scene_named(const std::string& wanted) const {
    std::string all;
    for (std::size_t i = 0; i < model_.scenes.size(); ++i) {
      if (model_.scenes[i].name == wanted || std::to_string(i) == wanted) return i;
      all += (i == 0 ? "" : ", ") + place("scenes", i, model_.scenes[i].name);
    }
    throw Error(where_, "there is no scene '" + wanted + "' in it; there are " + all);
  }

  Location where_;
  const SceneFolder& folder_;
  const std::string& scene_;
  tinygltf::Model model_;
  Document document_;
  std::vector<bool> is_packed_;
  std::size_t max_zero_elements_ = kMaxZeroElements;
};

}  // namespace

Document read_document(const std::string& path, const SceneFolder& folder, const std::string& scene) {
  return Converter(path, folder, scene, load(path, folder)).convert();
}

}  // namespace bdpt_tool::gltf
