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

#include <Iex.h>
#include <ImfIO.h>

#include <algorithm>
#include <exception>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/core/arguments.h"
#include "pictures/map_headers.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

// Interleaved; row v starts at the pixel (0, v) of a window whose first pixel is (left, top).
Imf::FrameBuffer frame_buffer(Image<float>& image, const std::vector<std::string>& channels,
                              int left, int top) {
  const std::size_t pixel = sizeof(float) * std::size_t(image.channels());
  const std::size_t row = pixel * std::size_t(image.width());
  char* origin = reinterpret_cast<char*>(image.data()) - std::ptrdiff_t(pixel) * left -
                 std::ptrdiff_t(row) * top;
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, origin + sizeof(float) * c, pixel, row));
  return buffer;
}

/// Bytes in memory as a file.
class Bytes : public Imf::IStream {
 public:
  Bytes(const std::string& bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* to, int size) override {
    if (size < 0 || position_ > bytes_.size() || std::size_t(size) > bytes_.size() - position_)
      throw Iex::InputExc("it ends too early");
    std::copy_n(bytes_.data() + position_, size, to);
    position_ += std::uint64_t(size);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::string& bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace

Image<float> parse_exr_channels(const std::string& bytes, const ExrHeader& header,
                                const std::vector<std::string>& channels, const std::string& where,
                                double limit) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, where + ": " + what);
  };
  GIGARAY_CHECK(!channels.empty());
  // The values, and a chunk of all channels as it is packed, unpacked and sorted.
  hold_against_limit(where, "states " + size_text(header.width, header.height) + " px",
                     sizeof(float) * (double(header.width) * header.height * channels.size() +
                                      4 * header.chunk_pixels * header.channels.size()) +
                         double(bytes.size()),
                     limit);
  try {
    Bytes stream(bytes, where);
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    if (window.max.x - window.min.x + 1 != header.width ||
        window.max.y - window.min.y + 1 != header.height)
      throw bad("is damaged in its header");
    for (const std::string& name : channels) {
      const Imf::Channel* channel = file.header().channels().findChannel(name);
      if (!channel || channel->xSampling != 1 || channel->ySampling != 1)
        throw bad("is damaged in its header");
    }
    Image<float> values(header.width, header.height, int(channels.size()));
    file.setFrameBuffer(frame_buffer(values, channels, window.min.x, window.min.y));
    file.readPixels(window.min.y, window.max.y);
    return values;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    throw bad("is damaged or no OpenEXR file (" + reason.substr(0, reason.find('\n')) + ")");
  }
}

FloatMap parse_exr(const std::string& bytes, const std::string& where, double limit) {
  const ExrHeader header = parse_exr_header(bytes, bytes.size(), where);
  if (header.channels.size() != 1)
    throw Error(ErrorCode::kBadInput, where + ": has not one channel, as a map has");
  return parse_exr_channels(bytes, header, {header.channels.front().name}, where, limit);
}

FloatMap read_exr(const std::filesystem::path& path) {
  constexpr std::uint64_t kMostHeader = 4 << 20;
  const double limit = opening_limit();
  const InputFile file(path);
  parse_exr_header(file.read(0, kMostHeader), file.size(), path.string());
  hold_against_limit(path.string(), "has " + std::to_string(file.size()) + " bytes",
                     double(file.size()), limit);
  return parse_exr(file.read(0, file.size()), path.string(), limit);
}

void write_exr(const std::filesystem::path& path, const FloatMap& map) {
  require_argument(map.channels() == 1 && !map.empty(), "map: one channel and pixels are needed");
  Imf::StdOSStream stream;
  {
    Imf::Header header(map.width(), map.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::OutputFile file(stream, header);
    FloatMap copy = map;  // the library takes pixels that it could change
    file.setFrameBuffer(frame_buffer(copy, {"Y"}, 0, 0));
    file.writePixels(map.height());
  }  // writes the table of rows
  write_file_atomically(path, stream.str());
}

}  // namespace gigaray
