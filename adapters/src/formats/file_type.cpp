// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/file_type.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/text.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

template <std::size_t N>
bool is_one_of(const std::string& word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string extension_of(const fs::path& path) { return lower(path.extension().string()); }

/// Files beside pictures that are never looked into. Raw photographs are not among them: a picture
/// may well lie under such a name.
bool has_other_extension(const fs::path& path) {
  static constexpr std::array<std::string_view, 32> kExtensions{
      ".json", ".txt", ".md",  ".csv",  ".xml", ".cfg", ".ini", ".yaml", ".yml", ".toml", ".py",
      ".sh",   ".log", ".htm", ".html", ".npy", ".npz", ".pfm", ".exr",  ".hdr", ".ply",  ".obj",
      ".mtl",  ".stl", ".glb", ".gltf", ".db",  ".h5",  ".mat", ".grl",  ".zip", ".gz"};
  return is_one_of(extension_of(path), kExtensions);
}

FileType unread(std::string name, std::string remedy) {
  return {FileKind::kUnread, std::move(name), std::move(remedy)};
}

FileType raw_photograph(const std::string& format) {
  return unread("raw photograph (" + format + ")",
                "develop it into TIFF, with `dcraw -6 -T FILE` or `darktable-cli FILE FILE.tif`");
}

FileType video() {
  return unread("video",
                "cut it into pictures, with `mkdir pictures; ffmpeg -i FILE -vf fps=2 "
                "pictures/%05d.png`, and name their folder");
}

FileType foreign(std::string name) {
  return unread(std::move(name), "convert it, with `convert FILE FILE.png`");
}

std::uint32_t number(std::string_view bytes, std::size_t at, int size, bool is_big_endian) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) {
    const int place = is_big_endian ? size - 1 - i : i;
    value |= std::uint32_t(std::uint8_t(bytes[at + std::size_t(i)])) << (8 * place);
  }
  return value;
}

/// A raw photograph in the clothes of TIFF has a preview as its first picture, or values of a
/// mosaic of colours. Which one: "DNG"; empty: it is a picture.
std::string raw_in_tiff(const InputFile& file, std::string_view head) {
  constexpr std::size_t kEntry = 12;
  constexpr std::uint32_t kSubfileType = 254, kPhotometric = 262, kDngVersion = 50706;
  constexpr std::uint32_t kMosaic = 32803, kLinearRaw = 34892;
  if (head.substr(8, 2) == "CR") return "CR2";
  static constexpr std::array<std::string_view, 18> kExtensions{
      ".dng", ".cr2", ".nef", ".nrw", ".arw", ".sr2", ".srf", ".pef", ".3fr",
      ".fff", ".iiq", ".erf", ".mef", ".mos", ".srw", ".dcr", ".kdc", ".rwl"};
  const std::string extension = extension_of(file.path());
  const std::string format = upper(extension.empty() ? "" : extension.substr(1));
  if (is_one_of(extension, kExtensions)) return format;
  const bool is_big_endian = head.starts_with("MM");
  const std::uint64_t offset = number(head, 4, 4, is_big_endian);
  const std::string count = file.read(offset, 2);
  if (count.size() < 2) return {};
  const std::string entries = file.read(offset + 2, kEntry * number(count, 0, 2, is_big_endian));
  for (std::size_t at = 0; at + kEntry <= entries.size(); at += kEntry) {
    const std::uint32_t tag = number(entries, at, 2, is_big_endian);
    const std::uint32_t words = number(entries, at + 8, 2, is_big_endian);
    if (tag == kDngVersion) return "DNG";
    if (tag == kPhotometric && (words == kMosaic || words == kLinearRaw)) return "DNG";
    if (tag == kSubfileType && (number(entries, at + 8, 4, is_big_endian) & 1) != 0)
      return "TIFF whose first picture is a preview";
  }
  return {};
}

/// Files of boxes, of which the first names its brands: ISO/IEC 14496-12.
FileType type_of_brand(std::string_view head) {
  const std::string brand(head.substr(8, 4));
  static constexpr std::array<std::string_view, 12> kHeif{"heic", "heix", "heim", "heis",
                                                          "hevc", "hevx", "hevm", "hevs",
                                                          "mif1", "msf1", "avif", "avis"};
  if (is_one_of(brand, kHeif)) return {FileKind::kPicture, {}, {}};
  return brand == "crx " ? raw_photograph("CR3") : video();
}

struct Mark {
  std::size_t at;
  std::string_view bytes;
};

template <std::size_t N>
bool has_any(std::string_view head, const Mark (&marks)[N]) {
  return std::any_of(std::begin(marks), std::end(marks), [&](const Mark& mark) {
    return head.size() >= mark.at && head.substr(mark.at).starts_with(mark.bytes);
  });
}

using namespace std::string_view_literals;

bool is_netpbm(std::string_view head) {
  return head.size() > 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '6' &&
         (head[2] == '\n' || head[2] == ' ' || head[2] == '\r' || head[2] == '\t' ||
          head[2] == '#');
}

