// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>

#include "files/text.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/error.h"
#include "gigaray/core/scratch_file.h"
#include "output/output_place.h"
#include "output/partial_folder.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// The extended attribute that says that this library wrote a file: its size and last change.
constexpr const char* kMark = "user.gigaray.written";

std::string mark_of(const struct stat& status) {
  return std::to_string(status.st_size) + " " + std::to_string(status.st_mtim.tv_sec) + "." +
         std::to_string(status.st_mtim.tv_nsec);
}

bool is_ours(const fs::path& path) {
  struct stat status = {};
  std::array<char, 100> mark{};
  const ssize_t size = lgetxattr(path.c_str(), kMark, mark.data(), mark.size());
  return size > 0 && lstat(path.c_str(), &status) == 0 &&
         std::string(mark.data(), std::size_t(size)) == mark_of(status);
}

/// A file without a name in a folder; -1 where the file system, or a system without /proc, can't
/// give it a name later.
int open_nameless(const fs::path& folder) {
  if (access("/proc/self/fd", X_OK) != 0) return -1;
  return open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
}

bool can_be_written_to(const fs::file_status& status) {
  return fs::is_character_file(status) || fs::is_fifo(status);
}

void copy(std::FILE* from, std::FILE* to) {
  std::array<char, 1 << 16> bytes;
  for (std::size_t size; (size = std::fread(bytes.data(), 1, bytes.size(), from)) > 0;)
    if (std::fwrite(bytes.data(), 1, size, to) != size) return;
}

}  // namespace

struct AtomicFile::State {
  State(const fs::path& path, std::optional<OutputRules> how) : named(path), rules(std::move(how)) {
    std::error_code error;
    goes_through = can_be_written_to(fs::status(path, error));
    place = goes_through ? path : output_place(path);
    if (rules && !goes_through) check_file_place(place, named, *rules);
    if (!goes_through) look();
    open_file();
  }
  ~State() {
    if (file) std::fclose(file);
    if (!name.empty()) unlink(name.c_str());
  }

  /// Refuses what is not to be replaced; true: an older one is there, which is to be moved aside.
  bool look() const {
    const auto refuse = [&](const std::string& why) {
      throw Error(ErrorCode::kInvalidArgument, named.string() + ": " + why);
    };
    std::error_code error;
    const fs::file_status status = fs::symlink_status(place, error);
    if (!fs::exists(status)) return false;
    if (fs::is_directory(status)) refuse("is a folder; name a file");
    if (!fs::is_regular_file(status)) refuse("is neither a file nor a device to write to");
    if (!rules || fs::file_size(place, error) == 0 || is_ours(place)) return false;
    if (!rules->replace)
      refuse(
          "is there and this program did not write it, or it was changed since; name another "
          "file, or add OutputRules::replace, which moves it to " +
          free_old_name(place).filename().string());
    return true;
  }

  void open_file() {
    const fs::path folder = goes_through ? fs::path(temporary_folder()) : place.parent_path();
    if (rules) tidy_partials(folder);
    int descriptor = open_nameless(folder);
    while (descriptor < 0) {
      name = partial_path(folder, place.filename().string());
      descriptor = open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0 || errno == EEXIST) continue;
      name.clear();
      fail();
    }
    // So that nobody takes it for what a dead process left, also once it has a name.
    flock(descriptor, LOCK_EX | LOCK_NB);
    file = fdopen(descriptor, "w+b");
    if (!file) fail();
  }

  [[noreturn]] void fail() const {
    cannot_write(named, std::error_code(errno, std::generic_category()));
  }

  void write_through() {
    std::rewind(file);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> device(std::fopen(place.c_str(), "wbe"),
                                                                 std::fclose);
    if (!device) fail();
    copy(file, device.get());
    if (std::ferror(file) || std::ferror(device.get()) || std::fflush(device.get()) != 0) fail();
  }

  void make_durable() {
    if (std::fflush(file) != 0) fail();
    if (!rules) return;  // the folder that it is in sees to that
    if (fsync(fileno(file)) != 0) fail();
    struct stat status = {};
    if (fstat(fileno(file), &status) != 0) fail();
    const std::string mark = mark_of(status);
    // Without attributes the next output asks for --replace.
    fsetxattr(fileno(file), kMark, mark.data(), mark.size(), 0);
  }

  /// Gives the file a name beside its place, for the one step that replaces an older file.
  void give_name() {
    if (!name.empty()) return;
    const std::string self = "/proc/self/fd/" + std::to_string(fileno(file));
    do {
      name = partial_path(place.parent_path(), place.filename().string());
      if (linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
    } while (errno == EEXIST);
    name.clear();
    fail();
  }

  void put_in_place(bool moves_older) {
    give_name();
    if (moves_older) rename_to_free(place, free_old_name(place));
    if (std::rename(name.c_str(), place.c_str()) != 0) fail();
    name.clear();
    if (rules) sync_names(place.parent_path());
  }

  fs::path named;
  std::optional<OutputRules> rules;
  bool goes_through = false;  ///< a device or a pipe
  fs::path place, name;       ///< name: of the partial file, if it has one
  std::FILE* file = nullptr;
};

AtomicFile::AtomicFile(const fs::path& path)
    : state_(std::make_unique<State>(path, std::nullopt)) {}

AtomicFile::AtomicFile(const fs::path& path, const OutputRules& rules,
                       std::initializer_list<const char*> extensions) {
  const std::string extension = lower(path.extension().string());
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!path.empty() && extensions.size() > 0 && !can_be_written_to(status) &&
      !fs::is_directory(status) &&
      std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string list;
    for (const char* allowed : extensions)
      list += (list.empty() ? "" : ", ") + std::string(allowed);
    throw Error(ErrorCode::kInvalidArgument,
                path.string() + ": the name of this output ends in " + list);
  }
  state_ = std::make_unique<State>(path, rules);
}

AtomicFile::~AtomicFile() = default;
AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), state_->file) != bytes.size()) state_->fail();
}

void AtomicFile::write_at_begin(std::string_view bytes) {
  std::rewind(state_->file);
  write(bytes);
  if (std::fseek(state_->file, 0, SEEK_END) != 0) state_->fail();
}

void AtomicFile::commit(const RunControl& control) { commit_together({this, 1}, control); }

void AtomicFile::commit_together(std::span<AtomicFile> files, const RunControl& control) {
  std::vector<bool> moves_older;
  for (AtomicFile& file : files) {
    State& state = *file.state_;
    state.make_durable();
    moves_older.push_back(!state.goes_through && state.look());
    if (!state.goes_through && files.size() > 1) state.give_name();
  }
  control.keep_result();
  for (std::size_t i = 0; i < files.size(); ++i) {
    State& state = *files[i].state_;
    if (state.goes_through)
      state.write_through();
    else
      state.put_in_place(moves_older[i]);
  }
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace gigaray
