// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "photographs.h"

#include <fmt/format.h>

#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/photographs.h"
#include "view_layout.h"

namespace gigaray::cli {
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
std::string why_walk(const InputOptions& input, const RunControl& control) {
  const std::string why = why_no_series(input.input, input.open.memory_bytes);
  if (!why.empty()) return why;
  LightField light_field = input.open_light_field();
  // Two whole pictures, and what is made of them to find features.
  constexpr double kBytesPerPixel = 18;
  hold_against_limit(
      input.input.string(),
      fmt::format("has pictures of {} × {} px", light_field.width, light_field.height),
      kBytesPerPixel * light_field.width * light_field.height,
      opening_limit(input.open.memory_bytes));
  const auto across = displacement_across_rows(light_field, control);
  if (!across || *across <= kMostAcrossRows) return {};
  RunControl silent;
  silent.on_progress = control.on_progress;
  if (settle_layout(input, light_field, silent)) return {};
  return fmt::format("{}: the pictures are no row, things move {:.1f} px across it",
                     input.input.string(), *across);
}

}  // namespace

fs::path find_cameras(const fs::path& photographs, const ColmapRunOptions& options,
                      const OutputOption& output, const RunControl& control) {
  fs::path work = fs::absolute(output.path).lexically_normal();
  if (!work.has_filename()) work = work.parent_path();
  work += ".colmap";
  const std::string record = record_of(photographs, options);
  if (fs::exists(work / kRecord) && read_text(work / kRecord) == record) {
    control.message(fmt::format("cameras as COLMAP found them before, in {}", work.string()));
    return work;
  }
  control.message(fmt::format("COLMAP's database, model and log go to {}", work.string()));
  AtomicFolder folder(work, "gigaray cameras", output.rules({photographs, options.masks}));
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
  return work;
}

LightField open_views(InputOptions input, const RunControl& control) {
  input.input = folder_of_photographs(input.input);
  if (states_layout(input.open) || !is_plain_folder(input.input, input.open))
    return input.open_light_field();
  if (const std::string twice = why_twice(input.input); !twice.empty())
    throw Error(ErrorCode::kBadInput, twice);
  if (const std::string why = why_walk(input, control); !why.empty())
    throw Error(ErrorCode::kBadInput, why +
                                          "; as photographs from anywhere they get cameras from "
                                          "`gigaray depth`, which runs COLMAP");
  return input.open_light_field();
}

LightField open_or_find_cameras(InputOptions input, const OutputOption& output,
                                const RunControl& control) {
  input.input = folder_of_photographs(input.input);
  if (states_layout(input.open) || !is_plain_folder(input.input, input.open))
    return input.open_light_field();
  if (const std::string twice = why_twice(input.input);
      !twice.empty() && !(input.find_cameras && twice.find("--find-cameras") != std::string::npos))
    throw Error(ErrorCode::kBadInput, twice);
  const std::string why = input.find_cameras ? "" : why_walk(input, control);
  if (!input.find_cameras && why.empty()) return input.open_light_field();
  if (const std::string option = input.rig.stated(); !option.empty())
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("{}: goes with views at equal steps on a line; {}", option,
                            why.empty() ? "with --find-cameras COLMAP finds the cameras"
                                        : why + " (--direction states that they are one)"));
  if (!why.empty()) control.message(why + "; their cameras are found with COLMAP");
  ColmapRunOptions options;
  options.masks = input.open.masks;
  options.max_size = input.max_size;
  options.quality = input.quality;
  options.strict = input.open.strict;
  const fs::path work = find_cameras(input.input, options, output, control);
  OpenOptions open;
  open.images = input.input;
  open.masks = input.open.masks;
  open.memory_bytes = input.open.memory_bytes;
  open.strict = input.open.strict;
  LightField light_field = input.open_light_field(work, open);
  if (const std::string note = unused_cameras(input.input, ""); !note.empty())
    light_field.notes.push_back(note);
  return light_field;
}

}  // namespace gigaray::cli
