// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>

#include "gigaray/core/error.h"
#include "gigaray/core/ray_sampler.h"

namespace gigaray {

/// Which rows a band holds, and where: row v in slot v % slots. Rows that come take the place of
/// those farthest behind, and the others stay where they are.
struct BandRing {
  RowRange rows;
  int slots = 0;

  int slot(int v) const { return v % slots; }

  /// The rows to load so that it holds those that are wanted. The last rows it has are among them:
  /// the gradients of the last one lacked a neighbour, and the colours of the one before, which it
  /// takes, may have been masked since.
  RowRange missing(RowRange wanted) const {
    constexpr int kAnew = 2;
    if (wanted.begin >= rows.begin && wanted.end <= rows.end) return {wanted.end, wanted.end};
    const bool goes_on =
        wanted.begin >= rows.begin && wanted.begin < rows.end - kAnew && wanted.size() <= slots;
    return {goes_on ? rows.end - kAnew : wanted.begin, wanted.end};
  }

  /// fresh: what is loaded of the wanted rows; all of them, or what is missing. Returns those of
  /// them that want gradients.
  RowRange load(RowRange wanted, RowRange fresh) {
    const bool goes_on = fresh.begin > wanted.begin;
    GIGARAY_CHECK(fresh.end == wanted.end && (!goes_on || fresh.begin == missing(wanted).begin));
    slots = std::max(slots, wanted.size());
    rows = {goes_on ? std::max(rows.begin, wanted.end - slots) : wanted.begin, wanted.end};
    return {fresh.begin + goes_on, fresh.end};
  }
};

}  // namespace gigaray
