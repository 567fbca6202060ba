// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gigaray/reconstruct.h"
#include "gigaray/scratch_file.h"

namespace gigaray {

/// Tuples in the order they came; those that don't fit into some memory go to a file without a
/// name.
class TupleStore {
 public:
  /// folder: for the file; empty keeps all tuples in memory.
  explicit TupleStore(std::string folder) : folder_(std::move(folder)) {}

  void append(const RayTuple& tuple);
  std::size_t size() const { return spilled_ + recent_.size(); }
  void for_each(const std::function<void(const RayTuple&)>& visit) const;

 private:
  static constexpr std::size_t kRecent = 1 << 20;  ///< Tuples in memory before they are spilled.

  std::string folder_;
  std::size_t spilled_ = 0;
  ScratchFile file_;
  std::vector<RayTuple> recent_;
};

}  // namespace gigaray
