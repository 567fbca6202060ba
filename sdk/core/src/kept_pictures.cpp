// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/kept_pictures.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>

#include "gigaray/core/arguments.h"
#include "gigaray/core/memory_limit.h"

namespace gigaray {
namespace {

/// Bytes in pages of their own, which go back to the system at once: a heap would keep them.
class Pages {
 public:
  explicit Pages(std::size_t size) : size_(size) {
    void* pages = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages != MAP_FAILED) data_ = static_cast<std::byte*>(pages);
  }
  ~Pages() {
    if (data_) munmap(data_, size_);
  }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  std::byte* data() const { return data_; }  ///< null: the system has none

 private:
  std::size_t size_;
  std::byte* data_ = nullptr;
};

/// A picture in as many bytes per value as its values have.
struct Packed {
  int width, height, channels, value_bytes;
  Pages pages;

  Packed(const Image<std::uint16_t>& picture, int value_bytes)
      : width(picture.width()),
        height(picture.height()),
        channels(picture.channels()),
        value_bytes(value_bytes),
        pages(picture.size() * std::size_t(value_bytes)) {
    if (!pages.data()) return;
    if (value_bytes == 1)
      std::copy(picture.begin(), picture.end(), reinterpret_cast<std::uint8_t*>(pages.data()));
    else
      std::copy(picture.begin(), picture.end(), reinterpret_cast<std::uint16_t*>(pages.data()));
  }

  double bytes() const { return double(width) * height * channels * value_bytes; }
  Image<std::uint16_t> picture() const {
    const std::size_t size = std::size_t(width) * height * channels;
    const auto image_of = [&](const auto* values) {
      return Image<std::uint16_t>(width, height, channels,
                                  std::vector<std::uint16_t>(values, values + size));
    };
    return value_bytes == 1 ? image_of(reinterpret_cast<const std::uint8_t*>(pages.data()))
                            : image_of(reinterpret_cast<const std::uint16_t*>(pages.data()));
  }
};

}  // namespace

struct KeptPictures::Impl {
  explicit Impl(double memory_bytes) : memory_bytes(memory_bytes) {}

  std::shared_ptr<const Packed> find(const std::string& key) const {
    const std::lock_guard lock(mutex);
    const auto found = pictures.find(key);
    return found == pictures.end() ? nullptr : found->second;
  }

  void keep(const std::string& key, const Image<std::uint16_t>& picture, int value_bytes) {
    const double needed = double(picture.size()) * value_bytes;
    {
      const std::lock_guard lock(mutex);
      if (!most) most = most_bytes(memory_bytes);
      if (bytes + needed > *most || pictures.contains(key)) return;
      bytes += needed;  // it is copied without the lock
    }
    const auto packed = std::make_shared<const Packed>(picture, value_bytes);
    const std::lock_guard lock(mutex);
    const bool is_kept = packed->pages.data() && pictures.emplace(key, packed).second;
    if (!is_kept) bytes -= needed;
  }

  void let_go(const std::string& key) {
    const std::lock_guard lock(mutex);
    const auto found = pictures.find(key);
    if (found == pictures.end()) return;
    bytes -= found->second->bytes();
    pictures.erase(found);
  }

  const double memory_bytes;
  mutable std::mutex mutex;
  std::optional<double> most;
  std::unordered_map<std::string, std::shared_ptr<const Packed>> pictures;
  double bytes = 0;
  std::atomic<int> num_decoded{0}, num_sources{0};
};

class KeptPictures::Source : public PixelSource {
 public:
  Source(std::shared_ptr<KeptPictures> kept, std::shared_ptr<const PixelSource> pixels,
         std::vector<std::string> keys)
      : kept_(std::move(kept)), pixels_(std::move(pixels)), keys_(std::move(keys)) {}

  Image<std::uint16_t> read(int view_idx) const override {
    Impl& kept = *kept_->impl_;
    const std::string& key = keys_.at(std::size_t(view_idx));
    if (const auto packed = kept.find(key)) return packed->picture();
    Image<std::uint16_t> picture = pixels_->read(view_idx);
    ++kept.num_decoded;
    kept.keep(key, picture, pixels_->bit_depth() / 8);
    return picture;
  }
  void let_go(int view_idx) const override {
    kept_->impl_->let_go(keys_.at(std::size_t(view_idx)));
  }
  bool is_held() const override { return true; }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return pixels_->bit_depth(); }

 private:
  std::shared_ptr<KeptPictures> kept_;
  std::shared_ptr<const PixelSource> pixels_;
  std::vector<std::string> keys_;
};

KeptPictures::KeptPictures(double memory_bytes) : impl_(std::make_unique<Impl>(memory_bytes)) {}
KeptPictures::~KeptPictures() = default;

double KeptPictures::most_bytes(double memory_bytes) {
  // The program with OpenCL takes about so much; what is made of the pictures takes the rest.
  constexpr double kProgram = 224 * double(1 << 20), kShare = 1.0 / 3;
  const double limit = memory_bytes > 0 ? memory_bytes : default_memory_limit();
  return std::max(kShare * (limit - kProgram), 0.0);
}

std::shared_ptr<const PixelSource> KeptPictures::over(std::shared_ptr<KeptPictures> kept,
                                                      std::shared_ptr<const PixelSource> pixels,
                                                      std::vector<std::string> keys) {
  require_argument(pixels != nullptr, "pixels: is null");
  if (!kept || pixels->is_held()) return pixels;
  return std::make_shared<Source>(std::move(kept), std::move(pixels), std::move(keys));
}

LightField KeptPictures::over(std::shared_ptr<KeptPictures> kept, LightField light_field) {
  if (!kept) return light_field;
  const std::string source = std::to_string(kept->impl_->num_sources++);
  std::vector<std::string> keys;
  for (int view = 0; view < light_field.num_views(); ++view)
    keys.push_back(source + ":" + std::to_string(view));
  light_field.pixels = over(std::move(kept), light_field.pixels, std::move(keys));
  return light_field;
}

double KeptPictures::bytes() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->bytes;
}

int KeptPictures::num_decoded() const { return impl_->num_decoded; }

}  // namespace gigaray
