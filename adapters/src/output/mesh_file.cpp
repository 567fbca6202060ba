// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/mesh_file.h"

#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/Exporter.hpp>

#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "formats/origin_text.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "output/glb.h"
#include "output/output_place.h"
#include "output/ply.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Of textures: what it takes away can't be seen.
constexpr int kJpegQuality = 95;

struct Format {
  const char* extension;
  const char* assimp_id;
};
constexpr std::array<Format, 4> kFormats{
    {{".ply", ""}, {".obj", "objnomtl"}, {".glb", "glb2"}, {".stl", "stlb"}}};

const Format& format_of(const std::filesystem::path& path) {
  for (const Format& format : kFormats)
    if (path.extension() == format.extension) return format;
  throw Error(ErrorCode::kInvalidArgument,
              path.string() + ": a surface is written as .ply, .obj, .glb or .stl");
}

std::string ply_of(const SurfaceMesh& mesh) {
  std::string bytes =
      ply::begin_header(mesh.positions.size(), mesh.origin, {"x", "y", "z", "nx", "ny", "nz"}) +
      "element face " + std::to_string(mesh.faces.size()) +
      "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3f &p = mesh.positions[i], &n = mesh.normals[i];
    for (const float number : {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()})
      ply::append(bytes, number);
    ply::append(bytes, mesh.colours[i]);
  }
  for (const auto& face : mesh.faces) {
    ply::append(bytes, std::uint8_t(face.size()));
    ply::append(bytes, face);
  }
  return bytes;
}

/// A surface whose vertices have one place in the texture each.
struct Unwelded {
  SurfaceMesh mesh;
  std::vector<Eigen::Vector2f> places;
};

Unwelded unwelded(const SurfaceMesh& mesh, const SurfaceTexture& texture) {
  constexpr std::uint32_t kNone = 0xffffffff;
  Unwelded result;
  result.mesh.origin = mesh.origin;
  std::vector<std::uint32_t> first(mesh.positions.size(), kNone), next;
  const auto copy_at = [&](std::uint32_t vertex, const Eigen::Vector2f& place) {
    std::uint32_t copy = first[vertex];
    while (copy != kNone && result.places[copy] != place) copy = next[copy];
    if (copy != kNone) return copy;
    copy = std::uint32_t(result.places.size());
    if (copy == kNone)
      throw Error(ErrorCode::kInvalidArgument, "a textured surface has less than 2^32 vertices");
    next.push_back(std::exchange(first[vertex], copy));
    result.places.push_back(place);
    result.mesh.positions.push_back(mesh.positions[vertex]);
    result.mesh.normals.push_back(mesh.normals[vertex]);
    return copy;
  };
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    auto& corners = result.mesh.faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = copy_at(mesh.faces[face][i], texture.corners[face][i]);
  }
  return result;
}

/// The scene owns what it points to. A surface without colours is left without.
aiScene scene_of(const SurfaceMesh& surface, bool is_gltf) {
  const float turn = is_gltf ? -1 : 1;
  const auto value = [&](std::uint8_t srgb) {
    return is_gltf ? glb::linear(srgb) : float(srgb) / 255;
  };
  auto* mesh = new aiMesh;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = unsigned(surface.positions.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  if (!surface.colours.empty()) mesh->mColors[0] = new aiColor4D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
    const Eigen::Vector3f &p = surface.positions[i], &n = surface.normals[i];
    mesh->mVertices[i] = {p.x(), turn * p.y(), turn * p.z()};
    mesh->mNormals[i] = {n.x(), turn * n.y(), turn * n.z()};
    if (surface.colours.empty()) continue;
    const Rgb8& colour = surface.colours[i];
    mesh->mColors[0][i] = {value(colour[0]), value(colour[1]), value(colour[2]), 1};
  }
  mesh->mNumFaces = unsigned(surface.faces.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3];
    std::copy_n(surface.faces[i].begin(), 3, mesh->mFaces[i].mIndices);
  }
  aiScene scene;
  scene.mNumMeshes = 1;
  scene.mMeshes = new aiMesh* [1] { mesh };
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mRootNode = new aiNode("surface");
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
  return scene;
}

/// Assimp's v points up.
void add_places(aiScene& scene, const std::vector<Eigen::Vector2f>& places) {
  aiMesh& mesh = *scene.mMeshes[0];
  mesh.mNumUVComponents[0] = 2;
  mesh.mTextureCoords[0] = new aiVector3D[mesh.mNumVertices];
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    mesh.mTextureCoords[0][i] = {places[i].x(), 1 - places[i].y(), 0};
}

/// reference: the name of a file, or of a texture in the scene.
void add_material(aiScene& scene, const std::string& reference) {
  aiMaterial& material = *scene.mMaterials[0];
  const aiString name("photographs"), file(reference);
  material.AddProperty(&name, AI_MATKEY_NAME);
  material.AddProperty(&file, AI_MATKEY_TEXTURE(aiTextureType_DIFFUSE, 0));
  // Lit by nothing but what is around, the surface has the colours of the texture.
  const aiColor3D white(1, 1, 1), black(0, 0, 0);
  material.AddProperty(&white, 1, AI_MATKEY_COLOR_DIFFUSE);
  material.AddProperty(&white, 1, AI_MATKEY_COLOR_AMBIENT);
  material.AddProperty(&black, 1, AI_MATKEY_COLOR_SPECULAR);
}

