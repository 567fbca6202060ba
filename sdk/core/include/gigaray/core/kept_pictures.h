// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Decoded pictures of one run, so that those that look at a light field one after the other
/// (layout, direction, range, noise, depth itself) decode each picture once. They take 8 or 16 bit
/// per value; one that there is no more room for is decoded again when it is read again.
/// Thread-safe.
class KeptPictures {
 public:
  /// memory_bytes: most that the run may take, of which pictures get a third of what the program
  /// itself leaves; 0: default_memory_limit(), asked for with the first picture.
  explicit KeptPictures(double memory_bytes = 0);
  /// Most that pictures take under this limit; 0: default_memory_limit().
  static double most_bytes(double memory_bytes);
  ~KeptPictures();
  KeptPictures(const KeptPictures&) = delete;
  KeptPictures& operator=(const KeptPictures&) = delete;

  /// `pixels`, each picture kept once read, until it is let go (PixelSource::let_go). keys: one per
  /// view, the same for the same picture of two sources and for no other. What is held in memory
  /// anyway is given back as it is, as is everything without `kept`.
  static std::shared_ptr<const PixelSource> over(std::shared_ptr<KeptPictures> kept,
                                                 std::shared_ptr<const PixelSource> pixels,
                                                 std::vector<std::string> keys);
  /// The light field over such a source, with keys that no other has.
  static LightField over(std::shared_ptr<KeptPictures> kept, LightField light_field);

  double bytes() const;     ///< held now
  int num_decoded() const;  ///< pictures that were read from what is beneath, each time counted

 private:
  struct Impl;
  class Source;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gigaray
