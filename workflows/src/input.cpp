// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/photographs.h"
#include "gigaray/adapters/shrunk.h"
#include "gigaray/workflows/view_list.h"
#include "open_as_asked.h"
#include "view_layout.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Where the finished run of COLMAP notes what it was for.
constexpr const char* kRecord = "photographs.txt";

/// Names, sizes and times of what COLMAP looks at, and the lens: the same text, the same cameras.
std::string record_of(const fs::path& photographs, const ColmapRunOptions& options) {
  std::string record;
  for (const fs::path& folder : {photographs, options.masks}) {
    if (folder.empty()) continue;
    std::vector<std::string> lines;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file())
        lines.push_back(fmt::format("{} {} {}\n", entry.path().filename().string(),
                                    entry.file_size(),
                                    entry.last_write_time().time_since_epoch().count()));
    std::sort(lines.begin(), lines.end());
    record += fs::absolute(folder).string() + "\n";
    for (const std::string& line : lines) record += line;
  }
  if (options.quality == ColmapQuality::kLow) record += "low quality\n";
  if (options.quality == ColmapQuality::kHigh) record += "high quality\n";
  if (options.max_size > 0) record += fmt::format("at most {} px\n", options.max_size);
  if (options.lens)
    record += fmt::format("{} {:.9g} {}\n", options.lens->model,
                          fmt::join(options.lens->params, " "), options.refine_lens);
  return record;
}

/// Is said where the views are, with nothing left to judge?
bool states_layout(const OpenOptions& open) {
  return open.direction != Travel::kAuto || open.lenslet.columns > 0 || open.grid.rows > 0;
}

/// Why the pictures of a plain folder are no row and no grid; empty: they are, or may be.
std::string why_walk(const InputRequest& input, const RunControl& control) {
  const std::string why = why_no_series(input.path, input.open.memory_bytes);
  if (!why.empty()) return why;
  LightField light_field = open_as_asked(input);
  // Two whole pictures, and what is made of them to find features.
  constexpr double kBytesPerPixel = 18;
  hold_against_limit(
      input.path.string(),
      fmt::format("has pictures of {} × {} px", light_field.width, light_field.height),
      kBytesPerPixel * light_field.width * light_field.height,
      opening_limit(input.open.memory_bytes));
  const auto across = displacement_across_rows(light_field, control);
  if (!across || *across <= kMostAcrossRows) return {};
  RunControl silent;
  silent.on_progress = control.on_progress;
  if (settle_layout(input, light_field, silent)) return {};
  return fmt::format("{}: the pictures are no row, things move {:.1f} px across it",
                     input.path.string(), *across);
}

}  // namespace

LightField open_as_asked(const fs::path& place, const InputRequest& request,
                         const OpenOptions& options) {
  OpenOptions given = options;
  if (request.max_size > 0) given.kept.reset();  // the shrunk ones are kept
  LightField light_field = open_light_field(place, given);
  if (!request.without.empty())
    light_field = gigaray::without(light_field, parse_views(request.without, light_field));
  request.rig.apply(light_field);
  if (request.max_size == 0) return light_field;
  light_field = shrunk(std::move(light_field), request.max_size);
  std::vector<std::string> keys;
  for (const View& view : light_field.views)
    keys.push_back(place.string() + '\n' + view.name + '\n' + std::to_string(request.max_size));
  light_field.pixels = KeptPictures::over(options.kept, light_field.pixels, std::move(keys));
  return light_field;
}

fs::path colmap_folder_beside(const fs::path& output) {
  fs::path work = fs::absolute(output).lexically_normal();
  if (!work.has_filename()) work = work.parent_path();
  return work += ".colmap";
}

void find_cameras(const fs::path& photographs, const fs::path& work,
                  const ColmapRunOptions& options, const OutputRules& rules,
                  const RunControl& control) {
  const std::string record = record_of(photographs, options);
  if (fs::exists(work / kRecord) && read_text(work / kRecord) == record) {
    control.message(fmt::format("cameras as COLMAP found them before, in {}", work.string()));
    return;
  }
  control.message(fmt::format("COLMAP's database, model and log go to {}", work.string()));
  AtomicFolder folder(work, "gigaray cameras", rules);
  try {
    const ColmapRun run = run_colmap(photographs, folder.path(), options, control);
    write_file_atomically(folder.path() / kRecord, record);
    folder.commit();
    control.message(fmt::format("COLMAP found the cameras of {} of {} photographs (log: {})",
                                run.num_registered, run.num_pictures,
                                (work / run.log.filename()).string()));
  } catch (const Error& error) {
    const std::string there = folder.path().string();
    if (control.cancelled() || there.empty() || !fs::exists(folder.path() / kColmapLog)) throw;
    std::string text = error.what();
    if (const auto at = text.find(there); at != std::string::npos)
      text.replace(at, there.size(), work.string());
    folder.commit();  // without a record: nobody takes it for a finished run
    throw Error(error.code(), text);
  }
}

namespace {

/// The refusal of photographs that are no row where no cameras are to be found.
Error needs_cameras(const std::string& why) {
  return Error(ErrorCode::kBadInput,
               why +
                   "; as photographs from anywhere they get cameras from `gigaray depth`, which "
                   "runs COLMAP");
}

/// With cameras of COLMAP. why: the pictures are no row; empty: they are not asked to be.
LightField open_with_found_cameras(const InputRequest& input, const std::string& why,
                                   const RunControl& control) {
  if (const std::string field = input.rig.stated(); !field.empty())
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("{}: goes with views at equal steps on a line; {}", field,
                            why.empty() ? "with `find_cameras` COLMAP finds the cameras"
                                        : why + " (`direction` states that they are one)"));
  if (!why.empty()) control.message(why + "; their cameras are found with COLMAP");
  ColmapRunOptions options;
  options.masks = input.open.masks;
  options.max_size = input.max_size;
  options.quality = input.quality;
  options.strict = input.open.strict;
  OutputRules rules{{input.path}, input.replace};
  if (!options.masks.empty()) rules.inputs.push_back(options.masks);
  find_cameras(input.path, input.colmap_folder, options, rules, control);
  OpenOptions open;
  open.images = input.path;
  open.masks = input.open.masks;
  open.memory_bytes = input.open.memory_bytes;
  open.strict = input.open.strict;
  LightField light_field = open_as_asked(input.colmap_folder, input, open);
  if (const std::string note = unused_cameras(input.path, ""); !note.empty())
    light_field.notes.push_back(note);
  return light_field;
}

LightField open_or_find_cameras(InputRequest input, const RunControl& control) {
  input.path = folder_of_photographs(input.path);
  if (states_layout(input.open) || !is_plain_folder(input.path, input.open))
    return open_as_asked(input);
  const bool can_find = !input.colmap_folder.empty();
  const bool must_find = can_find && input.find_cameras;
  if (const std::string twice = why_twice(input.path);
      !twice.empty() && !(must_find && twice.find("`find_cameras`") != std::string::npos))
    throw Error(ErrorCode::kBadInput, twice);
  const std::string why = must_find ? "" : why_walk(input, control);
  if (!must_find && why.empty()) return open_as_asked(input);
  if (!can_find) throw needs_cameras(why);
  return open_with_found_cameras(input, why, control);
}

}  // namespace

OpenedInput open_input(InputRequest request, const RunControl& control) {
  if (request.keep_pictures && !request.open.kept)
    request.open.kept = std::make_shared<KeptPictures>(request.open.memory_bytes);
  LightField light_field = open_or_find_cameras(request, control);
  return {std::move(light_field), std::move(request)};
}

}  // namespace gigaray
