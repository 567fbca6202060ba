// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

/// The lock that every call of the library is made under. The library's own error messages are off.
std::unique_lock<std::mutex> library() {
  static std::mutex mutex;
  std::unique_lock<std::mutex> lock(mutex);
  static const bool quiet = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  (void)quiet;
  return lock;
}

/// An identifier of the library and the call that gives it back. Negative: there is none.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Hdf5Type type_of(hid_t type) {
  const std::size_t size = H5Tget_size(type);
  constexpr std::size_t kLargest = 16;
  if (H5Tget_class(type) == H5T_FLOAT && size <= kLargest) return Hdf5Type::kFloat;
  if (H5Tget_class(type) != H5T_INTEGER || H5Tget_sign(type) != H5T_SGN_NONE)
    return Hdf5Type::kOther;
  return size == 1 ? Hdf5Type::kUint8 : size == 2 ? Hdf5Type::kUint16 : Hdf5Type::kOther;
}

/// Links into other files lead nowhere.
herr_t follow_nothing(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
  return -1;
}

/// Opens a dataset of this file; negative when there is none of this name.
hid_t open_dataset(hid_t file, const std::string& name) {
  const Id links(H5Pcreate(H5P_LINK_ACCESS), H5Pclose),
      access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_elink_cb(links, follow_nothing, nullptr);
  H5Pset_elink_cb(access, follow_nothing, nullptr);
  if (H5Lexists(file, name.c_str(), links) <= 0) return -1;
  {
    const Id object(H5Oopen(file, name.c_str(), links), H5Oclose);
    if (!object.valid() || H5Iget_type(object) != H5I_DATASET) return -1;
  }
  return H5Dopen2(file, name.c_str(), access);
}

/// What a dataset takes, and what there is of it.
void state_sizes(hid_t data, hid_t type, Hdf5Shape& shape) {
  shape.bytes = double(H5Tget_size(type));
  for (const std::uint64_t size : shape.sizes) shape.bytes *= double(size);
  shape.stored = double(H5Dget_storage_size(data));
  const Id creation(H5Dget_create_plist(data), H5Pclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED) return;
  std::vector<hsize_t> chunk(shape.sizes.size());
  if (H5Pget_chunk(creation, int(chunk.size()), chunk.data()) < 0) return;
  shape.chunk_bytes = double(H5Tget_size(type));
  for (const hsize_t size : chunk) shape.chunk_bytes *= double(size);
}

bool lies_elsewhere(hid_t data) {
  const Id creation(H5Dget_create_plist(data), H5Pclose);
  return H5Pget_layout(creation) == H5D_VIRTUAL || H5Pget_external_count(creation) > 0;
}

}  // namespace

struct Hdf5File::Handle {
  hid_t id = -1;
  ~Handle() {
    const auto lock = library();
    H5Fclose(id);
  }
};

bool Hdf5File::is_one(const std::filesystem::path& path) {
  check_input_file(path);
  const auto lock = library();
  return H5Fis_hdf5(path.c_str()) > 0;
}

Hdf5File::Hdf5File(const std::filesystem::path& path) : path_(path) {
  check_input_file(path);
  const hid_t id = [&] {
    const auto lock = library();
    return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }();
  if (id < 0)
    throw Error(ErrorCode::kBadInput, path.string() + ": is damaged, cut short or no HDF5 file");
  auto handle = std::make_shared<Handle>();
  handle->id = id;
  file_ = std::move(handle);
}

std::optional<Hdf5Shape> Hdf5File::shape(const std::string& dataset) const {
  const auto lock = library();
  const Id data(open_dataset(file_->id, dataset), H5Dclose);
  if (!data.valid()) return std::nullopt;
  if (lies_elsewhere(data))
    throw Error(ErrorCode::kBadInput, path_.string() + ": the values of dataset " + dataset +
                                          " lie in another file; copy them into this one");
  const Id space(H5Dget_space(data), H5Sclose);
  const Id type(H5Dget_type(data), H5Tclose);
  Hdf5Shape shape;
  std::vector<hsize_t> sizes(std::max(0, H5Sget_simple_extent_ndims(space)));
  if (!sizes.empty()) H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  shape.sizes.assign(sizes.begin(), sizes.end());
  shape.type = type_of(type);
  state_sizes(data, type, shape);
  // Deflate packs 1032 bytes into one at best; little data may be all alike.
  constexpr double kMostPacked = 1100, kLittle = 1 << 20;
  if (shape.bytes > kLittle && shape.bytes > kMostPacked * shape.stored)
    throw Error(ErrorCode::kBadInput,
                path_.string() + ": is damaged: dataset " + dataset + " states " +
                    std::to_string(std::uint64_t(std::min(shape.bytes, 1e18))) +
                    " bytes of values, of which it holds " +
                    std::to_string(std::uint64_t(shape.stored)));
  return shape;
}

std::optional<double> Hdf5File::attribute(const std::string& name) const {
  const auto lock = library();
  if (H5Aexists(file_->id, name.c_str()) <= 0) return std::nullopt;
  const Id attribute(H5Aopen(file_->id, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Id space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t kMost = 1000;
  if (count < 1 || count > kMost) return std::nullopt;
  std::vector<double> values(std::size_t(count), 0.0);
  // Fails for text, which has no conversion to a number.
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) return std::nullopt;
  return values.front();
}

namespace {

template <class T>
std::vector<T> read_block(hid_t file, hid_t type, const std::filesystem::path& path,
                          const std::string& name, const std::vector<std::uint64_t>& start,
                          const std::vector<std::uint64_t>& count) {
  const auto lock = library();
  const Id data(open_dataset(file, name), H5Dclose);
  const Id space(H5Dget_space(data), H5Sclose);
  const std::vector<hsize_t> from(start.begin(), start.end()), size(count.begin(), count.end());
  const hsize_t total = std::accumulate(size.begin(), size.end(), hsize_t{1}, std::multiplies<>());
  const Id block(H5Screate_simple(1, &total, nullptr), H5Sclose);
  std::vector<T> values(total);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr) < 0 ||
      H5Dread(data, type, block, space, H5P_DEFAULT, values.data()) < 0)
    throw Error(ErrorCode::kBadInput,
                path.string() + ": dataset " + name + " is damaged or cut short");
  return values;
}

}  // namespace

std::vector<std::uint16_t> Hdf5File::read_uint16(const std::string& dataset,
                                                 const std::vector<std::uint64_t>& start,
                                                 const std::vector<std::uint64_t>& count) const {
  return read_block<std::uint16_t>(file_->id, H5T_NATIVE_UINT16, path_, dataset, start, count);
}

std::vector<float> Hdf5File::read_float(const std::string& dataset,
                                        const std::vector<std::uint64_t>& start,
                                        const std::vector<std::uint64_t>& count) const {
  return read_block<float>(file_->id, H5T_NATIVE_FLOAT, path_, dataset, start, count);
}

}  // namespace gigaray
