// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/lane_kernel.h"

namespace gigaray::opencl {

std::vector<int> pack_sparse_blocks(RowRange rows, int lanes, StripMap<std::uint8_t>& todo) {
  std::vector<int> alone_v, alone_u;
  for (int v = rows.begin; v < rows.end; ++v) {
    std::uint8_t* row = todo.row(v);
    for (int begin = 0; begin < todo.width(); begin += lanes) {
      const int end = std::min(begin + lanes, todo.width());
      const auto count = end - begin - std::count(row + begin, row + end, 0);
      if (count == 0 || 2 * count >= lanes) continue;
      for (int u = begin; u < end; ++u)
        if (row[u]) {
          alone_v.push_back(v - rows.begin);
          alone_u.push_back(u);
        }
      std::fill(row + begin, row + end, 0);
    }
  }
  std::vector<int> packed;
  for (std::size_t i = 0; i < alone_u.size(); i += lanes)
    for (const std::vector<int>* values : {&alone_v, &alone_u})
      for (std::size_t lane = i; lane < i + lanes; ++lane)
        packed.push_back((*values)[std::min(lane, values->size() - 1)]);  // the last pixel again
  return packed;
}

}  // namespace gigaray::opencl
