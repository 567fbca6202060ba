// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Clouds and surfaces of a result. Only where the library was built with GIGARAY_MESHING.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/surface_texture.h"
#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/mesh_processing.h"
#include "gigaray/meshing/mesh_report.h"
#include "gigaray/meshing/texture.h"
#include "gigaray/workflows/memory_budget.h"
#include "gigaray/workflows/result.h"

namespace GIGARAY_API gigaray {

/// Of posed photographs, whose confidence is the share of pixels within 1 % of the depth: what is
/// less sure makes half of a room's wrong points and a seventh of all (docs/accuracy.md).
inline constexpr double kPosedConfidence = 0.6;

/// What clouds and surfaces start from.
struct PointsRequest {
  std::string views = "all";  ///< as parse_views() takes them
  /// Points that are less sure are left out. Empty: kPosedConfidence, or that of PointOptions.
  std::optional<double> min_confidence = {};
  PointOptions options = {};  ///< least_confidence is that of above
};

/// Views of a scene for points, with the options that suit them.
struct ScenePoints {
  DepthViews views;  ///< the chosen ones, read through the cache of the scene
  PointOptions options;
  std::string name;  ///< of the scene, for messages
};

/// Tells through `control` when scene units are not known.
ScenePoints points_of_scene(std::shared_ptr<DepthScene> scene, const PointsRequest& request,
                            const RunControl& control);

struct CloudRequest {
  PointsRequest points = {};
  CloudOptions cloud = {};  ///< its points and memory are decided here
  MemoryBudget memory = MemoryBudget();
};

/// One coloured, oriented cloud of all views, tile by tile. Throws Error(kBadInput) naming the
/// scene where its depth gives no point, kOutOfMemory before the work.
CloudReport cloud_of(const ScenePoints& points, const CloudRequest& request,
                     const std::function<void(const PointCloud& tile)>& take,
                     const RunControl& control);

/// The same from a scene to a file, .ply or .pcd, that appears only when it is complete:
///
///   auto scene = std::make_shared<DepthScene>(ResultRequest{"walked"});
///   write_cloud("walk.ply", scene, {}, control);
CloudReport write_cloud(const std::filesystem::path& path, std::shared_ptr<DepthScene> scene,
                        const CloudRequest& request, const RunControl& control);

enum class SurfaceMethod {
  kGrid,     ///< depth maps triangulated on their pixels, cut where depth jumps
  kPoisson,  ///< smooth, closes gaps
  kFront,    ///< triangles between the points of the cloud
};

struct SurfaceRequest {
  PointsRequest points = {};
  SurfaceMethod method = SurfaceMethod::kGrid;
  double voxel = 0;  ///< kPoisson, kFront: as CloudOptions::voxel; 0: by most_points
  std::size_t most_points = 300'000;
  double trim = 2;  ///< kPoisson: PoissonOptions::trim
  MeshCleaning cleaning = {};
  bool is_textured = false;
  TextureOptions texture = {};
  MemoryBudget memory = MemoryBudget();
};

/// A surface with what became of the pixels that it is made of.
struct SceneSurface {
  SurfaceMesh mesh;
  SurfaceTexture texture;  ///< with is_textured
  PointCounts pixels;
  MeshCleaned cleaned;
  MeshReport report;
  TextureCounts texture_counts;
};

/// Throws Error(kBadInput) naming the scene where its depth gives no surface, kOutOfMemory as soon
/// as it shows.
SceneSurface surface_of(const ScenePoints& points, const SurfaceRequest& request,
                        const RunControl& control);

/// The file of a surface (.ply, .obj, .glb, .stl), or the files of a textured one (.glb, .obj).
class SurfaceFile {
 public:
  /// Make it before the work: throws Error(kInvalidArgument) for another name.
  SurfaceFile(const std::filesystem::path& path, bool is_textured, const OutputRules& rules);
  ~SurfaceFile();
  SurfaceFile(const SurfaceFile&) = delete;
  SurfaceFile& operator=(const SurfaceFile&) = delete;
  void write(const SceneSurface& surface);
  void commit(const RunControl& control);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gigaray
