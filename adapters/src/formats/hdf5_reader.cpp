// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Light fields in a dataset LF of an HDF5 file.
//
// Old HCI benchmark (Wanner, Meister, Goldluecke 2013), lf.h5: LF is (t, s, v, u, c), the camera
// goes LEFT as s rises and down as t rises. Attributes: dH and dV, distance of cameras; focalLength
// in px; shift in px, by which pictures are moved so that d = dH · focalLength / depth − shift.
//
// Light Field Toolbox (Dansereau), .mat of version 7.3, which is HDF5: the MATLAB array LF is
// (t, s, v, u, c), and MATLAB stores the first axis fastest: (c, u, v, s, t) in the file. A fourth
// channel holds weights.
#include <algorithm>
#include <cmath>
#include <system_error>

#include "files/text.h"
#include "formats/readers.h"
#include "formats/view_grid.h"
#include "gigaray/adapters/hci_old.h"
#include "gigaray/adapters/input_file.h"
#include "hdf5_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr int kColumnsAtOnce = 16;              // of all views of a .mat file
constexpr std::uint64_t kMostPerAxis = 1000;    // views
constexpr std::uint64_t kMostPixels = 1 << 20;  // per axis

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

/// The file itself, or lf.h5 in a folder.
fs::path file_of(const fs::path& input) {
  std::error_code ignored;
  return fs::is_directory(input, ignored) ? input / "lf.h5" : input;
}

bool is_matlab(const fs::path& path) { return lower(path.extension().string()) == ".mat"; }

std::string sizes_text(const std::vector<std::uint64_t>& sizes) {
  std::string text;
  for (const std::uint64_t size : sizes) text += (text.empty() ? "" : " × ") + std::to_string(size);
  return text;
}

/// Where the samples of a light field lie in a dataset.
struct Layout {
  std::string dataset;
  bool reversed = false;  ///< axes as MATLAB stores them
  bool has_channels = true;
  Hdf5Type type = Hdf5Type::kUint8;
  int rows = 0, columns = 0, height = 0, width = 0, channels = 1;
  double chunk_bytes = 0;

  double view_samples() const { return double(width) * height * channels; }

  int bit_depth() const { return type == Hdf5Type::kUint8 ? 8 : 16; }

  /// Entries per axis of the dataset from those of (t, s, v, u, c).
  std::vector<std::uint64_t> in_file(std::vector<std::uint64_t> axes) const {
    if (!has_channels) axes.pop_back();
    if (reversed) std::reverse(axes.begin(), axes.end());
    return axes;
  }
};

Layout layout_of(const Hdf5File& file) {
  Layout layout;
  layout.reversed = is_matlab(file.path());
  std::optional<Hdf5Shape> shape;
  for (const char* name : {"LF", "LF/LF"})  // the second: a struct of that name
    if (!shape && (shape = file.shape(name))) layout.dataset = name;
  if (!shape) bad(file.path(), "has no dataset LF; a light field has one, (t, s, v, u, c)");
  std::vector<std::uint64_t> sizes = shape->sizes;
  if (layout.reversed) std::reverse(sizes.begin(), sizes.end());
  if (sizes.size() != 4 && sizes.size() != 5)
    bad(file.path(), "LF has " + std::to_string(sizes.size()) +
                         " axes; a light field has 5, (t, s, v, u, c), or 4 if it is grey");
  layout.has_channels = sizes.size() == 5;
  if (!layout.has_channels) sizes.push_back(1);
  if (sizes[4] != 1 && sizes[4] != 3 && sizes[4] != 4)
    bad(file.path(), "LF of " + sizes_text(sizes) + " has " + std::to_string(sizes[4]) +
                         " channels; 1, 3 or 4 (the last one weights) can be read");
  for (const int axis : {0, 1, 2, 3})
    if (sizes[axis] < 1 || sizes[axis] > (axis < 2 ? kMostPerAxis : kMostPixels))
      bad(file.path(), "LF of " + sizes_text(sizes) + " is no light field (t, s, v, u, c)");
  layout.type = shape->type;
  layout.chunk_bytes = shape->chunk_bytes;
  if (layout.type == Hdf5Type::kOther)
    bad(file.path(), "LF has values of another type than 8-bit, 16-bit or floating point");
  layout.rows = int(sizes[0]);
  layout.columns = int(sizes[1]);
  layout.height = int(sizes[2]);
  layout.width = int(sizes[3]);
  layout.channels = int(sizes[4]);
  return layout;
}

