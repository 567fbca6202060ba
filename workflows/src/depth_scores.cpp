// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/depth_scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/error.h"
#include "gigaray/core/metrics.h"
#include "gigaray/workflows/scene_truth.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr std::initializer_list<const char*> kMapExtensions{".pfm", ".exr", ".npy"};
constexpr std::initializer_list<const char*> kTruthExtensions{".pfm", ".exr", ".npy", ".png"};

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}
bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& text) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + text);
}

/// Files of one view. confidence: empty where there is none.
struct EstimateFiles {
  fs::path depth, confidence;
};

EstimateFiles beside_each_other(const fs::path& depth) {
  const fs::path confidence = depth.parent_path() / "confidence.pfm";
  const bool belongs = depth.filename() == "depth.pfm" && is_there(confidence);
  return {depth, belongs ? confidence : fs::path()};
}

/// The first that there is of NAME.pfm and so on; empty: none.
fs::path map_named(const fs::path& folder, const std::string& name,
                   std::initializer_list<const char*> extensions) {
  for (const char* extension : extensions)
    if (is_there(folder / (name + extension))) return folder / (name + extension);
  return {};
}

/// depth empty: the folder has none of this view.
EstimateFiles estimate_of(const fs::path& folder, const std::string& view) {
  if (is_there(folder / view / "depth.pfm")) return beside_each_other(folder / view / "depth.pfm");
  return {map_named(folder, view, kMapExtensions), {}};
}

fs::path truth_of(const fs::path& folder, const std::string& view) {
  const fs::path own = map_named(folder, view, kTruthExtensions);
  return own.empty() ? map_named(folder / "truth", view, kTruthExtensions) : own;
}

std::set<std::string> views_in(const fs::path& folder) {
  std::set<std::string> views;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& path = entry.path();
    if (is_there(path / "depth.pfm")) views.insert(path.filename().string());
    const auto is_map = [&](const char* extension) { return path.extension() == extension; };
    // A result has the maps of its centre at the top, too.
    const bool is_of_centre =
        path.stem() == "depth" || path.stem() == "confidence" || path.stem() == "disparity";
    if (is_there(path) && !is_of_centre && std::ranges::any_of(kMapExtensions, is_map))
      views.insert(path.stem().string());
  }
  return views;
}

/// The view whose maps stand at the top of a result.
std::string centre_of(const fs::path& result) {
  const fs::path file = result / "gigaray.json";
  const auto root = is_there(file) ? nlohmann::json::parse(read_json_text(file), nullptr, false)
                                   : nlohmann::json();
  if (!root.is_object() || !root.contains("centre") || !root["centre"].is_string())
    refuse(result, "its gigaray.json names no centre view; use `views` all or a list of names");
  return root["centre"];
}

struct DepthFiles {
  std::string view;
  fs::path truth;
  std::vector<EstimateFiles> estimates;
};

std::vector<DepthFiles> all_views(const std::vector<fs::path>& estimates, const fs::path& truth,
                                  const RunControl& control) {
  std::vector<DepthFiles> result;
  const std::set<std::string> names = views_in(estimates.front());
  if (names.empty())
    refuse(estimates.front(),
           "no depth maps in it, VIEW/depth.pfm or VIEW.pfm; depth needs cameras or a known rig");
  for (const std::string& view : names) {
    DepthFiles found{view, truth_of(truth, view), {}};
    for (const fs::path& estimate : estimates)
      found.estimates.push_back(estimate_of(estimate, view));
    const bool in_all = std::ranges::none_of(
        found.estimates, [](const EstimateFiles& files) { return files.depth.empty(); });
    if (in_all && !found.truth.empty()) result.push_back(std::move(found));
  }
  if (result.empty())
    refuse(truth, fmt::format("no truth of a view in it; that of {} would be {}.pfm, .exr, .npy or "
                              ".png, or in the folder truth",
                              *names.begin(), *names.begin()));
  if (result.size() < names.size())
    control.message(fmt::format("left out, for want of a truth or an estimate: {} views",
                                names.size() - result.size()));
  return result;
}

DepthFiles named_view(const std::vector<fs::path>& estimates, const fs::path& truth,
                      const std::string& view) {
  DepthFiles result{view, truth_of(truth, view), {}};
  if (result.truth.empty())
    refuse(truth,
           fmt::format("there is no truth of view {} ({}.pfm, .exr, .npy or .png)", view, view));
  for (const fs::path& estimate : estimates) {
    result.estimates.push_back(estimate_of(estimate, view));
    if (result.estimates.back().depth.empty())
      refuse(estimate, fmt::format("there is no depth of view {} ({}/depth.pfm or {}.pfm)", view,
                                   view, view));
  }
  return result;
}

