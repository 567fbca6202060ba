// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "level_rows.h"

#include <span>
#include <utility>

#include "gigaray/ray_sampler.h"

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
  memory_ = workspace.adopt(store_.bytes());
  if (!workspace.shares_host_memory()) store_ = RowStore();
}

RowsOnDevice LevelRows::stage(RowRange rows, std::size_t views, std::size_t view_bytes) {
  const std::size_t bytes = std::size_t(rows.size()) * views * view_bytes;
  if (!staged_ || staged_->bytes() < bytes) {
    staged_.reset();
    staged_ = workspace_->allocate(bytes);
  }
  return {staged_, rows.begin, int(views)};
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
  const RowsOnDevice opened = stage(rows, views_, view_bytes_);
  const Mapped mapped(*workspace_, *opened.memory, true);
  for (int v = rows.begin; v < rows.end; ++v)
    store_.read(v, 0, store_.row_bytes(),
                mapped.data() + std::size_t(v - rows.begin) * store_.row_bytes());
  return opened;
}

RowsOnDevice LevelRows::open(RowRange rows, const std::vector<int>& views, std::vector<int>& at) {
  at = views;
  if (memory_ || int(views.size()) == views_) return open(rows);
  const RowsOnDevice opened = stage(rows, views.size(), view_bytes_);
  const Mapped mapped(*workspace_, *opened.memory, true);
  std::byte* out = mapped.data();
  for (int v = rows.begin; v < rows.end; ++v)
    for (const int view : views) {
      store_.read(v, view * view_bytes_, view_bytes_, out);
      out += view_bytes_;
    }
  at = all_views(int(views.size()));
  return opened;
}

RowsOnDevice LevelRows::open_coarse(RowRange rows, int shift, const std::vector<int>& views,
                                    std::vector<int>& at) {
  GIGARAY_CHECK(!memory_);
  at = all_views(int(views.size()));
  const std::size_t coarse_bytes = ((view_bytes_ - 1) >> shift) + 1;
  const RowsOnDevice opened = stage(rows, views.size(), coarse_bytes);
  const Mapped mapped(*workspace_, *opened.memory, true);
  std::byte* out = mapped.data();
  std::vector<std::byte> line(view_bytes_);
  for (int v = rows.begin; v < rows.end; ++v)
    for (const int view : views) {
      store_.read(v << shift, view * view_bytes_, view_bytes_, line.data());
      for (std::size_t i = 0; i < coarse_bytes; ++i) *out++ = line[i << shift];
    }
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

void LevelRows::close(RowRange rows, const std::vector<int>& views, const RowsOnDevice& opened) {
  if (memory_) return;
  if (int(views.size()) == views_) return close(rows, opened);
  const Mapped mapped(*workspace_, *opened.memory, false);
  const std::byte* in = mapped.data();
  for (int v = rows.begin; v < rows.end; ++v)
    for (const int view : views) {
      store_.write(v, view * view_bytes_, view_bytes_, in);
      in += view_bytes_;
    }
}

}  // namespace gigaray
