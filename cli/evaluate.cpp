// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/metrics.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateOptions {
  fs::path estimate, truth;
  int border = 15;
  bool json = false;
};

/// The path itself, or the first of `names` that the folder has.
fs::path find_map(const fs::path& path, std::initializer_list<const char*> names) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw Error(ErrorCode::kBadInput, path.string() + ": no such file or folder");
  if (!fs::is_directory(path, ignored)) return path;
  std::string wanted;
  for (const char* name : names) {
    if (fs::exists(path / name, ignored)) return path / name;
    wanted += (wanted.empty() ? "" : " and no ") + std::string(name);
  }
  throw Error(ErrorCode::kBadInput,
              path.string() + ": the folder has no " + wanted + "; name a disparity map");
}

void print_json(const DisparityScores& scores) {
  // NaN becomes null.
  const nlohmann::ordered_json root = {
      {"BadPix0.07", scores.bad_pix_007}, {"BadPix0.03", scores.bad_pix_003},
      {"BadPix0.01", scores.bad_pix_001}, {"MSEx100", scores.mse_x100},
      {"Q25", scores.q25_x100},           {"filled", scores.filled},
      {"scored", scores.scored}};
  fmt::print("{}\n", root.dump());
}

void print_text(const DisparityScores& scores) {
  const auto line = [](const char* name, double value, const char* meaning) {
    fmt::print("{:<12}{:>9.3f}  {}\n", name, value, meaning);
  };
  line("BadPix0.07", scores.bad_pix_007, "% of pixels with an error above 0.07");
  line("BadPix0.03", scores.bad_pix_003, "% above 0.03");
  line("BadPix0.01", scores.bad_pix_001, "% above 0.01");
  line("MSEx100", scores.mse_x100, "mean squared error x 100");
  line("Q25", scores.q25_x100, "25th percentile of the error x 100");
  line("filled", scores.filled, fmt::format("% of {} pixels scored", scores.scored).c_str());
}

void evaluate(const EvaluateOptions& options) {
  const fs::path estimate = find_map(options.estimate, {"disparity.pfm"});
  const fs::path truth = find_map(options.truth, {"truth.pfm", "gt_disp_lowres.pfm"});
  const FloatMap estimate_map = read_float_map(estimate), truth_map = read_float_map(truth);
  DisparityScores scores;
  try {
    scores = score_disparity(estimate_map, truth_map, options.border);
  } catch (const Error& error) {
    throw Error(error.code(),
                estimate.string() + " against " + truth.string() + ": " + error.what());
  }
  if (options.json)
    print_json(scores);
  else
    print_text(scores);
}

}  // namespace

Run evaluate_command(CLI::App& app) {
  app.description("Score a disparity map against the truth with the HCI general metrics");
  auto options = std::make_shared<EvaluateOptions>();
  app.add_option("ESTIMATE", options->estimate, "Disparity map, or a folder of gigaray depth")
      ->required();
  app.add_option("TRUTH", options->truth,
                 "Disparity map, or a folder with truth.pfm or gt_disp_lowres.pfm")
      ->required();
  app.add_option("--border", options->border, "Pixels left out on each side")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print JSON");
  return [options](const RunControl&) { evaluate(*options); };
}

}  // namespace gigaray::cli