void embed(aiScene& scene, const std::string& jpeg) {
  auto* texture = new aiTexture;
  texture->mWidth = unsigned(jpeg.size());  // with a height of 0: bytes of a file
  std::copy_n("jpg", 4, texture->achFormatHint);
  texture->pcData = reinterpret_cast<aiTexel*>(new unsigned char[jpeg.size()]);
  std::memcpy(texture->pcData, jpeg.data(), jpeg.size());
  scene.mNumTextures = 1;
  scene.mTextures = new aiTexture* [1] { texture };
}

std::string_view bytes_of(const aiExportDataBlob& blob) {
  return {static_cast<const char*>(blob.data), blob.size};
}

/// The file that Assimp made, with what it can't state.
std::string completed(std::string_view bytes, const std::filesystem::path& path,
                      const Eigen::Vector3d& origin, glb::Shown shown) {
  if (path.extension() == ".glb") return glb::completed(bytes, origin, shown);
  if (origin.isZero(0)) return std::string(bytes);
  if (path.extension() == ".obj") return "# " + origin_text(origin) + "\n" + std::string(bytes);
  constexpr std::size_t kStlHead = 80;
  std::string head = "Gigaray, " + origin_text(origin);
  head.resize(kStlHead, ' ');
  return head + std::string(bytes.substr(kStlHead));
}

void check_corners(const SurfaceMesh& mesh) {
  for (const auto& face : mesh.faces)
    for (const std::uint32_t corner : face)
      require_argument(corner < mesh.positions.size(),
                       "mesh.faces: name a vertex that is not there");
}

}  // namespace

void write_mesh(AtomicFile& file, const std::filesystem::path& path, const SurfaceMesh& mesh) {
  const Format& format = format_of(path);
  if (mesh.faces.empty())
    throw Error(ErrorCode::kInvalidArgument, path.string() + ": the surface has no triangle");
  require_argument(
      mesh.normals.size() == mesh.positions.size() && mesh.colours.size() == mesh.positions.size(),
      "mesh.normals, mesh.colours: one for each position is needed");
  check_corners(mesh);
  if (path.extension() == ".ply") return file.write(ply_of(mesh));
  const bool is_gltf = path.extension() == ".glb";
  const aiScene scene = scene_of(mesh, is_gltf);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, format.assimp_id);
  if (!blob) throw Error(ErrorCode::kIo, path.string() + ": " + exporter.GetErrorString());
  file.write(completed(bytes_of(*blob), path, mesh.origin, glb::Shown::kVertexColours));
}

void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  AtomicFile file(path);
  write_mesh(file, path, mesh);
  file.commit();
}

bool can_have_texture(const fs::path& path) {
  return path.extension() == ".glb" || path.extension() == ".obj";
}

TexturedMeshOutput::TexturedMeshOutput(const fs::path& path, const OutputRules& rules) {
  if (!can_have_texture(path))
    throw Error(ErrorCode::kInvalidArgument, path.string() + ": only .glb and .obj have a texture");
  if (path.extension() == ".obj") {
    // Beside the file itself where the path is a link to it.
    const fs::path beside = fs::is_symlink(path) ? output_place(path) : path;
    for (const char* extension : {".jpg", ".mtl"})
      paths_.push_back(fs::path(beside).replace_extension(extension));
  }
  paths_.push_back(path);
  for (const fs::path& place : paths_)
    files_.emplace_back(place, rules, std::initializer_list<const char*>{});
}

void TexturedMeshOutput::write(const SurfaceMesh& mesh, const SurfaceTexture& texture) {
  const fs::path& path = paths_.back();
  if (mesh.faces.empty())
    throw Error(ErrorCode::kInvalidArgument, path.string() + ": the surface has no triangle");
  require_argument(
      mesh.normals.size() == mesh.positions.size() && texture.corners.size() == mesh.faces.size(),
      "mesh.normals, texture.corners: one for each position, one for each face are needed");
  check_corners(mesh);
  const bool is_gltf = path.extension() == ".glb";
  const Unwelded parts = unwelded(mesh, texture);
  aiScene scene = scene_of(parts.mesh, is_gltf);
  add_places(scene, parts.places);
  const std::string jpeg = jpeg_bytes(texture.picture, kJpegQuality);
  add_material(scene, is_gltf ? "*0" : paths_.front().filename().string());
  if (is_gltf) embed(scene, jpeg);
  Assimp::ExportProperties properties;
  properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, path.stem().string());
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob =
      exporter.ExportToBlob(&scene, is_gltf ? "glb2" : "obj", 0, &properties);
  if (!blob || (!is_gltf && !blob->next))
    throw Error(ErrorCode::kIo, path.string() + ": " + exporter.GetErrorString());
  if (!is_gltf) {
    files_[0].write(jpeg);
    files_[1].write(bytes_of(*blob->next));
  }
  files_.back().write(completed(bytes_of(*blob), path, mesh.origin, glb::Shown::kTexture));
}

void TexturedMeshOutput::commit(const RunControl& control) {
  AtomicFile::commit_together(files_, control);
}

}  // namespace gigaray
