// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// One line per OpenCL device; exit status 1 without any.
#include <cstdio>

#include "gigaray/engine/device.h"

int main() {
  try {
    const auto devices = gigaray::list_devices();
    for (const gigaray::DeviceInfo& device : devices)
      std::printf("%d: %s (%s), %s, driver %s, %d compute units, %.1f GiB%s%s\n", device.index,
                  device.name.c_str(), to_string(device.type), device.platform.c_str(),
                  device.driver_version.c_str(), device.compute_units,
                  double(device.global_memory) / (1u << 30), device.has_fp64 ? ", doubles" : "",
                  device.has_int64_atomics ? ", 64-bit atomics" : "");
    return devices.empty();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
