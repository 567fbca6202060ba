// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/cache_folder.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "gigaray/device.h"
#include "opencl/pocl_cache.h"

namespace gigaray::opencl {
namespace fs = std::filesystem;
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// A folder that lives as long as the process.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string path = (fs::temp_directory_path(error) / "gigaray-pocl-XXXXXX").string();
    if (!error && mkdtemp(path.data())) path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool is_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

std::optional<fs::path> cache_folder() {
  if (environment("GIGARAY_CACHE") == "off") return std::nullopt;
  if (const auto folder = environment("GIGARAY_CACHE_DIR"); !folder.empty()) {
    std::error_code error;
    const fs::path absolute = fs::absolute(folder, error);
    return error ? fs::path(folder) : absolute;
  }
  // A relative XDG path is invalid by the XDG base directory specification.
  if (const fs::path folder = environment("XDG_CACHE_HOME"); folder.is_absolute())
    return folder / "gigaray";
  if (const auto home = environment("HOME"); !home.empty())
    return fs::path(home) / ".cache" / "gigaray";
  return std::nullopt;
}

bool write_file_atomically(const fs::path& path, std::string_view content) {
  static std::atomic<unsigned> counter{0};
  const fs::path temporary = path.string() + "." + std::to_string(getpid()) + "." +
                             std::to_string(counter.fetch_add(1)) + ".tmp";
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream file(temporary, std::ios::binary);
  if (!file) return false;
  file.write(content.data(), std::streamsize(content.size()));
  file.close();
  if (file) {
    fs::rename(temporary, path, error);
    if (!error) return true;
  }
  fs::remove(temporary, error);
  return false;
}

std::optional<std::string> read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string content((std::istreambuf_iterator<char>(file)), {});
  if (file.bad()) return std::nullopt;
  return content;
}

void give_pocl_a_cache() {
  [[maybe_unused]] static const bool once = [] {
    if (!environment("POCL_CACHE_DIR").empty()) return true;
    const auto folder = cache_folder();
    if (folder && is_writable(*folder / kPoclFolder)) {
      static const PoclCache pocl(*folder / kPoclFolder);
      setenv("POCL_CACHE_DIR", pocl.folder().c_str(), 1);
    } else {
      static const TemporaryFolder temporary;
      if (!temporary.path().empty()) setenv("POCL_CACHE_DIR", temporary.path().c_str(), 1);
    }
    return true;
  }();
}

}  // namespace gigaray::opencl

namespace gigaray {
namespace fs = std::filesystem;

KernelCacheInfo kernel_cache_info() {
  KernelCacheInfo info;
  const auto folder = opencl::cache_folder();
  if (!folder) return info;
  info.folder = folder->string();
  for (const auto part : {opencl::kProgramFolder, opencl::kPoclFolder}) {
    std::error_code error;
    // Another process may add and remove files meanwhile: what vanishes is not counted.
    for (fs::recursive_directory_iterator it(*folder / part, error), end; !error && it != end;
         it.increment(error)) {
      std::error_code vanished;
      if (!it->is_regular_file(vanished)) continue;
      const auto size = it->file_size(vanished);
      if (vanished) continue;
      info.bytes += size;
      if (part == opencl::kProgramFolder && it->path().extension() == ".bin") ++info.programs;
    }
  }
  return info;
}

void clear_kernel_cache() {
  const auto folder = opencl::cache_folder();
  if (!folder) return;
  for (const auto part : {opencl::kProgramFolder, opencl::kPoclFolder}) {
    // The folders stay: a running PoCL expects its own to exist.
    std::error_code error;
    for (fs::directory_iterator it(*folder / part, error), end; !error && it != end;
         it.increment(error)) {
      std::error_code failure;
      fs::remove_all(it->path(), failure);
      if (failure)
        throw Error(ErrorCode::kIo,
                    "kernel cache: can't remove " + it->path().string() + ": " + failure.message());
    }
  }
}

}  // namespace gigaray
