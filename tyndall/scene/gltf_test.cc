#include "tyndall/scene/gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/shared_folder.h"
#include "tyndall/document/fault.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/image/png.h"
#include "tyndall/scene/glb_fixture.h"
#include "tyndall/scene/scene_file.h"
#include "tyndall/scene/transform.h"

namespace tyndall {
namespace {

using nlohmann::json;
using tests::Folder;
using tests::Glb;

Scene loaded(const Glb& glb, double meters_per_unit = 1.0) {
  const Folder folder;
  Scene scene;
  add_gltf(scene, folder.put("test.glb", glb.bytes()), {meters_per_unit});
  return scene;
}

std::string fault_of(const Glb& glb) {
  try {
    loaded(glb);
  } catch (const Fault& fault) {
    return fault.what();
  }
  return "";
}

bool warns(const Scene& scene, const std::string& of) {
  for (const std::string& warning : scene.warnings) {
    if (warning.find(of) != std::string::npos) return true;
  }
  return false;
}

void expect_near(const Vector& a, const Vector& b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}
Vector vector_of(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

Vector normal_of(const Mesh& mesh, std::size_t triangle = 0) {
  const auto& t = mesh.triangles[triangle];
  const Vector a = vector_of(mesh.positions[t[0]]);
  return normalized(cross(vector_of(mesh.positions[t[1]]) - a, vector_of(mesh.positions[t[2]]) - a));
}

TEST(Gltf, NodesAreScaledThenTurnedThenMovedDownTheTree) {
  Glb glb;
  const int mesh = glb.triangle_mesh();
  const double half = std::sqrt(0.5);
  const int child = glb.add("nodes", {{"mesh", mesh}, {"scale", {2, 3, 4}}});
  // A quarter turn about +Y takes +X to -Z.
  glb.node({{"translation", {10, 20, 30}}, {"rotation", {0, half, 0, half}}, {"children", {child}}});
  const Scene scene = loaded(glb);
  ASSERT_EQ(scene.meshes.size(), 1U);
  expect_near(vector_of(scene.meshes[0].positions[0]), {10, 20, 30});
  expect_near(vector_of(scene.meshes[0].positions[1]), {10, 20, 28});
  expect_near(vector_of(scene.meshes[0].positions[2]), {10, 23, 30});

  Glb by_matrix;
  const int same = by_matrix.add("nodes", {{"mesh", by_matrix.triangle_mesh()}});
  by_matrix.node({{"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 10, 20, 30, 1}}, {"children", {same}}});
  EXPECT_EQ(loaded(by_matrix).meshes[0].positions[1], scene.meshes[0].positions[1]);
}

TEST(Gltf, UnitsScalePlacesButNotLight) {
  Glb glb;
  glb.node({{"mesh", glb.triangle_mesh()}, {"translation", {1, 2, 3}}});
  glb.light({{"type", "point"}, {"intensity", 5}});
  glb.node({{"translation", {4, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Scene scene = loaded(glb, 0.01);
  expect_near(vector_of(scene.meshes[0].positions[1]), {0.02, 0.02, 0.03});
  expect_near(scene.points[0].position, {0.04, 0, 0});
  EXPECT_EQ(scene.points[0].intensity, Spectrum::grey(5.0));
}

TEST(Gltf, MirrorsKeepFrontFacesAndNormalsRight) {
  Glb glb;
  const int positions = glb.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  const int normals = glb.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
  glb.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}}}}});
  for (const json& scale : {json{1, 1, 1}, json{-1, 1, 1}, json{1, -2, 1}, json{-3, -1, 1}}) {
    glb.node({{"mesh", 0}, {"scale", scale}});
  }
  glb.node({{"mesh", 0}, {"scale", {1, 1, -1}}});
  const Scene scene = loaded(glb);
  ASSERT_EQ(scene.meshes.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const Vector front{0, 0, i == 4 ? -1.0 : 1.0};
    expect_near(normal_of(scene.meshes[i]), front);
    expect_near(vector_of(scene.meshes[i].normals[0]), front);
  }
}

TEST(Gltf, NormalsStayPerpendicularUnderUnevenScale) {
  const Transform t = placed({1, 2, 3}, {0.1, 0.3, -0.2, 0.8}, {1.0, -5.0, 0.25});
  const Vector along{1, 2, -1}, across{0.5, 0.1, 0.7}, normal = cross(along, across);
  EXPECT_NEAR(dot(t.normal(normal), t.vector(along)), 0.0, 1e-12);
  EXPECT_NEAR(dot(t.normal(normal), t.vector(across)), 0.0, 1e-12);
  EXPECT_GT(dot(t.normal(normal), t.vector(normal)), 0.0);
}

TEST(Gltf, ListsStripsAndFansOfEveryIndexTypeAreTheSameTriangles) {
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const auto with = [&](int mode, auto order) {
    Glb glb;
    const int positions = glb.accessor<float>(square, 3);
    const int indices = glb.accessor(order, 1);
    glb.add("meshes",
            {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", mode}}}}});
    glb.node({{"mesh", 0}});
    return loaded(glb).meshes.at(0);
  };
  const Mesh list = with(4, std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3});
  const Mesh strip = with(5, std::vector<std::uint8_t>{0, 1, 3, 2});
  const Mesh fan = with(6, std::vector<std::uint32_t>{0, 1, 2, 3});
  for (const Mesh& mesh : {list, strip, fan}) {
    ASSERT_EQ(mesh.triangles.size(), 2U);
    expect_near(normal_of(mesh, 0), {0, 0, 1});
    expect_near(normal_of(mesh, 1), {0, 0, 1});
  }
  const Mesh jagged = with(5, std::vector<std::uint8_t>{0, 1, 3, 3, 2});
  EXPECT_EQ(jagged.triangles.size(), 1U) << "triangles that repeat a vertex are dropped";
}

TEST(Gltf, SparseAndQuantisedAccessorsAreRead) {
  Glb glb;
  const int places = glb.view<std::uint16_t>({1});
  const int values = glb.view<float>({7, 8, 9});
  glb.add("accessors", {{"componentType", 5126},
                        {"count", 3},
                        {"type", "VEC3"},
                        {"sparse",
                         {{"count", 1},
                          {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                          {"values", {{"bufferView", values}}}}}});
  glb.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}});
  glb.node({{"mesh", 0}});
  const int quantised = glb.accessor<std::int16_t>({0, 0, 0, 32767, -32767, 0, 0, 16384, -32768}, 3);
  glb.json["accessors"][static_cast<std::size_t>(quantised)]["normalized"] = true;
  glb.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", quantised}}}}}}});
  glb.node({{"mesh", 1}});
  glb.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Scene scene = loaded(glb);
  EXPECT_EQ(scene.meshes[0].positions[0], (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(scene.meshes[0].positions[1], (std::array<float, 3>{7, 8, 9}));
  EXPECT_EQ(scene.meshes[1].positions[1], (std::array<float, 3>{1, -1, 0}));
  EXPECT_EQ(scene.meshes[1].positions[2][2], -1.0F);

  glb.json["accessors"][0]["sparse"]["count"] = 9;
  EXPECT_NE(fault_of(glb).find("/accessors/0/sparse"), std::string::npos);
}

TEST(Gltf, LightsKeepTheirNumbersAndShineAlongMinusZ) {
  Glb glb;
  glb.light({{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}, {"range", 3}});
  glb.light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}, {"intensity", 2}});
  glb.light({{"type", "directional"}, {"intensity", 1000}});
  const double half = std::sqrt(0.5);
  for (int i = 0; i < 3; ++i) {
    // A quarter turn about +X takes -Z to +Y; a scale changes no light.
    glb.node({{"translation", {i, 0, 0}},
              {"rotation", {half, 0, 0, half}},
              {"scale", {3, 3, 3}},
              {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  const Scene scene = loaded(glb);
  ASSERT_EQ(scene.points.size(), 1U);
  EXPECT_EQ(scene.points[0].intensity, (Spectrum{{8, 4, 2}}));
  ASSERT_EQ(scene.spots.size(), 1U);
  expect_near(scene.spots[0].position, {1, 0, 0});
  expect_near(scene.spots[0].direction, {0, 1, 0});
  EXPECT_NEAR(scene.spots[0].inner_angle, 0.1 * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(scene.spots[0].outer_angle, 0.5 * 180.0 / std::numbers::pi, 1e-12);
  ASSERT_EQ(scene.suns.size(), 1U);
  expect_near(scene.suns[0].direction, {0, 1, 0});
  EXPECT_EQ(scene.suns[0].irradiance, Spectrum::grey(1000.0));
  EXPECT_TRUE(warns(scene, "range of lights"));

  glb.json["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"]["innerConeAngle"] = 0.6;
  EXPECT_NE(fault_of(glb).find("/extensions/KHR_lights_punctual/lights/1/spot"), std::string::npos);
  glb.json["extensions"]["KHR_lights_punctual"]["lights"][1] = {{"type", "spott"}};
  EXPECT_NE(fault_of(glb).find("did you mean \"spot\"?"), std::string::npos) << fault_of(glb);
}

TEST(Gltf, FirstCameraInTheTreeIsTheOneUsed) {
  Glb glb;
  glb.add("cameras",
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}});
  glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 2.0}}}});
  glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.5}, {"znear", 0.1}}}});
  const double half = std::sqrt(0.5);
  glb.node({{"camera", 0}});
  glb.node({{"camera", 1}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}});
  glb.node({{"camera", 2}});
  const Folder folder;
  Scene scene;
  const auto camera = add_gltf(scene, folder.put("test.glb", glb.bytes())).camera;
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->camera.vertical_fov, 0.5 * 180.0 / std::numbers::pi, 1e-12);
  expect_near(camera->camera.position, {1, 2, 3});
  expect_near(camera->camera.look_at, {0, 2, 3});
  expect_near(camera->camera.up, {0, 1, 0});
  EXPECT_EQ(camera->aspect, 2.0);
  EXPECT_TRUE(warns(scene, "orthographic"));
}

