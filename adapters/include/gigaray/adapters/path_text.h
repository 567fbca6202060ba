// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// A path as text for JSON, which is UTF-8: as it is, or, where its bytes are none (names in
/// Latin-1), as "file:" and the path with those bytes percent-encoded, as in RFC 8089.
std::string path_text(const std::filesystem::path& path);
/// The path of such a text.
std::filesystem::path path_of_text(std::string_view text);

/// The name of a view whose picture has this name: without bytes that are no UTF-8 and without
/// control characters, both percent-encoded, so that it can stand in JSON, in lists and on a
/// terminal and names a folder.
std::string view_name_of(std::string_view name);

/// A path as one word of a shell, for lines that the user can copy: in quotes if it needs them.
std::string shell_word(const std::filesystem::path& path);

}  // namespace gigaray
