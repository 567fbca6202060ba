// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "result_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "depth_info.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/error.h"
#include "model_info.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The JSON file that describes an output folder; empty: there is none.
fs::path description_of(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"gigaray.json", "compare.json"})
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  return {};
}

ordered_json masks_json(const fs::path& folder, const ordered_json& about) {
  ordered_json root{{"format", about.at("format")},
                    {"depth", about.at("depth")},
                    {"unit", about.at("unit")},
                    {"least", about.at("least")},
                    {"most", about.at("most")}};
  std::vector<double> shares;
  for (const ordered_json& view : about.at("views")) shares.push_back(view.at("share"));
  root["views"] = shares.size();
  root["folder"] = path_text(folder);
  if (shares.empty()) return root;
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  root["share"] = {*least, *most};
  return root;
}

/// An output that other commands don't go on from: what is in it is written down beside it.
ordered_json other_json(const fs::path& folder, const ordered_json& about) {
  ordered_json root{{"format", about.at("format")}, {"folder", path_text(folder)}};
  ordered_json files = ordered_json::array();
  constexpr std::size_t kMostFiles = 12;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const fs::path name = entry.path().filename(); !name.string().starts_with('.'))
      names.push_back(path_text(name));
  std::sort(names.begin(), names.end());
  for (const std::string& name : names)
    if (files.size() < kMostFiles) files.push_back(name);
  root["files"] = files;
  root["num_files"] = names.size();
  return root;
}

void line(const std::string& label, const std::string& text) {
  fmt::print("{:<11}{}\n", label, text);
}

void print_next(const ordered_json& result) {
  const auto next = result.find("next");
  if (next == result.end()) return;
  std::string label = "next";
  for (const ordered_json& text : *next) {
    line(label, text.get<std::string>());
    label.clear();
  }
}

double percent(const ordered_json& share) { return 100 * share.get<double>(); }

void print_depth(const ordered_json& result) {
  const auto text = [&](const char* key) { return result.at(key).get<std::string>(); };
  line("result", fmt::format("depth of a light field, written by {}", text("program")));
  line("input", fmt::format("{} ({}, {}){}", text("input"), text("input_format"), text("kind"),
                            result.at("input_exists") ? "" : ", which is not there any more"));
  line("views", fmt::format("{}, {} … {}", result.at("views").get<int>(), text("first_view"),
                            text("last_view")));
  line("size",
       fmt::format("{} × {} px", result.at("width").get<int>(), result.at("height").get<int>()));
  line("of view", text("top_level_view") + ", whose maps stand at top level; 5 %, median, 95 %:");
  line("disparity", range_text(result.at("disparity")));
  line("depth", result.at("depth").is_null()
                    ? "not known in scene units; --focal-px and --baseline of `gigaray depth` "
                      "state the rig"
                    : range_text(result.at("depth")));
  line("coverage",
       fmt::format("{:.1f} % of the pixels have an estimate", percent(result.at("coverage"))));
  if (const ordered_json& confidence = result.at("confidence"); !confidence.is_null())
    line("confidence",
         fmt::format("median {:.2f}, above 0.5 for {:.1f} %", confidence.at("median").get<double>(),
                     percent(confidence.at("above_half"))));
  line("searched",
       fmt::format("{:.4g} … {:.4g}, {} hypotheses", result.at("searched").at(0).get<double>(),
                   result.at("searched").at(1).get<double>(), result.at("hypotheses").get<int>()));
  line("device", text("device"));
  line("time", fmt::format("{:.1f} s, {:.0f} MiB of memory", result.at("seconds").get<double>(),
                           result.at("peak_memory_mib").get<double>()));
  if (result.contains("note")) line("note", text("note"));
}

void print_masks(const ordered_json& result) {
  line("result",
       fmt::format("masks of {} {:g} … {:g}, of the depth in {}",
                   result.at("unit").get<std::string>(), result.at("least").get<double>(),
                   result.at("most").get<double>(), result.at("depth").get<std::string>()));
  line("views", fmt::format("{}", result.at("views").get<int>()));
  if (result.contains("share"))
    line("inside",
         fmt::format("{:.1f} … {:.1f} % of the pixels of a view", percent(result.at("share").at(0)),
                     percent(result.at("share").at(1))));
}

}  // namespace

std::string kind_of_result(const fs::path& place) {
  std::error_code ignored;
  if (fs::is_regular_file(place, ignored)) return kind_of_model(place);
  const fs::path path = fs::is_directory(place, ignored) ? description_of(place) : fs::path();
  if (path.empty()) return {};
  try {
    const auto about = ordered_json::parse(read_json_text(path), nullptr, false);
    if (!about.is_object() || !about.contains("format") || !about["format"].is_string()) return {};
    const std::string format = about["format"];
    for (const char* command : {"depth", "segment", "render", "probe", "compare"})
      if (format == std::string("gigaray ") + command) return format;
  } catch (const Error&) {
  }
  return {};
}

ordered_json result_json(const fs::path& place) {
  std::error_code ignored;
  if (fs::is_regular_file(place, ignored)) return model_json(place);
  const std::string kind = kind_of_result(place);
  if (kind == kDepthFormat) return depth_json(place);
  const fs::path path = description_of(place);
  try {
    const auto about = ordered_json::parse(read_json_text(path));
    return kind == "gigaray segment" ? masks_json(place, about) : other_json(place, about);
  } catch (const ordered_json::exception& problem) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: an entry is missing or of the wrong type ({})", path.string(),
                            problem.what()));
  }
}

void print_result(const ordered_json& result) {
  const std::string format = result.at("format");
  if (format == kDepthFormat) {
    print_depth(result);
  } else if (format == "gigaray segment") {
    print_masks(result);
  } else if (result.contains("files")) {
    line("result", fmt::format("what `{}` wrote", format));
    std::vector<std::string> names = result.at("files");
    const auto more = result.at("num_files").get<std::size_t>() - names.size();
    line("files", fmt::format("{}{}", fmt::join(names, " "),
                              more ? fmt::format(" and {} more", more) : std::string()));
  } else {
    print_model(result);
  }
  print_next(result);
}

ordered_json sparse_json(const fs::path& place, double memory_bytes) {
  const SparseFile file(place, memory_bytes);
  const LightField light_field = file.light_field();
  const int centre = centre_view(light_field);
  const FloatMap disparity = file.disparity(centre, {0, file.shape().height});
  std::error_code ignored;
  ordered_json root{{"file_bytes", fs::file_size(place, ignored)},
                    {"max_error", file.max_error()},
                    {"view", light_field.views[centre].name}};
  root.update(map_json(disparity, light_field));
  root["next"] = next_lines(place, light_field, centre, disparity);
  root["next"].push_back(fmt::format("gigaray decode {} -o views", shell_word(place)));
  return root;
}

void print_sparse(const ordered_json& sparse) {
  line("holds",
       fmt::format("{} bytes, {}", sparse.at("file_bytes").get<std::uint64_t>(),
                   sparse.at("max_error") == 0 ? std::string("lossless")
                                               : fmt::format("values within {} of the original",
                                                             sparse.at("max_error").get<int>())));
  line("of view", sparse.at("view").get<std::string>() + "; 5 %, median, 95 %:");
  line("disparity", range_text(sparse.at("disparity")));
  if (!sparse.at("depth").is_null()) line("depth", range_text(sparse.at("depth")));
  line("coverage",
       fmt::format("{:.1f} % of the pixels have an estimate", percent(sparse.at("coverage"))));
  print_next(sparse);
}

}  // namespace gigaray::cli