TEST(Gltf, MaterialsGiveColorsAndEmissionWithItsStrength) {
  Glb glb;
  glb.add("materials",
          {{"name", "lamp"},
           {"doubleSided", true},
           {"emissiveFactor", {1, 0.5, 0}},
           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}}}},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}}}});
  glb.json["extensionsRequired"] = {"KHR_materials_emissive_strength"};
  glb.triangle_mesh();
  glb.json["meshes"][0]["primitives"][0]["material"] = 0;
  glb.node({{"mesh", 0}});
  glb.triangle_mesh();
  glb.node({{"mesh", 1}});
  const Scene scene = loaded(glb);
  ASSERT_EQ(scene.materials.size(), 1U);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "lamp");
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.emission, (Spectrum{{12, 6, 0}}));
  EXPECT_EQ(m.base_color, (Spectrum{{0.1, 0.2, 0.3}}));
  EXPECT_EQ(m.metallic, 0.25);
  EXPECT_EQ(m.roughness, 0.5);
  EXPECT_EQ(scene.meshes[0].material, 0);
  EXPECT_EQ(scene.meshes[1].material, -1);
}

/// A file with a textured triangle whose picture is beside it: 2 x 1 pixels, red and mid-grey.
Glb textured(const Folder& folder, const std::string& uri) {
  write_png(folder.path / "picture.png", 2, 1, std::vector<std::uint8_t>{255, 0, 0, 188, 188, 188});
  Glb glb;
  const int positions = glb.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  const int uvs = glb.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
  glb.add("meshes",
          {{"primitives", {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"material", 0}}}}});
  glb.node({{"mesh", 0}});
  glb.add("images", {{"uri", uri}});
  glb.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
  glb.add("textures", {{"source", 0}, {"sampler", 0}});
  glb.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  return glb;
}

