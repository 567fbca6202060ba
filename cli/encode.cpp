// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "depth_options_cli.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/workflows/encode.h"
#include "memory_option.h"
#include "numbers.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

struct Settings {
  DepthRunOptions run;
  SparseFileOptions file;
  OutputOption output;
  std::filesystem::path depth;  ///< what `gigaray depth` wrote; empty: compute it
  bool json = false;
};

double share(std::uint64_t part, std::uint64_t all) { return double(part) / double(all); }

ordered_json to_json(const SparseFileReport& report, int max_error, double depth_seconds,
                     double encode_seconds) {
  return {{"rays", report.rays},
          {"tuples", report.tuples},
          {"tuples_per_ray", share(report.tuples, report.rays)},
          {"unexplained_rays", report.unexplained},
          {"rgb_bytes", report.rgb_bytes},
          {"tuple_bytes", report.tuple_bytes},
          {"difference_bytes", report.difference_bytes},
          {"file_bytes", report.file_bytes},
          {"file_per_rgb", share(report.file_bytes, report.rgb_bytes)},
          {"max_error", max_error},
          {"seconds_depth", depth_seconds},
          {"seconds_encode", encode_seconds}};
}

void print_text(const SparseFileReport& report, double depth_seconds, double encode_seconds) {
  const auto line = [](const char* label, const std::string& text) {
    fmt::print("{:<12}{}\n", label, text);
  };
  const auto of_rgb = [&](std::uint64_t bytes) {
    return fmt::format("{} bytes, {:.2f} % of the RGB bytes", bytes,
                       100 * share(bytes, report.rgb_bytes));
  };
  line("rays", fmt::format("{}; {} without an estimate", report.rays, report.unexplained));
  line("tuples", fmt::format("{}, {:.2f} % of the rays", report.tuples,
                             100 * share(report.tuples, report.rays)));
  line("tuples", of_rgb(report.tuple_bytes));
  line("difference", of_rgb(report.difference_bytes));
  line("file", of_rgb(report.file_bytes));
  line("seconds", fmt::format("{:.1f} depth, {:.1f} encoding", depth_seconds, encode_seconds));
}

void run(const Settings& settings, const RunControl& control) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  std::vector<std::filesystem::path> inputs = settings.run.input.places();
  inputs.push_back(settings.depth);
  AtomicFile file(settings.output.path, settings.output.rules(std::move(inputs)), {".grl"});
  OpenedInput input = open_input(settings.run.input, control);
  LightField& light_field = input.light_field;
  for (const std::string& note : light_field.notes) control.message(note);
  if (light_field.kind == LightFieldKind::kUnstructured)
    throw Error(ErrorCode::kInvalidArgument,
                settings.run.input.path.string() +
                    ": a sparse light field holds 3D and 4D light fields, not photographs from "
                    "anywhere");
  const auto begin = Clock::now();
  // Reading the depth takes less than computing it, which has a forecast of its own.
  if (!settings.depth.empty())
    settings.run.budget().require(
        kProgramBytes + coding_bytes(light_field),
        views_text(light_field.num_views(), light_field.width, light_field.height));
  const DisparityOfView disparity =
      settings.depth.empty() ? computed_disparities(input, settings.run.request(), control)
                             : disparities_of_result(settings.depth, light_field);
  const double depth_seconds = seconds_since(begin);
  const auto encode_begin = Clock::now();
  const SparseFileReport report =
      write_sparse_file(std::move(file), light_field, disparity, settings.file, control);
  const double encode_seconds = seconds_since(encode_begin);
  if (settings.json)
    fmt::print("{}\n",
               to_json(report, settings.file.max_error, depth_seconds, encode_seconds).dump(2));
  else
    print_text(report, depth_seconds, encode_seconds);
}

}  // namespace

Run encode_command(CLI::App& app) {
  app.description("Light field to one compact file, lossless");
  auto settings = std::make_shared<Settings>();
  settings->run.add_to(app);
  settings->output.add_to(app, "File for the result", "FILE.grl")->required();
  app.add_option("--depth", settings->depth,
                 "What `gigaray depth INPUT` wrote, all views (default: computed now)")
      ->type_name("DIR");
  app.add_option("--lossy", settings->file.max_error,
                 "Values may differ by up to Q of 255 (of 65535 for 16-bit pictures); 0: lossless")
      ->check(zero_or_more())
      ->capture_default_str()
      ->type_name("Q");
  app.add_option("--band", settings->file.band_rows,
                 "Rows that can be decoded by themselves (default: as many as have 131072 px)")
      ->check(above_zero())
      ->type_name("ROWS");
  app.add_flag("--json", settings->json, "Print JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
