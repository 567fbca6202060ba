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

void TupleStore::for_each(const std::function<void(const RayTuple&)>& visit) const {
  std::vector<RayTuple> block(4096);
  for (std::size_t done = 0; done < spilled_; done += block.size()) {
    block.resize(std::min(spilled_ - done, block.size()));
    file_.read(done * sizeof(RayTuple), block.size() * sizeof(RayTuple), block.data());
    for (const RayTuple& tuple : block) visit(tuple);
  }
  for (const std::vector<RayTuple>& block : full_)
    for (const RayTuple& tuple : block) visit(tuple);
  for (const RayTuple& tuple : recent_) visit(tuple);
}

}  // namespace gigaray
