// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// OpenEXR, https://openexr.com: one channel "Y"; rows from top to bottom as in memory.
#include <OpenImageIO/imageio.h>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "text.h"

namespace gigaray {
namespace {

std::string reason(std::string text) { return text.substr(0, text.find('\n')); }

}  // namespace

FloatMap read_exr(const std::filesystem::path& path) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw bad("is damaged or no OpenEXR file (" + reason(OIIO::geterror()) + ")");
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels != 1)
    throw bad("has " + std::to_string(spec.nchannels) + " channels; a map has one");
  FloatMap map(spec.width, spec.height);
  if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, map.data()))
    throw bad("is damaged or cut short (" + reason(input->geterror()) + ")");
  return map;
}

void write_exr(const std::filesystem::path& path, const FloatMap& map) {
  GIGARAY_CHECK(map.channels() == 1 && !map.empty());
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    const auto output = OIIO::ImageOutput::create("exr");
    GIGARAY_CHECK(output != nullptr);
    OIIO::ImageSpec spec(map.width(), map.height(), 1, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    if (!output->open(temporary.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, map.data()) || !output->close())
      throw Error(ErrorCode::kIo,
                  path.string() + ": can't be written (" + reason(output->geterror()) + ")");
  });
}

}  // namespace gigaray
