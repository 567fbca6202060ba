// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

// Float maps in files: one value per pixel, rows from top to bottom in memory, NaN where there is
// none. Every writer puts the whole file in place or nothing and throws Error(kIo) naming the
// place. Every reader throws Error(kBadInput) naming the file when it is damaged, Error(kIo) when
// it can't be opened.

/// By extension: .pfm, .npy or .exr.
FloatMap read_float_map(const std::filesystem::path& path);

/// PFM with one channel ("Pf"), either byte order; the scale's magnitude is ignored. NaN and
/// infinities are kept. Written in little endian.
FloatMap read_pfm(const std::filesystem::path& path);
void write_pfm(const std::filesystem::path& path, const FloatMap& map);

/// NumPy array of shape (v, u): float32 or float64 is read, either byte order, C order; float32 in
/// little endian is written.
FloatMap read_npy(const std::filesystem::path& path);
void write_npy(const std::filesystem::path& path, const FloatMap& map);

/// OpenEXR with one channel, 32-bit float when written.
FloatMap read_exr(const std::filesystem::path& path);
void write_exr(const std::filesystem::path& path, const FloatMap& map);

/// What a sample of a 16-bit PNG stands for: value = offset + scale · sample; sample 0 is NaN.
struct Png16Scale {
  double offset = 0;
  double scale = 1;
};

/// 16-bit grey PNG: range.min becomes 1, range.max becomes 65535, values outside are clamped, NaN
/// becomes 0.
Png16Scale write_png16(const std::filesystem::path& path, const FloatMap& map,
                       DisparityRange range);

/// 8-bit RGB PNG to look at: blue at range.min, red (near) at range.max, black where there is NaN.
void write_depth_picture(const std::filesystem::path& path, const FloatMap& map,
                         DisparityRange range);

}  // namespace gigaray
