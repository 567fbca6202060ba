// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "bytes.h"

#include <zstd.h>

#include <memory>
#include <new>

#include "gigaray/core/error.h"
#include "gigaray/sparse/sparse_coding.h"

namespace gigaray {
namespace {

// Higher levels search longer for repetitions, which differences hardly have.
constexpr int kLevel = 5;

using Compressor = std::unique_ptr<ZSTD_CCtx, decltype([](ZSTD_CCtx* c) { ZSTD_freeCCtx(c); })>;

ZSTD_CCtx* compressor() {
  thread_local const Compressor context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  return context.get();
}

std::string zstd(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compressCCtx(compressor(), packed.data(), packed.size(),
                                             bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size)) throw Error(ErrorCode::kIo, ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

void damaged(const char* what) {
  throw Error(ErrorCode::kBadInput, std::string("is damaged: ") + what);
}

void ByteWriter::number(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_.push_back(char(value | 0x80));
  bytes_.push_back(char(value));
}

void ByteWriter::signed_number(std::int64_t value) { number(zigzag(value)); }

void ByteWriter::block(std::string_view bytes) {
  number(bytes.size());
  if (bytes.empty()) return;
  const std::string packed = zstd(bytes);
  number(packed.size());
  bytes_ += packed;
}

std::uint64_t ByteReader::number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    if (bytes_.empty()) damaged("a part ends too early");
    const auto byte = std::uint8_t(bytes_.front());
    bytes_.remove_prefix(1);
    value |= std::uint64_t(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  damaged("a number is too large");
}

std::uint64_t ByteReader::number(std::uint64_t most) {
  const std::uint64_t value = number();
  if (value > most) damaged("a number is too large");
  return value;
}

std::int64_t ByteReader::signed_number(std::int64_t most) {
  return unzigzag(number(zigzag(-most)));
}

std::string ByteReader::block(std::size_t most) {
  const std::size_t size = number(most);
  if (size == 0) return {};
  const std::size_t packed = number(bytes_.size());
  if (packed > bytes_.size()) damaged("a part ends too early");
  if (ZSTD_getFrameContentSize(bytes_.data(), packed) != size)
    damaged("a part states another size than it has");
  std::string bytes(size, '\0');
  const std::size_t got = ZSTD_decompress(bytes.data(), size, bytes_.data(), packed);
  if (ZSTD_isError(got) || got != size) damaged("a part can't be decompressed");
  bytes_.remove_prefix(packed);
  return bytes;
}

std::string compressed(std::string_view bytes) {
  ByteWriter out;
  out.block(bytes);
  return out.take();
}

std::string decompressed(std::string_view bytes, std::size_t most) {
  ByteReader in(bytes);
  std::string result = in.block(most);
  if (!in.at_end()) damaged("more follows than it should have");
  return result;
}

}  // namespace gigaray
