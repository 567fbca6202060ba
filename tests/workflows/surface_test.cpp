// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/surface.h"

#include <memory>

#include "gigaray/workflows/depth.h"
#include "workflows_test.h"

namespace gigaray {
namespace {

using Surface = WorkflowsTest;

TEST_F(Surface, OfAWorkspaceInTwelveLines) {
  const std::filesystem::path workspace = walk(), file = folder / "walk.ply";
  OpenedInput input = open_input({.path = workspace}, control);
  auto depth = std::make_shared<Reconstruction>(compute_depth(input, {}, control));
  auto scene = std::make_shared<DepthScene>(input, depth);
  const CloudReport report = write_cloud(file, scene, {}, control);
  EXPECT_GT(report.points, 100u);
  EXPECT_GT(std::filesystem::file_size(file), 100u);
  const SceneSurface surface = surface_of(points_of_scene(scene, {}, control), {}, control);
  EXPECT_GT(surface.mesh.faces.size(), 100u);
  EXPECT_EQ(surface.report.faces, surface.mesh.faces.size());
}

TEST_F(Surface, OfAnotherNameIsRefused) {
  EXPECT_NE(
      refusal(ErrorCode::kInvalidArgument, [&] { SurfaceFile(folder / "scene.ply", true, {}); })
          .find("`texture`"),
      std::string::npos);
}

}  // namespace
}  // namespace gigaray
