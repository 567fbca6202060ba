// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "gigaray/engine/reconstruct.h"
#include "gigaray/workflows/input.h"

namespace gigaray {

/// A camera in the convention of docs/conventions.md.
nlohmann::ordered_json json_of(const Camera& camera);

/// Share of pixels that each level decided.
class Coverage {
 public:
  explicit Coverage(int levels) : counts_(levels + 1) {}
  void add(const ViewDepth& depth);
  nlohmann::ordered_json json() const;

 private:
  std::vector<double> counts_;  ///< [0]: no estimate
  double total_ = 0;
};

/// What gigaray.json of a depth folder says of views that are written (docs/formats.md).
struct WrittenViews {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  Coverage all, of_top;
  double min_confidence = 0;
  double kept = 1;  ///< share of the pixels that have an estimate, with min_confidence
  int top = 0;      ///< view whose maps stand at top level
};

/// The view whose maps stand at top level: the centre view, without it the one nearest to it.
int top_view_of(const LightField& light_field, const std::vector<int>& active);

nlohmann::ordered_json depth_record(const OpenedInput& input, const Reconstruction& result,
                                    const WrittenViews& written, double seconds);

}  // namespace gigaray
