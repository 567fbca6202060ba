// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "support/program.h"
#include "gigaray/version.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "gigaray/engine/device.h"

namespace gigaray::benchmarks {

int run_program(int argc, char** argv,
                const std::function<void(const std::vector<std::string>&)>& declare) {
  try {
    // The default of a flag, which a later one overrides; Repetitions() would win over it.
    std::string repetitions = "--benchmark_repetitions=5";
    std::vector<char*> all(argv, argv + argc);
    all.insert(all.begin() + 1, repetitions.data());
    argc = int(all.size());
    all.push_back(nullptr);
    argv = all.data();
    benchmark::Initialize(&argc, argv);
    const DeviceInfo device = select_device();
    benchmark::AddCustomContext("gigaray_version", GIGARAY_VERSION);
    benchmark::AddCustomContext("device", device.name);
    benchmark::AddCustomContext("device_type", to_string(device.type));
    benchmark::AddCustomContext("compute_units", std::to_string(device.compute_units));
    benchmark::AddCustomContext("platform", device.platform + " " + device.platform_version);
    benchmark::AddCustomContext("driver", device.driver_version);
    declare({argv + 1, argv + argc});
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

benchmark::internal::Benchmark* repeated(benchmark::internal::Benchmark* benchmark) {
  using Values = std::vector<double>;
  return benchmark->MeasureProcessCPUTime()
      ->UseRealTime()
      ->ReportAggregatesOnly()
      ->ComputeStatistics("min",
                          [](const Values& v) { return *std::min_element(v.begin(), v.end()); })
      ->ComputeStatistics("max",
                          [](const Values& v) { return *std::max_element(v.begin(), v.end()); });
}

}  // namespace gigaray::benchmarks
