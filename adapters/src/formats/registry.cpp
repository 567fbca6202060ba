// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/registry.h"

#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/photographs.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "formats/readers.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHciScene = "HCI scene";

std::vector<std::unique_ptr<const Reader>> all_readers() {
  std::vector<std::unique_ptr<const Reader>> all;
  all.push_back(gigaray_json_reader());
  all.push_back(sparse_file_reader());
  all.push_back(hci_reader());
  all.push_back(hdf5_reader());
  all.push_back(stanford_reader());
  all.push_back(lenslet_reader());
  all.push_back(colmap_reader());
  all.push_back(transforms_json_reader());
  all.push_back(llff_reader());
  all.push_back(mvsnet_reader());
  all.push_back(middlebury_par_reader());
  all.push_back(middlebury_stereo_reader());
  all.push_back(calibrated_pair_reader());
  all.push_back(strecha_reader());
  all.push_back(named_grid_reader());
  all.push_back(image_sequence_reader());
  return all;
}

// --lenslet makes any single picture a lenslet picture, and goes with nothing else.
const Reader& lenslet_reader_for(const fs::path& input) {
  std::error_code ignored;
  if (!fs::is_regular_file(input, ignored) || !is_picture(input))
    throw Error(ErrorCode::kInvalidArgument, "OpenOptions::lenslet: " + input.string() +
                                                 " is not one picture; leave the option out");
  static const std::unique_ptr<const Reader> reader = lenslet_reader();
  return *reader;
}

// The reader for the input. A positions file makes any folder of pictures an image sequence.
const Reader& reader_for(const fs::path& input, const OpenOptions& options) {
  if (options.lenslet.columns > 0) return lenslet_reader_for(input);
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
  if (best && options.grid.rows > 0 && best->name() != kHciScene && best != readers().back().get())
    throw Error(
        ErrorCode::kInvalidArgument,
        "OpenOptions::grid: goes with pictures that have one number in their names, not with the "
        "format " +
            best->name());
  if (best) return *best;
  throw Error(ErrorCode::kBadInput, input.string() + ": " + why_not);
}

}  // namespace

const std::vector<std::unique_ptr<const Reader>>& readers() {
  static const auto all = all_readers();
  return all;
}

fs::path folder_of_photographs(const fs::path& input) {
  const bool is_known = std::any_of(readers().begin(), readers().end(), [&](const auto& reader) {
    return reader->probe(input).score > 0;
  });
  return !is_known && !pictures_of(input / "images").empty() ? input / "images" : input;
}

bool is_plain_folder(const fs::path& input, const OpenOptions& options) {
  std::error_code error;
  return fs::is_directory(input, error) && options.positions.empty() &&
         &reader_for(input, options) == readers().back().get();
}

LightField open_light_field(const fs::path& input, const OpenOptions& options) {
  std::error_code error;
  if (!fs::exists(input, error))
    throw Error(error ? ErrorCode::kIo : ErrorCode::kBadInput,
                input.string() + ": " + (error ? error.message() : "no such file or folder"));
  if (!fs::is_directory(input, error)) check_input_file(input);
  const Reader& reader = reader_for(input, options);
  LightField light_field = reader.open(input, options);
  light_field.format = reader.name();
  for (std::vector<View>* views : {&light_field.views, &light_field.left_out})
    for (View& view : *views) view.name = view_name_of(view.name);
  const bool is_posed = light_field.kind == LightFieldKind::kUnstructured;
  for (const auto& [option, is_stated] :
       {std::pair("OpenOptions::images", !options.images.empty()),
        std::pair("OpenOptions::convention", options.convention.has_value())})
    if (is_stated && !is_posed)
      throw Error(ErrorCode::kInvalidArgument,
                  std::string(option) + ": goes with photographs whose cameras are known, not " +
                      "with a light field of the format " + light_field.format);
  if (!options.masks.empty() && !is_posed && !light_field.pixels->has_mask())
    throw Error(
        ErrorCode::kInvalidArgument,
        "OpenOptions::masks: goes with pictures in files, not with a light field of the format " +
            light_field.format);
  try {
    check(light_field);
  } catch (const Error& problem) {
    throw Error(problem.code(), input.string() + ": " + problem.what());
  }
  light_field = KeptPictures::over(options.kept, std::move(light_field));
  if (!options.positions.empty()) return light_field;
  if (const std::string note = unused_cameras(input, light_field.format); !note.empty())
    light_field.notes.push_back(note);
  return light_field;
}

}  // namespace gigaray
