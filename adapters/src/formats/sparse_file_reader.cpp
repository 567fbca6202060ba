// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A .grl file as a light field.
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "gigaray/adapters/sparse_file.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

class SparseFileReader : public Reader {
 public:
  std::string name() const override { return kSparseFormat; }

  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    return {
        lower(input.extension().string()) == ".grl" && fs::is_regular_file(input, ignored) ? 90 : 0,
        ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "a .grl file states");
    LightField light_field = SparseFile(input, options.memory_bytes).light_field();
    check(light_field);
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> sparse_file_reader() { return std::make_unique<SparseFileReader>(); }

}  // namespace gigaray
