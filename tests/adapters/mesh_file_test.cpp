// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "adapters/adapters_test.h"
#include "gigaray/adapters/cloud_file.h"

namespace gigaray {
namespace {

using nlohmann::json;

/// A triangle for every colour, side by side.
SurfaceMesh strip(const std::vector<Rgb8>& colours) {
  SurfaceMesh mesh;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float x = float(i);
    for (const Eigen::Vector3f& corner : {Eigen::Vector3f(x, 0.25f, 3), Eigen::Vector3f(x, 1, 3),
                                          Eigen::Vector3f(x + 0.5f, 1, 3)}) {
      mesh.positions.push_back(corner);
      mesh.normals.emplace_back(0, 0, -1);
      mesh.colours.push_back(colours[i]);
    }
    const auto first = std::uint32_t(3 * i);
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A .glb file as its specification describes it, read without the library that wrote it.
class Glb {
 public:
  explicit Glb(std::string bytes) : bytes_(std::move(bytes)) {
    EXPECT_EQ(bytes_.substr(0, 4), "glTF");
    EXPECT_EQ(get<std::uint32_t>(4), 2u);
    EXPECT_EQ(get<std::uint32_t>(8), bytes_.size());
    const auto length = get<std::uint32_t>(12);
    EXPECT_EQ(length % 4, 0u);
    EXPECT_EQ(bytes_.substr(16, 4), "JSON");
    root = json::parse(bytes_.substr(20, length));
    EXPECT_EQ(bytes_.substr(20 + length + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(20 + length + 8 + get<std::uint32_t>(20 + length), bytes_.size());
    binary_ = 20 + length + 8;
  }

  /// Values of an attribute of the only primitive, one list per vertex.
  std::vector<std::vector<double>> attribute(const std::string& name) const {
    const json& primitive = root.at("meshes").at(0).at("primitives").at(0);
    const json& accessor = root.at("accessors").at(int(primitive.at("attributes").at(name)));
    const json& view = root.at("bufferViews").at(int(accessor.at("bufferView")));
    const int components = accessor.at("type") == "VEC4" ? 4 : 3;
    EXPECT_EQ(accessor.at("componentType"), 5126) << "floats";
    const std::size_t stride = view.value("byteStride", 4 * components);
    const std::size_t begin =
        binary_ + view.value("byteOffset", 0) + accessor.value("byteOffset", 0);
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < accessor.at("count"); ++i) {
      values.emplace_back();
      for (int k = 0; k < components; ++k)
        values.back().push_back(get<float>(begin + i * stride + 4 * std::size_t(k)));
    }
    return values;
  }

  json root;

 private:
  template <class T>
  T get(std::size_t at) const {
    T value{};
    std::memcpy(&value, bytes_.substr(at, sizeof value).data(), sizeof value);
    return value;
  }
  std::string bytes_;
  std::size_t binary_ = 0;
};

class MeshFile : public AdaptersTest {};

TEST_F(MeshFile, ColoursOfGlbAreLinear) {
  const SurfaceMesh mesh = strip({{0, 10, 11}, {128, 188, 255}, {1, 64, 200}});
  write_mesh(folder / "a.glb", mesh);
  const auto colours = Glb(read("a.glb")).attribute("COLOR_0");
  ASSERT_EQ(colours.size(), 9u);
  // Values of the standard's table.
  const double wanted[3][3] = {{0, 0.00303527, 0.00334654},
                               {0.21586050, 0.50288646, 1},
                               {0.00030353, 0.05126946, 0.57758044}};
  for (std::size_t i = 0; i < colours.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(colours[i][k], wanted[i / 3][k], 1e-7) << i << " " << k;
}

TEST_F(MeshFile, OtherFormatsKeepTheColoursOfThePictures) {
  const SurfaceMesh mesh = strip({{0, 51, 255}});
  write_mesh(folder / "a.ply", mesh);
  const std::string ply = read("a.ply");
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.substr(body + 24, 3), std::string("\0\x33\xff", 3));
  EXPECT_EQ(ply.find("origin"), std::string::npos);
  write_mesh(folder / "a.obj", mesh);
  EXPECT_NE(read("a.obj").find("v 0 0.25 3 0 0.2"), std::string::npos) << read("a.obj");
}

TEST_F(MeshFile, MaterialOfGlbShowsTheColoursOfTheVertices) {
  write_mesh(folder / "a.glb", strip({{9, 80, 255}}));
  const json root = Glb(read("a.glb")).root;
  const json& material =
      root.at("materials").at(int(root.at("meshes").at(0).at("primitives").at(0).at("material")));
  const json& plain = material.at("pbrMetallicRoughness");
  EXPECT_EQ(plain.at("metallicFactor"), 0);
  EXPECT_EQ(plain.value("baseColorFactor", json({1, 1, 1, 1})), json({1, 1, 1, 1}));
  EXPECT_FALSE(plain.contains("baseColorTexture"));
  EXPECT_TRUE(material.at("extensions").contains("KHR_materials_unlit"));
  EXPECT_EQ(root.at("extensionsUsed").at(0), "KHR_materials_unlit");
}

TEST_F(MeshFile, OriginIsStatedInEveryFormatAndMovesNothing) {
  SurfaceMesh mesh = strip({{0, 51, 255}, {3, 4, 5}});
  write_mesh(folder / "near.glb", mesh);
  write_mesh(folder / "near.stl", mesh);
  mesh.origin = {500123.25, 4649776.5, -0.1};
  const std::string stated = "origin 500123.25 4649776.5 -0.1";
  for (const char* name : {"a.ply", "a.obj", "a.glb", "a.stl"}) write_mesh(folder / name, mesh);
  EXPECT_NE(read("a.ply").find("\ncomment " + stated + "\n"), std::string::npos);
  EXPECT_EQ(read("a.obj").find("# " + stated + "\n"), 0u);
  const std::string stl = read("a.stl"), near = read("near.stl");
  EXPECT_NE(stl.substr(0, 80).find(stated), std::string::npos);
  EXPECT_NE(stl.substr(0, 5), "solid");  // that would be text
  EXPECT_EQ(stl.substr(80), near.substr(80));

  const Glb far(read("a.glb")), close(read("near.glb"));
  EXPECT_EQ(far.attribute("POSITION"), close.attribute("POSITION"));
  EXPECT_EQ(far.attribute("COLOR_0"), close.attribute("COLOR_0"));
  const json& node = far.root.at("nodes").at(int(far.root.at("scenes").at(0).at("nodes").at(0)));
  EXPECT_EQ(node.at("extras").at("origin"), json({500123.25, 4649776.5, -0.1}));
  EXPECT_FALSE(close.root.at("nodes").at(0).contains("extras"));
}

TEST_F(MeshFile, CloudStatesItsOriginToo) {
  PointCloud cloud;
  cloud.origin = {4200000, 172000, 1e-3};
  cloud.positions = {{1, 2, 3}, {4, 5, 6}};
  cloud.normals.resize(2, Eigen::Vector3f(0, 0, -1));
  cloud.colours.resize(2, Rgb8{1, 2, 3});
  cloud.confidences = cloud.supports = {1, 1};
  CloudFile file(AtomicFile(folder / "a.ply"));
  file.add(cloud);
  file.add(cloud);
  file.commit();
  const std::string ply = read("a.ply");
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_NE(ply.find("\ncomment origin 4200000 172000 0.001\n"), std::string::npos) << ply;
  EXPECT_NE(ply.find("\nelement vertex 4\n"), std::string::npos) << ply;
  EXPECT_EQ(ply.size(), body + 4 * 35);
  float x = 0;
  std::memcpy(&x, ply.data() + body + 3 * 35, sizeof x);
  EXPECT_EQ(x, 4);
}

TEST_F(MeshFile, CloudAsPcdHasTheFieldsOfPcl) {
  PointCloud cloud;
  cloud.origin = {4200000, 172000, 1e-3};
  cloud.positions = {{1, 2, 3}, {4, 5, 6}};
  cloud.normals.resize(2, Eigen::Vector3f(0, 0, -1));
  cloud.colours.resize(2, Rgb8{1, 2, 3});
  cloud.confidences = cloud.supports = {0.5f, 2};
  CloudFile file(AtomicFile(folder / "a.pcd"), CloudFormat::kPcd);
  file.add(cloud);
  file.add(cloud);
  file.commit();
  const std::string pcd = read("a.pcd");
  const std::string end = "DATA binary\n";
  const std::size_t body = pcd.find(end) + end.size();
  EXPECT_TRUE(pcd.starts_with("# .PCD v0.7")) << pcd;
  for (const char* line : {"\n# origin 4200000 172000 0.001\n", "\nWIDTH 4\n", "\nPOINTS 4\n",
                           "FIELDS x y z normal_x normal_y normal_z confidence support rgb\n"})
    EXPECT_NE(pcd.find(line), std::string::npos) << line << pcd.substr(0, body);
  constexpr std::size_t kPoint = 36;
  ASSERT_EQ(pcd.size(), body + 4 * kPoint);
  float x = 0;
  std::memcpy(&x, pcd.data() + body + 3 * kPoint, sizeof x);
  EXPECT_EQ(x, 4);
  std::uint32_t rgb = 0;
  std::memcpy(&rgb, pcd.data() + body + 8 * sizeof(float), sizeof rgb);
  EXPECT_EQ(rgb, 0x010203u);
}

/// Two triangles with a common edge, whose sides lie apart in the texture: red and green at the top
/// of the picture, blue at its bottom.
struct Textured {
  SurfaceMesh mesh;
  SurfaceTexture texture;
};
Textured textured_square() {
  Textured result;
  result.mesh.positions = {{0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}};
  result.mesh.normals.resize(4, Eigen::Vector3f(0, 0, -1));
  result.mesh.colours.resize(4, Rgb8{9, 9, 9});
  result.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  result.texture.picture = Image<std::uint8_t>(32, 48, 3);
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 32; ++u) result.texture.picture(u, v, v >= 24 ? 2 : u < 16 ? 0 : 1) = 250;
  result.texture.corners = {{Eigen::Vector2f(0.125f, 0.125f), Eigen::Vector2f(0.125f, 0.25f),
                             Eigen::Vector2f(0.25f, 0.25f)},
                            {Eigen::Vector2f(0.75f, 0.75f), Eigen::Vector2f(0.875f, 0.75f),
                             Eigen::Vector2f(0.875f, 0.875f)}};
  return result;
}

/// The colour of a decoded picture at a place whose v points up.
cv::Vec3b colour_at(const cv::Mat& bgr, const aiVector3D& place) {
  return bgr.at<cv::Vec3b>(int((1 - place.y) * float(bgr.rows)), int(place.x * float(bgr.cols)));
}

/// What another program finds of the square: colours at the corners of both triangles.
void expect_square(const aiScene* scene, const cv::Mat& picture) {
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->mNumMeshes, 1u);
  const aiMesh& mesh = *scene->mMeshes[0];
  ASSERT_EQ(mesh.mNumFaces, 2u);
  EXPECT_EQ(mesh.mNumVertices, 6u);  // none is shared over the seam
  ASSERT_TRUE(mesh.HasTextureCoords(0));
  EXPECT_FALSE(mesh.HasVertexColors(0));
  ASSERT_EQ(picture.size(), cv::Size(32, 48));
  for (unsigned face = 0; face < 2; ++face)
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned corner = mesh.mFaces[face].mIndices[i];
      const aiVector3D& place = mesh.mTextureCoords[0][corner];
      const cv::Vec3b colour = colour_at(picture, place);
      EXPECT_GT(colour[face == 0 ? 2 : 0], 230) << face << " " << i;
      EXPECT_LT(colour[face == 0 ? 0 : 2], 25) << face << " " << i;
    }
}

cv::Mat decoded(const std::string& bytes) {
  return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

TEST_F(MeshFile, TexturedGlbHasItsPictureInside) {
  const Textured square = textured_square();
  TexturedMeshOutput output(folder / "a.glb", {});
  output.write(square.mesh, square.texture);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
  output.commit();
  const json root = Glb(read("a.glb")).root;
  const json& material = root.at("materials").at(0);
  EXPECT_EQ(material.at("pbrMetallicRoughness").at("baseColorTexture").at("index"), 0);
  EXPECT_EQ(material.at("pbrMetallicRoughness").at("metallicFactor"), 0);
  EXPECT_TRUE(material.at("extensions").contains("KHR_materials_unlit"));
  EXPECT_EQ(root.at("images").at(0).at("mimeType"), "image/jpeg");
  const json& attributes = root.at("meshes").at(0).at("primitives").at(0).at("attributes");
  EXPECT_TRUE(attributes.contains("TEXCOORD_0"));
  EXPECT_FALSE(attributes.contains("COLOR_0"));

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder / "a.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumTextures, 1u);
  const aiTexture& picture = *scene->mTextures[0];
  expect_square(scene, decoded({reinterpret_cast<const char*>(picture.pcData), picture.mWidth}));
}

TEST_F(MeshFile, TexturedObjHasItsMaterialAndPictureBesideIt) {
  Textured square = textured_square();
  square.mesh.origin = {500123.25, 4649776.5, -0.1};
  const std::vector<std::string> names{"a b.jpg", "a b.mtl", "a b.obj"};
  for (int round = 0; round < 2; ++round) {  // the second time in place of the first
    TexturedMeshOutput output(folder / "a b.obj", {});
    output.write(square.mesh, square.texture);
    for (const std::string& name : names)
      EXPECT_EQ(std::filesystem::exists(folder / name), round == 1);
    output.commit();
    ASSERT_EQ(output.paths().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(output.paths()[i], folder / names[i]);
  }
  const std::string obj = read("a b.obj");
  EXPECT_EQ(obj.find("# origin 500123.25 4649776.5 -0.1\n"), 0u);
  EXPECT_NE(obj.find("\nmtllib a b.mtl\n"), std::string::npos) << obj;
  EXPECT_NE(read("a b.mtl").find("map_Kd a b.jpg\n"), std::string::npos) << read("a b.mtl");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder / "a b.obj").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  expect_square(scene, decoded(read("a b.jpg")));
  aiString file;
  const aiMesh& mesh = *scene->mMeshes[0];
  ASSERT_EQ(scene->mMaterials[mesh.mMaterialIndex]->GetTexture(aiTextureType_DIFFUSE, 0, &file),
            aiReturn_SUCCESS);
  EXPECT_STREQ(file.C_Str(), "a b.jpg");
}

TEST_F(MeshFile, AForeignFileBesideATexturedObjIsKept) {
  write("a.mtl", "mine");
  expect_error(ErrorCode::kInvalidArgument, "a.mtl",
               [&] { TexturedMeshOutput(folder / "a.obj", {}); });
  const Textured square = textured_square();
  TexturedMeshOutput output(folder / "a.obj", {.inputs = {}, .replace = true});
  output.write(square.mesh, square.texture);
  output.commit();
  EXPECT_EQ(read("a.mtl.old-1"), "mine");
  RunControl cancelled;
  cancelled.cancel();
  TexturedMeshOutput stopped(folder / "b.obj", {});
  stopped.write(square.mesh, square.texture);
  expect_error(ErrorCode::kCancelled, "stopped", [&] { stopped.commit(cancelled); });
  for (const char* name : {"b.obj", "b.mtl", "b.jpg"})
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
  for (const char* name : {"c.ply", "c.stl"})
    expect_error(ErrorCode::kInvalidArgument, ".glb and .obj",
                 [&] { TexturedMeshOutput(folder / name, {}); });
}

}  // namespace
}  // namespace gigaray
