// Files from elsewhere, and what of a scene reaches the library.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_shared_test {

TEST_F(ToolGltf, EveryKindOfThingThatIsLeftOutIsToldOfOnce) {
  const std::string attributes = triangle() + ",\"targets\":[{\"POSITION\":0}]";
  const std::string material =
      "{\"alphaMode\":\"BLEND\",\"emissiveFactor\":[1,1,1],\"pbrMetallicRoughness\":{\"metallicFactor\":0.5},"
      "\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1},"
      "\"KHR_materials_sheen\":{\"sheenColorFactor\":[1,1,1]},"
      "\"KHR_materials_iridescence\":{\"iridescenceFactor\":1},"
      "\"KHR_materials_anisotropy\":{\"anisotropyStrength\":1}}}";
  const std::string unlit = "{\"extensions\":{\"KHR_materials_unlit\":{}}}";
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"children\":[1]},{\"mesh\":1}",
                 "\"meshes\":[{\"primitives\":[{" + attributes + ",\"material\":0}]},{\"primitives\":[{" + attributes +
                     ",\"material\":1},{" + attributes + ",\"material\":2}]}],\"materials\":[" + material + "," +
                     material + "," + unlit +
                     "],\"animations\":[{\"channels\":[],\"samplers\":[]}],\"extensionsUsed\":[\"KHR_materials_"
                     "variants\",\"KHR_materials_unlit\"]");
  EXPECT_EQ(scene.instances.size(), 3u);
  for (const char* kind : {"animations are left out", "morph targets stay as they are at rest: meshes[0].primitives[0]",
                           "alpha of what emits is left out",
                           "unlit materials emit their colour, and are not lit: materials[2]",
                           "the extension KHR_materials_variants is not known"}) {
    EXPECT_EQ(notes_with(kind), 1u) << kind << " in\n" << notes();
  }
}

TEST_F(ToolGltf, LabelsAndTheLightmapsUvReachTheLibrary) {
  const Context context = make_context(1, diagnostics_);
  const auto error = [&](SceneDescription scene) {
    try {
      build_scene(context.get(), scene);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  SceneDescription scene = read_nodes("{\"mesh\":0,\"name\":\"Lamp\"}", mesh_of(triangle()));
  EXPECT_EQ(error(scene), "no error");
  SceneDescription wrong_uv = scene;
  std::get<TriangleMesh>(wrong_uv.shapes[0].geometry).uv_lightmap = {0, 0};
  expect_contains(error(wrong_uv), "uv[1]");
  SceneDescription singular = scene;
  singular.instances[0].transform = {1};
  expect_contains(error(singular), "Lamp");
}

TEST_F(ToolGltf, OneSidedMaterialsReachTheLibrary) {
  const Context context = make_context(1, diagnostics_);
  const SceneDescription scene = read_material("\"pbrMetallicRoughness\":{\"metallicFactor\":0}");
  const auto hash = [&](bool one_sided) {
    SceneDescription copy = scene;
    copy.materials.at(0).one_sided = one_sided;
    const Scene built = build_scene(context.get(), copy);
    auto info = sized<bdpt_scene_info>();
    check(bdpt_scene_get_info(built.get(), &info), "the scene");
    return info.hash;
  };
  EXPECT_NE(hash(false), hash(true));
}

TEST_F(ToolGltf, SharedDamagedFilesAreRefusedWithAReason) {
  const std::filesystem::path folder = std::filesystem::path(BDPT_SHARED_DIR) / "scenes/importer-edge";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t files = 0;
  for (const char* kind : {"gltf-bad", "glb-bad"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / kind)) {
      const auto extension = entry.path().extension();
      if (extension != ".gltf" && extension != ".glb") continue;
      ++files;
      if (entry.path().filename() == "BoxBadNormals.glb") {
        EXPECT_NO_THROW(read_scene(entry.path().string(), diagnostics_));
        continue;
      }
      try {
        read_scene(entry.path().string(), diagnostics_);
        ADD_FAILURE() << entry.path() << " was read";
      } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string() + ":")) << error.what();
      }
    }
  }
  EXPECT_EQ(files, 39u);
}

TEST_F(ToolGltf, SharedModelsAreRead) {
  const std::filesystem::path folder = std::filesystem::path(BDPT_SHARED_DIR) / "scenes/gltf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t models = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    ++models;
    EXPECT_NO_THROW(read_scene(entry.path().string(), diagnostics_)) << entry.path();
  }
  EXPECT_EQ(models, 28u);
}

TEST_F(ToolGltf, SharedCornellBoxHasUvForLightmapsOnEveryMesh) {
  const std::filesystem::path file =
      std::filesystem::path(BDPT_SHARED_DIR) / "scenes/lightmap/bevy-cornell/CornellBox.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared scenes are not here";
  const SceneDescription scene = read_scene(file.string(), diagnostics_);
  std::vector<std::string> labels;
  std::size_t triangles = 0;
  for (const InstanceDescription& instance : scene.instances) {
    labels.push_back(instance.label);
    const TriangleMesh& shape = mesh(scene, static_cast<std::size_t>(instance.shape));
    EXPECT_EQ(shape.uv_lightmap.size(), 2 * shape.vertex_count()) << instance.label;
    triangles += shape.triangle_count();
  }
  EXPECT_EQ(labels, (std::vector<std::string>{"Light", "large.box", "small.box", "cornell.box/0", "cornell.box/1",
                                              "cornell.box/2"}));
  EXPECT_EQ(triangles, 36u);
  EXPECT_EQ(scene.materials.at(0).emission, (Rgb{100, 100, 100}));
}

}  // namespace bdpt_tool::tool_gltf_shared_test
