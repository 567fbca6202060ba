// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/atomic_output.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "gigaray/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, const std::error_code& why) {
  throw Error(ErrorCode::kIo, path.string() + ": can't be written (" + why.message() + ")");
}

// Beside `path`, so that renaming stays on one file system; hidden, so that no reader takes it.
fs::path temporary_beside(const fs::path& path) {
  static std::atomic<int> counter{0};
  return path.parent_path() / ("." + path.filename().string() + ".partial-" +
                               std::to_string(getpid()) + "-" + std::to_string(counter++));
}

// "format" in a JSON file; empty when there is none.
std::string format_of(const fs::path& description) {
  std::ifstream file(description);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) return {};
  const auto format = json.find("format");
  return format != json.end() && format->is_string() ? format->get<std::string>() : "";
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw Error(ErrorCode::kInvalidArgument, path.string() + ": is a folder; name a file");
  temporary_ = temporary_beside(path);
  errno = 0;
  file_.open(temporary_, std::ios::binary);
  check();
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::check() {
  if (!file_) cannot_write(path_, std::error_code(errno, std::generic_category()));
}

void AtomicFile::write(std::string_view bytes) {
  errno = 0;
  file_.write(bytes.data(), std::streamsize(bytes.size()));
  check();
}

void AtomicFile::write_at_begin(std::string_view bytes) {
  errno = 0;
  file_.seekp(0);
  file_.write(bytes.data(), std::streamsize(bytes.size()));
  file_.seekp(0, std::ios::end);
  check();
}

void AtomicFile::commit() {
  errno = 0;
  file_.close();
  check();
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) cannot_write(path_, error);
  temporary_.clear();
}

AtomicFolder::AtomicFolder(const fs::path& target, std::string format, std::string description)
    : format_(std::move(format)), description_(std::move(description)) {
  std::error_code error;
  // Without links and "." parts: the folder is renamed, which needs its own name.
  target_ = fs::weakly_canonical(fs::absolute(target), error);
  if (error) cannot_write(target, error);
  if (!target_.has_filename()) target_ = target_.parent_path();
  check_target();
  partial_ = target_;
  partial_ += ".partial-" + std::to_string(getpid());
  fs::create_directories(target_.parent_path(), error);
  if (error || !fs::create_directory(partial_, error))
    cannot_write(target_, error ? error : std::make_error_code(std::errc::file_exists));
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void AtomicFolder::check_target() const {
  std::error_code error;
  if (!fs::exists(target_, error)) return;
  if (!fs::is_directory(target_, error))
    throw Error(ErrorCode::kInvalidArgument,
                target_.string() + ": is a file; name a folder for the output");
  const bool empty = fs::is_empty(target_, error);
  if (error) cannot_write(target_, error);
  if (!empty && format_of(target_ / description_) != format_)
    throw Error(ErrorCode::kInvalidArgument,
                target_.string() +
                    ": is not empty and no earlier output of this command; name "
                    "another folder");
}

void AtomicFolder::commit() {
  GIGARAY_CHECK(!partial_.empty());
  check_target();  // It may have changed during a long run.
  std::error_code error;
  fs::path old;
  if (fs::exists(target_, error) && !fs::is_empty(target_, error)) {
    old = target_;
    old += ".old-" + std::to_string(getpid());
    fs::rename(target_, old, error);
    if (error) cannot_write(target_, error);
  }
  fs::rename(partial_, target_, error);
  if (error) {
    std::error_code ignored;
    if (!old.empty()) fs::rename(old, target_, ignored);
    cannot_write(target_, error);
  }
  partial_.clear();
  if (!old.empty()) fs::remove_all(old, error);
}

}  // namespace gigaray
