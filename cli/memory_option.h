// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gigaray::cli {

/// Bytes that the program takes before it holds a picture, its libraries included.
inline constexpr double kProgramBytes = 112 * double(1 << 20);

/// --memory of a command that tells from sizes alone what it will take, and refuses before the work
/// what doesn't fit.
class MemoryBudget {
 public:
  explicit MemoryBudget(double gib = 0) : gib_(gib) {}

  /// takes: roughly, for --help: "about 40 bytes per pixel of a picture".
  void add_to(CLI::App& app, const std::string& takes);

  /// What the command may take, bytes: as stated, else default_memory_limit(). The same at every
  /// call.
  double bytes() const;

  /// Throws Error(kOutOfMemory) when `needed` bytes, those of the program included, are more than
  /// that; names the least limit that will do. what: "25 views of 640 x 480 px".
  void require(double needed, const std::string& what) const;

 private:
  double gib_ = 0;
  mutable double usual_ = 0;
};

/// "25 views of 640 x 480 px", for MemoryBudget::require().
std::string views_text(int num_views, int width, int height);

}  // namespace gigaray::cli