FileType type_by_content(const InputFile& file) {
  constexpr std::size_t kHead = 64;
  const std::string head = file.read(0, kHead);
  static constexpr Mark kPictures[] = {{0, "\xff\xd8\xff"sv},   {0, "\x89PNG\r\n"sv},
                                       {0, "GIF8"sv},           {8, "WEBP"sv},
                                       {0, "\0\0\0\x0cjP  "sv}, {0, "\xff\x4f\xff\x51"sv},
                                       {0, "\0\0\0\x0cJXL "sv}, {0, "\xff\x0a"sv}};
  if (has_any(head, kPictures) || is_netpbm(head)) return {FileKind::kPicture, {}, {}};
  constexpr std::size_t kHeaderOfBmp = 26;
  if (head.starts_with("BM") && head.size() >= kHeaderOfBmp && number(head, 6, 4, false) == 0)
    return {FileKind::kPicture, {}, {}};
  static constexpr Mark kTiff[] = {{0, "II*\0"sv}, {0, "MM\0*"sv}};
  if (head.size() > 9 && has_any(head, kTiff)) {
    const std::string raw = raw_in_tiff(file, head);
    return raw.empty() ? FileType{FileKind::kPicture, {}, {}} : raw_photograph(raw);
  }
  static constexpr Mark kBigTiff[] = {{0, "II+\0"sv}, {0, "MM\0+"sv}};
  if (has_any(head, kBigTiff)) return {FileKind::kPicture, {}, {}};
  static constexpr Mark kLight[] = {{0, "\x76\x2f\x31\x01"sv},
                                    {0, "#?RADIANCE"sv},
                                    {0, "#?RGBE"sv},
                                    {0, "PF\n"sv},
                                    {0, "PF\r"sv},
                                    {0, "PF "sv}};
  if (has_any(head, kLight)) return {FileKind::kLight, {}, {}};
  if (head.size() > 12 && head.substr(4, 4) == "ftyp") return type_of_brand(head);

  struct Raw {
    Mark mark;
    const char* format;
  };
  static constexpr Raw kRaw[] = {{{0, "IIRO"sv}, "ORF"},
                                 {{0, "IIRS"sv}, "ORF"},
                                 {{0, "MMOR"sv}, "ORF"},
                                 {{0, "IIU\0"sv}, "RW2"},
                                 {{0, "FUJIFILMCCD-RAW"sv}, "RAF"},
                                 {{6, "HEAPCCDR"sv}, "CRW"},
                                 {{0, "FOVb"sv}, "X3F"},
                                 {{0, "\0MRM"sv}, "MRW"}};
  for (const Raw& raw : kRaw)
    if (has_any(head, {raw.mark})) return raw_photograph(raw.format);
  static constexpr Mark kVideos[] = {{8, "AVI "sv},
                                     {0, "\x1a\x45\xdf\xa3"sv},
                                     {0, "\0\0\1\xba"sv},
                                     {0, "\0\0\1\xb3"sv},
                                     {0, "\x30\x26\xb2\x75"sv},
                                     {0, "FLV\1"sv},
                                     {0, "YUV4MPEG2"sv},
                                     {4, "moov"sv},
                                     {4, "mdat"sv},
                                     {4, "wide"sv}};
  if (has_any(head, kVideos)) return video();
  if (head.starts_with("8BPS")) return foreign("Photoshop file");
  if (head.starts_with("P7\n")) return foreign("PAM file");
  if (head.starts_with("SDPX") || head.starts_with("XPDS")) return foreign("DPX file");
  if (head.starts_with("SIMPLE  =")) return foreign("FITS file");
  if (head.starts_with("gimp xcf")) return foreign("GIMP file");
  if (head.starts_with("DDS ")) return foreign("DDS file");
  return {};
}

FileType type_by_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 14> kVideos{
      ".mp4",  ".mov", ".avi", ".mkv", ".webm", ".m4v", ".mpg",
      ".mpeg", ".wmv", ".flv", ".mts", ".m2ts", ".3gp", ".insv"};
  const std::string extension = extension_of(path);
  if (extension == ".tga") return {FileKind::kPicture, {}, {}};
  return is_one_of(extension, kVideos) ? video() : FileType{};
}

}  // namespace

FileType file_type(const fs::path& path) {
  try {
    const FileType type = type_by_content(InputFile(path));
    return type.kind == FileKind::kOther ? type_by_name(path) : type;
  } catch (const Error&) {
    return {};
  }
}

FileKind likely_kind(const fs::path& path) {
  if (is_picture_name(path)) return FileKind::kPicture;
  return has_other_extension(path) ? FileKind::kOther : file_type(path).kind;
}

bool is_exr(const fs::path& path) {
  try {
    return InputFile(path).read(0, 4) == "\x76\x2f\x31\x01";
  } catch (const Error&) {
    return false;
  }
}

bool is_lossy(const fs::path& path) {
  try {
    const std::string head = InputFile(path).read(0, 12);
    static constexpr Mark kLossy[] = {{0, "\xff\xd8"sv}, {8, "WEBP"sv}, {4, "ftyp"sv}};
    return has_any(head, kLossy);
  } catch (const Error&) {
    return false;
  }
}

std::string why_unread(const fs::path& path) {
  FileType type = file_type(path);
  if (type.kind != FileKind::kUnread) return {};
  const std::string file = path.filename().string();
  for (auto at = type.remedy.find("FILE"); at != std::string::npos;
       at = type.remedy.find("FILE", at + file.size()))
    type.remedy.replace(at, 4, file);
  return "is a " + type.name + ", which can't be read; " + type.remedy;
}

std::string why_no_pictures(const fs::path& folder) {
  std::map<std::string, std::vector<fs::path>> unread;
  for (const fs::path& path : files_of(folder))
    if (const FileType type = file_type(path); type.kind == FileKind::kUnread)
      unread[type.name].push_back(path);
  if (unread.empty()) return {};
  const auto most = std::max_element(
      unread.begin(), unread.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  const fs::path& first = most->second.front();
  const std::size_t count = most->second.size();
  return first.filename().string() +
         (count > 1 ? ", one of " + std::to_string(count) + ", " : std::string(" ")) +
         why_unread(first);
}

}  // namespace gigaray
