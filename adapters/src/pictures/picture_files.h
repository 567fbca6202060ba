// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace gigaray {

/// Is a picture turned as the camera noted in its file (EXIF)?
enum class Orientation {
  kApplied,  ///< upright, as programs show it
  kIgnored,  ///< as the sensor saw it; COLMAP and other programs that find cameras look at this one
};

/// How a picture holds its values.
enum class Samples {
  k8,      ///< 8 bit
  k16,     ///< 16 bit
  k32,     ///< 32-bit integers
  kLight,  ///< floating point, taken as linear light
};

/// What the header of a picture says.
struct PictureSpec {
  int width = 0;
  int height = 0;
  int bit_depth = 8;  ///< that it is read with: 8 or 16
  Samples samples = Samples::k8;
  bool is_grey = false;
  bool has_alpha = false;
  bool is_turned = false;  ///< its orientation is not upright
  /// Maker, model and focal length of the camera as EXIF has them; empty: not stated.
  std::string taken_with;
};

/// Has the name an extension of a picture format that light fields come in? For what may not be
/// there, or is looked at in a moment anyway.
bool is_picture_name(const std::filesystem::path& path);

/// Is the file a picture, by its name or by what is in it?
bool is_picture(const std::filesystem::path& path);

/// Regular, visible files of a folder, sorted by name. Throws Error(kBadInput) or Error(kIo).
std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder);

/// Those whose name ends with `ending` (lower case), in any letter case. Nothing when it is no
/// folder.
std::vector<std::filesystem::path> files_ending_in(const std::string& ending,
                                                   const std::filesystem::path& folder);

/// Regular, visible files of a folder that are pictures by their names or by what is in them,
/// sorted by name. Those that only hold floating point (OpenEXR, RGBE, PFM) are, where at most one
/// is of another kind and there are more of them. Nothing when it is no folder.
std::vector<std::filesystem::path> pictures_of(const std::filesystem::path& folder);

/// Reads the header alone. Throws Error(kBadInput) naming the file: no picture, damaged, of a type
/// that is not read, takes more than `limit` bytes to decode (opening_limit).
PictureSpec read_picture_spec(const std::filesystem::path& path, Orientation orientation,
                              double limit);

/// Does the end that its format has lack at the end of the file (JPEG and PNG)? Decoding tells for
/// sure.
bool may_be_cut_short(const std::filesystem::path& path);

/// Decodes a picture as RGB, grey repeated, alpha dropped. spec: becomes what its header says.
/// Throws Error(kBadInput) naming the file when it is damaged, cut short or takes more than `limit`
/// bytes.
Image<std::uint16_t> decode_picture(const std::filesystem::path& path, Orientation orientation,
                                    PictureSpec& spec, double limit, const ValueScale& scale = {});

/// Brings 8-bit values to 16 bit: 255 becomes 65535.
void widen_to_16_bit(Image<std::uint16_t>& picture);

/// Most bits of any picture. Notes what is dropped or changed when all are read alike.
int common_bit_depth(const std::vector<PictureSpec>& specs, std::vector<std::string>& notes);

/// "640×480"
std::string size_text(int width, int height);

/// Sets width, height and pixels of `light_field` from its pictures, one per view in their order,
/// with masks from options.masks and of what is transparent, and notes what is dropped. Reads
/// headers, a picture that may be cut short, and of those deeper than 8 bit or with an alpha
/// channel a few. Views whose picture is missing, damaged or, of more than four, of another size
/// than nearly all are left out with a note; kind becomes that of the rest. Throws Error(kBadInput)
/// naming the file: fewer than two are left, several sizes, a fault with options.strict, too large
/// for opening_limit(options.memory_bytes).
void attach_pictures(LightField& light_field, std::vector<std::filesystem::path> files,
                     const OpenOptions& options);

}  // namespace gigaray
