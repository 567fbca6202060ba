// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/contest_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/workflows/error_map.h"
#include "gigaray/workflows/score_report.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

template <class T>
Image<T> cut(const Image<T>& picture, const CloseUp& square) {
  Image<T> part(square.size, square.size, picture.channels());
  for (int v = 0; v < square.size; ++v)
    std::copy_n(&picture(square.u, square.v + v), std::size_t(square.size) * picture.channels(),
                part.row(v));
  return part;
}

struct Column {
  const char *name, *heading;
};

std::vector<Column> columns_of(const Contest& contest) {
  if (!contest.truth)
    return {
        {kPhotoConsistency, "photo-consistency"}, {"filled", "filled, %"}, {"seconds", "seconds"}};
  std::vector<Column> columns{
      {"BadPix0.07", "BadPix 0.07"}, {"BadPix0.03", "0.03"}, {"BadPix0.01", "0.01"},
      {"MSEx100", "MSE × 100"},      {"Q25", "Q25"},         {"Discontinuities", "discontinuities"},
      {"NearJumps", "near jumps"}};
  if (contest.is_pair())
    columns = {{"bad0.5", "bad 0.5"},
               {"bad1.0", "bad 1"},
               {"bad2.0", "bad 2"},
               {"bad4.0", "bad 4"},
               {"nonocc.bad1.0", "bad 1, seen by both"},
               {"avgerr", "avgerr"},
               {"rms", "rms"},
               {"A90", "A90"},
               {"NearJumps", "near jumps, 0.07"}};
  columns.push_back({"filled", "filled, %"});
  columns.push_back({kPhotoConsistency, "photo-consistency"});
  columns.push_back({"seconds", "seconds"});
  return columns;
}

std::vector<ScoreRow> rows_of(const std::vector<Contestant>& contestants) {
  std::vector<ScoreRow> rows;
  for (const Contestant& contestant : contestants)
    rows.push_back({contestant.name, "", contestant.scores});
  return rows;
}

}  // namespace

std::vector<CloseUp> close_ups(const FloatMap& disparity, DisparityRange range, int count) {
  const int size = std::min({96, disparity.width(), disparity.height()});
  Mask jumps(disparity.width(), disparity.height());
  const double jump = (range.max - range.min) / 20;
  for (int v = 1; v < disparity.height(); ++v)
    for (int u = 1; u < disparity.width(); ++u)
      for (const float before : {disparity(u - 1, v), disparity(u, v - 1)})
        jumps(u, v) |= std::abs(disparity(u, v) - before) > jump;
  std::vector<std::pair<long, CloseUp>> squares;
  const int step = std::max(1, size / 4);
  for (int v = 0; v + size <= disparity.height(); v += step)
    for (int u = 0; u + size <= disparity.width(); u += step) {
      long inside = 0;
      for (int y = v; y < v + size; ++y)
        inside += std::count(jumps.row(y) + u, jumps.row(y) + u + size, 1);
      squares.push_back({inside, {u, v, size}});
    }
  std::ranges::stable_sort(squares, std::ranges::greater(), &std::pair<long, CloseUp>::first);
  std::vector<CloseUp> chosen;
  for (const auto& [inside, square] : squares) {
    const bool is_free = std::ranges::all_of(chosen, [&](const CloseUp& other) {
      return std::abs(other.u - square.u) >= size || std::abs(other.v - square.v) >= size;
    });
    if (is_free && int(chosen.size()) < count && (inside > 0 || chosen.empty()))
      chosen.push_back(square);
  }
  return chosen;
}

void write_contest_pictures(const fs::path& folder, const Contest& contest,
                            const std::vector<Contestant>& contestants,
                            const std::vector<CloseUp>& squares, const ContestFacts& facts) {
  Image<std::uint16_t> picture = read_view(contest.light_field, contest.view);
  take_mask(picture);
  const int depth = contest.light_field.pixels->bit_depth();
  write_png(folder / "view.png", picture, depth);
  for (std::size_t k = 0; k < squares.size(); ++k)
    write_png(folder / fmt::format("view-{}.png", k + 1), cut(picture, squares[k]), depth);
  const auto write_map = [&](const std::string& name, const FloatMap& map) {
    fs::create_directories(folder / name);
    write_pfm(folder / name / "disparity.pfm", map);
    write_depth_picture(folder / name / "disparity.png", map, contest.range);
    for (std::size_t k = 0; k < squares.size(); ++k)
      write_depth_picture(folder / name / fmt::format("disparity-{}.png", k + 1),
                          cut(map, squares[k]), contest.range);
  };
  if (contest.truth) write_map("truth", *contest.truth);
  for (const Contestant& contestant : contestants) {
    write_map(contestant.name, contestant.disparity);
    if (!contest.truth) continue;
    const Image<std::uint16_t> errors =
        draw_error_map(contestant.disparity, *contest.truth, contest.border(), facts.error_range);
    write_png(folder / contestant.name / "error.png", errors, 8);
    for (std::size_t k = 0; k < squares.size(); ++k)
      write_png(folder / contestant.name / fmt::format("error-{}.png", k + 1),
                cut(errors, squares[k]), 8);
  }
}

