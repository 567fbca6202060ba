// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gigaray {

enum class Hdf5Type { kUint8, kUint16, kFloat, kOther };

/// What a dataset holds.
struct Hdf5Shape {
  std::vector<std::uint64_t> sizes;  ///< slowest axis first
  Hdf5Type type = Hdf5Type::kOther;
  double bytes = 0;        ///< of all values, unpacked
  double stored = 0;       ///< bytes of them that the file holds
  double chunk_bytes = 0;  ///< that are unpacked at once
};

/// An HDF5 file, open for reading. The only place that calls the HDF5 library. Thread-safe:
/// Debian's build of the library is not, so that calls take turns.
class Hdf5File {
 public:
  /// Does the file begin like HDF5, also behind the user block of a MATLAB file? Throws what
  /// check_input_file throws.
  static bool is_one(const std::filesystem::path& path);

  /// Throws Error(kBadInput) naming the file when it is damaged, cut short or no HDF5.
  explicit Hdf5File(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  /// Nothing when there is no such dataset. Throws Error(kBadInput) when its values lie in another
  /// file, or when it states more values than the bytes that are stored can hold.
  std::optional<Hdf5Shape> shape(const std::string& dataset) const;
  /// First number of an attribute of the root group; nothing when it is not there or no number.
  std::optional<double> attribute(const std::string& name) const;
  /// A block of a dataset, slowest axis first, converted to T. start and count: one entry per axis.
  /// Throws Error(kBadInput) naming file and dataset when it can't be read.
  std::vector<std::uint16_t> read_uint16(const std::string& dataset,
                                         const std::vector<std::uint64_t>& start,
                                         const std::vector<std::uint64_t>& count) const;
  std::vector<float> read_float(const std::string& dataset, const std::vector<std::uint64_t>& start,
                                const std::vector<std::uint64_t>& count) const;

 private:
  struct Handle;
  std::filesystem::path path_;
  std::shared_ptr<const Handle> file_;
};

}  // namespace gigaray
