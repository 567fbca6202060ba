// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_page.h"

#include <array>
#include <string_view>
#include <utility>

#include "gigaray/core/error.h"
#include "gigaray/workflows/html.h"
#include "page_template.h"
#include "viewer_bundle.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// JSON within a script element: nothing in it ends the element.
std::string within_script(const std::string& json) {
  std::string result;
  for (const char c : json)
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  return result;
}

}  // namespace

bool has_view_page() { return !viewer_file("index.html").empty(); }

std::string page_with(const std::string& title, const std::string& scene) {
  if (!has_view_page())
    throw Error(ErrorCode::kDevice,
                "this build of gigaray has no page: install nodejs and npm and build it again");
  const std::string name = html_text(title);
  // In the order in which they stand in the page.
  const std::array<std::pair<std::string_view, std::string_view>, 4> places{
      {{"<!--gigaray:title-->", name},
       {"/*gigaray:style*/", viewer_file("viewer.css")},
       {"<!--gigaray:scene-->", scene},
       {"/*gigaray:script*/", viewer_file("viewer.js")}}};
  std::string_view rest = viewer_file("index.html");
  std::string page;
  for (const auto& [place, text] : places) {
    const std::size_t at = rest.find(place);
    GIGARAY_CHECK(at != std::string_view::npos);
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return page.append(rest);
}

std::string view_page(const std::string& title, const MakeScene& make_scene) {
  std::string elements;
  const std::string json = make_scene([&](const std::string& name, std::string bytes) {
    elements += "<script type=\"text/plain\" class=\"gigaray-blob\" data-name=\"" + name + "\">";
    elements += base64(std::move(bytes));
    elements += "</script>\n";
  });
  elements += "<script type=\"application/json\" id=\"gigaray-scene\">";
  elements += within_script(json) + "</script>\n";
  return page_with(title, elements);
}

std::uintmax_t write_view_folder(const fs::path& folder, const std::string& title,
                                 const MakeScene& make_scene) {
  std::uintmax_t size = 0;
  const auto write = [&](const fs::path& path, const std::string& bytes) {
    write_file_atomically(path, bytes);
    size += bytes.size();
  };
  const std::string page = page_with(title, "");
  fs::create_directory(folder / "data");
  const std::string json = make_scene([&](const std::string& name, const std::string& bytes) {
    write(folder / "data" / name, bytes);
  });
  write(folder / "scene.json", json);
  write(folder / "index.html", page);
  return size;
}

}  // namespace gigaray
