// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "depth_options_cli.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/workflows/input.h"
#include "input_info.h"
#include "result_info.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
  DepthRunOptions run;  ///< as `depth` takes them, so that the forecast is its own
  std::string views = "all";
  bool json = false;
};

void tell_of_input(const InfoOptions& options, const RunControl& control) {
  const InputOptions& place = options.run.input;
  OpenedInput input = open_input(place, control);
  DepthRequest request = options.run.request();
  request.views = options.views;
  const DepthForecast depth = forecast_depth(input, request, control);
  const LightField& light_field = input.light_field;
  const bool is_sparse = light_field.format == kSparseFormat;
  ordered_json sparse;
  if (is_sparse) sparse = sparse_json(place.path, place.open.memory_bytes);
  if (options.json) return print_json(light_field, depth, sparse);
  print_text(light_field, depth);
  if (is_sparse) print_sparse(sparse);
}

void tell_of_result(const InfoOptions& options, const std::string& kind, const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0 && option->get_name() != "INPUT" && option->get_name() != "--json")
      throw Error(ErrorCode::kInvalidArgument,
                  fmt::format("{}: goes with a light field; {} is a result of `{}`",
                              option->get_name(), options.run.input.path.string(), kind));
  const ordered_json result = result_json(options.run.input.path);
  if (options.json)
    fmt::print("{}\n", result.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  else
    print_result(result);
}

}  // namespace

Run info_command(CLI::App& app) {
  app.description(
      "What an input is and what depth of it takes; what a result holds and what to type next");
  auto options = std::make_shared<InfoOptions>();
  options->run.add_to(app);
  options->run.add_depth_to(app);
  app.add_option("--views", options->views, "Views that get depth, as `depth` takes them")
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print JSON");
  return [options, &app](const RunControl& control) {
    const std::string kind = kind_of_result(options->run.input.path);
    if (kind.empty())
      tell_of_input(*options, control);
    else
      tell_of_result(*options, kind, app);
  };
}

}  // namespace gigaray::cli
