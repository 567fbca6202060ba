// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/registry.h"

#include <system_error>

#include "readers.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

std::vector<std::unique_ptr<const Reader>> all_readers() {
  std::vector<std::unique_ptr<const Reader>> all;
  all.push_back(gigaray_json_reader());
  all.push_back(hci_reader());
  all.push_back(stanford_reader());
  for (auto& reader : later_formats()) all.push_back(std::move(reader));
  all.push_back(image_sequence_reader());
  return all;
}

// The reader for the input. A positions file makes any folder of pictures an image sequence.
const Reader& reader_for(const fs::path& input, const OpenOptions& options) {
  const Reader* best = nullptr;
  int best_score = 0;
  std::string why_not;
  for (const auto& reader : readers()) {
    const ProbeResult result = reader->probe(input);
    if (!options.positions.empty() && reader != readers().back() && result.score > 0) continue;
    if (result.score > best_score) {
      best = reader.get();
      best_score = result.score;
    }
    if (!result.why_not.empty()) why_not = result.why_not;
  }
  if (best) return *best;
  throw Error(ErrorCode::kBadInput, input.string() + ": " + why_not);
}

}  // namespace

const std::vector<std::unique_ptr<const Reader>>& readers() {
  static const auto all = all_readers();
  return all;
}

LightField open_light_field(const fs::path& input, const OpenOptions& options) {
  std::error_code error;
  if (!fs::exists(input, error))
    throw Error(error ? ErrorCode::kIo : ErrorCode::kBadInput,
                input.string() + ": " + (error ? error.message() : "no such file or folder"));
  const Reader& reader = reader_for(input, options);
  LightField light_field = reader.open(input, options);
  light_field.format = reader.name();
  try {
    check(light_field);
  } catch (const Error& problem) {
    throw Error(problem.code(), input.string() + ": " + problem.what());
  }
  return light_field;
}

}  // namespace gigaray
