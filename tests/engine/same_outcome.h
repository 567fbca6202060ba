// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/parity_bench.h"

namespace gigaray::testing_support {

/// What a step left, as bits; all NaNs are one.
class Outcome {
 public:
  template <class T>
  Outcome& add(const char* what, HostSteps& steps, const Map<T>& map, RowRange rows) {
    const StripMap<T> values = steps.workspace().get(map);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < values.width(); ++u)
        values_.push_back({what, u, v, bits_of(values.row(v)[u])});
    return *this;
  }
  /// Rows of views or a list: u counts from the beginning.
  template <class T>
  Outcome& add(const char* what, const std::vector<T>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values_.push_back({what, int(i), 0, bits_of(values[i])});
    return *this;
  }
  template <class T>
  Outcome& add(const char* what, HostSteps& steps, const RowsOnDevice& rows) {
    std::vector<T> values(rows.memory->bytes() / sizeof(T));
    steps.down(rows, values);
    return add(what, values);
  }

  /// The first value that is not the same; empty: all are.
  std::string difference(const Outcome& actual) const {
    if (values_.size() != actual.values_.size()) return "another number of values";
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Value &a = values_[i], &b = actual.values_[i];
      if (a.bits != b.bits)
        return std::string(a.what) + " at " + std::to_string(a.u) + ", " + std::to_string(a.v) +
               ": " + text_of(a.bits) + " expected, not " + text_of(b.bits);
    }
    return "";
  }
  /// Values that are not all alike: a step that does nothing must not pass.
  bool varies() const {
    return std::any_of(values_.begin(), values_.end(),
                       [this](const Value& value) { return value.bits != values_[0].bits; });
  }

 private:
  struct Value {
    const char* what;
    int u, v;
    std::uint64_t bits;
  };
  static std::uint64_t bits_of(float x) {
    return std::bit_cast<std::uint32_t>(std::isnan(x) ? kNoEstimate : x);
  }
  static std::uint64_t bits_of(HypothesisBounds x) { return std::uint64_t(x.first) << 16 | x.last; }
  template <class T>
  static std::uint64_t bits_of(T x) {
    static_assert(std::is_integral_v<T>);
    return std::uint64_t(x);
  }
  static std::string text_of(std::uint64_t bits) {
    return std::to_string(bits) + " (" + std::to_string(std::bit_cast<float>(std::uint32_t(bits))) +
           ")";
  }

  std::vector<Value> values_;
};

/// step: HostSteps& → Outcome, called with the same maps of the host on both workspaces.
template <class S, class Step>
void expect_same(ParityBench<S>& bench, Step step) {
  const Outcome expected = step(*bench.reference);
  EXPECT_EQ(expected.difference(step(*bench.opencl)), "")
      << bench.width() << " x " << bench.height() << ", rows " << bench.rows().begin << " to "
      << bench.rows().end;
  EXPECT_TRUE(bench.width() < 90 || expected.varies()) << "nothing was done";
}

}  // namespace gigaray::testing_support
