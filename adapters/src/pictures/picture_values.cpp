// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <locale>
#include <sstream>

#include "files/text.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr double kMost = 65535;

std::uint16_t of_bits(std::uint32_t value, int bits) {
  const std::uint32_t scaled = bits > 16 ? value >> (bits - 16) : value << (16 - bits);
  // A shift to the left may carry bits out.
  const bool is_beyond = bits < 32 && (value >> bits) != 0;
  return std::uint16_t(is_beyond ? 0xffff : scaled);
}

std::uint16_t of_light(float light, float full) {
  const double share = double(light) / full;
  if (!(share > 0)) return 0;  // NaN too
  if (share >= 1) return std::isinf(share) ? 0 : std::uint16_t(kMost);
  const double encoded =
      share <= 0.0031308 ? 12.92 * share : 1.055 * std::pow(share, 1 / 2.4) - 0.055;
  return std::uint16_t(std::lround(kMost * encoded));
}

template <class T, class Convert>
Image<std::uint16_t> converted(const Image<T>& stored, Convert convert) {
  Image<std::uint16_t> colours(stored.width(), stored.height(), 3);
  const std::size_t repeated = stored.channels() == 1 ? 3 : 1;
  for (std::size_t i = 0; i < stored.size(); ++i)
    std::fill_n(colours.data() + i * repeated, repeated, convert(stored.data()[i]));
  return colours;
}

std::string text_of(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << value;
  return text.str();
}

/// Pictures of one kind, the first, the last and some between: at most so many.
std::vector<std::size_t> spread(const std::vector<PictureSpec>& specs, Samples samples,
                                std::size_t most) {
  std::vector<std::size_t> all, chosen;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].samples == samples) all.push_back(i);
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(all[count == 1 ? 0 : i * (all.size() - 1) / (count - 1)]);
  return chosen;
}

/// Bits that integers of `of` bits use. 0: all.
int bits_of(const std::vector<fs::path>& files, const std::vector<std::size_t>& which, int of,
            double limit) {
  std::uint32_t most = 0;
  for (const std::size_t i : which) {
    try {
      PictureSpec spec;
      const StoredPicture stored = read_stored(files[i], Orientation::kIgnored, spec, limit);
      for (const std::uint16_t value : stored.whole) most = std::max<std::uint32_t>(most, value);
      for (const std::uint32_t value : stored.deep) most = std::max(most, value);
    } catch (const Error&) {
      continue;  // whoever reads it says why
    }
    if (most > 0x3fff && of == 16) return 0;
  }
  if (most == 0) return 0;
  // What is rounded after it was scaled may be a little above.
  constexpr std::uint32_t kAbove = 128;  // a part of full scale
  for (const int bits : {8, 10, 12, 14})
    if (most <= ((1u << bits) - 1) + (1u << bits) / kAbove) return bits;
  const int bits = std::bit_width(most);
  return bits < of && of > 16 ? bits : 0;
}

int noted_bits(const std::vector<fs::path>& files, const std::vector<PictureSpec>& specs,
               Samples samples, double limit, std::vector<std::string>& notes) {
  // Few tell that all bits are used; that some never are needs more.
  constexpr std::size_t kMostPictures = 16;
  const int of = samples == Samples::k16 ? 16 : 32;
  const int bits = bits_of(files, spread(specs, samples, kMostPictures), of, limit);
  if (bits == 0) return of;
  notes.push_back("the " + std::to_string(of) + "-bit pictures use " + std::to_string(bits) +
                  " bits: " + std::to_string((std::uint64_t(1) << bits) - 1) + " is full scale");
  return bits;
}

/// Values of some pixels, and how many of them are no light.
struct LightSample {
  std::vector<float> values;
  std::size_t num_invalid = 0;
};

LightSample sample_light(const std::vector<fs::path>& files, const std::vector<std::size_t>& which,
                         double limit) {
  constexpr std::size_t kMostValues = 300'000;  // per picture
  LightSample sample;
  for (const std::size_t i : which) {
    try {
      PictureSpec spec;
      const Image<float> light = read_stored(files[i], Orientation::kIgnored, spec, limit).light;
      // Odd, so that it goes through columns and channels.
      const std::size_t step = light.size() / kMostValues | 1;
      for (std::size_t at = 0; at < light.size(); at += step) {
        const float value = light.data()[at];
        if (std::isfinite(value) && value >= 0)
          sample.values.push_back(value);
        else
          ++sample.num_invalid;
      }
    } catch (const Error&) {
      continue;  // whoever reads it says why
    }
  }
  return sample;
}

float noted_light(const std::vector<fs::path>& files, const std::vector<PictureSpec>& specs,
                  double limit, std::vector<std::string>& notes) {
  constexpr std::size_t kMostPictures = 5;
  constexpr double kClipped = 0.01;             // share of values that may be brighter
  constexpr float kDarkest = 0.25, kUsual = 1;  // pictures made to be looked at end at 1
  const std::vector<std::size_t> which = spread(specs, Samples::kLight, kMostPictures);
  if (which.empty()) return 1;
  LightSample sample = sample_light(files, which, limit);
  std::vector<float>& values = sample.values;
  float full = kUsual;
  double clipped = 0;
  if (!values.empty()) {
    const auto bright = values.begin() + std::ptrdiff_t((1 - kClipped) * double(values.size() - 1));
    std::nth_element(values.begin(), bright, values.end());
    if (*bright > kUsual || (*bright > 0 && *bright < kDarkest)) full = *bright;
    clipped = double(std::ranges::count_if(values, [&](float value) { return value > full; })) /
              double(values.size());
  }
  const std::string type = lower(files[which.front()].extension().string());
  std::string note = "the floating-point pictures (" + type +
                     ") are taken as linear light: " + text_of(full) + " is full scale";
  if (clipped > 0) note += ", " + text_of(100 * clipped) + " % of the values are brighter";
  if (sample.num_invalid > 0)
    note +=
        ", " +
        text_of(100.0 * double(sample.num_invalid) / double(sample.num_invalid + values.size())) +
        " % are not finite or below 0 and become black";
  notes.push_back(note);
  return full;
}

}  // namespace

Image<std::uint16_t> colours_of_16_bit(StoredPicture stored, Samples samples,
                                       const ValueScale& scale) {
  if (samples == Samples::kLight)
    return converted(stored.light, [&](float value) { return of_light(value, scale.full_light); });
  if (samples == Samples::k32)
    return converted(stored.deep,
                     [&](std::uint32_t value) { return of_bits(value, scale.bits_of_32); });
  if (samples == Samples::k16 && scale.bits_of_16 < 16)
    for (std::uint16_t& value : stored.whole) value = of_bits(value, scale.bits_of_16);
  if (stored.whole.channels() == 3) return std::move(stored.whole);
  return converted(stored.whole, [](std::uint16_t value) { return value; });
}

ValueScale scale_of(const std::vector<fs::path>& files, const std::vector<PictureSpec>& specs,
                    double limit, std::vector<std::string>& notes) {
  GIGARAY_CHECK(files.size() == specs.size());
  ValueScale scale;
  scale.bits_of_16 = noted_bits(files, specs, Samples::k16, limit, notes);
  scale.bits_of_32 = noted_bits(files, specs, Samples::k32, limit, notes);
  scale.full_light = noted_light(files, specs, limit, notes);
  return scale;
}

}  // namespace gigaray
