// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pictures.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "gigaray/adapters/atomic_output.h"
#include "png_bytes.h"

namespace gigaray {

std::string png_bytes(const cv::Mat& bgr) {
  std::vector<unsigned char> bytes;
  GIGARAY_CHECK(cv::imencode(".png", bgr, bytes));
  return {bytes.begin(), bytes.end()};
}

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& picture,
               int bit_depth) {
  GIGARAY_CHECK(bit_depth == 8 || bit_depth == 16);
  GIGARAY_CHECK(!picture.empty() && (picture.channels() == 1 || picture.channels() == 3));
  const cv::Mat view(picture.height(), picture.width(), CV_16UC(picture.channels()),
                     const_cast<std::uint16_t*>(picture.data()));
  cv::Mat encoded;
  view.convertTo(encoded, bit_depth == 8 ? CV_8U : CV_16U);
  if (picture.channels() == 3) cv::cvtColor(encoded, encoded, cv::COLOR_RGB2BGR);
  write_file_atomically(path, png_bytes(encoded));
}

}  // namespace gigaray