/// A block of the dataset as integers of layout.bit_depth(): floating point is 0 … 1.
std::vector<std::uint16_t> read_block(const Hdf5File& file, const Layout& layout,
                                      const std::vector<std::uint64_t>& start,
                                      const std::vector<std::uint64_t>& count) {
  if (layout.type != Hdf5Type::kFloat) return file.read_uint16(layout.dataset, start, count);
  std::vector<std::uint16_t> values;
  for (const float value : file.read_float(layout.dataset, start, count))
    values.push_back(value > 0 ? std::uint16_t(std::lround(65535 * std::min(value, 1.0f))) : 0);
  return values;
}

/// Decodes one view at a time; in C order a view is one piece of the file.
class Hdf5Views : public PixelSource {
 public:
  Hdf5Views(Hdf5File file, Layout layout) : file_(std::move(file)), layout_(std::move(layout)) {}

  Image<std::uint16_t> read(int view_idx) const override {
    const int channels = layout_.channels;
    const auto values =
        read_block(file_, layout_,
                   layout_.in_file({std::uint64_t(view_idx / layout_.columns),
                                    std::uint64_t(view_idx % layout_.columns), 0, 0, 0}),
                   layout_.in_file({1, 1, std::uint64_t(layout_.height),
                                    std::uint64_t(layout_.width), std::uint64_t(channels)}));
    Image<std::uint16_t> picture(layout_.width, layout_.height, 3);
    for (std::size_t pixel = 0; pixel < picture.size() / 3; ++pixel)
      for (int c = 0; c < 3; ++c)
        picture.data()[3 * pixel + c] = values[pixel * channels + (channels == 1 ? 0 : c)];
    return picture;
  }
  int bit_depth() const override { return layout_.bit_depth(); }

 private:
  Hdf5File file_;
  Layout layout_;
};

/// All views of a file in MATLAB's order, where every view is spread over the whole file: read
/// once, some picture columns of all views at a time.
std::vector<Image<std::uint16_t>> read_matlab_views(const Hdf5File& file, const Layout& layout) {
  const std::size_t views = std::size_t(layout.rows) * layout.columns;
  std::vector<Image<std::uint16_t>> pictures(views,
                                             Image<std::uint16_t>(layout.width, layout.height, 3));
  const int channels = std::min(layout.channels, 3);
  for (int first = 0; first < layout.width; first += kColumnsAtOnce) {
    const int count = std::min(kColumnsAtOnce, layout.width - first);
    const auto values =
        read_block(file, layout, layout.in_file({0, 0, 0, std::uint64_t(first), 0}),
                   layout.in_file({std::uint64_t(layout.rows), std::uint64_t(layout.columns),
                                   std::uint64_t(layout.height), std::uint64_t(count),
                                   std::uint64_t(channels)}));
    std::size_t i = 0;  // (c, u, v, s, t)
    for (int c = 0; c < channels; ++c)
      for (int u = first; u < first + count; ++u)
        for (int v = 0; v < layout.height; ++v)
          for (int column = 0; column < layout.columns; ++column)
            for (int row = 0; row < layout.rows; ++row, ++i) {
              auto& picture = pictures[std::size_t(row) * layout.columns + column];
              picture(u, v, c) = values[i];
              if (channels == 1) picture(u, v, 1) = picture(u, v, 2) = values[i];
            }
  }
  return pictures;
}

class Hdf5Reader : public Reader {
 public:
  std::string name() const override { return "HDF5 light field"; }