TEST(Gltf, BaseColorTexturesAreLinear) {
  const Folder folder;
  Scene scene;
  add_gltf(scene, folder.put("test.glb", textured(folder, "picture.png").bytes()));
  ASSERT_EQ(scene.textures.size(), 1U);
  const Texture& t = scene.textures[0];
  EXPECT_EQ(t.width, 2);
  EXPECT_EQ(t.color[0], (std::array<float, 3>{1, 0, 0}));
  EXPECT_NEAR(t.color[1][1], 0.5029, 1e-4);
  EXPECT_EQ(t.wrap_u, Wrap::clamp);
  EXPECT_EQ(t.wrap_v, Wrap::mirror);
  EXPECT_EQ(scene.meshes[0].uvs[0].size(), 3U);
}

TEST(Gltf, TextureTransformsActOnCoordinates) {
  const Folder folder;
  Glb glb = textured(folder, "picture.png");
  // The extension's own example: the lower left quarter of the picture, turned clockwise by 90 degrees.
  glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  Scene scene;
  add_gltf(scene, folder.put("test.glb", glb.bytes()));
  const auto& uvs = scene.meshes[0].uvs[0];
  EXPECT_NEAR(uvs[0][0], 0.0, 1e-7);
  EXPECT_NEAR(uvs[0][1], 1.0, 1e-7);
  EXPECT_NEAR(uvs[1][0], 0.0, 1e-7);
  EXPECT_NEAR(uvs[1][1], 0.5, 1e-7);
  EXPECT_NEAR(uvs[2][0], 0.5, 1e-7);
  EXPECT_NEAR(uvs[2][1], 1.0, 1e-7);
}

