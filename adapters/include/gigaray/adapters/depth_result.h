// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

#include "gigaray/adapters/reader.h"
#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// The output folder of `gigaray depth`, for what goes on from it: geometry and maps of the views
/// that have depth. Opening reads gigaray.json alone. Everything throws Error(kBadInput) naming the
/// file when it is missing, damaged or of another size.
class DepthResult {
 public:
  explicit DepthResult(const std::filesystem::path& folder);

  /// Kind, size, rig, places and cameras of the views as they were when depth was computed; no
  /// pixels.
  const LightField& light_field() const { return light_field_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Range of disparities (inverse depths) that was searched.
  DisparityRange searched() const { return searched_; }
  /// Number of hypotheses in it; 0: not stated.
  int hypotheses() const { return hypotheses_; }

  /// Index of the view whose maps stand at top level too: the centre view, or the one nearest to
  /// it that has depth.
  int top_view() const { return top_view_; }
  /// What depth was computed of; it may be gone.
  const std::filesystem::path& input() const { return input_; }

  /// (v, u) of the view, in the unit of ViewDepth; NaN: no estimate. Of an unstructured view as
  /// large as its own camera.
  FloatMap disparity(int view) const { return map(view, "disparity.pfm"); }
  FloatMap confidence(int view) const { return map(view, "confidence.pfm"); }

  /// The light field with its pictures. Of unstructured views they lie in the folder; of others
  /// they are those of `input`, or, when that is empty, of what depth was computed of.
  LightField with_pictures(const std::filesystem::path& input = {}) const;

  /// `input`, or when that is empty what depth was computed of, in the size of the maps and opened
  /// with what was said of it then: all its views, also those that were left out.
  LightField open_input(const std::filesystem::path& input = {}) const;

 private:
  FloatMap map(int view, const char* name) const;

  std::filesystem::path folder_, input_;
  OpenOptions opened_with_;
  LightField light_field_;
  DisparityRange searched_;
  int hypotheses_ = 0, top_view_ = 0;
};

/// A camera of a JSON file: the object "camera" in it, or the whole file, as in gigaray.json of
/// `gigaray depth`. Throws Error(kBadInput) naming the file.
Camera read_camera(const std::filesystem::path& path);

}  // namespace gigaray
