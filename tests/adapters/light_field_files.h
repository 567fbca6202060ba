// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <hdf5.h>

#include <numeric>
#include <string>
#include <vector>

#include "adapters/adapters_test.h"
#include "gigaray/engine/camera_order.h"
#include "support/analytic_field.h"

namespace gigaray {

/// Two textured planes before a camera that is at the place of each view; disparity 0.5 and 1.6.
inline LightField planes_seen_from(std::vector<View> views, int width = 93, int height = 61) {
  testing_support::Layer front{1.6, 7};
  front.left = 0.2 * width;
  front.right = 0.5 * width;
  return testing_support::analytic_field(width, height, std::move(views), {{0.5, 3}, front})
      .light_field;
}

inline cv::Mat to_mat(const Image<std::uint16_t>& picture) {
  cv::Mat mat(picture.height(), picture.width(), CV_8UC3);
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
      for (int c = 0; c < 3; ++c) mat.at<cv::Vec3b>(v, u)[2 - c] = std::uint8_t(picture(u, v, c));
  return mat;
}

/// Writes HDF5 files, one dataset or attribute at a time.
class Hdf5Writer {
 public:
  /// user_block: bytes in front of the HDF5 data, as MATLAB has 512.
  explicit Hdf5Writer(const std::filesystem::path& path, hsize_t user_block = 0) {
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(creation, user_block);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
  }
  ~Hdf5Writer() { H5Fclose(file_); }

  void attribute(const std::string& name, double value) {
    const hsize_t one = 1;
    const hid_t space = H5Screate_simple(1, &one, nullptr);
    const hid_t id =
        H5Acreate2(file_, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(id);
    H5Sclose(space);
  }
  /// value(indices) in the file's order of axes, slowest first.
  template <class Value>
  void dataset(const std::string& name, hid_t type, const std::vector<hsize_t>& sizes,
               Value value) {
    std::size_t total = 1;
    for (const hsize_t size : sizes) total *= size;
    std::vector<double> values(total);
    for (std::size_t i = 0; i < total; ++i) {
      std::vector<int> at(sizes.size());
      std::size_t rest = i;
      for (std::size_t axis = sizes.size(); axis-- > 0; rest /= sizes[axis])
        at[axis] = int(rest % sizes[axis]);
      values[i] = value(at);
    }
    const hid_t space = H5Screate_simple(int(sizes.size()), sizes.data(), nullptr);
    const hid_t id =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(id);
    H5Sclose(space);
  }

 private:
  hid_t file_;
};

/// Finds the directions of what was read as `gigaray depth` does, and expects every view where the
/// view of `truth` with the same picture stands.
inline void expect_places(LightField read, const LightField& truth) {
  RunControl control;
  check_direction(read, control);
  ASSERT_EQ(read.num_views(), truth.num_views());
  for (int i = 0; i < read.num_views(); ++i) {
    const auto picture = read.pixels->read(i);
    int same = -1;
    for (int j = 0; j < truth.num_views(); ++j)
      if (truth.pixels->read(j) == picture) same = j;
    ASSERT_GE(same, 0) << read.views[i].name << " is no picture of the scene";
    EXPECT_NEAR(read.views[i].s, truth.views[same].s, 1e-9) << read.views[i].name;
    EXPECT_NEAR(read.views[i].t, truth.views[same].t, 1e-9) << read.views[i].name;
  }
}

}  // namespace gigaray