TEST(Gltf, MapsAreKeptWithTheirCoordinates) {
  const Folder folder;
  Glb glb = textured(folder, "picture.png");
  const int second = glb.accessor<float>({0, 0, 0.5, 0, 0, 0.5}, 2);
  const int tangents = glb.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, 4);
  auto& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = second;
  attributes["TANGENT"] = tangents;
  glb.json["materials"][0] = {{"emissiveTexture", {{"index", 0}}},
                              {"emissiveFactor", {1, 1, 1}},
                              {"normalTexture", {{"index", 0}, {"texCoord", 1}, {"scale", 0.5}}},
                              {"alphaMode", "MASK"},
                              {"alphaCutoff", 0.25},
                              {"extensions", {{"KHR_materials_ior", {{"ior", 1.33}}}}},
                              {"pbrMetallicRoughness",
                               {{"baseColorFactor", {1, 1, 1, 0.5}},
                                {"baseColorTexture", {{"index", 0}}},
                                {"metallicRoughnessTexture", {{"index", 0}, {"texCoord", 1}}}}}};
  glb.json["extensionsUsed"] = {"KHR_materials_ior"};
  glb.json["extensionsRequired"] = {"KHR_materials_ior"};
  Scene scene;
  add_gltf(scene, folder.put("test.glb", glb.bytes()));
  const Material& m = scene.materials[0];
  ASSERT_EQ(scene.textures.size(), 2U) << "as colours, and as numbers";
  EXPECT_EQ(m.color_map.texture, m.emission_map.texture);
  EXPECT_EQ(m.roughness_map.texture, m.normal_map.texture);
  EXPECT_NEAR(scene.textures[static_cast<std::size_t>(m.color_map.texture)].color[1][0], 0.5029, 1e-4);
  EXPECT_NEAR(scene.textures[static_cast<std::size_t>(m.normal_map.texture)].color[1][0], 188.0 / 255, 1e-7);
  ASSERT_EQ(scene.meshes[0].uvs.size(), 2U);
  EXPECT_NE(m.color_map.uv_set, m.normal_map.uv_set);
  EXPECT_EQ(scene.meshes[0].uvs[static_cast<std::size_t>(m.normal_map.uv_set)][1][0], 0.5F);
  EXPECT_EQ(scene.meshes[0].tangents[2][3], -1.0F);
  EXPECT_EQ(m.normal_scale, 0.5);
  EXPECT_EQ(m.alpha, 0.5);
  EXPECT_EQ(m.alpha_cutoff, 0.25);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.ior, 1.33);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(Gltf, MaterialsOutOfBoundsAreRefused) {
  const auto with = [](const json& material) {
    Glb glb;
    glb.add("materials", material);
    glb.triangle_mesh();
    glb.json["meshes"][0]["primitives"][0]["material"] = 0;
    glb.node({{"mesh", 0}});
    return fault_of(glb);
  };
  EXPECT_EQ(with({{"alphaMode", "BLEND"}}), "");
  EXPECT_NE(with({{"alphaMode", "BLENT"}}).find("BLEND"), std::string::npos);
  EXPECT_NE(with({{"alphaMode", "MASK"}, {"alphaCutoff", -1}}).find("/alphaCutoff"), std::string::npos);
  EXPECT_NE(with({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 2}}}}}).find("/3"), std::string::npos);
  EXPECT_NE(with({{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}).find("/ior"), std::string::npos);
  EXPECT_NE(with({{"normalTexture", {{"index", 0}}}}).find("/normalTexture/index"), std::string::npos);
}