/// Maps instead of folders: one view without a name.
DepthFiles only_maps(const std::vector<fs::path>& estimates, const fs::path& truth) {
  if (is_folder(truth))
    refuse(truth, "a depth map is compared with a map; name the truth's, or a folder of estimates");
  DepthFiles result{"", truth, {}};
  for (const fs::path& estimate : estimates) {
    if (is_folder(estimate))
      refuse(estimate, "a folder is compared with a folder of true depth, and " + truth.string() +
                           " is a file");
    result.estimates.push_back(beside_each_other(estimate));
  }
  return result;
}

std::vector<DepthFiles> find_views(const std::vector<fs::path>& estimates, const fs::path& truth,
                                   const std::string& views, const RunControl& control) {
  const auto require = [](const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) refuse(path, "no such file or folder");
  };
  std::ranges::for_each(estimates, require);
  require(truth);
  const bool are_folders = std::ranges::all_of(estimates, is_folder) && is_folder(truth);
  if (!are_folders) return {only_maps(estimates, truth)};
  if (views == "all") return all_views(estimates, truth, control);
  std::vector<DepthFiles> result;
  const std::vector<std::string> names =
      views == "centre" ? std::vector{centre_of(estimates.front())} : view_names_in(views);
  for (const std::string& view : names) result.push_back(named_view(estimates, truth, view));
  return result;
}

FloatMap read_values(const fs::path& path) {
  if (path.extension() != ".png") return read_float_map(path);
  int bit_depth = 0;
  const Image<std::uint16_t> picture = read_picture(path, &bit_depth);
  if (bit_depth != 16) refuse(path, "true depth in a PNG has 16 bits; this one has 8");
  FloatMap map(picture.width(), picture.height());
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) map(u, v) = picture(u, v, 0);
  return map;
}

/// Whether a picture of one size is one of the other, enlarged, with sides rounded to whole pixels.
bool have_one_shape(const FloatMap& a, const FloatMap& b) {
  const double turned = double(a.width()) * b.height() - double(b.width()) * a.height();
  return std::abs(turned) <=
         std::max(std::max(a.width(), a.height()), std::max(b.width(), b.height()));
}

/// The values of a map at the centres of the pixels of one of another size; nearest, since between
/// two surfaces there is no depth.
FloatMap at_pixels_of(const FloatMap& map, int width, int height) {
  FloatMap result(width, height);
  const auto source = [](int i, int count, int source_count) {
    return std::min(source_count - 1, int((i + 0.5) * source_count / count));
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      result(u, v) = map(source(u, width, map.width()), source(v, height, map.height()));
  return result;
}

std::string size_of(const FloatMap& map) {
  return fmt::format("{} x {}", map.width(), map.height());
}

std::vector<Score> sheet(const DepthErrors& errors, const std::vector<double>& kept) {
  std::vector<Score> sheet;
  const DepthScores all = errors.scores();
  const auto& limits = DepthScores::kWithinPercent;
  for (std::size_t i = 0; i < limits.size(); ++i)
    sheet.push_back({fmt::format("within{:g}", limits[i]), all.within[i],
                     fmt::format("% of pixels within {:g} % of the depth", limits[i])});
  sheet.push_back({"median", all.median, "median of the error, % of the depth"});
  sheet.push_back({"filled", all.filled, fmt::format("% of {} pixels scored", all.scored)});
  sheet.push_back({"scored", double(all.scored), "pixels"});
  for (std::size_t i = 0; i < limits.size(); ++i)
    sheet.push_back({fmt::format("filled.within{:g}", limits[i]), all.within_filled[i],
                     fmt::format("% within {:g} %, of the filled", limits[i])});
  for (const double percent : kept) {
    const DepthScores part = errors.most_confident(percent);
    const std::string name = fmt::format("kept{:g}.", percent);
    for (std::size_t i = 0; i < limits.size(); ++i)
      sheet.push_back({fmt::format("{}within{:g}", name, limits[i]), part.within_filled[i],
                       fmt::format("% within {:g} %, of the most confident", limits[i])});
    for (std::size_t i = 0; i < limits.size(); ++i)
      sheet.push_back({fmt::format("{}all{:g}", name, limits[i]), part.within[i],
                       fmt::format("% kept and within {:g} %, of all", limits[i])});
    sheet.push_back({name + "median", part.median, "median of the error of those, %"});
    sheet.push_back({name + "filled", part.filled, "% kept"});
  }
  return sheet;
}

/// All errors of all views are kept until the end, 8 bytes each; the last cut takes 16 more, the
/// maps of a view some 8 times theirs.
void require_memory(const std::vector<DepthFiles>& views, const MemoryBudget& memory) {
  double largest = 0, whole = 0;
  for (const DepthFiles& view : views) {
    double widest = 0;
    for (const EstimateFiles& files : view.estimates) {
      std::error_code error;
      if (const auto bytes = fs::file_size(files.depth, error); !error)
        widest = std::max(widest, double(bytes));
    }
    largest = std::max(largest, widest);
    whole += widest;
  }
  const double kept = 2 * double(views.front().estimates.size()) + 4;
  memory.require(
      kProgramBytes + 8 * largest + kept * whole,
      fmt::format("{} depth maps of {:.3g} million pixels together", views.size(), whole / 4e6));
}

void check(const DepthChoice& choice) {
  const double scale = choice.truth_scale.value_or(1);
  if (!(scale > 0 && std::isfinite(scale)))
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("`truth_scale` is {}; it must be above 0", scale));
  for (const double percent : choice.kept)
    if (!(percent > 0 && percent <= 100))
      throw Error(ErrorCode::kInvalidArgument,
                  fmt::format("`kept` is {}; it must be above 0 and at most 100", percent));
}

