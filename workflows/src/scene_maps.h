// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Maps as the page reads them, see docs/formats.md, "Scenes of the page". A browser decodes 16-bit
// PNG to 8 bit, so maps come as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gigaray/core/image.h"

namespace gigaray {

/// Codes of floats: 0 no estimate, c ≥ 1 means least + (c − 1) · (most − least) / 65534.
struct MapCodes {
  double least = 0, most = 1;  ///< least < most

  /// The least range that holds all values of the maps that are handed to it.
  void include(const FloatMap& map);
  /// After the last map: a range that is none becomes one.
  void settle();
  std::uint16_t code(float value) const;  ///< nearest, halves up
  double value(double code) const;

 private:
  bool is_empty_ = true;
};

/// A stream of gzip.
std::string gzipped(std::string_view bytes);

/// Codes as left differences, high bytes of the whole map first, gzipped.
std::string packed_values(const FloatMap& map, const MapCodes& codes);
/// Values [0, 1] in 8 bit, NaN 0, as left differences, gzipped.
std::string packed_shares(const FloatMap& map);

/// One pixel of `map` for each of the smaller picture, the one at its centre: no value is made up.
FloatMap picked(const FloatMap& map, int width, int height);

}  // namespace gigaray
