// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The page of `gigaray view` (viewer/), with a scene in it or beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/view_scene.h"

namespace GIGARAY_API gigaray {

/// Is the page part of this build? It is made where node and npm are there.
bool has_view_page();

/// Makes a scene: hands its files on and returns scene.json, as view_scene() does.
using MakeScene = std::function<std::string(const TakeSceneFile& take)>;

/// One page with everything in it, which opens from a file. Throws Error(kDevice) where
/// has_view_page() is false, and what make_scene throws.
std::string view_page(const std::string& title, const MakeScene& make_scene);

/// Kind of a folder with a page, for AtomicFolder.
inline constexpr const char* kViewFormat = "gigaray view";

/// index.html, scene.json and data/ for any web server, into a folder that is there. Returns the
/// bytes of all. Throws the same.
std::uintmax_t write_view_folder(const std::filesystem::path& folder, const std::string& title,
                                 const MakeScene& make_scene);

}  // namespace gigaray