/// Compares views one after the other.
class DepthScoring {
 public:
  DepthScoring(const std::vector<std::string>& labels, const DepthChoice& choice,
               const RunControl& control)
      : labels_(labels), choice_(choice), control_(control), pooled_(labels.size()) {}

  void add(const DepthFiles& view) {
    FloatMap truth = read_values(view.truth);
    for (float& value : truth) value = float(value * choice_.truth_scale.value_or(1));
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const EstimateFiles& files = view.estimates[i];
      try {
        add(view, i, read_float_map(files.depth), truth,
            files.confidence.empty() ? FloatMap() : read_float_map(files.confidence));
      } catch (const Error& error) {
        const std::string text = error.what(), name = files.depth.string();
        throw Error(error.code(), text.starts_with(name) ? text : name + ": " + text);
      }
    }
  }

  ScoreTable finish(bool is_pooled) {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (pooled_[i].scores().scored == 0)
        throw Error(ErrorCode::kBadInput, "nothing to score: no pixel has a true depth");
      if (is_pooled) table_.pooled.push_back({labels_[i], "all", sheet(pooled_[i], choice_.kept)});
    }
    return std::move(table_);
  }

 private:
  void add(const DepthFiles& view, std::size_t candidate, const FloatMap& estimate,
           const FloatMap& truth, const FloatMap& confidence) {
    const bool fits = size_of(estimate) == size_of(truth);
    FloatMap resampled;
    if (!fits) {
      if (!have_one_shape(estimate, truth))
        throw Error(ErrorCode::kBadInput,
                    fmt::format("the map is {}, the truth {} is {}; they need one shape",
                                size_of(estimate), view.truth.string(), size_of(truth)));
      if (!std::exchange(is_resampling_told_, true))
        control_.message(fmt::format("the truth of {} is read at the pixels of maps of {}",
                                     size_of(truth), size_of(estimate)));
      resampled = at_pixels_of(truth, estimate.width(), estimate.height());
    }
    DepthErrors errors;
    for (DepthErrors* sum : {&errors, &pooled_[candidate]})
      sum->add(estimate, fits ? truth : resampled, confidence, choice_.border);
    table_.rows.push_back({labels_[candidate], view.view, sheet(errors, choice_.kept)});
  }

  const std::vector<std::string>& labels_;
  const DepthChoice& choice_;
  const RunControl& control_;
  std::vector<DepthErrors> pooled_;
  ScoreTable table_;
  bool is_resampling_told_ = false;
};

}  // namespace

ScoreTable score_depth(const std::vector<fs::path>& estimates,
                       const std::vector<std::string>& labels, const fs::path& truth,
                       const std::string& views, const DepthChoice& choice,
                       const MemoryBudget& memory, const RunControl& control) {
  check(choice);
  const std::vector<DepthFiles> found = find_views(estimates, truth, views, control);
  require_memory(found, memory);
  DepthScoring scoring(labels, choice, control);
  for (const DepthFiles& view : found) {
    control.throw_if_cancelled();
    scoring.add(view);
  }
  return scoring.finish(!found.front().view.empty());
}

}  // namespace gigaray
