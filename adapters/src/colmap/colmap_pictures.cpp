// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "colmap/colmap_pictures.h"

#include <algorithm>
#include <memory>
#include <system_error>

#include "files/text.h"
#include "formats/file_type.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/mask_folder.h"
#include "pictures/picture_faults.h"
#include "pictures/picture_loading.h"
#include "pictures/picture_values.h"

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

ColmapPictures::ColmapPictures(const fs::path& photographs, const fs::path& work, bool strict,
                               const RunControl& control)
    : photographs_(photographs), work_(work), folder_(photographs), limit_(opening_limit()) {
  std::vector<PictureFault> faulty;
  for (const fs::path& path : pictures_of(photographs)) {
    const std::string name = path.filename().string();
    PictureSpec spec;
    const std::string why = fault_of_picture(path, Orientation::kIgnored, limit_, &spec);
    if (why.empty()) {
      names_.push_back(name);
      specs_.push_back(spec);
    } else {
      faulty.push_back({name, path, why});
    }
  }
  if (!faulty.empty() && (strict || names_.size() < 2))
    throw Error(ErrorCode::kBadInput, faulty.front().why);
  if (names_.size() < 2) {
    const std::string why = why_no_pictures(photographs);
    throw Error(ErrorCode::kBadInput, photographs.string() + ": holds " +
                                          (names_.empty() ? "no photograph" : "one photograph") +
                                          ", cameras need two or more to be found" +
                                          (why.empty() ? "" : "; " + why));
  }
  if (!faulty.empty()) control.message(left_out_text(faulty, names_.size() + faulty.size()));
}

void ColmapPictures::write_copies(const fs::path& masks, const RunControl& control) {
  if (!masks.empty()) write_masks(masks);
  std::vector<bool> is_copied;
  for (std::size_t i = 0; i < names_.size(); ++i)
    is_copied.push_back(!is_read_by_colmap(photographs_ / names_[i], specs_[i]));
  const auto count = std::ranges::count(is_copied, true);
  if (count == 0) return;
  copy_photographs(is_copied, control);
  control.message(std::to_string(count) + " of " + std::to_string(names_.size()) +
                  " photographs are copied to 8-bit JPEG for COLMAP, which can't read them");
}

void ColmapPictures::copy_photographs(const std::vector<bool>& is_copied,
                                      const RunControl& control) {
  std::vector<fs::path> files;
  for (const std::string& name : names_) files.push_back(photographs_ / name);
  std::vector<std::string> same_notes_as_when_opened;
  const ValueScale scale = scale_of(files, specs_, limit_, same_notes_as_when_opened);
  folder_ = work_ / "copies";
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw Error(ErrorCode::kIo, folder_.string() + ": can't be written (" + error.message() + ")");
  for (std::size_t i = 0; i < names_.size(); ++i) {
    control.progress("COLMAP: copies", double(i), double(names_.size()));
    control.throw_if_cancelled();
    if (is_copied[i])
      write_copy(files[i], folder_ / names_[i], scale, limit_);
    else
      fs::create_symlink(fs::absolute(files[i]), folder_ / names_[i]);
  }
}

void ColmapPictures::write_masks(const fs::path& from) {
  masks_ = work_ / "masks";
  fs::create_directory(masks_);
  const MaskFolder known(from);
  bool any = false;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const fs::path mask = known.find(names_[i]);
    if (mask.empty()) continue;
    any = true;
    const int width = specs_[i].width, height = specs_[i].height;
    const fs::path target = masks_ / (names_[i] + ".png");
    const bool is_scaled = is_mask_scaled(mask, photographs_ / names_[i], width, height,
                                          Orientation::kIgnored, limit_);
    if (!is_scaled && lower(mask.extension().string()) == ".png") {
      fs::create_symlink(fs::absolute(mask), target);
      continue;
    }
    const Mask seen = read_mask(mask, width, height, Orientation::kIgnored, limit_);
    Image<std::uint16_t> black_and_white(width, height);
    std::ranges::transform(seen, black_and_white.begin(),
                           [](std::uint8_t value) { return std::uint16_t(value ? 255 : 0); });
    write_png(target, black_and_white, 8);
  }
  if (!any)
    throw Error(ErrorCode::kBadInput, from.string() +
                                          ": holds no mask of any photograph; that of " +
                                          names_.front() + " is " + names_.front() + ".png");
}

ColmapPictures::~ColmapPictures() {
  std::error_code ignored;
  if (folder_ != photographs_) fs::remove_all(folder_, ignored);
}

}  // namespace gigaray
