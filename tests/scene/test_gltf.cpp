// glTF files: accessors of every type, nodes of every transform, containers, URIs, extensions.
#include <cmath>
#include <numbers>

#include "tests/scene/gltf_text.h"

namespace glintmark {
namespace {

/// The quad's four corners in order, whatever order the mesh has them in.
void expectQuad(const TriangleMesh& mesh, double tolerance = 0) {
  ASSERT_EQ(mesh.positions.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(mesh.uvs[v].x, mesh.positions[v].x, tolerance);
    EXPECT_NEAR(mesh.uvs[v].y, mesh.positions[v].y, tolerance);
    EXPECT_EQ(mesh.normals[v], glm::vec3(0, 0, 1));
  }
}

TEST(Gltf, TheQuadIsRead) {
  const PartMesh mesh = gltf(quadText());
  expectQuad(mesh.mesh);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Gltf, IntegersAreWhatTheFormatSays) {
  // Each type of uv, normalised or quantised by the node's or texture's scale.
  GltfText bytes = quadText();
  bytes.primitive()["attributes"]["TEXCOORD_0"] = bytes.add<std::uint8_t>(
      "VEC2", 5121, 4, {0, 0, 9, 9, 255, 0, 9, 9, 255, 255, 9, 9, 0, 255}, 4, true);
  expectQuad(gltf(bytes).mesh);
  GltfText shorts = quadText();
  shorts.primitive()["attributes"]["TEXCOORD_0"] =
      shorts.add<std::uint16_t>("VEC2", 5123, 4, {0, 0, 65535, 0, 65535, 65535, 0, 65535}, 0, true);
  expectQuad(gltf(shorts).mesh);
  GltfText quantised = quadText();
  quantised.primitive()["attributes"]["POSITION"] = quantised.add<std::int16_t>(
      "VEC3", 5122, 4, {-500, 0, 0, 0, 500, 0, 0, 0, 500, 1000, 0, 0, -500, 1000, 0}, 8);
  quantised.primitive()["attributes"]["NORMAL"] = quantised.add<std::int8_t>(
      "VEC3", 5120, 4, {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127}, 4, true);
  quantised.json["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
  quantised.json["nodes"][0]["translation"] = {0.5, 0, 0};
  quantised.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  expectQuad(gltf(quantised).mesh, 1e-7);
  GltfText wide = quadText();
  wide.primitive()["indices"] = wide.add<std::uint32_t>("SCALAR", 5125, 6, {0, 1, 2, 0, 2, 3});
  expectQuad(gltf(wide).mesh);
  // The least signed number counts as -1, not as a little less.
  GltfText least = quadText();
  least.primitive()["attributes"]["POSITION"] = least.add<std::int8_t>(
      "VEC3", 5120, 4, {-128, 0, 0, 0, 127, 0, 0, 0, 127, 127, 0, 0, -127, 127, 0}, 4, true);
  float lowest = 0;
  const PartMesh signed_mesh = gltf(least);
  for (const glm::vec3& p : signed_mesh.mesh.positions) lowest = std::min(lowest, p.x);
  EXPECT_EQ(lowest, -1.0f);
}

TEST(Gltf, SparseAccessorsAndAccessorsWithoutBytes) {
  GltfText text = quadText();
  // All zeros but for three corners.
  const int indices = text.add<std::uint8_t>("SCALAR", 5121, 3, {1, 2, 3});
  const int values = text.add<float>("VEC3", 5126, 3, {1, 0, 0, 1, 1, 0, 0, 1, 0});
  const auto view = [&](int accessor) { return text.json["accessors"][accessor]["bufferView"]; };
  text.json["accessors"][0].erase("bufferView");
  text.json["accessors"][0]["sparse"] = {
      {"count", 3},
      {"indices", {{"bufferView", view(indices)}, {"componentType", 5121}}},
      {"values", {{"bufferView", view(values)}}}};
  expectQuad(gltf(text).mesh);
  text.json["accessors"][0]["sparse"]["count"] = 4;
  expectMessage(gltfError(text), {"accessor 0 (sparse)", "do not fit"});
}

TEST(Gltf, SingularAndMirroredNodes) {
  GltfText text = quadText();
  text.json["nodes"] = {{{"mesh", 0}},
                        {{"mesh", 0}, {"scale", {0, 0, 0}}},
                        {{"mesh", 0}, {"scale", {-1, 1, 1}}, {"translation", {5, 0, 0}}},
                        {{"mesh", 0}, {"scale", {1, 1, 0}}, {"translation", {9, 0, 0}}}};
  text.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const PartMesh mesh = gltf(text);
  EXPECT_EQ(mesh.mesh.triangleCount(), 6u);
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"2 of 8 triangles", "no area"});
  for (const glm::vec3& n : mesh.mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  for (const glm::uvec3& t : mesh.mesh.triangles) {
    const glm::vec3 a = mesh.mesh.positions[t.x], b = mesh.mesh.positions[t.y],
                    c = mesh.mesh.positions[t.z];
    EXPECT_GT(glm::cross(b - a, c - a).z, 0);  // fronts stay fronts
  }
}

TEST(Gltf, NodesAreATree) {
  GltfText text = quadText();
  text.json["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 3}}},
                        {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
  for (const glm::vec3& p : gltf(text).mesh.positions) {
    EXPECT_EQ(p.z, 3);
    EXPECT_LE(p.x, 1e-6);  // turned from x to y
  }
  text.json["nodes"][1]["children"] = {0};
  expectMessage(gltfError(text), {"node 0", "its own ancestor"});
  text.json["nodes"][1]["children"] = {7};
  expectMessage(gltfError(text), {"no 7 in its nodes"});
}

TEST(Gltf, StripsFansAndFacesWithoutNormals) {
  for (const int mode : {5, 6}) {
    GltfText text = quadText();
    text.primitive()["mode"] = mode;
    const std::vector<std::uint16_t> order =
        mode == 5 ? std::vector<std::uint16_t>{0, 1, 3, 2} : std::vector<std::uint16_t>{0, 1, 2, 3};
    text.primitive()["indices"] = text.add<std::uint16_t>("SCALAR", 5123, 4, order);
    text.primitive()["attributes"].erase("NORMAL");
    expectQuad(gltf(text).mesh);
  }
  GltfText points = quadText();
  points.primitive()["mode"] = 0;
  expectMessage(gltfError(points), {"no triangles"});
}

TEST(Gltf, FacesWithoutNormalsAreFlat) {
  GltfText text = quadText();
  text.primitive()["attributes"].erase("NORMAL");
  // One corner lifted: the triangles no longer lie in one plane.
  text.primitive()["attributes"]["POSITION"] =
      text.add<float>("VEC3", 5126, 4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1});
  const TriangleMesh mesh = gltf(text).mesh;
  ASSERT_EQ(mesh.positions.size(), 6u);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(glm::distance(mesh.normals[t[k]], glm::normalize(glm::cross(b - a, c - a))), 1e-6f);
  }
}

TEST(Gltf, ContainersAndUris) {
  const TemporaryFolder folder;
  GltfText text = quadText();
  expectQuad(importMesh(folder.write("two.glb", text.glb())).mesh);
  expectQuad(importMesh(folder.write("SHOUTED.GLB", text.glb())).mesh);
  std::string cut = text.glb();
  cut.resize(cut.size() - 40);
  const std::string half = folder.write("half.glb", cut);
  expectMessage(errorOf([&] { importMesh(half); }), {"half.glb", "ends within a chunk"});

  folder.write("a b#%.bin", text.bytes);
  for (const char* uri : {"a%20b%23%25.bin", "a b#%.bin", "./a%20b%23%25.bin"}) {
    text.json["buffers"] = {{{"byteLength", text.bytes.size()}, {"uri", uri}}};
    expectQuad(importMesh(folder.write("uri.gltf", "\xEF\xBB\xBF" + text.json.dump())).mesh);
  }
  std::string hex = "data:application/octet-stream,";
  for (const char c : text.bytes) {
    char coded[4];
    std::snprintf(coded, sizeof coded, "%%%02X", static_cast<unsigned char>(c));
    hex += coded;
  }
  text.json["buffers"][0]["uri"] = hex;
  expectQuad(importMesh(folder.write("data.gltf", text.json.dump())).mesh);
  const auto complaint = [&](const std::string& uri) {
    text.json["buffers"][0]["uri"] = uri;
    const std::string file = folder.write("bad.gltf", text.json.dump());
    return errorOf([&] { importMesh(file); });
  };
  expectMessage(complaint("gone.bin"), {"gone.bin", "not there"});
  expectMessage(complaint("https://example.org/a.bin"), {"https://example.org", "beside it"});
  expectMessage(complaint("data:;base64,AAAA"), {"does not fit its buffer of 3 bytes"});
  expectMessage(complaint("data:;base64,A!AA"), {"not base64"});
}

TEST(Gltf, VersionOne) {
  const TemporaryFolder folder;
  const GltfText two = quadText();
  Json accessors, views;
  for (std::size_t i = 0; i < two.json["accessors"].size(); ++i) {
    Json accessor = two.json["accessors"][i];
    Json view = two.json["bufferViews"][i];
    view["buffer"] = "binary_glTF";
    accessor["bufferView"] = "v" + std::to_string(i);
    accessor["byteOffset"] = 0;
    accessors["a" + std::to_string(i)] = accessor;
    views["v" + std::to_string(i)] = view;
  }
  const Json one = {
      {"asset", {{"version", "1.0"}}},
      {"scene", "main"},
      {"scenes", {{"main", {{"nodes", {"root"}}}}}},
      {"nodes",
       {{"root",
         {{"meshes", {"quad"}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}}},
      {"meshes",
       {{"quad",
         {{"primitives",
           {{{"attributes", {{"POSITION", "a0"}, {"NORMAL", "a1"}, {"TEXCOORD_0", "a2"}}},
             {"indices", "a3"},
             {"material", "paint"}}}}}}}},
      {"materials", {{"paint", Json::object()}}},
      {"accessors", accessors},
      {"bufferViews", views},
      {"buffers", {{"binary_glTF", {{"byteLength", two.bytes.size()}, {"type", "arraybuffer"}}}}}};
  std::string text = one.dump();
  while (text.size() % 4 != 0) text += ' ';
  const auto words = [&](std::size_t length) {
    return rawBytes(std::vector<std::uint32_t>{
        1, static_cast<std::uint32_t>(20 + text.size() + two.bytes.size()),
        static_cast<std::uint32_t>(length), 0});
  };
  const PartMesh mesh =
      importMesh(folder.write("one.glb", "glTF" + words(text.size()) + text + two.bytes));
  expectQuad(mesh.mesh);
  EXPECT_EQ(mesh.parts, std::vector<std::string>{"paint"});
}

TEST(Gltf, ExtensionsAreDecodedHarmlessOrRefused) {
  for (const char* harmless : {"KHR_materials_unlit", "MSFT_texture_dds", "KHR_lights_punctual"}) {
    GltfText text = quadText();
    text.json["extensionsRequired"] = {harmless};
    expectQuad(gltf(text).mesh);
  }
  for (const char* unknown : {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
                              "EXT_meshopt_compression", "X_y"}) {
    GltfText text = quadText();
    text.json["extensionsRequired"] = {unknown};
    expectMessage(gltfError(text), {"requires the extension", unknown});
  }
}

TEST(Gltf, TextureTransformsMoveUvs) {
  GltfText text = quadText();
  text.json["materials"] = {
      {{"name", "cloth"},
       {"normalTexture",
        {{"index", 0},
         {"extensions",
          {{"KHR_texture_transform",
            {{"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}}}}}}}}};
  text.primitive()["material"] = 0;
  const TriangleMesh mesh = gltf(text).mesh;
  for (std::size_t v = 0; v < 4; ++v) {
    // Scaled, then a quarter turn counter-clockwise where v runs down, then moved.
    EXPECT_NEAR(mesh.uvs[v].x, 3 * mesh.positions[v].y + 0.5, 1e-6);
    EXPECT_NEAR(mesh.uvs[v].y, -2 * mesh.positions[v].x + 0.25, 1e-6);
  }
}

TEST(Gltf, MorphsAreSaid) {
  GltfText text = quadText();
  const int moves = text.add<float>("VEC3", 5126, 4, {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
  text.primitive()["targets"] = {{{"POSITION", moves}}};
  text.json["meshes"][0]["weights"] = {0.5};
  PartMesh mesh = gltf(text);
  for (const glm::vec3& p : mesh.mesh.positions) EXPECT_EQ(p.z, 1);
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"morph targets", "default weights"});
  text.json["nodes"][0]["weights"] = {0};
  for (const glm::vec3& p : gltf(text).mesh.positions) EXPECT_EQ(p.z, 0);
}

TEST(Gltf, WhatIsWrongIsSaid) {
  const auto changed = [](const std::function<void(GltfText&)>& change) {
    GltfText text = quadText();
    change(text);
    return gltfError(text);
  };
  expectMessage(changed([](GltfText& t) { t.json["accessors"][0]["componentType"] = 1; }),
                {"accessor 0", "component type 1"});
  expectMessage(changed([](GltfText& t) { t.json["accessors"][0]["type"] = "VEC9"; }), {"'VEC9'"});
  expectMessage(changed([](GltfText& t) { t.json["accessors"][0]["count"] = 1'000'000'000; }),
                {"accessor 0", "do not fit"});
  expectMessage(changed([](GltfText& t) { t.json["accessors"][0]["count"] = -4; }),
                {"count is -4", "at least 0"});
  expectMessage(changed([](GltfText& t) { t.json["accessors"][0]["byteOffset"] = 1u << 31; }),
                {"do not fit"});
  expectMessage(changed([](GltfText& t) { t.json["bufferViews"][0]["byteLength"] = 1u << 31; }),
                {"does not fit its buffer"});
  expectMessage(changed([](GltfText& t) { t.primitive()["indices"] = 0; }),
                {"component type 5126"});
  expectMessage(changed([](GltfText& t) {
                  t.primitive()["indices"] = t.add<std::uint16_t>("SCALAR", 5123, 3, {0, 1, 9});
                }),
                {"names vertex 9, but there are only 4"});
  expectMessage(changed([](GltfText& t) {
                  t.json["nodes"][0]["matrix"] = {1, 2, 3};
                }),
                {"matrix is not 16 numbers"});
  expectMessage(changed([](GltfText& t) { t.primitive()["material"] = 3; }), {"no material 3"});
  const TemporaryFolder folder;
  for (const char* text : {"", "[]", "{", "{\"asset\":{\"version\":\"2.0\"}}"}) {
    const std::string file = folder.write("bad.gltf", text);
    expectMessage(errorOf([&] { importMesh(file); }), {"bad.gltf"});
  }
}

TEST(Gltf, WhatOnlyAnExtensionCouldReadIsRefusedByItsName) {
  const TemporaryFolder folder;
  GltfText draco = quadText();
  draco.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  EXPECT_EQ(importMesh(draco.write(folder)).mesh.triangleCount(), 2u);  // stored plainly as well
  draco.json["accessors"][0].erase("bufferView");
  expectMessage(errorOf([&] { importMesh(draco.write(folder)); }), {"KHR_draco_mesh_compression"});
  GltfText meshopt = quadText();
  const std::string file = meshopt.write(folder);
  meshopt.json["buffers"].push_back(
      {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  meshopt.json["bufferViews"][0]["buffer"] = 1;
  folder.write("mesh.gltf", meshopt.json.dump());
  expectMessage(errorOf([&] { importMesh(file); }), {"EXT_meshopt_compression"});
  // In a container only the first buffer is the container's.
  GltfText second = quadText();
  std::string glb = second.glb();
  second.json["buffers"].push_back({{"byteLength", 48}});
  second.json["bufferViews"][0]["buffer"] = 1;
  std::string text = second.json.dump();
  while (text.size() % 4 != 0) text += ' ';
  const auto word = [](std::size_t value) {
    return rawBytes(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  };
  glb = "glTF" + word(2) + word(28 + text.size() + second.bytes.size()) + word(text.size()) +
        "JSON" + text + word(second.bytes.size()) + std::string("BIN\0", 4) + second.bytes;
  expectMessage(errorOf([&] { importMesh(folder.write("mesh.glb", glb)); }),
                {"buffer 1 has neither a uri nor bytes"});
}

TEST(Gltf, SmallSlipsOfWritersAreForgiven) {
  const TemporaryFolder folder;
  GltfText text = quadText();
  text.json["asset"]["version"] = 2.0;
  text.json["extensionsRequired"] = {"KHR_technique_webgl"};
  const std::string file = text.write(folder);
  text.json["buffers"][0]["byteLength"] = 100000;
  folder.write("mesh.gltf", text.json.dump());
  EXPECT_EQ(importMesh(file).mesh.triangleCount(), 2u);
}

TEST(Gltf, MaterialsBecomeOursWhereTheSceneAsks) {
  const TemporaryFolder folder;
  GltfText text = quadText();
  text.json["materials"] = {
      {{"name", "steel"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"roughnessFactor", 0.5}}},
       {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
       {"extensions", {{"KHR_materials_anisotropy", {{"anisotropyStrength", 0.6}}}}}}};
  text.json["textures"] = {{{"source", 0}}};
  text.json["images"] = {{{"uri", "bumps%20n.png"}}};
  text.primitive()["material"] = 0;
  SceneRequest request;
  request.mesh_file = text.write(folder);
  request.scene = folder.write("scene.toml", "materials = \"file\"\n" + sceneText());
  std::filesystem::path asked;
  request.normal_loader = [&](const std::filesystem::path& file) {
    asked = file;
    Image image(1, 1, 3);
    image.pixels = {0.8f, 0.5f, 0.9f};  // slope 0.6 / 0.8
    return image;
  };
  const Scene scene = loadScene(request);
  EXPECT_EQ(asked.filename(), "bumps n.png");
  ASSERT_EQ(scene.materials.size(), 2u);
  for (const std::uint32_t m : scene.mesh.triangle_materials) EXPECT_EQ(m, 1u);
  const Material& steel = scene.materials[1];
  EXPECT_EQ(steel.name, "steel");
  EXPECT_FALSE(steel.has_glints);
  EXPECT_FLOAT_EQ(steel.params.surface.f0.x, 0.5f);
  EXPECT_FLOAT_EQ(steel.params.surface.albedo.x, 0.0f);
  EXPECT_FLOAT_EQ(steel.params.surface.alpha_g.x, 0.25f + 0.75f * 0.36f);
  EXPECT_FLOAT_EQ(steel.params.surface.alpha_g.y, 0.25f);
  ASSERT_TRUE(steel.normal_map);
  const glm::vec3 n = steel.normal_map->map->at(0, 0);
  EXPECT_NEAR(n.x / n.z, 0.5 * 0.75, 1e-5);

  request.scene = folder.write("plain.toml", sceneText());
  const Scene plain = loadScene(request);
  EXPECT_EQ(plain.materials.size(), 1u);
  bool said = false;
  for (const std::string& note : plain.notes)
    said = said || note.find("1 materials of mesh.gltf were not used") != std::string::npos;
  EXPECT_TRUE(said);
  request.scene = folder.write("wrong.toml", "materials = \"mesh\"\n" + sceneText());
  expectMessage(errorOf([&] { loadScene(request); }), {"materials is 'mesh'", "scene or file"});
}

}  // namespace
}  // namespace glintmark
