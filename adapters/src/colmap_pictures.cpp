// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "colmap_pictures.h"

#include <memory>
#include <system_error>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "picture_loading.h"
#include "picture_values.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Does COLMAP's library read it? It looks at the content, not at the name.
bool is_read_by_colmap(const fs::path& path, const PictureSpec& spec) {
  if (spec.bit_depth != 8) return false;
  const std::string head = InputFile(path).read(0, 4);
  if (head.size() < 4) return false;
  for (const char* magic : {"\xff\xd8\xff", "\x89PNG", "BM", "II*", "P5", "P6"})
    if (head.starts_with(magic)) return true;
  return head == std::string("MM\0*", 4);
}

/// The EXIF of a picture, which COLMAP takes the focal length from.
void add_exif(const fs::path& from, double limit, vips::VImage& image) {
  constexpr const char* kField = "exif-data";
  try {
    const vips::VImage original = open_picture(from, limit);
    if (original.get_typeof(kField) == 0) return;
    std::size_t size = 0;
    const void* bytes = original.get_blob(kField, &size);
    vips_image_set_blob_copy(image.get_image(), kField, bytes, size);
  } catch (const vips::VError&) {
    return;  // formats of other libraries
  } catch (const Error&) {
    return;
  }
}

void write_copy(const fs::path& from, const fs::path& to, const ValueScale& scale, double limit) {
  PictureSpec spec;
  Image<std::uint16_t> picture = decode_picture(from, Orientation::kIgnored, spec, limit, scale);
  if (spec.bit_depth == 16)
    for (std::uint16_t& value : picture) value /= 257;
  vips::VImage image =
      vips::VImage::new_from_memory(picture.data(), picture.size() * sizeof(std::uint16_t),
                                    picture.width(), picture.height(), 3, VIPS_FORMAT_USHORT)
          .cast(VIPS_FORMAT_UCHAR)
          .copy(vips::VImage::option()->set("interpretation", VIPS_INTERPRETATION_sRGB));
  add_exif(from, limit, image);
  try {
    constexpr int kQuality = 98;
    const std::unique_ptr<VipsBlob, void (*)(VipsBlob*)> blob(
        image.jpegsave_buffer(vips::VImage::option()
                                  ->set("Q", kQuality)
                                  ->set("subsample_mode", VIPS_FOREIGN_SUBSAMPLE_OFF)),
        [](VipsBlob* area) { vips_area_unref(VIPS_AREA(area)); });
    std::size_t size = 0;
    const auto* bytes = static_cast<const char*>(vips_blob_get(blob.get(), &size));
    write_file_atomically(to, {bytes, size});
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kBadInput,
                from.string() + ": can't be copied for COLMAP (" + vips_reason(error) + ")");
  }
}

}  // namespace

ColmapPictures::ColmapPictures(const fs::path& folder, const std::vector<std::string>& names,
                               const fs::path& copies, const RunControl& control)
    : folder_(folder) {
  const double limit = opening_limit();
  std::vector<bool> is_copied;
  for (const std::string& name : names) {
    specs_.push_back(read_picture_spec(folder / name, Orientation::kIgnored, limit));
    is_copied.push_back(!is_read_by_colmap(folder / name, specs_.back()));
    num_copies_ += is_copied.back();
  }
  if (num_copies_ == 0) return;
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(folder / name);
  std::vector<std::string> same_notes_as_when_opened;
  const ValueScale scale = scale_of(files, specs_, limit, same_notes_as_when_opened);
  copies_ = folder_ = copies;
  std::error_code error;
  fs::create_directories(copies, error);
  if (error)
    throw Error(ErrorCode::kIo, copies.string() + ": can't be written (" + error.message() + ")");
  for (std::size_t i = 0; i < names.size(); ++i) {
    control.progress("COLMAP: copies", double(i), double(names.size()));
    control.throw_if_cancelled();
    if (is_copied[i])
      write_copy(folder / names[i], copies / names[i], scale, limit);
    else
      fs::create_symlink(fs::absolute(folder / names[i]), copies / names[i]);
  }
  control.message(std::to_string(num_copies_) + " of " + std::to_string(names.size()) +
                  " photographs are copied to 8-bit JPEG for COLMAP, which can't read them");
}

ColmapPictures::~ColmapPictures() {
  std::error_code ignored;
  if (!copies_.empty()) fs::remove_all(copies_, ignored);
}

}  // namespace gigaray
