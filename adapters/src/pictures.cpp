// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pictures.h"

#include "gigaray/adapters/atomic_output.h"
#include "png_bytes.h"

namespace gigaray {

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& picture,
               int bit_depth) {
  write_file_atomically(path, png_bytes(picture, bit_depth));
}

}  // namespace gigaray
