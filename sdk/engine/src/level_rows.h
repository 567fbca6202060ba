// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "row_store.h"
#include "workspace.h"

namespace gigaray {

/// Where what is kept of a run lies.
enum class Place {
  kDevice,  ///< in the memory of the device
  kHost,    ///< in the host's: rows are brought to the device when steps want them
  kFile     ///< in files
};

/// Some rows of some views of one level side by side: [v][view][…]. On the device, or in a RowStore
/// from where some rows at a time are brought. Zero at first.
class LevelRows {
 public:
  LevelRows() = default;
  /// view_bytes: of a row of one view. folder: for files.
  LevelRows(Workspace& workspace, RowRange rows, int views, std::size_t view_bytes, Place place,
            const std::string& folder);
  /// Of all rows of a level, [v][view][…], which nobody writes any more, those that are wanted.
  LevelRows(Workspace& workspace, std::shared_ptr<RowStore> store, RowRange wanted, int views,
            Place place);

  bool empty() const { return rows_.size() == 0; }
  int views() const { return views_; }
  std::size_t row_bytes() const { return std::size_t(views_) * view_bytes_; }
  bool on_device() const { return memory_ != nullptr; }

  /// Rows of all views.
  RowsOnDevice open(RowRange rows);
  /// Rows of some views, ascending; at: where they lie among what is stored.
  RowsOnDevice open(RowRange rows, const std::vector<int>& views, std::vector<int>& at);
  /// One row in 1 << shift of some views, and one byte of it: of rows, and bytes, of a coarser
  /// level. Not of rows on the device.
  RowsOnDevice open_coarse(RowRange rows, int shift, const std::vector<int>& views,
                           std::vector<int>& at);
  /// Rows of one view.
  ViewRows open_view(RowRange rows, int view);
  /// Ends what open() or open_view() began, when the rows were changed.
  void close(RowRange rows, const RowsOnDevice& opened);
  void close(RowRange rows, const std::vector<int>& views, const RowsOnDevice& opened);
  void close(RowRange rows, int view, const ViewRows& opened) { close(rows, {view}, opened.rows); }

  /// Rows of all views to and from the host's memory. Waits.
  void read(RowRange rows, std::byte* out);
  void write(RowRange rows, const std::byte* in);

 private:
  RowsOnDevice stage(RowRange rows, std::size_t views, std::size_t view_bytes);

  Workspace* workspace_ = nullptr;
  RowRange rows_;
  int views_ = 0;
  std::size_t view_bytes_ = 0;
  std::shared_ptr<Memory> memory_;  ///< of the rows from memory_begin_; null: they are in the store
  int memory_begin_ = 0;
  std::shared_ptr<RowStore> store_;  ///< of the rows from store_begin_
  int store_begin_ = 0;
  std::shared_ptr<Memory> staged_;  ///< the rows that are open
};

}  // namespace gigaray
