// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/adapters/reader.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// How well an input fits a reader.
struct ProbeResult {
  /// 0: not this format. Otherwise the reader with the highest score opens the input: 10 for loose
  /// evidence (numbered pictures), 50 for a pattern of names, 90 for a file of this very format.
  int score = 0;
  /// What is missing, when the score is 0: the end of a sentence about the input. May be empty.
  std::string why_not;
};

/// One input format. Readers have no state.
///
/// To add one: a class in adapters/src/FORMAT_reader.cpp with a maker in src/readers.h, a line in
/// src/registry.cpp, a section in docs/formats.md, a test in tests/adapters.
class Reader {
 public:
  virtual ~Reader() = default;
  virtual std::string name() const = 0;
  /// Looks at names and at most one small file; never throws for what an input contains.
  virtual ProbeResult probe(const std::filesystem::path& input) const = 0;
  /// Called when probe() gave a score. Errors as open_light_field().
  virtual LightField open(const std::filesystem::path& input, const OpenOptions& options) const = 0;
};

/// All readers; of two with the same score the earlier one wins.
const std::vector<std::unique_ptr<const Reader>>& readers();

}  // namespace gigaray
