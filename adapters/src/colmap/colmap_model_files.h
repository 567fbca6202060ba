// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <string_view>

#include "gigaray/adapters/colmap_model.h"

namespace gigaray {

/// Parsers of the files of a model, from their bytes; what they find is added to `model`. Throw
/// Error(kBadInput) beginning with `where`, the file's name. What depends on other files is left to
/// check(ColmapModel).
struct ColmapParser {
  void (*cameras)(std::string_view bytes, const std::string& where, ColmapModel& model);
  void (*images)(std::string_view bytes, const std::string& where, ColmapModel& model);
  void (*points)(std::string_view bytes, const std::string& where, ColmapModel& model);
};
extern const ColmapParser kBinaryColmapParser, kTextColmapParser;

struct ColmapPrinter {
  std::string (*cameras)(const ColmapModel& model);
  std::string (*images)(const ColmapModel& model);
  std::string (*points)(const ColmapModel& model);
};
extern const ColmapPrinter kBinaryColmapPrinter, kTextColmapPrinter;

/// Takes an image, a point or a camera whose numbers were read: normalises the quaternion, puts
/// what is not finite or impossible to what is left out, throws Error(kBadInput) for what can't be.
void accept(ColmapModel::Image image, const std::string& where, ColmapModel& model);
void accept(ColmapModel::Point point, const std::string& where, ColmapModel& model);
void accept(std::uint32_t camera_id, Lens lens, const std::string& where, ColmapModel& model);

/// Leaves images without a camera out. Throws Error(kBadInput) beginning with `where` when the
/// parts contradict each other or no image is left; when `strict`, for anything left out.
void settle(ColmapModel& model, const std::string& where, bool strict);

}  // namespace gigaray
