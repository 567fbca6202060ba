// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/sparse/sparse_light_field.h"

namespace GIGARAY_API gigaray {

/// LightField::format of a .grl file.
inline constexpr const char* kSparseFormat = "sparse light field";

/// How a .grl file is written.
struct SparseFileOptions {
  /// Largest difference of a decoded value from the original, in steps of the bit depth; 0:
  /// lossless.
  int max_error = 0;
  /// Rows that decode by themselves; 0: as many as have 2^17 px, 16 at least.
  int band_rows = 0;
  SparseOptions sparse;
};

/// What was written.
struct SparseFileReport {
  std::uint64_t rays = 0;  ///< pixels of all views
  std::uint64_t tuples = 0;
  std::uint64_t unexplained = 0;  ///< rays that no tuple draws, for want of an estimate
  std::uint64_t rgb_bytes = 0;    ///< of all views without compression
  std::uint64_t tuple_bytes = 0;
  std::uint64_t difference_bytes = 0;
  std::uint64_t file_bytes = 0;
};

/// Writes a light field as tuples Γ and differences ΔE, whole or not at all (docs/formats.md).
/// disparity: of every view. Throws Error(kInvalidArgument) for options and for unstructured views,
/// Error(kIo) when the place can't be written, what the pictures throw, kCancelled.
SparseFileReport write_sparse_file(AtomicFile file, const LightField& light_field,
                                   const DisparityOfView& disparity,
                                   const SparseFileOptions& options, const RunControl& control);
/// The same; an older file is replaced, whoever wrote it.
inline SparseFileReport write_sparse_file(const std::filesystem::path& path,
                                          const LightField& light_field,
                                          const DisparityOfView& disparity,
                                          const SparseFileOptions& options,
                                          const RunControl& control) {
  return write_sparse_file(AtomicFile(path), light_field, disparity, options, control);
}

/// A .grl file. Opening reads the directory alone; what is asked for is read when it is, the tuples
/// of a band once. Cheap to copy; thread-safe. Everything throws Error(kBadInput) naming the file
/// when it is damaged.
class SparseFile {
 public:
  /// memory_bytes: most that decoding may take; 0: default_memory_limit().
  explicit SparseFile(const std::filesystem::path& path, double memory_bytes = 0);

  /// Its pixels come from the file. Exactly those that were encoded when max_error() is 0.
  LightField light_field() const;
  const SparseShape& shape() const;
  int max_error() const;
  DisparityRange disparity_range() const;  ///< of the tuples; 0 … 1 when there is none

  /// Rows of a view as RGB, (v − rows.begin, u, c).
  Image<std::uint16_t> picture(int view, RowRange rows) const;
  /// Rows of a view's disparity, (v − rows.begin, u), as the tuples have it; NaN where none is.
  FloatMap disparity(int view, RowRange rows) const;
  /// All tuples, read now.
  const SparseTuples& tuples() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace gigaray