TEST(Gltf, ReferencesStayInTheFolderUnlessAllowed) {
  const Folder folder;
  const Glb glb = textured(folder, "../picture.png");
  const auto file = folder.put("inside/test.glb", glb.bytes());
  Scene scene;
  EXPECT_THROW(add_gltf(scene, file), Fault);
  EXPECT_NO_THROW(add_gltf(scene, file, {1.0, true}));
  for (const char* uri : {"/etc/passwd", "file:///etc/passwd", "http://example.org/a.png", "absent.png", "", "."}) {
    EXPECT_THROW(add_gltf(scene, folder.put("test.glb", textured(folder, uri).bytes())), Fault) << uri;
  }
}

TEST(Gltf, TreesThatAreNoTreesAreRefused) {
  Glb loop;
  loop.node({{"children", {1}}});
  loop.add("nodes", {{"children", {0}}});
  EXPECT_NE(fault_of(loop).find("two places of the tree"), std::string::npos);
  Glb shared;
  shared.node({{"children", {2}}});
  shared.node({{"children", {2}}});
  shared.add("nodes", {{"name", "x"}});
  EXPECT_NE(fault_of(shared).find("/nodes/2"), std::string::npos);
  Glb absent;
  absent.node({{"children", {7}}});
  EXPECT_NE(fault_of(absent).find("/nodes/0/children/0"), std::string::npos);
  Glb all_in_loop;
  all_in_loop.json.erase("scenes");
  all_in_loop.json.erase("scene");
  all_in_loop.add("nodes", {{"children", {0}}});
  EXPECT_TRUE(loaded(all_in_loop).meshes.empty());
}

