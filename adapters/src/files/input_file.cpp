// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "files/text.h"
#include "gigaray/core/error.h"
#include "gigaray/core/memory_limit.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr double kMiB = 1 << 20;
constexpr double kLeastLimit = 64 * kMiB;

[[noreturn]] void unreadable(const fs::path& path) {
  throw Error(ErrorCode::kIo,
              path.string() + ": can't be read (" + std::generic_category().message(errno) + ")");
}

void refuse_other_kinds(const fs::path& path, mode_t mode) {
  if (S_ISREG(mode)) return;
  if (S_ISDIR(mode)) throw Error(ErrorCode::kIo, path.string() + ": is a folder, not a file");
  const char* kind = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  throw Error(ErrorCode::kBadInput, path.string() + ": is " + kind +
                                        ", not a file; write what it gives into a file and name "
                                        "that");
}

/// "1.5 KiB", "24 MiB"
std::string size_in_words(double bytes) {
  constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  int unit = 0;
  for (; bytes >= 1024 && unit < 6; ++unit) bytes /= 1024;
  std::string text =
      std::to_string(unit > 0 && bytes < 10 ? std::round(10 * bytes) / 10 : std::round(bytes));
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " " + kUnits[unit];
}

}  // namespace

double opening_limit(double memory_bytes) {
  return std::max(memory_bytes > 0 ? memory_bytes : default_memory_limit(), kLeastLimit);
}

void hold_against_limit(const std::string& place, const std::string& claim, double bytes,
                        double limit) {
  if (!(bytes <= limit))
    throw Error(ErrorCode::kBadInput,
                place + ": " + claim + ", which takes " + size_in_words(bytes) +
                    " of memory; the limit is " + size_in_words(limit) +
                    " (three quarters of what is free, or OpenOptions::memory_bytes)");
}

InputFile::InputFile(const fs::path& path) : path_(path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) unreadable(path);
  refuse_other_kinds(path, about.st_mode);
  // Whatever took its place meanwhile is not waited for.
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) unreadable(path);
  try {
    if (fstat(descriptor_, &about) != 0) unreadable(path);
    refuse_other_kinds(path, about.st_mode);
  } catch (const Error&) {
    close(descriptor_);
    throw;
  }
  size_ = std::uint64_t(about.st_size);
}

InputFile::~InputFile() { close(descriptor_); }

std::uint64_t InputFile::read(std::uint64_t offset, char* bytes, std::uint64_t size) const {
  std::uint64_t got = 0;
  while (got < size) {
    const ssize_t more = pread(descriptor_, bytes + got, size - got, off_t(offset + got));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) unreadable(path_);
    if (more == 0) break;
    got += std::uint64_t(more);
  }
  return got;
}

std::string InputFile::read(std::uint64_t offset, std::uint64_t size) const {
  std::string bytes(offset < size_ ? std::min(size, size_ - offset) : 0, '\0');
  bytes.resize(read(offset, bytes.data(), bytes.size()));
  return bytes;
}

void check_input_file(const fs::path& path) { InputFile{path}; }

std::string read_bytes(const fs::path& path, double most) {
  const InputFile file(path);
  if (double(file.size()) > most)
    throw Error(ErrorCode::kBadInput, path.string() + ": has " +
                                          size_in_words(double(file.size())) +
                                          "; the limit for such a file is " + size_in_words(most));
  return file.read(0, file.size());
}

std::string read_text(const fs::path& path) { return as_utf8(read_bytes(path, double(kMostText))); }

std::string read_json_text(const fs::path& path, double memory_bytes) {
  std::string text = as_utf8(read_bytes(path, double(kMostJson)));
  check_json(text, path.string(), memory_bytes);
  return text;
}

void check_json(std::string_view text, const std::string& where, double memory_bytes) {
  // A member of an object takes three of these marks and some 130 bytes, an entry of a list one and
  // up to 48 while the list grows.
  constexpr double kBytesPerMark = 64;
  double marks = 1;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        quoted = false;
      continue;
    }
    switch (c) {
      case '"':
        quoted = true;
        ++marks;
        break;
      case '[':
      case '{':
        ++marks;
        if (++depth > kDeepestJson)
          throw Error(ErrorCode::kBadInput, where + ": is nested deeper than " +
                                                std::to_string(kDeepestJson) +
                                                " levels; it is damaged or not meant for this");
        break;
      case ']':
      case '}':
        --depth;
        break;
      case ',':
      case ':':
        ++marks;
        break;
      default:
        break;
    }
  }
  // So many take a few seconds to parse; a description of 100,000 photographs has half of them.
  constexpr double kMostMarks = 8e6;
  if (marks > kMostMarks)
    throw Error(ErrorCode::kBadInput, where + ": holds " + std::to_string(std::uint64_t(marks)) +
                                          " values; the limit is 8000000");
  hold_against_limit(where, "holds " + std::to_string(std::uint64_t(marks)) + " values",
                     kBytesPerMark * marks + double(text.size()), opening_limit(memory_bytes));
}

}  // namespace gigaray
