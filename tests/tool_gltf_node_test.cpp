// Nodes of glTF: where everything is, by which names, in which scene.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_node_test {

TEST_F(ToolGltf, NodesTranslateRotateAndScaleInThisOrderFromTheirParentOn) {
  const double h = std::sqrt(.5);
  const std::string z90 = "[0,0," + std::to_string(h) + "," + std::to_string(h) + "]";
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes(
      "{\"children\":[1],\"translation\":[10,0,0]},"
      "{\"mesh\":0,\"translation\":[1,2,3],\"rotation\":" +
          z90 + ",\"scale\":[2,3,4]}",
      mesh_text);
  expect_near(transformed(scene.instances[0].transform, {1, 1, 1}, 1), {11 - 3, 2 + 2, 3 + 4});
}

TEST_F(ToolGltf, MatricesAreListedByColumns) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes("{\"mesh\":0,\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1]}", mesh_text);
  expect_near(transformed(scene.instances[0].transform, {1, 0, 0}, 1), {5, 7, 7});
}

TEST_F(ToolGltf, NodesShareTheShapesOfAMeshAndGiveTheirNames) {
  const std::string one = triangle(), two = triangle(), three = triangle();
  const SceneDescription scene =
      read_nodes("{\"children\":[1,2,3]},{\"mesh\":0,\"name\":\"left\"},{\"mesh\":0,\"name\":\"right\"},{\"mesh\":1}",
                 "\"meshes\":[{\"name\":\"wall\",\"primitives\":[{" + one + "},{" + two + "}]},{\"primitives\":[{" +
                     three + "}]}]");
  EXPECT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.shapes[1].label, "wall");
  std::vector<std::string> labels;
  for (const InstanceDescription& instance : scene.instances) labels.push_back(instance.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"left/0", "left/1", "right/0", "right/1", "nodes[3]"}));
  EXPECT_EQ(scene.instances[0].shape, scene.instances[2].shape);
}

TEST_F(ToolGltf, GpuInstancingMakesCopiesOfANode) {
  const std::string mesh_text = mesh_of(triangle());
  const int translation = buffer_.add("VEC3", Floats{1, 0, 0, 0, 2, 0});
  const int scale = buffer_.add("VEC3", Floats{1, 1, 1, 3, 3, 3});
  const std::string node =
      "{\"mesh\":0,\"name\":\"tree\",\"translation\":[0,0,5],\"extensions\":{\"EXT_mesh_gpu_instancing\":{"
      "\"attributes\":{\"TRANSLATION\":" +
      std::to_string(translation) + ",\"SCALE\":" + std::to_string(scale) + "}}}}";
  const SceneDescription scene = read_nodes(node, mesh_text);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].label, "tree[1]");
  EXPECT_EQ(scene.shapes.size(), 1u);
  expect_near(transformed(scene.instances[0].transform, {1, 1, 1}, 1), {2, 1, 6});
  expect_near(transformed(scene.instances[1].transform, {1, 1, 1}, 1), {3, 5, 8});
}

TEST_F(ToolGltf, TheDefaultSceneIsReadAndTheOthersAreToldOf) {
  const std::string mesh_text = mesh_of(triangle());
  const std::string more = "\"nodes\":[{\"mesh\":0,\"name\":\"a\"},{\"mesh\":0,\"name\":\"b\"}]," + mesh_text + "," +
                           buffer_.members() + ",\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1]}]";
  EXPECT_EQ(read_document(more).instances.at(0).label, "a");
  EXPECT_EQ(read_document(more + ",\"scene\":1").instances.at(0).label, "b");
  EXPECT_EQ(notes_with("one scene of 2 is read"), 1u);
  const ReadOptions first{.scene = "0", .folder = "", .environment = ""};
  EXPECT_EQ(read_scene(folder_.file("scene.gltf"), diagnostics_, first).instances.at(0).label, "a");
  try {
    read_scene(folder_.file("scene.gltf"), diagnostics_, {.scene = "attic", .folder = "", .environment = ""});
    FAIL();
  } catch (const Error& error) {
    expect_contains(error.what(), "there is no scene 'attic' in it; there are scenes[0], scenes[1]");
  }
}

TEST_F(ToolGltf, WhatIsScaledToNothingIsLeftOut) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes("{\"mesh\":0,\"children\":[1]},{\"mesh\":0,\"scale\":[1,0,1]}", mesh_text);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(notes_with("what is scaled to nothing is left out: nodes[1]"), 1u);
}

TEST_F(ToolGltf, ANodeHasOneParentAndIsNotItsOwnAncestor) {
  const std::string mesh_text = mesh_of(triangle());
  const auto error = [&](const std::string& nodes) { return error_of(scene_of(nodes, mesh_text)); };
  EXPECT_EQ(error("{\"children\":[1,2]},{\"children\":[3]},{\"children\":[3],\"name\":\"b\"},{\"mesh\":0}"),
            "scene.gltf: nodes[3] is a child of nodes[1] and of nodes[2] 'b'; it may have one parent");
  EXPECT_EQ(error("{\"children\":[1,1]},{\"mesh\":0}"),
            "scene.gltf: nodes[1] is a child of nodes[0] and of nodes[0]; it may have one parent");
  EXPECT_EQ(error("{\"children\":[1]},{\"children\":[0]}"), "scene.gltf: nodes[0] is its own ancestor");
  EXPECT_EQ(error("{\"children\":[0]}"), "scene.gltf: nodes[0] is its own ancestor");
  EXPECT_EQ(error("{\"mesh\":0},{\"children\":[2]},{\"children\":[1]}"), "scene.gltf: nodes[1] is its own ancestor");
  EXPECT_EQ(error("{\"mesh\":0},{\"children\":[0]}"),
            "scene.gltf: nodes[0] is a root of the scene and a child of nodes[1]");
}

TEST_F(ToolGltf, DeepTreesAreNoDangerToTheStack) {
  std::string nodes;
  const int depth = 100000;
  for (int i = 0; i < depth; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
  const std::string mesh_text = mesh_of(triangle());
  EXPECT_EQ(read_nodes(nodes + "{\"mesh\":0}", mesh_text).instances.size(), 1u);
}

}  // namespace bdpt_tool::tool_gltf_node_test
