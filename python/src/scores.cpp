// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Scores against a truth, the reason for a pixel's depth, and .grl files.
#include "gigaray/workflows/scores.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/metrics.h"
#include "gigaray/workflows/encode.h"
#include "gigaray/workflows/evaluate.h"
#include "gigaray/workflows/probe.h"
#include "gigaray/workflows/view_list.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

py::dict dict_of(const std::vector<Score>& scores) {
  py::dict result;
  for (const Score& score : scores) result[py::str(score.name)] = score.value;
  return result;
}

ScoreChoice choice_of(const std::vector<std::string>& metrics, std::optional<int> border) {
  ScoreChoice choice{false, false, border};
  for (const std::string& name : metrics) {
    if (name == "hci")
      choice.hci = true;
    else if (name == "middlebury")
      choice.middlebury = true;
    else
      refuse("`metrics` has '" + name + "'; there are hci and middlebury");
  }
  if (metrics.empty()) refuse("`metrics` is empty");
  return choice;
}

py::dict score_maps(const py::object& estimate, const py::object& truth,
                    const std::vector<std::string>& metrics, std::optional<int> border) {
  return dict_of(run([estimate = map_from(estimate, "estimate"), truth = map_from(truth, "truth"),
                      choice = choice_of(metrics, border)](const RunControl&) {
    return scores_of(estimate, truth, {}, choice);
  }));
}

/// Against a scene of a benchmark, with the regions that it states.
py::dict score_scene(const py::object& estimate, const std::filesystem::path& scene,
                     const std::vector<std::string>& metrics, std::optional<int> border) {
  return dict_of(run([estimate = map_from(estimate, "estimate"), scene,
                      choice = choice_of(metrics, border)](const RunControl&) {
    const std::filesystem::path file = find_truth(scene);
    if (file.empty()) throw Error(ErrorCode::kBadInput, scene.string() + ": has no true disparity");
    const SceneParts parts = read_scene_parts(scene, {}, estimate.width(), estimate.height());
    return scores_of(estimate, read_truth(file), parts, choice);
  }));
}

/// Relative errors of depth.
py::dict score_depth_maps(const py::object& estimate, const py::object& truth, int border) {
  const DepthScores scores = run([estimate = map_from(estimate, "estimate"),
                                  truth = map_from(truth, "truth"), border](const RunControl&) {
    DepthErrors errors;
    errors.add(estimate, truth, {}, border);
    return errors.scores();
  });
  py::dict result;
  const char* names[] = {"within 0.5 %", "within 1 %", "within 2 %", "within 5 %"};
  for (std::size_t i = 0; i < scores.within.size(); ++i) result[names[i]] = scores.within[i];
  result["median"] = scores.median;
  result["filled"] = scores.filled;
  return result;
}

py::dict score_folders(const std::vector<std::filesystem::path>& estimates,
                       const std::filesystem::path& truth, const std::string& views,
                       const std::vector<std::string>& metrics, std::optional<int> border) {
  EvaluateRequest request;
  request.estimates = estimates;
  request.truth = truth;
  request.views = views;
  request.choice = choice_of(metrics, border);
  const ScoreTable table =
      run([request](const RunControl& control) { return evaluate(request, control); });
  if (table.rows.size() == 1) return dict_of(table.rows.front().scores);
  py::dict result;
  for (const ScoreRow& row : table.rows) result[py::str(row.view)] = dict_of(row.scores);
  return result;
}

py::object peak_of(const std::optional<ScorePeak>& peak) {
  if (!peak) return py::none();
  return py::make_tuple(peak->disparity, peak->score);
}

py::dict probe(const PyLightField& light_field, int u, int v, const std::string& view,
               const py::dict& depth, bool decided) {
  ProbeRequest request{depth_request(depth), view, u, v, decided};
  ProbeFinding found = run([input = light_field.input, request](const RunControl& control) mutable {
    return probe_pixel(input, request, control);
  });
  const HypothesisRange range = found.curve.hypotheses;
  std::vector<float> hypotheses;
  for (int i = 0; i < range.count; ++i) hypotheses.push_back(float(range.value(i)));
  py::dict result;
  result["view"] = found.view;
  result["u"] = found.u;
  result["v"] = found.v;
  result["disparity"] = found.curve.disparity;
  result["confidence"] = found.curve.confidence;
  result["hypotheses"] = array_of_list<float>(std::move(hypotheses));
  result["scores"] = array_of_list<float>(std::move(found.curve.scores));
  result["samples"] = array_of_list<float>(std::move(found.curve.samples));
  result["best"] = peak_of(found.best);
  result["runner_up"] = peak_of(found.runner_up);
  result["mean"] = found.mean;
  result["seen_by"] = found.seen_by;
  if (found.decision) {
    py::dict decision;
    decision["level"] = found.decision->level;
    decision["view"] = found.decision->view;
    decision["u"] = found.decision->u;
    decision["v"] = found.decision->v;
    decision["disparity"] = found.decision->disparity;
    result["decision"] = decision;
  }
  return result;
}

/// The depth of a result for the views of a light field, which are the same pictures.
std::vector<int> matched_views(const LightField& field, const PyResult& result) {
  const LightField& other = result.field();
  if (field.width != other.width || field.height != other.height)
    refuse("`result` is of pictures of another size than `light_field`");
  std::vector<int> views;
  for (const View& view : field.views) {
    const int found = result.scene->find(view.name);
    if (found < 0 || std::ranges::find(result.scene->views(), found) == result.scene->views().end())
      refuse("`result` has no depth of view " + view.name + "; that of all views is needed");
    views.push_back(found);
  }
  return views;
}

py::dict encode(const PyLightField& light_field, const ResultPointer& result,
                const std::filesystem::path& path, int max_error, bool replace) {
  LightField field = light_field.field();
  const std::vector<int> views = matched_views(field, *result);
  // Depth may have found another direction of travel than was assumed.
  for (std::size_t i = 0; i < views.size(); ++i)
    field.views[i] = result->field().views[std::size_t(views[i])];
  const SparseFileReport report = run([=](const RunControl& control) {
    const std::lock_guard lock(*result->turn);
    SparseFileOptions options;
    options.max_error = max_error;
    const OutputRules rules{{light_field.input.request.places()}, replace};
    return write_sparse_file(
        AtomicFile(path, rules, {".grl"}), field,
        [&](int view) { return result->scene->disparity(views[std::size_t(view)]); }, options,
        control);
  });
  py::dict summary;
  summary["rays"] = report.rays;
  summary["tuples"] = report.tuples;
  summary["rgb_bytes"] = report.rgb_bytes;
  summary["file_bytes"] = report.file_bytes;
  return summary;
}

}  // namespace

void bind_scores(py::module_& module) {
  module.def("score_maps", &score_maps, py::arg("estimate"), py::arg("truth"), py::arg("metrics"),
             py::arg("border"));
  module.def("score_scene", &score_scene, py::arg("estimate"), py::arg("scene"), py::arg("metrics"),
             py::arg("border"));
  module.def("score_depth_maps", &score_depth_maps, py::arg("estimate"), py::arg("truth"),
             py::arg("border"));
  module.def("score_folders", &score_folders, py::arg("estimates"), py::arg("truth"),
             py::arg("views"), py::arg("metrics"), py::arg("border"));
  module.def("probe", &probe, py::arg("light_field"), py::arg("u"), py::arg("v"), py::arg("view"),
             py::arg("depth"), py::arg("decided"));
  module.def("encode", &encode, py::arg("light_field"), py::arg("result"), py::arg("path"),
             py::arg("max_error"), py::arg("replace"));
}

}  // namespace gigaray::python
