// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "level_rows.h"

#include <span>
#include <utility>

#include "gigaray/core/ray_sampler.h"

namespace gigaray {

LevelRows::LevelRows(Workspace& workspace, RowRange rows, int views, std::size_t view_bytes,
                     Place place, const std::string& folder)
    : workspace_(&workspace),
      rows_(rows),
      views_(views),
      view_bytes_(view_bytes),
      memory_begin_(rows.begin),
      store_begin_(rows.begin) {
  if (place == Place::kDevice)
    memory_ = workspace.allocate(std::size_t(rows.size()) * row_bytes());
  else
    store_ =
        std::make_shared<RowStore>(rows.size(), row_bytes(), place == Place::kFile ? folder : "");
}

LevelRows::LevelRows(Workspace& workspace, std::shared_ptr<RowStore> store, RowRange wanted,
                     int views, Place place)
    : workspace_(&workspace),
      rows_(wanted),
      views_(views),
      view_bytes_(store->row_bytes() / std::size_t(views)),
      store_(std::move(store)) {
  if (place != Place::kDevice) return;
  const std::span<std::byte> all = store_->bytes();
  if (workspace.shares_host_memory()) {
    memory_ = workspace.adopt(all);
    return;
  }
  memory_begin_ = wanted.begin;
  memory_ = workspace.adopt(
      all.subspan(std::size_t(wanted.begin) * row_bytes(), wanted.size() * row_bytes()));
  store_.reset();
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
  GIGARAY_CHECK(rows.begin >= rows_.begin && rows.end <= rows_.end);
  if (memory_) return {memory_, memory_begin_, views_};
  const RowsOnDevice opened = stage(rows, views_, view_bytes_);
  const Mapped mapped(*workspace_, *opened.memory, true);
  for (int v = rows.begin; v < rows.end; ++v)
    store_->read(v - store_begin_, 0, row_bytes(),
                 mapped.data() + std::size_t(v - rows.begin) * row_bytes());
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
      store_->read(v - store_begin_, view * view_bytes_, view_bytes_, out);
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
      store_->read((v << shift) - store_begin_, view * view_bytes_, view_bytes_, line.data());
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
    store_->write(v - store_begin_, 0, row_bytes(),
                  mapped.data() + std::size_t(v - rows.begin) * row_bytes());
}

void LevelRows::close(RowRange rows, const std::vector<int>& views, const RowsOnDevice& opened) {
  if (memory_) return;
  if (int(views.size()) == views_) return close(rows, opened);
  const Mapped mapped(*workspace_, *opened.memory, false);
  const std::byte* in = mapped.data();
  for (int v = rows.begin; v < rows.end; ++v)
    for (const int view : views) {
      store_->write(v - store_begin_, view * view_bytes_, view_bytes_, in);
      in += view_bytes_;
    }
}

void LevelRows::read(RowRange rows, std::byte* out) {
  const std::size_t bytes = row_bytes();
  if (memory_)
    return workspace_->read(*memory_, {out, rows.size() * bytes},
                            std::size_t(rows.begin - memory_begin_) * bytes);
  for (int v = rows.begin; v < rows.end; ++v, out += bytes)
    store_->read(v - store_begin_, 0, bytes, out);
}

void LevelRows::write(RowRange rows, const std::byte* in) {
  const std::size_t bytes = row_bytes();
  if (memory_)
    return workspace_->write(*memory_, {in, rows.size() * bytes},
                             std::size_t(rows.begin - memory_begin_) * bytes);
  for (int v = rows.begin; v < rows.end; ++v, in += bytes)
    store_->write(v - store_begin_, 0, bytes, in);
}

}  // namespace gigaray
