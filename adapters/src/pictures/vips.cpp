// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/vips.h"

#include "gigaray/core/error.h"
#include "gigaray/core/parallel.h"

namespace gigaray {

void use_vips() {
  static const bool started = [] {
    if (VIPS_INIT("gigaray") != 0) throw Error(ErrorCode::kIo, "libvips can't be started");
    vips_concurrency_set(num_threads());
    vips_cache_set_max(0);  // a file may change between two calls
    const auto ignore = [](const char*, GLogLevelFlags, const char*, void*) {};
    g_log_set_handler("VIPS", GLogLevelFlags(G_LOG_LEVEL_WARNING | G_LOG_LEVEL_INFO), ignore,
                      nullptr);
    return true;
  }();
  (void)started;
}

std::string vips_reason(const vips::VError& error) {
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace gigaray