TEST(Gltf, DeepTreesDoNotExhaustTheStack) {
  Glb glb;
  const int mesh = glb.triangle_mesh();
  constexpr int depth = 50000;
  glb.node({{"children", {1}}, {"translation", {1, 0, 0}}});
  for (int i = 1; i < depth; ++i) glb.add("nodes", {{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  glb.add("nodes", {{"mesh", mesh}});
  const Scene scene = loaded(glb);
  EXPECT_EQ(scene.meshes.at(0).positions[0][0], static_cast<float>(depth));
}

TEST(Gltf, EveryBoundIsChecked) {
  const auto broken = [](const auto& change) {
    Glb glb;
    glb.triangle_mesh();
    const int indices = glb.accessor<std::uint16_t>({0, 1, 2}, 1);
    glb.json["meshes"][0]["primitives"][0]["indices"] = indices;
    glb.node({{"mesh", 0}});
    change(glb.json);
    return fault_of(glb);
  };
  EXPECT_EQ(broken([](json&) {}), "");
  const std::vector<std::pair<std::string, std::function<void(json&)>>> changes{
      {"count", [](json& j) { j["accessors"][0]["count"] = 4; }},
      {"huge count", [](json& j) { j["accessors"][0]["count"] = 4000000000U; }},
      {"offset", [](json& j) { j["accessors"][0]["byteOffset"] = 8; }},
      {"huge offset", [](json& j) { j["accessors"][0]["byteOffset"] = 4294967295U; }},
      {"view", [](json& j) { j["accessors"][0]["bufferView"] = 5; }},
      {"buffer", [](json& j) { j["bufferViews"][0]["buffer"] = 1; }},
      {"view length", [](json& j) { j["bufferViews"][0]["byteLength"] = 1000; }},
      {"view offset", [](json& j) { j["bufferViews"][0]["byteOffset"] = 4294967295U; }},
      {"stride", [](json& j) { j["bufferViews"][0]["byteStride"] = 252; }},
      {"stride below size", [](json& j) { j["bufferViews"][0]["byteStride"] = 4; }},
      {"type", [](json& j) { j["accessors"][0]["type"] = "VEC2"; }},
      {"component", [](json& j) { j["accessors"][0]["componentType"] = 5130; }},
      {"index type", [](json& j) { j["accessors"][1]["componentType"] = 5122; }},
      {"indices", [](json& j) { j["meshes"][0]["primitives"][0]["indices"] = 9; }},
      {"position", [](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; }},
      {"normals", [](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1; }},
      {"material", [](json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }},
      {"mode", [](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }},
      {"mesh", [](json& j) { j["nodes"][0]["mesh"] = 3; }},
      {"scene", [](json& j) { j["scene"] = 3; }},
      {"matrix", [](json& j) { j["nodes"][0]["matrix"] = std::vector<double>(16, 1e308); }},
      {"far away",
       [](json& j) {
         j["nodes"][0]["translation"] = {1e16, 0, 0};
       }},
      {"meshes", [](json& j) { j["meshes"] = "all of them"; }},
      {"primitives",
       [](json& j) {
         j["meshes"][0]["primitives"] = {{"attributes", 5}};
       }},
      {"extension", [](json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
      {"version", [](json& j) { j["asset"]["version"] = "1.0"; }},
  };
  for (const auto& [name, change] : changes) EXPECT_NE(broken(change), "") << name;
}

TEST(Gltf, WhatIsNotDoneIsSaid) {
  Glb glb;
  const int mesh = glb.triangle_mesh();
  glb.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = glb.accessor<float>({1, 1, 1, 1, 1, 1, 1, 1, 1}, 3);
  glb.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  glb.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  glb.add("textures", json::object());
  glb.json["meshes"][0]["primitives"][0]["material"] = glb.add("materials", {{"occlusionTexture", {{"index", 0}}}});
  glb.node({{"mesh", mesh}});
  glb.json["extensionsUsed"] = {"KHR_materials_transmission"};
  const Scene scene = loaded(glb);
  EXPECT_EQ(scene.meshes.size(), 1U);
  for (const char* what : {"vertex colours", "morph targets", "points and lines", "occlusion", "transmission"}) {
    EXPECT_TRUE(warns(scene, what)) << what;
  }
}

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
}

TEST(Gltf, RealFilesHaveWhatTheyHave) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/gltf");
  const Scene cornell = read_scene(folder / "cornell/cornellBox.gltf");
  EXPECT_EQ(cornell.meshes.size(), 10U);
  EXPECT_EQ(triangle_count(cornell), 16732U);
  EXPECT_FALSE(cornell.environment);
  EXPECT_NEAR(cornell.camera.position.z, 19.992, 1e-3);
  EXPECT_NEAR(cornell.camera.vertical_fov, 41.112, 1e-3);
  EXPECT_EQ(cornell.film.width, 480);
  std::size_t emissive = 0;
  for (const Material& m : cornell.materials) emissive += m.emission == Spectrum::grey(10.0);
  EXPECT_EQ(emissive, 1U);

  const Scene lights = read_scene(folder / "khronos-lights/lights.gltf");
  EXPECT_EQ(triangle_count(lights), 1724U);
  ASSERT_EQ(lights.points.size(), 1U);
  EXPECT_EQ(lights.points[0].intensity, (Spectrum{{20, 0, 0}}));
  expect_near(lights.points[0].position, {0, 22, 0});
  ASSERT_EQ(lights.suns.size(), 1U);
  expect_near(lights.suns[0].direction, {0, 0, -1});
  EXPECT_NEAR(lights.suns[0].irradiance[2], 2.1, 1e-12);

  const Scene three = read_scene(folder / "default_scene_three_lights.glb");
  EXPECT_EQ(triangle_count(three), 12U);
  EXPECT_EQ(three.points.size(), 1U);
  EXPECT_EQ(three.spots.size(), 1U);
  EXPECT_EQ(three.suns.size(), 1U);
  EXPECT_NEAR(three.points[0].intensity[0], 54351.4, 0.1);
  EXPECT_NEAR(three.spots[0].outer_angle, 22.5, 1e-4);

  const Scene suzanne = read_scene(folder / "blender-io/02_suzanne/02_suzanne.gltf");
  EXPECT_EQ(triangle_count(suzanne), 3936U);
  ASSERT_EQ(suzanne.textures.size(), 3U) << "colours, roughness, normals";
  ASSERT_EQ(suzanne.meshes[0].uvs.size(), 1U);
  EXPECT_EQ(suzanne.meshes[0].uvs[0].size(), suzanne.meshes[0].positions.size());
  EXPECT_EQ(triangle_count(read_scene(folder / "blender-io/04_lights/04_lights.gltf")), 2U);
  EXPECT_EQ(triangle_count(read_scene(folder / "blender-io/05_metallic_sphere_light/05_metallic_sphere_light.gltf")),
            962U);
  EXPECT_EQ(triangle_count(read_scene(folder / "shaderball/shaderball.glb")), 88264U);
}

TEST(Gltf, MalformedFilesAreAnsweredWithAMessageOfLineAndPointer) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "assets/gltf/malformed");
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf") continue;
    ++files;
    try {
      read_scene(entry.path());
      ADD_FAILURE() << entry.path() << " was read";
    } catch (const Fault& fault) {
      EXPECT_NE(fault.where.find(".gltf:"), std::string::npos) << fault.where;
      EXPECT_NE(fault.where.find(": at /"), std::string::npos) << fault.where;
      EXPECT_NE(std::string(fault.what()).find(entry.path().filename().string()), std::string::npos) << fault.what();
      EXPECT_EQ(fault.found.find("crashes"), std::string::npos) << fault.what();
    }
  }
  EXPECT_EQ(files, 14);
}

