// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <array>
#include <system_error>

#include "colmap/colmap_folders.h"
#include "files/text.h"
#include "gigaray/adapters/photographs.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Names of files of cameras, lower case, and the format whose reader takes them.
struct CameraFiles {
  std::string_view begin, end;
  std::string_view format;
};
constexpr std::array kCameraFiles{
    CameraFiles{"transforms", ".json", "transforms.json"},
    CameraFiles{"cameras.txt", "", "COLMAP workspace"},
    CameraFiles{"cameras.bin", "", "COLMAP workspace"},
    CameraFiles{"images.txt", "", "COLMAP workspace"},
    CameraFiles{"images.bin", "", "COLMAP workspace"},
    CameraFiles{"poses_bounds.npy", "", "LLFF poses_bounds.npy"},
    CameraFiles{"calib.txt", "", "Middlebury stereo pair with calib.txt"},
    CameraFiles{"", "_par.txt", "Middlebury multi-view"},
    CameraFiles{"", ".camera", "Strecha .camera files"},
    CameraFiles{"", "_cam.txt", "MVSNet cameras"},
};

bool is_of(const CameraFiles& kind, const std::string& name) {
  return name.starts_with(kind.begin) && name.ends_with(kind.end) &&
         (!kind.end.empty() || name == kind.begin);
}

/// Names that others give to cameras: OpenMVG, OpenSfM, Bundler, VisualSFM, Meshroom, Agisoft,
/// NSVF, scanners and own calibrations.
bool sounds_like_cameras(const std::string& name) {
  const fs::path path(name);
  const std::string stem = path.stem().string(), extension = path.extension().string();
  for (const char* known : {".nvm", ".sfm", ".p4d", ".opk"})
    if (extension == known) return true;
  for (const char* known : {"bundle.out", "bundle.rd.out", "sfm_data.json", "reconstruction.json",
                            "k.txt", "traj.txt", "trajectory.txt", "trajectory.log"})
    if (name == known) return true;
  constexpr std::array kText{".json", ".txt", ".npz", ".npy",  ".xml", ".yml",
                             ".yaml", ".csv", ".log", ".toml", ".mat", ".dat"};
  if (std::ranges::find(kText, extension) == kText.end()) return false;
  for (const char* word : {"camera", "cams", "pose", "calib", "intrinsic", "extrinsic"})
    if (stem.find(word) != std::string::npos) return true;
  return false;
}

/// Is a folder of that name a part of a capture, whose other files belong to it?
bool is_part_of_capture(const fs::path& folder) {
  std::error_code ignored;
  const std::string name = lower(
      fs::absolute(folder / "x", ignored).lexically_normal().parent_path().filename().string());
  for (const char* word : {"image", "rgb", "frame", "picture", "photo", "color", "colour", "input",
                           "undistorted", "jpg", "png"})
    if (name.starts_with(word)) return true;
  return false;
}

/// by_words: also what only sounds like cameras.
bool is_unused(const std::string& name, const std::string& format, bool by_words) {
  bool is_known = false;
  for (const CameraFiles& kind : kCameraFiles) {
    if (!is_of(kind, name)) continue;
    if (kind.format == format) return false;
    is_known = true;
  }
  return is_known || (by_words && sounds_like_cameras(name));
}

/// Does a folder with such a name hold cameras?
bool holds_cameras(const fs::path& folder, const std::string& name, const std::string& format) {
  std::error_code ignored;
  if (name == "sparse") return format != "COLMAP workspace" && !colmap_models_of(folder).empty();
  return (name == "cams" || name == "cameras") && format != "MVSNet cameras" &&
         format != "Strecha .camera files" && !fs::is_empty(folder, ignored);
}

void add_unused(const fs::path& folder, const std::string& format, bool by_words,
                std::vector<fs::path>& found) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const std::string name = lower(entry->path().filename().string());
    const bool is_there = entry->is_directory(ignored) ? holds_cameras(entry->path(), name, format)
                                                       : entry->is_regular_file(ignored) &&
                                                             is_unused(name, format, by_words);
    if (is_there) found.push_back(entry->path().lexically_normal());
  }
}

}  // namespace

std::string unused_cameras(const fs::path& input, const std::string& format) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) return {};
  std::vector<fs::path> found;
  add_unused(input, format, true, found);
  const bool has_cameras = std::ranges::any_of(
      kCameraFiles, [&](const CameraFiles& kind) { return kind.format == format; });
  // An input with cameras of its own has no need of others around it.
  if (!has_cameras) add_unused(input / "..", format, is_part_of_capture(input), found);
  if (found.empty()) return {};
  std::ranges::sort(found);
  constexpr std::size_t kMostNamed = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(found.size(), kMostNamed); ++i)
    names += (i > 0 ? ", " : "") + found[i].string();
  if (found.size() > kMostNamed)
    names += " and " + std::to_string(found.size() - kMostNamed) + " more";
  return "looks like cameras and is not used: " + names;
}

}  // namespace gigaray
