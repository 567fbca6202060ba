// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

/// Opens a namespace of the public headers: what it declares is seen outside of a shared library;
/// everything else is hidden. `namespace GIGARAY_API gigaray {`.
#define GIGARAY_API [[gnu::visibility("default")]]
