// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The page of `gigaray compare`.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "gigaray/baselines/contest_report.h"
#include "gigaray/core/error.h"
#include "gigaray/workflows/html.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 1200px; padding: 1em 2em;
  color: #222; background: #fff }
h1 { font-size: 1.5em } h2 { font-size: 1.2em; margin-top: 2em } h3 { font-size: 1em; margin: 0 }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums }
th, td { padding: .25em .7em; text-align: right; border-bottom: 1px solid #ddd }
th { border-bottom: 2px solid #888; vertical-align: bottom }
th:first-child, td:first-child, th:last-child, td:last-child { text-align: left }
tr.ours { background: #eef6ee } td.best { font-weight: bold }
.wide { overflow-x: auto; font-size: .85em }
.row { display: flex; flex-wrap: wrap; gap: 1em; margin: .5em 0 1.5em }
figure { margin: 0 } figcaption { font-size: .85em; color: #555 }
.map img { width: 260px } .pair { display: flex; flex-direction: column; gap: .3em }
.pair img { width: 120px; image-rendering: pixelated }
p.note { color: #555; font-size: .9em }
)";

/// The file as a data: URL.
std::string embedded(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || bytes.empty()) throw Error(ErrorCode::kIo, path.string() + ": can't be read again");
  return "data:image/png;base64," + base64(std::move(bytes));
}

std::string figure(const fs::path& path, const std::string& caption) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                     embedded(path), html_text(caption), html_text(caption));
}

/// The last part of a path that may end with a slash.
std::string name_of(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

std::string table_of(const Contest& contest, const std::vector<Contestant>& contestants) {
  const auto rows = contest_table(contest, contestants);
  std::string text = "<table><thead><tr>";
  for (const std::string& cell : rows.front()) text += "<th>" + html_text(cell) + "</th>";
  text += "</tr></thead><tbody>\n";
  // The best of each column; more is better of what is filled alone.
  const auto value = [&](std::size_t row, std::size_t column) {
    return rows[row][column] == "-" ? double(kNoEstimate) : std::stod(rows[row][column]);
  };
  for (std::size_t row = 1; row < rows.size(); ++row) {
    text += contestants[row - 1].is_ours ? "<tr class=\"ours\">" : "<tr>";
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      bool is_best = column > 0 && column + 1 < rows[row].size() && rows[row][column] != "-";
      for (std::size_t other = 1; is_best && other < rows.size(); ++other) {
        const bool more = rows.front()[column].starts_with("filled");
        is_best = more ? !(value(other, column) > value(row, column))
                       : !(value(other, column) < value(row, column));
      }
      text += fmt::format("<td{}>{}</td>", is_best ? " class=\"best\"" : "",
                          html_text(rows[row][column]));
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table>\n";
}

std::string agreement_table(const std::vector<Contestant>& contestants) {
  std::string text = fmt::format(
      "<h2>Agreement</h2><p>% of pixels where two maps differ by no more than {} px per view "
      "step.</p><div class=\"wide\"><table><thead><tr><th></th>",
      kAgreement);
  for (const Contestant& b : contestants) text += "<th>" + html_text(b.name) + "</th>";
  text += "<th></th></tr></thead><tbody>\n";
  for (const Contestant& a : contestants) {
    text += "<tr><td>" + html_text(a.title) + "</td>";
    for (const Contestant& b : contestants)
      text += fmt::format("<td>{:.1f}</td>", agreement(a.disparity, b.disparity, kAgreement));
    text += "<td></td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

/// Close-ups side by side, of two pictures one above the other; below: may be empty.
std::string close_ups_of(const fs::path& above, const fs::path& below, std::size_t squares) {
  std::string text;
  for (std::size_t k = 1; k <= squares; ++k) {
    text += "<div class=\"pair\">";
    for (const fs::path& stem : {above, below})
      if (!stem.empty())
        text += figure(stem.string() + fmt::format("-{}.png", k), fmt::format("close-up {}", k));
    text += "</div>";
  }
  return text;
}

std::string method_section(const fs::path& folder, const Contest& contest,
                           const Contestant& contestant, std::size_t squares) {
  const fs::path own = folder / contestant.name;
  std::string text = fmt::format("<h3>{}</h3><p class=\"note\">{}. {}. Looked at {}; {:.2f} s.",
                                 html_text(contestant.title), html_text(contestant.reference),
                                 html_text(contestant.parameters), html_text(contestant.views),
                                 contestant.seconds);
  if (contestant.choices.size() > 1) {
    text += fmt::format(" {} of the choices of views: ",
                        contest.truth ? "BadPix 0.07" : "Photo-consistency");
    for (const Choice& choice : contestant.choices)
      text += fmt::format("{}{} {:.2f}", &choice == contestant.choices.data() ? "" : ", ",
                          html_text(choice.views), choice.measure);
    text += ".";
  }
  text += "</p>\n<div class=\"row\"><div class=\"map\">" +
          figure(own / "disparity.png", "disparity") + "</div>";
  if (contest.truth) text += "<div class=\"map\">" + figure(own / "error.png", "error") + "</div>";
  text += close_ups_of(own / "disparity", contest.truth ? own / "error" : fs::path(), squares);
  return text + "</div>\n";
}

}  // namespace

std::string contest_page(const fs::path& folder, const Contest& contest,
                         const std::vector<Contestant>& contestants,
                         const std::vector<CloseUp>& squares, const ContestFacts& facts) {
  const LightField& light_field = contest.light_field;
  const std::string title = "Comparison: " + name_of(facts.input);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head><body>\n"
      "<h1>{0}</h1>\n",
      html_text(title), kStyle);
  text += fmt::format(
      "<p>{} {} views of {} × {} ({}), depth of view {}, disparities {:.3g} … {:.3g} px per view "
      "step. {}, {}. Times hold the reading of the pictures.{}</p>\n",
      light_field.num_views(), to_string(light_field.kind), light_field.width, light_field.height,
      html_text(light_field.format), html_text(light_field.views[contest.view].name),
      contest.range.min, contest.range.max, html_text(facts.program), html_text(facts.machine),
      contest.repeats == 1 ? ""
                           : fmt::format(" Times are medians of {} runs, which gave the same maps.",
                                         contest.repeats));
  if (contest.is_posed())
    text += fmt::format(
        "<p>Disparity is inverse depth times {:.4g}, the focal length in px times the median "
        "distance of neighbouring cameras: what a camera so far to the side would see. Views are "
        "turned into rectified pairs for the baselines.</p>\n",
        contest.unit);
  text += contest.truth
              ? fmt::format(
                    "<p>Truth: {}. {} Of the choices of views that had the least BadPix 0.07 "
                    "was taken.</p>",
                    html_text(contest.truth_place.filename().string()),
                    contest.is_pair()
                        ? ""
                        : fmt::format("{} px at the border are left out.", contest.border()))
              : std::string(
                    "<p>There is no truth. Photo-consistency is the mean over the pixels with an "
                    "estimate of the median difference of colours to the other views, of 255: it "
                    "tells wrong depth only where there is texture. Of the choices of views that "
                    "had the least was taken.</p>");
  text += "<ul>";
  for (const std::string& sentence : verdict(contest, contestants))
    text += "<li>" + html_text(sentence) + "</li>";
  text += "</ul>\n" + table_of(contest, contestants);
  if (!contest.truth) text += agreement_table(contestants);

  text += "<h2>Scene</h2><div class=\"row\"><div class=\"map\">" +
          figure(folder / "view.png", "view") + "</div>";
  if (contest.truth)
    text += "<div class=\"map\">" + figure(folder / "truth/disparity.png", "truth") + "</div>";
  text += close_ups_of(folder / "view", contest.truth ? folder / "truth/disparity" : fs::path(),
                       squares.size());
  text += "</div>\n<h2>Methods</h2>\n";
  if (contest.truth)
    text += fmt::format(
        "<p class=\"note\">Errors: white is right, red too far by {0} px or more, blue too near, "
        "black no estimate, grey not scored.</p>",
        facts.error_range);
  for (const Contestant& contestant : contestants)
    text += method_section(folder, contest, contestant, squares.size());
  return text + "</body></html>\n";
}

}  // namespace gigaray
