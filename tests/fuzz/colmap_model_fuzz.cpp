// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The parsers of COLMAP models. The first byte chooses file and format; what is accepted must be
// printed and parsed again as the same.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "colmap/colmap_model_files.h"
#include "gigaray/core/error.h"

using gigaray::ColmapModel;
using gigaray::ColmapParser;
using gigaray::ColmapPrinter;

namespace {

void parse_again(const ColmapModel& model, const ColmapParser& parser,
                 const ColmapPrinter& printer) {
  ColmapModel again;
  parser.cameras(printer.cameras(model), "again", again);
  parser.images(printer.images(model), "again", again);
  parser.points(printer.points(model), "again", again);
  GIGARAY_CHECK(again.cameras == model.cameras);
  GIGARAY_CHECK(again.images.size() == model.images.size());
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    GIGARAY_CHECK(again.images[i].translation == model.images[i].translation);
    GIGARAY_CHECK(again.images[i].features == model.images[i].features);
  }
  GIGARAY_CHECK(again.points.size() == model.points.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool binary = data[0] % 2 == 0;
  const ColmapParser& parser = binary ? gigaray::kBinaryColmapParser : gigaray::kTextColmapParser;
  ColmapModel model;
  try {
    switch (data[0] / 2 % 3) {
      case 0:
        parser.cameras(bytes, "fuzz", model);
        break;
      case 1:
        parser.images(bytes, "fuzz", model);
        break;
      default:
        parser.points(bytes, "fuzz", model);
    }
  } catch (const gigaray::Error& error) {
    GIGARAY_CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
    return 0;
  }
  for (const auto& [id, lens] : model.cameras) {
    const gigaray::LensMap map(lens);
    for (const double x : {-0.7, 0.0, 0.3})
      if (const auto pixel = map.distort({x, 0.2})) map.undistort(*pixel);
    map.undistort({lens.width / 3.0, lens.height / 2.0});
  }
  parse_again(model, gigaray::kBinaryColmapParser, gigaray::kBinaryColmapPrinter);
  parse_again(model, gigaray::kTextColmapParser, gigaray::kTextColmapPrinter);
  try {
    settle(model, "fuzz", size % 2 == 0);
  } catch (const gigaray::Error&) {
  }
  return 0;
}
