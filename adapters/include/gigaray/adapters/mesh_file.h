// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/surface_mesh.h"

namespace gigaray {

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

}  // namespace gigaray
