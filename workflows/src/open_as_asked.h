// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/workflows/input.h"

namespace gigaray {

/// What readers make of `place`, with all that `request` states but its own path and OpenOptions:
/// views left out, the rig, the size. Finds no cameras.
LightField open_as_asked(const std::filesystem::path& place, const InputRequest& request,
                         const OpenOptions& options);
inline LightField open_as_asked(const InputRequest& request) {
  return open_as_asked(request.path, request, request.open);
}

}  // namespace gigaray
