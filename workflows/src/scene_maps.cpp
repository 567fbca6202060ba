// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "scene_maps.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gigaray/core/error.h"

namespace gigaray {

void MapCodes::include(const FloatMap& map) {
  for (const float value : map) {
    if (!std::isfinite(value)) continue;
    least = is_empty_ ? value : std::min(least, double(value));
    most = is_empty_ ? value : std::max(most, double(value));
    is_empty_ = false;
  }
}

void MapCodes::settle() {
  if (!(least < most)) most = least + 1;
}

std::uint16_t MapCodes::code(float value) const {
  if (!std::isfinite(value)) return 0;
  const double steps = std::floor((value - least) / (most - least) * 65534 + 0.5);
  return std::uint16_t(1 + std::clamp(steps, 0.0, 65534.0));
}

double MapCodes::value(double code) const { return least + (code - 1) * (most - least) / 65534; }

std::string gzipped(std::string_view bytes) {
  constexpr int kGzip = 16 + MAX_WBITS;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw Error(ErrorCode::kOutOfMemory, "no memory to pack a map");
  std::string packed(deflateBound(&stream, uLong(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  GIGARAY_CHECK(status == Z_STREAM_END);
  return packed;
}

std::string packed_values(const FloatMap& map, const MapCodes& codes) {
  std::string bytes(2 * map.size(), '\0');
  std::size_t i = 0;
  for (int v = 0; v < map.height(); ++v) {
    std::uint16_t left = 0;
    for (int u = 0; u < map.width(); ++u, ++i) {
      const std::uint16_t code = codes.code(map(u, v));
      const auto difference = std::uint16_t(code - left);
      bytes[i] = char(difference >> 8);
      bytes[map.size() + i] = char(difference & 0xff);
      left = code;
    }
  }
  return gzipped(bytes);
}

std::string packed_shares(const FloatMap& map) {
  std::string bytes(map.size(), '\0');
  std::size_t i = 0;
  for (int v = 0; v < map.height(); ++v) {
    std::uint8_t left = 0;
    for (int u = 0; u < map.width(); ++u, ++i) {
      const float share = map(u, v);
      const auto code = std::isnan(share)
                            ? std::uint8_t(0)
                            : std::uint8_t(std::lround(255 * std::clamp(share, 0.f, 1.f)));
      bytes[i] = char(std::uint8_t(code - left));
      left = code;
    }
  }
  return gzipped(bytes);
}

FloatMap picked(const FloatMap& map, int width, int height) {
  if (map.width() == width && map.height() == height) return map;
  FloatMap result(width, height);
  const auto nearest = [](int i, int size, int full) {
    return std::min(full - 1, int((i + 0.5) * full / size));
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      result(u, v) = map(nearest(u, width, map.width()), nearest(v, height, map.height()));
  return result;
}

}  // namespace gigaray
