// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/mesh_file.h"

#include <assimp/scene.h>
#include <assimp/Exporter.hpp>

#include <array>
#include <string>
#include <string_view>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/error.h"
#include "glb.h"
#include "origin_text.h"
#include "ply.h"

namespace gigaray {
namespace {

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

/// The scene owns what it points to.
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
  mesh->mColors[0] = new aiColor4D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
    const Eigen::Vector3f &p = surface.positions[i], &n = surface.normals[i];
    const Rgb8& colour = surface.colours[i];
    mesh->mVertices[i] = {p.x(), turn * p.y(), turn * p.z()};
    mesh->mNormals[i] = {n.x(), turn * n.y(), turn * n.z()};
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

/// The file that Assimp made, with what it can't state.
std::string completed(std::string_view bytes, const std::filesystem::path& path,
                      const Eigen::Vector3d& origin) {
  if (path.extension() == ".glb") return glb::completed(bytes, origin);
  if (origin.isZero(0)) return std::string(bytes);
  if (path.extension() == ".obj") return "# " + origin_text(origin) + "\n" + std::string(bytes);
  constexpr std::size_t kStlHead = 80;
  std::string head = "Gigaray, " + origin_text(origin);
  head.resize(kStlHead, ' ');
  return head + std::string(bytes.substr(kStlHead));
}

}  // namespace

void write_mesh(AtomicFile& file, const std::filesystem::path& path, const SurfaceMesh& mesh) {
  const Format& format = format_of(path);
  if (mesh.faces.empty())
    throw Error(ErrorCode::kInvalidArgument, path.string() + ": the surface has no triangle");
  GIGARAY_CHECK(mesh.normals.size() == mesh.positions.size() &&
                mesh.colours.size() == mesh.positions.size());
  if (path.extension() == ".ply") return file.write(ply_of(mesh));
  const bool is_gltf = path.extension() == ".glb";
  const aiScene scene = scene_of(mesh, is_gltf);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, format.assimp_id);
  if (!blob) throw Error(ErrorCode::kIo, path.string() + ": " + exporter.GetErrorString());
  const std::string_view bytes(static_cast<const char*>(blob->data), blob->size);
  file.write(completed(bytes, path, mesh.origin));
}

void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  AtomicFile file(path);
  write_mesh(file, path, mesh);
  file.commit();
}

}  // namespace gigaray
