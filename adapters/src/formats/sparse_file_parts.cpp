// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/sparse_file_parts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/described_light_field.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/sparse/sparse_coding.h"

namespace gigaray {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json to_json(const Section& section) {
  return {section.offset, section.size, section.checksum};
}

Section to_section(const json& entry) { return {entry.at(0), entry.at(1), entry.at(2)}; }

SparseDirectory parse(const json& root) {
  const auto bad = [](const char* what) { return Error(ErrorCode::kBadInput, what); };
  SparseDirectory directory;
  directory.light_field = described_light_field(root);
  const int bit_depth = root.at("bit_depth");
  if (bit_depth != 8 && bit_depth != 16) throw bad("its bit depth is neither 8 nor 16");
  directory.max_error = root.at("max_error");
  const LightField& light_field = directory.light_field;
  constexpr int kMostSize = 1 << 20;
  if (light_field.width < 1 || light_field.height < 1 || light_field.width > kMostSize ||
      light_field.height > kMostSize || light_field.views.empty())
    throw bad("its size is absurd");
  const int band_rows = root.at("band_rows");
  if (band_rows < 1 || band_rows > kMostSize) throw bad("its bands are absurd");
  directory.shape = sparse_shape(light_field, bit_depth, band_rows);
  directory.shape.slope_bits = root.at("slope_bits");
  directory.shape.slope_tolerance = root.at("slope_tolerance");
  if (directory.shape.slope_bits < 0 || directory.shape.slope_bits > 20 ||
      directory.shape.slope_tolerance < 0)
    throw bad("its slopes are absurd");
  for (const json& entry : root.at("tuples"))
    directory.tuples.push_back({to_section(entry.at(0)), entry.at(1), entry.at(2)});
  for (const json& view : root.at("differences"))
    std::transform(view.begin(), view.end(),
                   std::back_inserter(directory.differences.emplace_back()), to_section);
  const std::size_t bands = directory.shape.num_bands();
  if (directory.tuples.size() != bands ||
      directory.differences.size() != light_field.views.size() ||
      std::any_of(directory.differences.begin(), directory.differences.end(),
                  [&](const auto& view) { return view.size() != bands; }))
    throw bad("it has not as many sections as views and bands");
  return directory;
}

}  // namespace

std::string encode_directory(const SparseDirectory& directory) {
  ordered_json root = description_of(directory.light_field);
  root["bit_depth"] = directory.shape.bit_depth;
  root["max_error"] = directory.max_error;
  root["slope_bits"] = directory.shape.slope_bits;
  root["slope_tolerance"] = directory.shape.slope_tolerance;
  root["band_rows"] = directory.shape.band_rows;
  for (const TupleSection& band : directory.tuples)
    root["tuples"].push_back({to_json(band.section), band.least_slope, band.largest_slope});
  for (const std::vector<Section>& view : directory.differences) {
    ordered_json sections = ordered_json::array();
    for (const Section& section : view) sections.push_back(to_json(section));
    root["differences"].push_back(sections);
  }
  return compressed(root.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

SparseDirectory decode_directory(std::string_view bytes, const std::string& where, double limit) {
  std::string text;
  try {
    text = decompressed(bytes, std::size_t(std::min(limit, double(kMostJson))));
  } catch (const Error& problem) {
    throw Error(ErrorCode::kBadInput, where + ": " + problem.what());
  }
  check_json(text, where, limit);
  try {
    return parse(json::parse(text));
  } catch (const json::exception& problem) {
    throw Error(ErrorCode::kBadInput,
                where + ": is damaged: its directory can't be read (" + problem.what() + ")");
  } catch (const Error& problem) {
    throw Error(ErrorCode::kBadInput, where + ": " + problem.what());
  }
}

void fill_undrawn(DrawnRows& drawn) {
  for (int v = 0; v < drawn.rows.size(); ++v) {
    int last = -1;
    const auto copy = [&](int from, int to) {
      for (int c = 0; c < 3; ++c) drawn.colour(to, v, c) = drawn.colour(from, v, c);
    };
    for (int u = 0; u < drawn.slope.width(); ++u) {
      if (drawn.slope(u, v) == DrawnRows::kNone) {
        if (last >= 0) copy(last, u);
        continue;
      }
      if (last < 0)
        for (int left = 0; left < u; ++left) copy(u, left);
      last = u;
    }
  }
}

}  // namespace gigaray
