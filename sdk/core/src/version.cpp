// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/version.h"

namespace gigaray {

const char* version() { return GIGARAY_VERSION; }

}  // namespace gigaray
