// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "model_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <vector>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/core/error.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::uint64_t kMostHead = 1 << 16;  // of a PLY file

Error bad(const fs::path& file, const std::string& what) {
  return Error(ErrorCode::kBadInput, file.string() + ": " + what);
}

/// Lines of the head of a PLY file; empty: it is none, or none with a whole head.
std::string ply_head(const fs::path& file) {
  std::string bytes = InputFile(file).read(0, kMostHead);
  const auto end = bytes.find("end_header");
  if (!bytes.starts_with("ply") || end == std::string::npos) return {};
  return bytes.substr(0, end);
}

ordered_json ply_json(const fs::path& file) {
  const std::string head = ply_head(file);
  if (head.empty()) throw bad(file, "is damaged or no PLY file");
  ordered_json root;
  std::uint64_t vertices = 0, faces = 0;
  std::istringstream lines(head);
  for (std::string text; std::getline(lines, text);) {
    std::istringstream words(text);
    std::string first, second;
    words >> first >> second;
    std::uint64_t count = 0;
    if (first == "element" && words >> count) {
      if (second == "vertex") vertices = count;
      if (second == "face") faces = count;
    }
    double x = 0, y = 0, z = 0;
    if (first == "comment" && second == "origin" && words >> x >> y >> z)
      root["origin"] = {x, y, z};
  }
  root["vertices"] = vertices;
  root["faces"] = faces;
  return root;
}

/// Null: it is none, or none with a whole head.
ordered_json pcd_json(const fs::path& file) {
  std::istringstream lines(InputFile(file).read(0, kMostHead));
  ordered_json root;
  bool is_pcd = false;
  for (std::string text; std::getline(lines, text);) {
    std::istringstream words(text);
    std::string first, second;
    words >> first;
    std::uint64_t count = 0;
    double x = 0, y = 0, z = 0;
    if (first == "#" && words >> second && second == "origin" && words >> x >> y >> z)
      root["origin"] = {x, y, z};
    is_pcd |= first == "FIELDS";
    if (first == "POINTS" && words >> count) root["vertices"] = count;
    if (first == "DATA" && is_pcd && root.contains("vertices")) {
      root["faces"] = 0;
      return root;
    }
  }
  return nullptr;
}

/// The first chunk of binary glTF; null: it is none.
ordered_json glb_root(const fs::path& file) {
  constexpr std::uint64_t kHead = 20;
  const InputFile bytes(file);
  const std::string head = bytes.read(0, kHead);
  if (head.size() < kHead || !head.starts_with("glTF")) return nullptr;
  std::uint32_t length = 0;
  std::memcpy(&length, head.data() + 12, sizeof length);
  if (length > kMostText || length > bytes.size()) return nullptr;
  const std::string text = bytes.read(kHead, length);
  check_json(text, file.string());
  return ordered_json::parse(text, nullptr, false);
}

/// Three numbers, or whatever somebody else wrote there.
bool is_place(const ordered_json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_array() && found->size() == 3 &&
         std::ranges::all_of(*found, [](const ordered_json& number) { return number.is_number(); });
}

ordered_json glb_json(const fs::path& file) {
  const ordered_json gltf = glb_root(file);
  if (!gltf.is_object()) throw bad(file, "is damaged or no binary glTF");
  ordered_json root;
  try {
    std::uint64_t vertices = 0, indices = 0;
    for (const ordered_json& mesh : gltf.at("meshes"))
      for (const ordered_json& part : mesh.at("primitives")) {
        const auto& accessors = gltf.at("accessors");
        const auto& positions =
            accessors.at(part.at("attributes").at("POSITION").get<std::size_t>());
        vertices += positions.at("count").get<std::uint64_t>();
        if (part.contains("indices"))
          indices +=
              accessors.at(part["indices"].get<std::size_t>()).at("count").get<std::uint64_t>();
        if (is_place(positions, "min") && is_place(positions, "max"))
          root["box"] = {positions["min"], positions["max"]};
      }
    root["vertices"] = vertices;
    root["faces"] = indices / 3;
    for (const ordered_json& node : gltf.value("nodes", ordered_json::array()))
      if (node.contains("extras") && is_place(node["extras"], "origin"))
        root["origin"] = node["extras"]["origin"];
  } catch (const ordered_json::exception& problem) {
    throw bad(file, std::string("is damaged (") + problem.what() + ")");
  }
  return root;
}

}  // namespace

std::string kind_of_model(const fs::path& file) {
  try {
    if (file.extension() == ".glb") return glb_root(file).is_object() ? "gigaray mesh" : "";
    if (file.extension() == ".pcd") return pcd_json(file).is_object() ? "gigaray cloud" : "";
    if (file.extension() != ".ply" || ply_head(file).empty()) return {};
    return ply_json(file).at("faces") == 0 ? "gigaray cloud" : "gigaray mesh";
  } catch (const Error&) {
    return {};
  }
}

ordered_json model_json(const fs::path& file) {
  ordered_json root{{"format", kind_of_model(file)}, {"file", path_text(file)}};
  root["bytes"] = InputFile(file).size();
  root.update(file.extension() == ".glb"   ? glb_json(file)
              : file.extension() == ".pcd" ? pcd_json(file)
                                           : ply_json(file));
  return root;
}

void print_model(const ordered_json& model) {
  const auto count = [&](const char* key) { return model.at(key).get<std::uint64_t>(); };
  const bool is_cloud = model.at("format") == "gigaray cloud";
  fmt::print("{:<11}{}, {} bytes\n", "result", is_cloud ? "point cloud" : "surface",
             count("bytes"));
  if (is_cloud)
    fmt::print("{:<11}{}\n", "points", count("vertices"));
  else
    fmt::print("{:<11}{} triangles between {} vertices\n", "faces", count("faces"),
               count("vertices"));
  const auto print_place = [&](const char* label, const ordered_json& place) {
    std::vector<std::string> numbers;
    for (const ordered_json& number : place)
      numbers.push_back(fmt::format("{:.9g}", number.get<double>()));
    fmt::print("{:<11}{}\n", label, fmt::join(numbers, " "));
  };
  if (model.contains("box")) {
    print_place("from", model.at("box").at(0));
    print_place("to", model.at("box").at(1));
  }
  if (model.contains("origin")) print_place("origin", model.at("origin"));
  fmt::print("{:<11}open it in {}\n", "next",
             is_cloud ? "MeshLab or CloudCompare" : "Blender or MeshLab");
}

}  // namespace gigaray::cli
