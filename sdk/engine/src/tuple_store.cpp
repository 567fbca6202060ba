// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tuple_store.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace gigaray {

void TupleStore::append(const RayTuple& tuple) {
  recent_.push_back(tuple);
  if (folder_.empty() || recent_.size() < kRecent) return;
  if (!file_) {
    std::string name = folder_ + "/gigaray-XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor >= 0) unlink(name.c_str());
    if (std::FILE* file = descriptor >= 0 ? fdopen(descriptor, "w+b") : nullptr)
      file_ = {file, std::fclose};
  }
  if (!file_ ||
      std::fwrite(recent_.data(), sizeof(RayTuple), recent_.size(), file_.get()) != recent_.size())
    throw Error(ErrorCode::kIo,
                folder_ + ": can't write intermediate data: " + std::strerror(errno));
  spilled_ += recent_.size();
  recent_.clear();
}

void TupleStore::for_each(const std::function<void(const RayTuple&)>& visit) const {
  if (file_) {
    std::rewind(file_.get());
    std::vector<RayTuple> block(4096);
    for (std::size_t left = spilled_; left > 0;) {
      const std::size_t count = std::min(left, block.size());
      if (std::fread(block.data(), sizeof(RayTuple), count, file_.get()) != count)
        throw Error(ErrorCode::kIo, folder_ + ": can't read intermediate data");
      for (std::size_t i = 0; i < count; ++i) visit(block[i]);
      left -= count;
    }
    std::fseek(file_.get(), 0, SEEK_END);
  }
  for (const RayTuple& tuple : recent_) visit(tuple);
}

}  // namespace gigaray
