// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/image_view.h"

#include <utility>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

template <class T>
class PixelsOfViews : public PixelSource {
 public:
  PixelsOfViews(std::vector<ImageView<const T>> pictures, std::shared_ptr<const void> owner)
      : pictures_(std::move(pictures)), owner_(std::move(owner)) {
    for (const ImageView<const T>& picture : pictures_) {
      require_argument(picture.data != nullptr, "pictures: one has no data");
      require_argument(picture.width >= 1 && picture.height >= 1, "pictures: one is empty");
      require_argument(picture.channels == 1 || picture.channels >= 3,
                       "pictures: must have 1 channel, or 3 and more");
      require_argument(picture.width == pictures_[0].width &&
                           picture.height == pictures_[0].height &&
                           picture.channels == pictures_[0].channels,
                       "pictures: must all have one size and number of channels");
    }
  }

  Image<std::uint16_t> read(int view_idx) const override {
    require_argument(view_idx >= 0 && std::size_t(view_idx) < pictures_.size(),
                     "view_idx: there is no picture of this view");
    const ImageView<const T>& from = pictures_[std::size_t(view_idx)];
    Image<std::uint16_t> picture(from.width, from.height, 3);
    for (int v = 0; v < from.height; ++v)
      for (int u = 0; u < from.width; ++u)
        for (int c = 0; c < 3; ++c) picture(u, v, c) = from(u, v, from.channels == 1 ? 0 : c);
    return picture;
  }
  int bit_depth() const override { return 8 * sizeof(T); }
  bool is_held() const override { return true; }

 private:
  std::vector<ImageView<const T>> pictures_;
  std::shared_ptr<const void> owner_;
};

}  // namespace

std::shared_ptr<const PixelSource> pixels_of_views(
    std::vector<ImageView<const std::uint8_t>> pictures, std::shared_ptr<const void> owner) {
  return std::make_shared<PixelsOfViews<std::uint8_t>>(std::move(pictures), std::move(owner));
}

std::shared_ptr<const PixelSource> pixels_of_views(
    std::vector<ImageView<const std::uint16_t>> pictures, std::shared_ptr<const void> owner) {
  return std::make_shared<PixelsOfViews<std::uint16_t>>(std::move(pictures), std::move(owner));
}

}  // namespace gigaray
