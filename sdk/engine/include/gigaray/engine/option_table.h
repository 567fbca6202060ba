// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Every field of DepthOptions, once: name, type, range, unit and meaning. DepthOptions::check(),
// the program's --set and --options, the record of a run and docs/options.md come from this table.
// To add a field: depth_options.h and one line of the table in option_table.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/option_value.h"
#include "gigaray/engine/depth_options.h"

namespace GIGARAY_API gigaray {

enum class OptionType {
  kBool,
  kInteger,
  kNumber,
  kRange,    ///< two numbers, or nothing
  kIndices,  ///< a list of integers, which may be empty
  kText
};
const char* to_string(OptionType type);

/// Bounds of a number, which belong to it. Infinite: any but NaN.
struct OptionBounds {
  double least, most;
  bool or_zero = false;  ///< 0 is another way to say nothing
};

/// A field of DepthOptions.
struct DepthOption {
  template <class T>
  using Access = T& (*)(DepthOptions&);
  using Field = std::variant<Access<bool>, Access<int>, Access<float>, Access<double>,
                             Access<std::optional<DisparityRange>>, Access<std::vector<int>>,
                             Access<std::string>>;

  const char* name;  ///< with dots: "winner.median_radius"
  Field field;
  OptionBounds bounds;  ///< of integers, numbers and of both ends of a range
  const char* unit;     ///< "": none
  const char* meaning;  ///< one line

  OptionType type() const;
  /// A float comes as the shortest decimal number that gives the same float.
  OptionValue get(const DepthOptions& options) const;
  /// Numbers become what the field is: 3 and 3.0 are the same, words are read as what they hold.
  /// Throws Error(kInvalidArgument), one line with the field and the value, for what can't be meant
  /// and for what check() refuses; the options are as before then.
  void set(DepthOptions& options, const OptionValue& value) const;
  /// Throws Error(kInvalidArgument) with the field and its value where it is out of bounds.
  void check(const DepthOptions& options) const;
};

/// In the order of depth_options.h.
const std::vector<DepthOption>& depth_option_table();

/// Null: there is none of this name.
const DepthOption* find_depth_option(std::string_view name);

/// DepthOption::set() by name. Throws Error(kInvalidArgument), also where there is no such option.
void set_option(DepthOptions& options, std::string_view name, const OptionValue& value);

/// All fields: options that set_option() gets them one by one are equal to these, to the bit.
std::vector<NamedValue> option_values(const DepthOptions& options);

/// As a command line states it: "3", "true", "-1 2", "0,4,6"; nothing: "none".
std::string to_text(const OptionValue& value);

/// docs/options.md: the table, with the values that the presets have.
std::string option_reference();

}  // namespace gigaray
