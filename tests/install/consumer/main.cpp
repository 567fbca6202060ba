// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// A project outside: makes a light field in memory, computes depth, writes and reads it as a sparse
// light field, masks what is near.
#include <cmath>
#include <cstdio>
#include <vector>

#include "gigaray/adapters/sparse_file.h"
#include "gigaray/applications/segmentation.h"
#include "gigaray/engine/reconstruct.h"

namespace {

constexpr int kWidth = 65, kHeight = 33, kViews = 5;
constexpr double kDisparity = 1.5;

// A wall parallel to the rig: a view is the pattern, shifted by its distance from the centre.
gigaray::Image<std::uint16_t> picture_at(double s) {
  gigaray::Image<std::uint16_t> picture(kWidth, kHeight, 3);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const double x = u + s * kDisparity;
      for (int c = 0; c < 3; ++c)
        picture(u, v, c) = std::uint16_t(
            std::lround(127.5 + 60 * std::sin(0.9 * x + c) + 60 * std::sin(0.37 * x + 0.7 * v)));
    }
  return picture;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  gigaray::LightField light_field;
  light_field.width = kWidth;
  light_field.height = kHeight;
  std::vector<gigaray::Image<std::uint16_t>> pictures;
  for (int i = 0; i < kViews; ++i) {
    const double s = i - kViews / 2;
    light_field.views.push_back({"view" + std::to_string(i), s, 0});
    pictures.push_back(picture_at(s));
  }
  light_field.pixels = gigaray::pixels_in_memory(pictures, 8);

  try {
    gigaray::DepthOptions options = gigaray::auto_options();
    options.disparity = {0.5, 2.5};
    const gigaray::RunControl control;
    auto result = gigaray::reconstruct(light_field, options, {}, control);
    gigaray::write_sparse_file(
        argv[1], light_field, [&](int view) { return result.view(view).disparity; }, {}, control);

    const gigaray::SparseFile file(argv[1]);
    const int centre = gigaray::centre_view(light_field);
    const bool same = gigaray::read_view(file.light_field(), centre) == pictures[centre];
    const gigaray::FloatMap disparity = file.disparity(centre, {0, kHeight});
    gigaray::Mask mask;
    gigaray::segment(disparity, {1.4f, 1.6f}, mask);
    const float found = disparity(kWidth / 2, kHeight / 2);
    std::printf("disparity %.3f, truth %.3f; picture %s; mask %d\n", found, kDisparity,
                same ? "restored" : "differs", mask(kWidth / 2, kHeight / 2));
    return std::abs(found - kDisparity) < 0.05 && same && mask(kWidth / 2, kHeight / 2) == 1 ? 0
                                                                                             : 1;
  } catch (const gigaray::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
