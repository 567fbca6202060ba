// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// A project outside, with the shared libraries alone: posed photographs of a folder become a cloud
// and a surface.
//   shared_consumer INPUT CLOUD.ply SURFACE.glb
#include <cstdio>
#include <cstring>
#include <memory>

#include "gigaray/version.h"
#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/surface.h"

int main(int argc, char** argv) {
  if (argc != 4 || std::strcmp(gigaray::version(), GIGARAY_VERSION) != 0) return 2;
  try {
    const gigaray::RunControl control;
    auto input = gigaray::open_input({.path = argv[1]}, control);
    auto depth =
        std::make_shared<gigaray::Reconstruction>(gigaray::compute_depth(input, {}, control));
    auto scene = std::make_shared<gigaray::DepthScene>(input, depth);
    gigaray::write_cloud(argv[2], scene, {}, control);
    const auto surface =
        gigaray::surface_of(gigaray::points_of_scene(scene, {}, control), {}, control);
    gigaray::SurfaceFile file(argv[3], false, {});
    file.write(surface);
    file.commit(control);
    std::printf("%zu faces\n", surface.mesh.faces.size());
  } catch (const gigaray::Error& error) {  // it comes out of a shared library
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  try {
    gigaray::open_input({.path = "not/there"}, {});
  } catch (const gigaray::Error& error) {
    return error.code() == gigaray::ErrorCode::kBadInput || error.code() == gigaray::ErrorCode::kIo
               ? 0
               : 1;
  }
  return 1;
}
