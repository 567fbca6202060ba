// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <functional>
#include <system_error>

#include "readers.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_transforms_json(const fs::path& input) {
  return input.filename() == "transforms.json" || is_there(input / "transforms.json");
}

bool is_llff(const fs::path& input) {
  return input.filename() == "poses_bounds.npy" || is_there(input / "poses_bounds.npy");
}

class LaterFormat : public Reader {
 public:
  LaterFormat(std::string name, std::function<bool(const fs::path&)> fits)
      : name_(std::move(name)), fits_(std::move(fits)) {}
  std::string name() const override { return name_; }
  ProbeResult probe(const fs::path& input) const override { return {fits_(input) ? 80 : 0, ""}; }
  LightField open(const fs::path& input, const OpenOptions&) const override {
    throw Error(ErrorCode::kBadInput, input.string() + ": " + name_ +
                                          " is not readable yet by this version; pictures along a "
                                          "line or in a grid are");
  }

 private:
  std::string name_;
  std::function<bool(const fs::path&)> fits_;
};

}  // namespace

std::vector<std::unique_ptr<const Reader>> later_formats() {
  std::vector<std::unique_ptr<const Reader>> formats;
  formats.push_back(std::make_unique<LaterFormat>("transforms.json", is_transforms_json));
  formats.push_back(std::make_unique<LaterFormat>("LLFF poses_bounds.npy", is_llff));
  return formats;
}

}  // namespace gigaray
