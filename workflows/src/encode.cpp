// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "gigaray/adapters/depth_result.h"

namespace gigaray {

double coding_bytes(const LightField& light_field) {
  return double(light_field.width) * light_field.height * (13.0 * light_field.num_views() + 60);
}

DisparityOfView computed_disparities(OpenedInput& input, const DepthRequest& request,
                                     const RunControl& control) {
  DepthOptions options = prepare_depth(input, request, control);
  const LightField& light_field = input.light_field;
  // The estimates stay while the file is written.
  options.memory_beside = coding_bytes(light_field);
  const auto depth =
      std::make_shared<Reconstruction>(reconstruct(light_field, options, request.backend, control));
  return [depth](int view) { return depth->view(view).disparity; };
}

DisparityOfView disparities_of_result(const std::filesystem::path& result,
                                      LightField& light_field) {
  const auto depth = std::make_shared<DepthResult>(result);
  const LightField& geometry = depth->light_field();
  if (geometry.width != light_field.width || geometry.height != light_field.height)
    throw Error(ErrorCode::kBadInput, fmt::format("{}: its maps are {} × {}, the pictures {} × {}",
                                                  result.string(), geometry.width, geometry.height,
                                                  light_field.width, light_field.height));
  std::vector<int> map_of_view;
  for (View& view : light_field.views) {
    const auto found = std::find_if(geometry.views.begin(), geometry.views.end(),
                                    [&](const View& other) { return other.name == view.name; });
    if (found == geometry.views.end())
      throw Error(ErrorCode::kBadInput,
                  fmt::format("{}: has no depth of view {}; that of all {} views is needed",
                              result.string(), view.name, light_field.num_views()));
    view = *found;
    map_of_view.push_back(int(found - geometry.views.begin()));
  }
  return [depth, map_of_view](int view) { return depth->disparity(map_of_view[view]); };
}

}  // namespace gigaray
