// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tuple_store.h"

#include <algorithm>
#include <utility>

namespace gigaray {

void TupleStore::append(const std::vector<RayTuple>& tuples) {
  for (const RayTuple& tuple : tuples) append(tuple);
}

void TupleStore::append(const RayTuple& tuple) {
  recent_.reserve(kBlock);
  recent_.push_back(tuple);
  if (recent_.size() < kBlock) return;
  if (folder_.empty()) {
    full_.push_back(std::move(recent_));
  } else {
    if (!file_.is_open()) file_ = ScratchFile(folder_);
    file_.write(spilled_ * sizeof(RayTuple), recent_.size() * sizeof(RayTuple), recent_.data());
    spilled_ += recent_.size();
  }
  recent_.clear();
}

void TupleStore::for_each(int i, const std::function<void(const RayTuple&)>& visit) const {
  const std::size_t end = i + 1 < num_views() ? begins_[i + 1] : size();
  std::size_t at = begins_.at(i);
  std::vector<RayTuple> block(4096);
  while (at < std::min(end, spilled_)) {
    block.resize(std::min(std::min(end, spilled_) - at, block.size()));
    file_.read(at * sizeof(RayTuple), block.size() * sizeof(RayTuple), block.data());
    for (const RayTuple& tuple : block) visit(tuple);
    at += block.size();
  }
  for (; at < end; ++at) {
    const std::size_t kept = at - spilled_;
    visit(kept / kBlock < full_.size() ? full_[kept / kBlock][kept % kBlock]
                                       : recent_[kept - full_.size() * kBlock]);
  }
}

std::size_t RunTuples::size() const {
  std::size_t size = 0;
  for (const TupleStore& part : parts_) size += part.size();
  return size;
}

void RunTuples::for_each(const std::function<void(const RayTuple&)>& visit) const {
  for (int i = 0; !parts_.empty() && i < parts_.front().num_views(); ++i)
    for (const TupleStore& part : parts_) part.for_each(i, visit);
}

}  // namespace gigaray
