// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/cache_folder.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>

#include "gigaray/core/scratch_file.h"
#include "gigaray/engine/device.h"
#include "opencl/pocl_cache.h"

namespace gigaray::opencl {
namespace fs = std::filesystem;
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// A folder for PoCL that lives as long as the process.
class TemporaryFolder {
 public:
  /// Throws Error(kIo) when there is no room for it.
  TemporaryFolder() {
    const std::string folder = temporary_folder();
    if (const std::string why = why_no_room(folder, kPoclRoom); !why.empty())
      throw Error(ErrorCode::kIo, why);
    std::string path = folder + "/gigaray-pocl-XXXXXX";
    if (!mkdtemp(path.data()))
      throw Error(ErrorCode::kIo, folder + ": no folder can be made in it");
    path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The first folder that has room: what the user names for PoCL, the one in our cache, a temporary
/// one. Throws Error(kIo) with all reasons when none has.
void choose_pocl_folder() {
  std::string reasons;
  const auto has_room = [&](const fs::path& folder) {
    const std::string why = why_no_room(folder, kPoclRoom);
    if (!why.empty()) reasons += why + "; ";
    return why.empty();
  };
  if (const std::string named = environment("POCL_CACHE_DIR"); !named.empty()) {
    if (has_room(named)) return;
  } else if (const auto folder = cache_folder(); folder && has_room(*folder / kPoclFolder)) {
    static const PoclCache pocl(*folder / kPoclFolder);
    setenv("POCL_CACHE_DIR", pocl.folder().c_str(), 1);
    return;
  }
  try {
    static const TemporaryFolder temporary;
    setenv("POCL_CACHE_DIR", temporary.path().c_str(), 1);
  } catch (const Error& error) {
    throw Error(ErrorCode::kIo, reasons + error.what());
  }
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
  std::string content;
  constexpr std::size_t kPiece = 1 << 18;
  for (std::size_t size = 0; file; size += std::size_t(file.gcount()), content.resize(size)) {
    content.resize(size + kPiece);
    file.read(content.data() + size, kPiece);
  }
  if (file.bad()) return std::nullopt;
  return content;
}

std::string why_no_room(const fs::path& folder, std::uint64_t bytes) {
  std::error_code error;
  fs::create_directories(folder, error);
  // Room on the disk is asked for; a limit on the size of one file (ulimit -f) is another matter.
  rlimit one_file{};
  if (getrlimit(RLIMIT_FSIZE, &one_file) == 0)
    bytes = std::min<std::uint64_t>(bytes, one_file.rlim_cur);
  try {
    ScratchFile(folder.string()).reserve(bytes);
  } catch (const Error& failure) {
    return failure.what();
  }
  return "";
}

const std::string& give_pocl_a_cache() {
  static const std::string failure = []() -> std::string {
    try {
      choose_pocl_folder();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }();
  return failure;
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
      // A file of ours per program, one of PoCL's.
      if (it->path().extension() == ".bin" || it->path().filename() == "program.bc")
        ++info.programs;
    }
  }
  return info;
}

void clear_kernel_cache() {
  const auto folder = opencl::cache_folder();
  std::error_code ignored;
  if (!folder || !fs::is_directory(*folder, ignored)) return;
  // PoCL ends the process whose kernels vanish.
  const opencl::PoclCacheAlone alone(*folder / opencl::kPoclFolder);
  if (alone.is_in_use())
    throw Error(ErrorCode::kIo, "kernel cache: " + folder->string() +
                                    " is in use by another run; clear it when that has ended");
  for (const auto part : {opencl::kReadyFolder, opencl::kProgramFolder, opencl::kPoclFolder}) {
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
