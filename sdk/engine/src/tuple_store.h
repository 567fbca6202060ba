// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gigaray/core/scratch_file.h"
#include "gigaray/engine/reconstruct.h"

namespace gigaray {

/// Tuples in the order they came, view after view; those that don't fit into some memory go to a
/// file without a name.
class TupleStore {
 public:
  /// folder: for the file; empty keeps all tuples in memory.
  explicit TupleStore(std::string folder) : folder_(std::move(folder)) {}

  void append(const std::vector<RayTuple>& tuples);
  /// What comes from now on is of the next view.
  void begin_view() { begins_.push_back(size()); }
  std::size_t size() const { return spilled_ + kBlock * full_.size() + recent_.size(); }
  int num_views() const { return int(begins_.size()); }
  /// Those of the i-th view.
  void for_each(int i, const std::function<void(const RayTuple&)>& visit) const;

 private:
  /// Tuples that are spilled together, or kept in one piece: no vector is ever copied to grow.
  static constexpr std::size_t kBlock = 1 << 16;

  void append(const RayTuple& tuple);

  std::string folder_;
  std::size_t spilled_ = 0;
  ScratchFile file_;
  std::vector<std::vector<RayTuple>> full_;  ///< without a folder
  std::vector<RayTuple> recent_;
  std::vector<std::size_t> begins_;  ///< of the views
};

/// Those of a run: of every view, what one partition has after the other.
class RunTuples {
 public:
  void add(TupleStore of_partition) { parts_.push_back(std::move(of_partition)); }
  std::size_t size() const;
  void for_each(const std::function<void(const RayTuple&)>& visit) const;

 private:
  std::vector<TupleStore> parts_;
};

}  // namespace gigaray
