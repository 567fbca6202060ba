// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Writes seeds of the binary formats that fuzz targets read: FOLDER/TARGET/NAME, the first byte
// chooses the parser.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>
#include <vips/vips8>

#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/maps.h"

namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 13, kHeight = 7;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void add(const fs::path& folder, const std::string& name, char choice, const std::string& bytes) {
  fs::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << choice << bytes;
}

gigaray::FloatMap map() {
  gigaray::FloatMap map(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) map(u, v) = 0.5f * float(u) - float(v);
  return map;
}

void add_maps(const fs::path& folder, const fs::path& work) {
  gigaray::write_pfm(work, map());
  add(folder, "pfm", 0, bytes_of(work));
  gigaray::write_colmap_depth_map(work, map());
  add(folder, "colmap", 2, bytes_of(work));
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                 Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
                                 Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    Imf::Header header(kWidth, kHeight);
    header.compression() = compression;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    gigaray::FloatMap values = map();
    {
      Imf::OutputFile file(work.c_str(), header);
      Imf::FrameBuffer buffer;
      buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                    sizeof(float), sizeof(float) * kWidth));
      file.setFrameBuffer(buffer);
      file.writePixels(kHeight);
    }
    add(folder, "exr_" + std::to_string(int(compression)), 1, bytes_of(work));
  }
}

void add_pictures(const fs::path& folder) {
  const vips::VImage ramp =
      vips::VImage::xyz(2 * kWidth, kHeight).linear({9, 30}, {1, 2}).cast(VIPS_FORMAT_UCHAR);
  const vips::VImage colour =
      ramp.bandjoin(ramp.extract_band(0))
          .copy(vips::VImage::option()->set("interpretation", VIPS_INTERPRETATION_sRGB));
  int number = 0;
  for (const char* format :
       {".png", ".png[interlace]", ".png[bitdepth=1,palette]", ".jpg", ".jpg[interlace]", ".tif",
        ".tif[tile,tile-width=16,tile-height=16,compression=deflate]",
        ".tif[compression=lzw,predictor=horizontal]", ".tif[compression=jpeg]", ".webp",
        ".webp[lossless]", ".gif", ".jp2", ".ppm", ".heic"}) {
    try {
      void* bytes = nullptr;
      std::size_t size = 0;
      colour.write_to_buffer(format, &bytes, &size);
      ++number;
      add(folder, "picture_" + std::to_string(number), char(number % 2),
          std::string(static_cast<char*>(bytes), size));
      g_free(bytes);
    } catch (const vips::VError&) {
      // This build of libvips can't write the format.
    }
  }
}

void add_dataset(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& sizes,
                 bool packed) {
  hsize_t total = 1;
  for (const hsize_t size : sizes) total *= size;
  std::vector<double> values(total);
  for (std::size_t i = 0; i < total; ++i) values[i] = double(i * 37 % 251 + 1);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (packed) {
    H5Pset_chunk(creation, int(sizes.size()), sizes.data());
    H5Pset_deflate(creation, 9);
  }
  const hid_t space = H5Screate_simple(int(sizes.size()), sizes.data(), nullptr);
  const hid_t data = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(data);
  H5Sclose(space);
  H5Pclose(creation);
}

void add_attribute(hid_t file, const char* name, double value) {
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t id = H5Acreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(id, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(id);
  H5Sclose(space);
}

void add_hdf5(const fs::path& folder, const fs::path& work) {
  for (const bool packed : {false, true}) {
    const std::string suffix = packed ? "_packed" : "";
    const hid_t file = H5Fcreate(work.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    add_dataset(file, "LF", H5T_STD_U8LE, {3, 2, 5, 7, 3}, packed);
    add_dataset(file, "GT_DEPTH", H5T_IEEE_F32LE, {3, 2, 5, 7}, packed);
    for (const char* name : {"dH", "dV", "focalLength", "shift"}) add_attribute(file, name, 2);
    H5Fclose(file);
    for (const char choice : {0, 1, 2})
      add(folder, "hdf5_" + std::to_string(choice) + suffix, choice, bytes_of(work));
    const hid_t matlab = H5Fcreate(work.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    add_dataset(matlab, "LF", H5T_STD_U16LE, {3, 7, 5, 2, 3}, packed);
    H5Fclose(matlab);
    add(folder, "matlab" + suffix, 0, bytes_of(work));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || VIPS_INIT(argv[0]) != 0) return 2;
  const fs::path folder = argv[1], work = folder / "work";
  fs::create_directories(folder);
  add_maps(folder / "maps", work);
  add_pictures(folder / "picture");
  add_hdf5(folder / "hdf5", work);
  fs::remove(work);
  return 0;
}
