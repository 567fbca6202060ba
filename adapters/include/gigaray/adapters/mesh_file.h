// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <vector>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/surface_mesh.h"
#include "gigaray/core/surface_texture.h"

namespace GIGARAY_API gigaray {

/// Writes a surface: binary .ply, .obj, binary glTF .glb, binary .stl (which
/// has no colours). Axes as they are, but .glb, whose y points up and whose surfaces look along z:
/// there y and z are negated. Colours are sRGB, but linear in .glb, where the material shows them
/// as they are, without lamps (KHR_materials_unlit; others see a rough white that is no metal).
/// Positions are relative to mesh.origin; other than 0 it is stated as a comment "origin X Y Z" in
/// .ply and .obj, in the head of .stl, and as "origin" in the extras of the node of .glb, always in
/// the scene's axes. Throws Error(kInvalidArgument) for another extension and for an empty
/// surface, Error(kIo). path: as the file was named; the caller commits it.
void write_mesh(AtomicFile& file, const std::filesystem::path& path, const SurfaceMesh& mesh);
/// The same, whole or not at all; an older file is replaced, whoever wrote it.
void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh);

/// Can a file of this name have a texture? .glb and .obj can.
bool can_have_texture(const std::filesystem::path& path);

/// A surface with a texture in place of colours of vertices: .glb with the picture in it as JPEG,
/// or .obj with NAME.mtl and NAME.jpg beside it. Vertices are doubled along the rims of pieces of
/// the texture. In .glb the texture is shown as it is (KHR_materials_unlit).
class TexturedMeshOutput {
 public:
  /// Make it before the work, so that a place that can't be used shows then. Throws as AtomicFile,
  /// of the files beside it too, and Error(kInvalidArgument) for another extension.
  TexturedMeshOutput(const std::filesystem::path& path, const OutputRules& rules);

  /// Throws Error(kInvalidArgument) for an empty surface, Error(kIo).
  void write(const SurfaceMesh& mesh, const SurfaceTexture& texture);
  /// Puts all files in their places, as AtomicFile::commit_together.
  void commit(const RunControl& control = RunControl());

  /// All files, that of the mesh last.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  std::vector<std::filesystem::path> paths_;
  std::vector<AtomicFile> files_;
};

}  // namespace gigaray