  ProbeResult probe(const fs::path& input) const override {
    const fs::path path = file_of(input);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return {};
    const std::string extension = lower(path.extension().string());
    return {extension == ".h5" || extension == ".hdf5" || extension == ".mat" ? 70 : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    const fs::path path = file_of(input);
    if (is_matlab(path) && !Hdf5File::is_one(path) &&
        InputFile(path).read(0, 20).starts_with("MATLAB 5.0 MAT-file"))
      bad(path, "is a MATLAB file older than version 7.3; write it anew with save(…, '-v7.3')");
    Hdf5File file(path);
    const Layout layout = layout_of(file);
    hold(path, layout, opening_limit(options.memory_bytes));
    const auto dh = file.attribute("dH");
    const bool hci = dh && !layout.reversed;

    const Directions directions =
        Directions::of_grid(options, hci ? Travel::kLeft : Travel::kRight, Travel::kDown);
    LightField light_field;
    light_field.width = layout.width;
    light_field.height = layout.height;
    const double dv = file.attribute("dV").value_or(dh.value_or(1));
    light_field.views = grid_views(layout.rows, layout.columns, directions,
                                   hci && *dh > 0 && dv > 0 ? dv / *dh : 1);
    light_field.kind = kind_from_positions(light_field.views);
    if (hci)
      apply_rig(file, light_field);
    else
      assume_directions(light_field, directions);
    if (layout.channels == 4)
      light_field.notes.push_back("the fourth channel of LF, weights, is ignored");
    if (layout.channels == 1)
      light_field.notes.push_back("grey pictures are read as colour with equal channels");
    if (!layout.reversed) {
      light_field.pixels = std::make_shared<Hdf5Views>(std::move(file), layout);
      return light_field;
    }
    auto pictures = read_matlab_views(file, layout);
    try {
      attach_bright_views(light_field, std::move(pictures), layout.bit_depth());
    } catch (const Error& problem) {
      bad(path, problem.what());
    }
    return light_field;
  }

 private:
  /// One view, or all of a .mat file: samples as they are and as integers, the picture, a chunk as
  /// it is packed and unpacked.
  static void hold(const fs::path& path, const Layout& layout, double limit) {
    constexpr double kSample = 6, kPixel = 6;
    const double pixels = double(layout.width) * layout.height;
    const double views = double(layout.rows) * layout.columns;
    const double at_once = layout.reversed
                               ? views * layout.height * std::min(layout.width, kColumnsAtOnce) *
                                     std::min(layout.channels, 3)
                               : layout.view_samples();
    const double bytes = (layout.reversed ? views : 1) * kPixel * pixels + kSample * at_once +
                         2 * layout.chunk_bytes;
    hold_against_limit(path.string(),
                       "LF states " + std::to_string(layout.rows * layout.columns) + " views of " +
                           size_text(layout.width, layout.height) + " px",
                       bytes, limit);
  }

  static void apply_rig(const Hdf5File& file, LightField& light_field) {
    const double baseline = file.attribute("dH").value();
    const auto focal = file.attribute("focalLength");
    const auto shift = file.attribute("shift");
    if (baseline > 0) light_field.rig.baseline = baseline;
    if (focal && *focal > 0) light_field.rig.focal_px = focal;
    if (baseline > 0 && focal && *focal > 0 && shift && *shift > 0)
      light_field.rig.focus_distance = baseline * *focal / *shift;
  }
};

}  // namespace

std::unique_ptr<const Reader> hdf5_reader() { return std::make_unique<Hdf5Reader>(); }

FloatMap read_hci_old_truth(const fs::path& input) {
  const Hdf5File file(file_of(input));
  const auto shape = file.shape("GT_DEPTH");
  if (!shape) bad(file.path(), "has no dataset GT_DEPTH, so no true depth");
  const std::vector<std::uint64_t>& sizes = shape->sizes;
  if (sizes.size() != 4 && sizes.size() != 2)
    bad(file.path(), "GT_DEPTH has " + std::to_string(sizes.size()) +
                         " axes; (t, s, v, u), or (v, u) of the centre view, is expected");
  const auto number = [&](const char* name) {
    const auto value = file.attribute(name);
    if (!value || !std::isfinite(*value))
      bad(file.path(), std::string("has no attribute ") + name +
                           "; disparity from GT_DEPTH needs dH, focalLength and shift");
    return *value;
  };
  const double scale = number("dH") * number("focalLength"), shift = number("shift");

  // The view that centre_view() means: s falls with the column.
  std::vector<std::uint64_t> start(sizes.size(), 0), count(sizes.size(), 1);
  if (sizes.size() == 4) {
    start[0] = (sizes[0] - 1) / 2;
    start[1] = sizes[1] / 2;
  }
  std::copy(sizes.end() - 2, sizes.end(), count.end() - 2);
  if (count[count.size() - 1] > kMostPixels || count[count.size() - 2] > kMostPixels)
    bad(file.path(), "GT_DEPTH of " + sizes_text(sizes) + " is no depth of views");
  hold_against_limit(file.path().string(), "GT_DEPTH is " + sizes_text(sizes),
                     4 * sizeof(float) * double(count.back()) * double(count[count.size() - 2]) +
                         2 * shape->chunk_bytes,
                     opening_limit());
  const std::vector<float> depth = file.read_float("GT_DEPTH", start, count);
  std::vector<float> mask(depth.size(), 1);
  if (const auto mask_shape = file.shape("GT_DEPTH_MASK"); mask_shape && mask_shape->sizes == sizes)
    mask = file.read_float("GT_DEPTH_MASK", start, count);
  FloatMap disparity(int(count.back()), int(count[count.size() - 2]), 1, kNoEstimate);
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (depth[i] > 0 && std::isfinite(depth[i]) && mask[i] != 0)
      disparity.data()[i] = float(scale / depth[i] - shift);
  return disparity;
}

}  // namespace gigaray
