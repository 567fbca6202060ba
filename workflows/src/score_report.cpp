// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/score_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace gigaray {
namespace {

using nlohmann::ordered_json;

bool is_count(const Score& score) { return score.name.ends_with("scored"); }

std::vector<std::string> estimates_of(const std::vector<ScoreRow>& rows) {
  std::vector<std::string> names;
  for (const ScoreRow& row : rows)
    if (std::find(names.begin(), names.end(), row.estimate) == names.end())
      names.push_back(row.estimate);
  return names;
}

std::vector<const ScoreRow*> rows_of(const std::vector<ScoreRow>& rows,
                                     const std::string& estimate) {
  std::vector<const ScoreRow*> found;
  for (const ScoreRow& row : rows)
    if (row.estimate == estimate) found.push_back(&row);
  return found;
}

/// Over the views that have a value.
std::vector<Score> means(const std::vector<const ScoreRow*>& rows) {
  std::vector<Score> result = rows.front()->scores;
  for (std::size_t i = 0; i < result.size(); ++i) {
    double sum = 0;
    int count = 0;
    for (const ScoreRow* row : rows) {
      const double value = row->scores[i].value;
      if (std::isnan(value)) continue;
      sum += value;
      ++count;
    }
    result[i].value = sum / count;
  }
  return result;
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3f}", value); }

ordered_json object_of(const std::vector<Score>& scores) {
  ordered_json root = ordered_json::object();
  for (const Score& score : scores) {
    if (is_count(score))
      root[score.name] = long(std::lround(score.value));
    else
      root[score.name] = score.value;  // NaN becomes null.
  }
  return root;
}

std::string one_view_text(const std::vector<ScoreRow>& rows) {
  std::size_t name_width = 10;
  for (const Score& score : rows.front().scores)
    name_width = std::max(name_width, score.name.size());
  std::vector<std::size_t> widths;
  for (const ScoreRow& row : rows)
    widths.push_back(rows.size() == 1 ? 9 : std::max<std::size_t>(9, row.estimate.size() + 2));
  std::string text;
  if (rows.size() > 1) {
    text += fmt::format("{:<{}}", "", name_width + 2);
    for (std::size_t i = 0; i < rows.size(); ++i)
      text += fmt::format("{:>{}}", rows[i].estimate, widths[i]);
    text += "\n";
  }
  for (std::size_t k = 0; k < rows.front().scores.size(); ++k) {
    const Score& score = rows.front().scores[k];
    if (is_count(score)) continue;  // Stands beside the share of filled pixels.
    text += fmt::format("{:<{}}", score.name, name_width + 2);
    for (std::size_t i = 0; i < rows.size(); ++i)
      text += fmt::format("{:>{}}", number(rows[i].scores[k].value), widths[i]);
    text += "  " + score.meaning + "\n";
  }
  return text;
}

std::string views_text(const std::vector<ScoreRow>& rows, bool with_means) {
  const auto is_main = [](const Score& score) {
    // Of the whole picture; sub-regions have a dot behind their name.
    for (const char* name : {"BadPix0.07", "BadPix0.03", "BadPix0.01", "MSEx100", "NearJumps",
                             "bad0.5", "bad1.0", "bad2.0", "avgerr", "rms", "within0.5", "within1",
                             "within2", "within5", "median", "filled"})
      if (score.name == name) return true;
    return false;
  };
  std::size_t name_width = 4;
  for (const ScoreRow& row : rows) name_width = std::max(name_width, row.view.size());
  const auto line = [&](const std::string& name, const std::vector<Score>& scores, auto cell) {
    std::string text = fmt::format("{:<{}}", name, name_width);
    for (const Score& score : scores)
      if (is_main(score)) text += fmt::format("{:>12}", cell(score));
    return text + "\n";
  };
  const auto value = [](const Score& score) { return number(score.value); };
  std::string text;
  const std::vector<std::string> estimates = estimates_of(rows);
  for (const std::string& estimate : estimates) {
    if (estimates.size() > 1) text += estimate + "\n";
    const auto own = rows_of(rows, estimate);
    text += line("view", own.front()->scores, [](const Score& score) { return score.name; });
    for (const ScoreRow* row : own) text += line(row->view, row->scores, value);
    if (with_means) text += line("mean", means(own), value);
  }
  return text;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string scores_as_text(const ScoreTable& table) {
  if (table.rows.front().view.empty()) return one_view_text(table.rows);
  const std::string views = views_text(table.rows, table.pooled.empty());
  return table.pooled.empty() ? views : views + "all\n" + one_view_text(table.pooled);
}

std::string scores_as_json(const ScoreTable& table) {
  const std::vector<ScoreRow>& rows = table.rows;
  if (rows.size() == 1 && rows.front().view.empty())
    return object_of(rows.front().scores).dump() + "\n";
  ordered_json root = {{"scores", ordered_json::array()}};
  for (const ScoreRow& row : rows) {
    ordered_json entry = {{"estimate", row.estimate}};
    if (!row.view.empty()) entry["view"] = row.view;
    entry.update(object_of(row.scores));
    root["scores"].push_back(entry);
  }
  if (!table.pooled.empty()) {
    root["all"] = ordered_json::array();
    for (const ScoreRow& row : table.pooled) {
      ordered_json entry = {{"estimate", row.estimate}};
      entry.update(object_of(row.scores));
      root["all"].push_back(entry);
    }
  } else if (!rows.front().view.empty()) {
    root["means"] = ordered_json::array();
    for (const std::string& estimate : estimates_of(rows)) {
      ordered_json entry = {{"estimate", estimate}};
      entry.update(object_of(means(rows_of(rows, estimate))));
      root["means"].push_back(entry);
    }
  }
  return root.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string scores_as_csv(const ScoreTable& table) {
  std::vector<ScoreRow> rows = table.rows;
  rows.insert(rows.end(), table.pooled.begin(), table.pooled.end());
  std::string text = "estimate,view";
  for (const Score& score : rows.front().scores) text += "," + csv_cell(score.name);
  text += "\n";
  for (const ScoreRow& row : rows) {
    text += csv_cell(row.estimate) + "," + csv_cell(row.view);
    for (const Score& score : row.scores)
      text += std::isnan(score.value) ? ","
              : is_count(score)       ? fmt::format(",{:.0f}", score.value)
                                      : fmt::format(",{:.10g}", score.value);
    text += "\n";
  }
  return text;
}

}  // namespace gigaray
