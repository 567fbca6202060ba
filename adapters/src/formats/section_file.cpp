// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/section_file.h"

#include <xxhash.h>

#include <array>
#include <bit>
#include <cstddef>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they are");

// As in PNG: no text, and copies that changed line ends show.
constexpr char kMagic[8] = {'\x89', 'G', 'R', 'L', '\r', '\n', '\x1a', '\n'};
constexpr std::uint64_t kVersion = 1;

struct Head {
  std::array<char, 8> magic = std::to_array(kMagic);
  std::uint64_t version = kVersion;
  std::uint64_t file_size = 0;
  Section directory;
  std::uint64_t checksum = 0;  ///< of what stands before it
};
static_assert(sizeof(Head) == 56 && std::has_unique_object_representations_v<Head>);

std::uint64_t checksum_of(std::string_view bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

std::string_view bytes_of(const Head& head) {
  return {reinterpret_cast<const char*>(&head), sizeof(Head)};
}

std::uint64_t checksum_of(const Head& head) {
  return checksum_of(bytes_of(head).substr(0, offsetof(Head, checksum)));
}

}  // namespace

SectionWriter::SectionWriter(AtomicFile file) : file_(std::move(file)), size_(sizeof(Head)) {
  file_.write(bytes_of(Head{}));
}

Section SectionWriter::add(std::string_view bytes) {
  const Section section{size_, bytes.size(), checksum_of(bytes)};
  file_.write(bytes);
  size_ += bytes.size();
  return section;
}

std::uint64_t SectionWriter::finish(std::string_view directory, const RunControl& control) {
  Head head;
  head.directory = add(directory);
  head.file_size = size_;
  head.checksum = checksum_of(head);
  file_.write_at_begin(bytes_of(head));
  file_.commit(control);
  return size_;
}

SectionReader::SectionReader(const std::filesystem::path& path, double limit)
    : file_(path), size_(file_.size()), limit_(limit) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  Head head;
  const std::size_t got = file_.read(0, reinterpret_cast<char*>(&head), sizeof head);
  if (got < sizeof head.magic || head.magic != std::to_array(kMagic))
    throw bad("is no sparse light field, or damaged at its begin");
  if (got < sizeof head) throw bad("is cut short");
  if (head.checksum != checksum_of(head) && head.version <= kVersion)
    throw bad("is damaged: the checksum of its head is wrong");
  if (head.version > kVersion)
    throw bad("has version " + std::to_string(head.version) +
              "; this program reads up to version " + std::to_string(kVersion) +
              ": get a newer one");
  if (size_ < head.file_size)
    throw bad("is cut short: " + std::to_string(size_) + " of " + std::to_string(head.file_size) +
              " bytes");
  if (size_ > head.file_size) throw bad("is damaged: more follows after its end");
  directory_ = head.directory;
}

std::string SectionReader::read(const Section& section) const {
  if (section.offset > size_ || section.size > size_ - section.offset)
    throw Error(ErrorCode::kBadInput, path().string() + ": is damaged: a section lies outside");
  hold_against_limit(path().string(), "has a section of " + std::to_string(section.size) + " bytes",
                     double(section.size), limit_);
  const std::string bytes = file_.read(section.offset, section.size);
  if (bytes.size() != section.size)
    throw Error(ErrorCode::kIo, path().string() + ": can't be read to its end");
  if (checksum_of(bytes) != section.checksum)
    throw Error(ErrorCode::kBadInput, path().string() +
                                          ": is damaged: a checksum is wrong between bytes " +
                                          std::to_string(section.offset) + " and " +
                                          std::to_string(section.offset + section.size));
  return bytes;
}

}  // namespace gigaray
