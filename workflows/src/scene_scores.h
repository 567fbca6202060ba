// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <nlohmann/json.hpp>

#include "gigaray/core/light_field.h"
#include "gigaray/workflows/view_scene.h"

namespace gigaray {

/// The part "scores" of scene.json: curves of view number `view` of the scene, `name`, of which
/// width × height px are shown, `scale` px for one of the light field, on a coarse grid. Hands
/// their file to `take`. Null with a message where there is no device.
nlohmann::ordered_json scene_scores(const CurveSource& source, int view, const std::string& name,
                                    int width, int height, double scale, const TakeSceneFile& take,
                                    const RunControl& control);

}  // namespace gigaray
