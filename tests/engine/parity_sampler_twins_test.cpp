// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Law 5 of ray_sampler.h: the OpenCL twin of a sampler locates the same ray.
#include <gtest/gtest.h>

#include "engine/parity_bench.h"
#include "kernels/kernel_params.h"
#include "opencl/buffer.h"
#include "opencl/program_cache.h"

namespace gigaray::testing_support {
namespace {

// Single precision at positions of a few hundred px.
constexpr double kTolerance = 2e-4;

constexpr const char* kLocateRays = R"(
__kernel void locate_rays(__global const float* tables, const int table_size,
                          __global const int2* pairs,
                          __global const float4* rays, __global float4* there) {
  const int i = get_global_id(0);
  float u = 0, v = 0, h = 0;
  const float4 ray = rays[i];
  const int seen = locate(tables + pairs[i].x * table_size, pairs[i].y, ray.x, ray.y, ray.z, &u, &v, &h);
  there[i] = (float4)(u, v, h, seen);
})";

struct Float4 {
  float u, v, hypothesis, seen;
};
struct Pair {
  int from, to;
};

template <RaySampler S>
void expect_same_rays(const S& level0) {
  auto device = opencl::Device::open();
  const opencl::SourcePart parts[] = {{"kernel_params.h", opencl::kernel_source("kernel_params.h")},
                                      {"common.cl", opencl::kernel_source("common.cl")},
                                      {"sampler", opencl::kernel_source(S::kKernelFile)},
                                      {"locate_rays.cl", kLocateRays}};
  opencl::Kernel kernel(
      device, opencl::build_program(device, parts, S::kRaysShiftAlike ? "" : " -DSHIFT_ALIKE=0"),
      "locate_rays");
  std::mt19937 random(3);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * float(random() >> 8) / float(1 << 24);
  };
  for (int level = 0; level < 4; ++level) {
    const S sampler = level0.at_level(level);
    std::vector<Pair> pairs;
    std::vector<Float4> rays;
    for (int a = 0; a < sampler.num_views(); ++a)
      for (int b = 0; b < sampler.num_views(); ++b)
        for (int i = 0; i < 5; ++i) {
          pairs.push_back({a, b});
          rays.push_back({std::ldexp(uniform(0, 400), -level), std::ldexp(uniform(0, 300), -level),
                          uniform(-1, 2), 0});
        }
    std::vector<Float4> there(rays.size());
    std::vector<float> tables;
    for (int ref = 0; ref < sampler.num_views(); ++ref)
      for (const float value : sampler.ray_table(ref)) tables.push_back(value);
    const int table_size = int(tables.size()) / sampler.num_views();
    const opencl::Buffer table_buffer(device, std::span<const float>(tables));
    const opencl::Buffer pair_buffer(device, std::span<const Pair>(pairs));
    const opencl::Buffer ray_buffer(device, std::span<const Float4>(rays));
    const opencl::Buffer out(device, there.size() * sizeof(Float4));
    kernel.set_args(table_buffer, table_size, pair_buffer, ray_buffer, out).run(rays.size(), 1);
    out.read(std::span(there));
    Difference position, hypothesis;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto expected =
          sampler.locate(pairs[i].from, pairs[i].to, {rays[i].u, rays[i].v, rays[i].hypothesis});
      ASSERT_EQ(expected.has_value(), there[i].seen != 0);
      if (!expected) continue;
      position.add(expected->u, there[i].u);
      position.add(expected->v, there[i].v);
      hypothesis.add(expected->hypothesis, there[i].hypothesis);
    }
    ParityTable::instance().add(ParityRig<S>::kName, "locate, px", position);
    ParityTable::instance().add(ParityRig<S>::kName, "locate, hypothesis", hypothesis);
    EXPECT_LE(position.largest, kTolerance);
    EXPECT_LE(hypothesis.largest, S::kRaysShiftAlike ? 1e-6 : 2e-5);
  }
}

TEST(ParitySamplerTwins, EpiLocatesTheSameRay) {
  expect_same_rays(EpiSampler(row_of_views(5)));
  expect_same_rays(EpiSampler(irregular_row()));
}

TEST(ParitySamplerTwins, GridLocatesTheSameRay) {
  expect_same_rays(GridSampler(grid_of_views(3, 2)));
  expect_same_rays(GridSampler(irregular_grid()));
}

TEST(ParitySamplerTwins, UnstructuredLocatesTheSameRay) {
  expect_same_rays(UnstructuredSampler(cameras_around(irregular_grid(), 400, 300)));
}

}  // namespace
}  // namespace gigaray::testing_support
