// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "gigaray/adapters/maps.h"
#include "gigaray/core/error.h"
#include "gigaray/workflows/scene_truth.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// The last part of every path without a map's extension, or the whole paths where that would not
/// tell them apart.
std::vector<std::string> labels_of(const std::vector<fs::path>& paths) {
  std::vector<std::string> labels;
  for (const fs::path& path : paths) {
    fs::path name = (path.has_filename() ? path : path.parent_path()).filename();
    for (const char* extension : {".pfm", ".npy", ".exr"})
      if (name.extension() == extension) name = name.stem();
    labels.push_back(name.string());
  }
  std::vector<std::string> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return labels;
  std::transform(paths.begin(), paths.end(), labels.begin(),
                 [](const fs::path& path) { return path.string(); });
  return labels;
}

/// A map of floats has 4 bytes per pixel in its file, some 8 maps of the size are made of it.
void require_memory(const EvaluateRequest& request, const ViewMaps& maps) {
  double largest = 0;
  std::vector<fs::path> files = maps.estimates;
  files.push_back(maps.truth);
  for (const fs::path& file : files) {
    std::error_code error;
    if (const auto bytes = fs::file_size(file, error); !error)
      largest = std::max(largest, double(bytes));
  }
  request.memory.require(kProgramBytes + 8 * largest,
                         fmt::format("maps of {:.3g} million pixels", largest / 4e6));
}

ScoreTable score_disparities(const EvaluateRequest& request, const RunControl& control,
                             const std::function<void(const ScoredMap&)>& look) {
  const std::vector<std::string> labels = labels_of(request.estimates);
  const auto views = find_view_maps(request.estimates, request.truth,
                                    request.views.empty() ? "centre" : request.views, control);
  const bool is_only_one = views.size() == 1 && labels.size() == 1;
  ScoreTable table;
  for (const ViewMaps& maps : views) {
    control.throw_if_cancelled();
    require_memory(request, maps);
    const FloatMap truth = read_truth(maps.truth);
    SceneParts scene;
    // The masks of a scene are those of its centre view.
    if (maps.view.empty())
      scene = read_scene_parts(request.truth, request.masks, truth.width(), truth.height());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const FloatMap estimate = read_float_map(maps.estimates[i]);
      try {
        table.rows.push_back(
            {labels[i], maps.view, scores_of(estimate, truth, scene, request.choice)});
      } catch (const Error& error) {
        throw Error(error.code(), maps.estimates[i].string() + " against " + maps.truth.string() +
                                      ": " + error.what());
      }
      if (look) look({labels[i], maps.view, estimate, truth, is_only_one});
    }
  }
  return table;
}

}  // namespace

ScoreTable evaluate(const EvaluateRequest& request, const RunControl& control,
                    const std::function<void(const ScoredMap&)>& look) {
  if (request.estimates.empty())
    throw Error(ErrorCode::kInvalidArgument, "`estimates`: no map is named");
  if (!request.of_depth) return score_disparities(request, control, look);
  DepthChoice choice = request.depth;
  choice.border = request.choice.border.value_or(0);
  return score_depth(request.estimates, labels_of(request.estimates), request.truth,
                     request.views.empty() ? "all" : request.views, choice, request.memory,
                     control);
}

}  // namespace gigaray