/// Truncations and flipped bits of a file with a bit of everything, by seed.
TEST(Gltf, DamagedFilesAreAnsweredWithAMessageOrAScene) {
  const Folder folder;
  Glb glb = textured(folder, "picture.png");
  glb.json["meshes"][0]["primitives"][0]["indices"] = glb.accessor<std::uint8_t>({0, 1, 2}, 1);
  glb.light({{"type", "spot"}, {"spot", json::object()}, {"intensity", 2}});
  glb.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"rotation", {0, 1, 0, 0}}});
  glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  glb.node({{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  const int times = glb.accessor<float>({0, 1}, 1), values = glb.accessor<float>({0, 0, 0, 1, 0, 0}, 3);
  glb.add("animations", {{"samplers", {{{"input", times}, {"output", values}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  const std::vector<std::uint8_t> good = glb.bytes();
  ASSERT_TRUE(read_scene_in_time(folder.put("bad.glb", good)).moves);
  int refused = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes = good;
    if (seed % 3 == 0) bytes.resize(random() % bytes.size());
    for (unsigned flips = seed % 3; flips > 0; --flips) {
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    }
    try {
      const Scene scene = read_scene(folder.put("bad.glb", bytes));
      for (const Mesh& mesh : scene.meshes) {
        for (const auto& t : mesh.triangles) {
          for (const std::uint32_t corner : t) ASSERT_LT(corner, mesh.positions.size()) << seed;
        }
      }
    } catch (const Fault& fault) {
      ++refused;
      EXPECT_NE(std::string(fault.what()).find("bad.glb"), std::string::npos) << seed << ": " << fault.what();
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 1000);
}

}  // namespace
}  // namespace tyndall
