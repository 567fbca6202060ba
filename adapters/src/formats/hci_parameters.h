// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gigaray {

/// parameters.cfg of an HCI scene: lines "key = value" or "key: value", keys in any letter case,
/// perhaps in quotes, with comments behind ; or #; sections and anything else are passed over.
/// Errors (kBadInput) begin with `where`, the file's name.
class HciParameters {
 public:
  HciParameters(std::string_view text, std::string where);

  /// Empty when there is no such key; throws when it isn't a finite number.
  std::optional<double> number(const std::string& key) const;
  /// 1 … 1000, `usual` when there is no such key.
  int cameras(const std::string& key, int usual) const;

 private:
  std::string where_;
  std::map<std::string, std::string> values_;
};

}  // namespace gigaray
