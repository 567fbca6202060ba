// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "decoded_pictures.h"

#include <algorithm>
#include <vector>

#include "gigaray/core/parallel.h"
#include "stage_timer.h"

namespace gigaray {

DecodedPictures decode_pictures(const LightField& light_field, const MemoryPlan& plan,
                                const RunControl& control, std::map<std::string, double>& seconds) {
  const StageTimer timer(seconds, "decode");
  const int height = light_field.height, views = light_field.num_views();
  const std::size_t width = light_field.width;
  const std::size_t value_bytes = light_field.pixels->bit_depth() / 8;
  const std::size_t line = width * 3;
  DecodedPictures decoded;
  decoded.pixels = std::make_shared<RowStore>(height, views * line * value_bytes, plan.work_folder);
  if (light_field.pixels->has_mask())
    decoded.shown = std::make_shared<RowStore>(height, views * width, plan.work_folder);

  control.progress("decode", 0, views);
  const auto decode_view = [&](int view) {
    Image<std::uint16_t> picture = read_view(light_field, view);
    light_field.pixels->let_go(view);
    if (const auto mask = take_mask(picture))
      for (int v = 0; v < height; ++v) decoded.shown->write(v, view * width, width, mask->row(v));
    std::vector<std::uint8_t> bytes(line);
    for (int v = 0; v < height; ++v) {
      const void* row = picture.row(v);
      if (value_bytes == 1) {
        std::copy(picture.row(v), picture.row(v) + line, bytes.begin());
        row = bytes.data();
      }
      decoded.pixels->write(v, view * line * value_bytes, line * value_bytes, row);
    }
  };
  parallel_for(
      views, decode_view, [&](int done) { control.progress("decode", done, views); },
      plan.decoders);
  return decoded;
}

}  // namespace gigaray
