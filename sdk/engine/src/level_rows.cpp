// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "level_rows.h"

#include <span>
#include <utility>

namespace gigaray {

LevelRows::LevelRows(Workspace& workspace, int rows, int views, std::size_t view_bytes, Place place,
                     const std::string& folder)
    : workspace_(&workspace), rows_(rows), views_(views), view_bytes_(view_bytes) {
  if (place == Place::kDevice)
    memory_ = workspace.allocate(std::size_t(rows) * views * view_bytes);
  else
    store_ = RowStore(rows, views * view_bytes, place == Place::kFile ? folder : "");
}

LevelRows::LevelRows(Workspace& workspace, RowStore store, int rows, int views, Place place)
    : workspace_(&workspace),
      rows_(rows),
      views_(views),
      view_bytes_(store.row_bytes() / std::size_t(views)),
      store_(std::move(store)) {
  if (place != Place::kDevice) return;
  AlignedBytes unused;
  const std::span bytes(store_.open({0, rows}, unused), std::size_t(rows) * store_.row_bytes());
  memory_ = workspace.adopt(bytes);
  if (!workspace.shares_host_memory()) store_ = RowStore();
}

RowsOnDevice LevelRows::stage(RowRange rows, int views) {
  const std::size_t bytes = std::size_t(rows.size()) * views * view_bytes_;
  if (!staged_ || staged_->bytes() < bytes) {
    staged_.reset();
    staged_ = workspace_->allocate(bytes);
  }
  return {staged_, rows.begin, views};
}

namespace {

/// Memory as the host sees it.
class Mapped {
 public:
  Mapped(Workspace& workspace, Memory& memory, bool to_fill)
      : workspace_(workspace), memory_(memory), bytes_(workspace.map(memory, to_fill)) {}
  ~Mapped() {
    try {
      workspace_.unmap(memory_, bytes_);
    } catch (...) {  // shows again at the next step
    }
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  std::byte* data() const { return bytes_.data(); }

 private:
  Workspace& workspace_;
  Memory& memory_;
  std::span<std::byte> bytes_;
};

}  // namespace

RowsOnDevice LevelRows::open(RowRange rows) {
  if (memory_) return {memory_, 0, views_};
  const RowsOnDevice opened = stage(rows, views_);
  const Mapped mapped(*workspace_, *opened.memory, true);
  for (int v = rows.begin; v < rows.end; ++v)
    store_.read(v, 0, store_.row_bytes(),
                mapped.data() + std::size_t(v - rows.begin) * store_.row_bytes());
  return opened;
}

RowsOnDevice LevelRows::open(RowRange rows, const std::vector<int>& views, std::vector<int>& at) {
  at = views;
  if (memory_ || int(views.size()) == views_) return open(rows);
  const RowsOnDevice opened = stage(rows, int(views.size()));
  const Mapped mapped(*workspace_, *opened.memory, true);
  std::byte* out = mapped.data();
  for (int v = rows.begin; v < rows.end; ++v)
    for (const int view : views) {
      store_.read(v, view * view_bytes_, view_bytes_, out);
      out += view_bytes_;
    }
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = int(i);
  return opened;
}

ViewRows LevelRows::open_view(RowRange rows, int view) {
  std::vector<int> at;
  RowsOnDevice opened = open(rows, {view}, at);
  return {std::move(opened), at.front()};
}

void LevelRows::close(RowRange rows, const RowsOnDevice& opened) {
  if (memory_) return;
  const Mapped mapped(*workspace_, *opened.memory, false);
  for (int v = rows.begin; v < rows.end; ++v)
    store_.write(v, 0, store_.row_bytes(),
                 mapped.data() + std::size_t(v - rows.begin) * store_.row_bytes());
}

void LevelRows::close(RowRange rows, int view, const ViewRows& opened) {
  if (memory_) return;
  if (opened.rows.stored_views == views_) return close(rows, opened.rows);
  const Mapped mapped(*workspace_, *opened.rows.memory, false);
  for (int v = rows.begin; v < rows.end; ++v)
    store_.write(v, view * view_bytes_, view_bytes_,
                 mapped.data() + std::size_t(v - rows.begin) * view_bytes_);
}

}  // namespace gigaray
