// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "gigaray/core/ray_sampler.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/samplers/any_sampler.h"
#include "memory_plan.h"

namespace gigaray {

/// Rows of one level that a partition has to do with. Each lies within those below it; what is
/// beyond `own` is worked out again instead of being waited for.
struct PartitionRows {
  RowRange own;       ///< whose estimates it finds, keeps and gives to others
  RowRange swept;     ///< that some stage of the sweep over a view looks at for those
  RowRange todo;      ///< where it has to know what is to do
  RowRange unpacked;  ///< whose estimates of before tell that
  RowRange pixels;    ///< of any view: what its rays reach
  bool operator==(const PartitionRows&) const = default;
};

/// How the rows of all levels are shared out among `partitions`, [partition][level]. Of one
/// partition everything is all rows. There are fewer where a level has too few rows for so many.
/// refs: the views that get depth.
std::vector<std::vector<PartitionRows>> partition_rows(
    const MemoryPlan& plan, const DepthOptions& options, const AnySampler& sampler,
    const HypothesisRange& hypotheses, const std::vector<int>& refs, int partitions);

/// Rows of one level that partitions bring each other. They lie where the functions say.
struct BroughtRows {
  RowRange own;               ///< what this partition has
  RowRange wanted;            ///< what it wants; of that, what others have is brought
  std::size_t row_bytes = 0;  ///< the same for all
  std::function<void(RowRange, std::byte*)> read;
  std::function<void(RowRange, const std::byte*)> write;
};

/// One of the parties that work on the rows of a run, and what passes between them. All make the
/// same calls in the same order; each call waits for the others.
class Partition {
 public:
  virtual ~Partition() = default;
  virtual int index() const = 0;
  virtual int count() const = 0;
  virtual void bring(const BroughtRows& rows) = 0;
  virtual long sum(long value) = 0;  ///< over all
  /// One after the other, the first one first.
  virtual void in_turn(const std::function<void()>& job) = 0;
};

/// Runs job in `count` threads, of which this is the first, each as one partition. When one throws,
/// the others are left at their next call, and what it threw is thrown here.
void run_partitions(int count, const std::function<void(Partition&)>& job);

}  // namespace gigaray