ordered_json contest_json(const Contest& contest, const std::vector<Contestant>& contestants,
                          const ContestFacts& facts) {
  const LightField& light_field = contest.light_field;
  ordered_json methods = ordered_json::array();
  for (const Contestant& contestant : contestants) {
    ordered_json choices = ordered_json::array(), scores = ordered_json::object();
    for (const Choice& choice : contestant.choices)
      choices.push_back({{"views", choice.views}, {"measure", choice.measure}});
    for (const Score& score : contestant.scores) scores[score.name] = score.value;
    methods.push_back({{"name", contestant.name},
                       {"title", contestant.title},
                       {"reference", contestant.reference},
                       {"parameters", contestant.parameters},
                       {"views", contestant.views},
                       {"choices", choices},
                       {"seconds", contestant.seconds},
                       {"scores", scores}});
  }
  ordered_json root{
      {"format", "gigaray compare"},
      {"version", 1},
      {"program", facts.program},
      {"input", facts.input},
      {"device",
       contestants.front().is_ours ? ordered_json(contestants.front().device) : ordered_json()},
      {"machine", facts.machine},
      {"light_field", light_field.format},
      {"kind", to_string(light_field.kind)},
      {"num_views", light_field.num_views()},
      {"width", light_field.width},
      {"height", light_field.height},
      {"view", light_field.views[contest.view].name},
      {"disparity_range", {contest.range.min, contest.range.max}},
      {"disparity_of_inverse_depth",
       contest.is_posed() ? ordered_json(contest.unit) : ordered_json()},
      {"truth",
       contest.truth_place.empty() ? ordered_json() : ordered_json(contest.truth_place.string())},
      {"repeats", contest.repeats},
      {"measure", contest.truth ? "BadPix0.07" : kPhotoConsistency},
      {"methods", methods},
      {"verdict", verdict(contest, contestants)}};
  if (!contest.truth) {
    ordered_json table = ordered_json::object();
    for (const Contestant& a : contestants)
      for (const Contestant& b : contestants)
        table[a.name][b.name] = agreement(a.disparity, b.disparity, kAgreement);
    root["agreement"] = {{"within", kAgreement}, {"percent", table}};
  }
  return root;
}

std::string contest_csv(const std::vector<Contestant>& contestants) {
  return scores_as_csv({rows_of(contestants), {}});
}

std::vector<std::vector<std::string>> contest_table(const Contest& contest,
                                                    const std::vector<Contestant>& contestants) {
  std::vector<std::vector<std::string>> table{{"method"}};
  std::vector<Column> columns;
  for (const Column& column : columns_of(contest))
    if (std::ranges::any_of(contestants, [&](const Contestant& contestant) {
          return !std::isnan(contestant.score(column.name));
        }))
      columns.push_back(column);
  for (const Column& column : columns) table.front().emplace_back(column.heading);
  table.front().emplace_back("looked at");
  for (const Contestant& contestant : contestants) {
    table.push_back({contestant.title});
    for (const Column& column : columns) {
      const double value = contestant.score(column.name);
      table.back().push_back(std::isnan(value) ? "-" : fmt::format("{:.2f}", value));
    }
    table.back().push_back(contestant.views);
  }
  return table;
}

std::vector<std::string> verdict(const Contest& contest,
                                 const std::vector<Contestant>& contestants) {
  const auto ours = std::ranges::find_if(contestants, &Contestant::is_ours);
  if (ours == contestants.end() || std::ranges::all_of(contestants, &Contestant::is_ours))
    return {};
  std::vector<std::string> names{kPhotoConsistency};
  if (contest.truth)
    names = {"BadPix0.07", "BadPix0.03", "BadPix0.01", "MSEx100", "Discontinuities", "NearJumps"};
  if (contest.truth && contest.is_pair())
    names = {"bad0.5", "bad1.0", "bad2.0", "avgerr", "NearJumps"};
  std::vector<std::string> sentences;
  bool is_behind = false;
  for (const std::string& name : names) {
    // A score that a map is too empty for is behind all others.
    const auto value = [&](const Contestant& contestant) {
      const double score = contestant.score(name);
      return std::isnan(score) ? std::numeric_limits<double>::infinity() : score;
    };
    if (std::ranges::all_of(contestants, [&](const Contestant& c) { return std::isinf(value(c)); }))
      continue;
    std::vector<std::string> better, equal;
    int others = 0;
    for (const Contestant& other : contestants) {
      if (other.is_ours) continue;
      ++others;
      const std::string text = fmt::format("{} ({:.2f})", other.title, value(other));
      if (value(other) < value(*ours)) better.push_back(text);
      if (value(other) == value(*ours)) equal.push_back(text);
    }
    is_behind = is_behind || !better.empty();
    std::string sentence = fmt::format("{}: {} ({:.2f}) ", name, ours->title, value(*ours));
    if (better.empty() && equal.empty())
      sentence += fmt::format("is ahead of all {} others.", others);
    else if (better.empty())
      sentence += fmt::format("is as good as {}.", fmt::join(equal, ", "));
    else
      sentence += fmt::format("is behind {}.", fmt::join(better, ", "));
    sentences.push_back(sentence);
  }
  if (contest.is_pair() && is_behind)
    sentences.push_back(
        "Two views are few for this method: it compares single rays, where the others compare "
        "windows (so the paper, section 5).");
  return sentences;
}

}  // namespace gigaray
