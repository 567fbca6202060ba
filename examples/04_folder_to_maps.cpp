// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Depth of every view of a folder of pictures, written as `gigaray depth` does.
//   04_folder_to_maps INPUT OUTPUT
#include "gigaray/workflows/depth.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  gigaray::RunControl control;  // progress, messages, cancel
  gigaray::compute_depth_folder({.path = argv[1]}, {}, {.path = argv[2]}, control);
}
