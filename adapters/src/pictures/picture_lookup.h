// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gigaray {

/// Finds pictures in a folder under the names that files of cameras have for them. Lists every
/// folder once.
class PictureLookup {
 public:
  explicit PictureLookup(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The name, relative to the folder, that a picture is found under; empty: none. In this order:
  /// as it is stated; with `/` for `\`; in other letter case; with the extension of a picture where
  /// it has none, or another one where that leaves one picture alone.
  std::string find(const std::string& stated) const;

  /// The same for a name that lies in other folders on another machine: what stands behind its
  /// first, second … folder.
  std::string find_below(const std::string& stated) const;

 private:
  /// Names in a folder below, by their lower case.
  const std::multimap<std::string, std::string>& names_in(const std::filesystem::path& below) const;

  std::filesystem::path folder_;
  mutable std::map<std::filesystem::path, std::multimap<std::string, std::string>> listed_;
};

/// Names of pictures as they are found.
struct FoundNames {
  std::filesystem::path folder;
  /// In the order asked for; those that are not there as they were stated, with `/` for `\`.
  std::vector<std::string> names;
};

/// The folder in which most of the pictures are, the earlier one of equals. Stated paths of another
/// machine are tried where a picture is not there as stated.
FoundNames find_names(const std::vector<std::filesystem::path>& folders,
                      const std::vector<std::string>& stated);

}  // namespace gigaray
