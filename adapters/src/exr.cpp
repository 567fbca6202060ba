// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// OpenEXR, https://openexr.com: one channel, "Y" when written; rows from top to bottom as in
// memory.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <exception>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

// Row v starts at the pixel (0, v) of a window whose first pixel is (left, top).
Imf::FrameBuffer frame_buffer(FloatMap& map, const char* channel, int left, int top) {
  const std::size_t row = sizeof(float) * map.width();
  char* origin = reinterpret_cast<char*>(map.data()) - std::ptrdiff_t(sizeof(float)) * left -
                 std::ptrdiff_t(row) * top;
  Imf::FrameBuffer buffer;
  buffer.insert(channel, Imf::Slice(Imf::FLOAT, origin, sizeof(float), row));
  return buffer;
}

}  // namespace

FloatMap read_exr(const std::filesystem::path& path) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  try {
    Imf::InputFile file(path.c_str());
    const Imf::ChannelList& channels = file.header().channels();
    const auto first = channels.begin();
    auto second = first;
    if (first == channels.end() || ++second != channels.end())
      throw bad("has not one channel, as a map has");
    const Imath::Box2i window = file.header().dataWindow();
    FloatMap map(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    file.setFrameBuffer(frame_buffer(map, first.name(), window.min.x, window.min.y));
    file.readPixels(window.min.y, window.max.y);
    return map;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw bad(std::string("is damaged or no OpenEXR file (") + error.what() + ")");
  }
}

void write_exr(const std::filesystem::path& path, const FloatMap& map) {
  GIGARAY_CHECK(map.channels() == 1 && !map.empty());
  Imf::StdOSStream stream;
  {
    Imf::Header header(map.width(), map.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::OutputFile file(stream, header);
    FloatMap copy = map;  // the library takes pixels that it could change
    file.setFrameBuffer(frame_buffer(copy, "Y", 0, 0));
    file.writePixels(map.height());
  }  // writes the table of rows
  write_file_atomically(path, stream.str());
}

}  // namespace gigaray
