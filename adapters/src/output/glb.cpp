// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Binary glTF 2.0, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html: a head of 12 bytes,
// then chunks, each with its length, its type and as many bytes; the first is JSON, filled up with
// spaces to a multiple of 4. Assimp 5.2 writes it; it leaves the material without what makes it
// unlit and names extensions that it doesn't use, so these are put in here.
#include "output/glb.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "gigaray/core/error.h"

namespace gigaray::glb {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kHead = 12, kChunkHead = 8, kLengthAt = 8;

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
  std::uint32_t number = 0;
  GIGARAY_CHECK(place + sizeof number <= bytes.size());
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

void set_number(std::string& bytes, std::size_t place, std::size_t value) {
  const auto number = std::uint32_t(value);
  GIGARAY_CHECK(number == value && place + sizeof number <= bytes.size());
  std::memcpy(bytes.data() + place, &number, sizeof number);
}

}  // namespace

float linear(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  return float(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

std::string completed(std::string_view bytes, const Eigen::Vector3d& origin, Shown shown) {
  using json = nlohmann::ordered_json;
  const std::size_t begin = kHead + kChunkHead, length = number_at(bytes, kHead);
  GIGARAY_CHECK(begin + length <= bytes.size());
  json root = json::parse(bytes.substr(begin, length));
  root["extensionsUsed"] = {"KHR_materials_unlit"};
  const bool is_textured = shown == Shown::kTexture;
  json surface = {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
  if (is_textured) surface["baseColorTexture"] = {{"index", 0}};
  for (json& material : root.at("materials"))
    material = {{"name", is_textured ? "photographs" : "colours of the vertices"},
                {"pbrMetallicRoughness", surface},
                {"doubleSided", true},
                {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  if (!origin.isZero(0)) {
    const auto node = root.at("scenes").at(0).at("nodes").at(0).get<std::size_t>();
    root.at("nodes").at(node)["extras"]["origin"] = {origin.x(), origin.y(), origin.z()};
  }
  std::string text = root.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string result(bytes.substr(0, begin));
  result += text;
  result += bytes.substr(begin + length);
  set_number(result, kHead, text.size());
  set_number(result, kLengthAt, result.size());
  return result;
}

}  // namespace gigaray::glb
