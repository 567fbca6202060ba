// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// A point cloud of posed photographs: a COLMAP workspace, transforms.json, …
//   05_walk_to_cloud INPUT CLOUD.ply
#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/surface.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  gigaray::RunControl control;
  auto input = gigaray::open_input({.path = argv[1]}, control);
  auto depth =
      std::make_shared<gigaray::Reconstruction>(gigaray::compute_depth(input, {}, control));
  auto scene = std::make_shared<gigaray::DepthScene>(input, depth);
  gigaray::write_cloud(argv[2], scene, {}, control);
}
