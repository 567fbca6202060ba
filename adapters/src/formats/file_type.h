// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

namespace gigaray {

enum class FileKind {
  kOther,    ///< no picture
  kPicture,  ///< as cameras and programs write them
  kLight,    ///< what only holds floating point: OpenEXR, RGBE, PFM with three channels
  kUnread,   ///< a picture or film of a type that is not read
};

/// What a file is.
struct FileType {
  FileKind kind = FileKind::kOther;
  /// Of what is not read: "raw photograph (NEF)", "video".
  std::string name;
  /// Of what is not read: what makes pictures of it that are, with a command.
  std::string remedy;
};

/// By the first bytes of the file, whatever its name; by its name where a format has no mark of its
/// own (TGA, transport streams). A few bytes are read; what can't be is kOther.
FileType file_type(const std::filesystem::path& path);

/// The same, but for what has an extension of usual pictures or of something else nothing is read:
/// cheap for folders of many files.
FileKind likely_kind(const std::filesystem::path& path);

/// Is it OpenEXR, by its first bytes?
bool is_exr(const std::filesystem::path& path);

/// Is it a picture of a type that loses detail as a rule: JPEG, WebP, HEIF, AVIF?
bool is_lossy(const std::filesystem::path& path);

/// "is a video; …" with what makes pictures of it. Empty when that is not the trouble.
std::string why_unread(const std::filesystem::path& path);

/// "a.nef, one of 12, is a raw photograph (NEF), …": what a folder holds instead of pictures that
/// can be read. Empty when it holds nothing of the kind. Throws as files_of().
std::string why_no_pictures(const std::filesystem::path& folder);

}  // namespace gigaray
