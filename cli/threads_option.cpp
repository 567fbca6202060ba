// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "threads_option.h"

#include <cstdlib>
#include <string>
#include <thread>

#include "gigaray/core/parallel.h"

namespace gigaray::cli {
namespace {

bool is_stated = false;

}  // namespace

void add_threads_option(CLI::App& app) {
  if (!app.get_option_no_throw("--memory")) return;
  constexpr int kMost = 1024;
  app.add_option_function<int>(
         "--threads",
         [](int threads) {
           set_num_threads(threads);
           is_stated = true;
         },
         "Processors to use, OpenCL on the processor (PoCL) included (default: all that the "
         "program may use); the result does not depend on it")
      ->check(CLI::Range(1, kMost))
      ->type_name("N");
}

void limit_opencl_threads() {
  // Without a word PoCL takes all that the machine has, whatever the quota of a container.
  const bool has_fewer = num_threads() < int(std::thread::hardware_concurrency());
  if (!is_stated && !has_fewer) return;
  const std::string threads = std::to_string(num_threads());
  // The second name is that of PoCL 5 and later. What the user set in the environment stays, unless
  // the option says otherwise.
  for (const char* name : {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT"})
    setenv(name, threads.c_str(), is_stated ? 1 : 0);
}

}  // namespace gigaray::cli
