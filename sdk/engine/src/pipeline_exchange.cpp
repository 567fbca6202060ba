// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What a partition needs of others, and what it gives them.
#include <algorithm>

#include "pipeline.h"

namespace gigaray {

void Pipeline::bring_rows(LevelRows& rows, int level, RowRange wanted) {
  // Some at a time: those of all views may be more than the plan leaves room for.
  constexpr std::size_t kBytesAtOnce = 64 << 20;
  const int height = plan_.levels[level].shape.height;
  const int at_once = int(std::clamp<std::size_t>(kBytesAtOnce / rows.row_bytes(), 1, height));
  for (int v = 0; v < height; v += at_once)
    partition_->bring({rows_of(level).own, overlap(wanted, {v, std::min(v + at_once, height)}),
                       rows.row_bytes(),
                       [&](RowRange part, std::byte* out) { rows.read(part, out); },
                       [&](RowRange part, const std::byte* in) { rows.write(part, in); }});
}

bool Pipeline::do_rays_stay(int level) const {
  const int height = plan_.levels[level].shape.height;
  return std::visit(
      [&](const auto& sampler) {
        const auto of_level = sampler.at_level(level);
        for (const std::vector<PartitionRows>& rows : rows_)
          for (const int view : active_)
            if (of_level.rows_needed(view, rows[level].own, hypotheses_, height) != rows[level].own)
              return false;
        return true;
      },
      sampler_);
}

RowRange Pipeline::rows_reaching(int view, RowRange reached) const {
  if (rays_stay()) return reached;
  constexpr int kBlock = 16;
  RowRange rows{shape().height, 0};
  for (int v = 0; v < shape().height; v += kBlock) {
    const RowRange block{v, std::min(v + kBlock, shape().height)};
    if (overlap(rows_needed(view, block), reached).size() == 0) continue;
    rows = {std::min(rows.begin, block.begin), block.end};
  }
  return rows;
}

void Pipeline::propagate_to_others(int active_idx) {
  if (rays_stay()) return;  // they arrived as they were accepted
  const int view = active_[active_idx];
  const RowRange from = rows_reaching(view, rows().own);
  workspace_.begin_stage("propagate");
  bring_map(of_view_.accepted, from);
  bring_map(of_view_.confidence, from);
  bring_map(of_view_.radiance, from);
  for (const RowRange band : bands(from)) {
    const RowRange reached = overlap(rows_needed(view, band), rows().own);
    if (reached.size() == 0) continue;
    load_rows(partners_[view], reached, true);
    propagate(active_idx, band);
  }
}

}  // namespace gigaray
