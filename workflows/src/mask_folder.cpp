// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/error.h"
#include "gigaray/workflows/masks.h"
#include "gigaray/workflows/view_list.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

Image<std::uint16_t> as_picture(const Mask& mask) {
  Image<std::uint16_t> picture(mask.width(), mask.height());
  std::transform(mask.begin(), mask.end(), picture.begin(),
                 [](std::uint8_t inside) { return std::uint16_t(inside ? 255 : 0); });
  return picture;
}

Image<std::uint16_t> as_picture(const FloatMap& matte) {
  Image<std::uint16_t> picture(matte.width(), matte.height());
  std::transform(matte.begin(), matte.end(), picture.begin(),
                 [](float opacity) { return std::uint16_t(std::lround(opacity * 65535)); });
  return picture;
}

/// matte: empty if there is none.
void write_view(const fs::path& place, const Mask& mask, const FloatMap& matte, bool as_exr) {
  write_png(place / "mask.png", as_picture(mask), 8);
  if (!matte.empty()) write_png(place / "matte.png", as_picture(matte), 16);
  if (!as_exr) return;
  if (!matte.empty()) return write_exr(place / "matte.exr", matte);
  FloatMap opacity(mask.width(), mask.height());
  std::copy(mask.begin(), mask.end(), opacity.begin());
  write_exr(place / "mask.exr", opacity);
}

ordered_json record_of(const SceneMasks& masks, const ordered_json& views) {
  const DepthScene& scene = masks.scene();
  ordered_json root{{"format", kSegmentFormat},
                    {"version", 1},
                    {"depth", path_text(fs::absolute(scene.name()))},
                    {"unit", to_string(masks.unit())},
                    {"least", masks.values().least},
                    {"most", masks.values().most},
                    {"min_confidence", scene.min_confidence()},
                    {"views", views}};
  if (const auto& pixel = masks.pixel())
    root["at"] = {{"view", scene.light_field().views[pixel->view()].name},
                  {"u", pixel->at().u},
                  {"v", pixel->at().v},
                  {"value", pixel->value()}};
  return root;
}

}  // namespace

int write_masks(const SceneMasks& masks, const std::string& views, bool as_exr,
                const fs::path& folder, const RunControl& control) {
  const LightField& geometry = masks.scene().light_field();
  std::vector<int> chosen = parse_views(views, geometry);
  if (chosen.empty()) chosen = masks.scene().views();
  const int centre = centre_view(geometry);
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    control.progress("segment", double(i), double(chosen.size()));
    const std::string& name = geometry.views[chosen[i]].name;
    const auto [mask, matte] = masks.view(chosen[i]);
    const fs::path place = folder / name;
    std::error_code error;
    fs::create_directories(place, error);
    if (error) throw Error(ErrorCode::kIo, place.string() + ": " + error.message());
    write_view(place, mask, matte, as_exr);
    if (chosen[i] == centre) write_view(folder, mask, matte, as_exr);
    const auto inside = std::count(mask.begin(), mask.end(), 1);
    list.push_back({{"name", name}, {"share", double(inside) / double(mask.size())}});
  }
  write_file_atomically(
      folder / "gigaray.json",
      record_of(masks, list).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  return int(chosen.size());
}

}  // namespace gigaray
