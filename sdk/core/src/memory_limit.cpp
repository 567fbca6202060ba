// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/memory_limit.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace gigaray {

double available_memory() {
  std::ifstream info("/proc/meminfo");
  std::string key, unit;
  for (double kib; info >> key >> kib >> unit;)
    if (key == "MemAvailable:") return kib * 1024;
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) / 2;
}

double default_memory_limit() { return 0.75 * available_memory(); }

}  // namespace gigaray
