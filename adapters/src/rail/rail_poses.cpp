// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <map>

#include "colmap/colmap_folders.h"
#include "gigaray/adapters/rail_rectification.h"
#include "pictures/picture_files.h"

namespace gigaray {

namespace fs = std::filesystem;

bool has_colmap_model(const fs::path& input) { return !colmap_models_of(input).empty(); }

RailPhotographs with_colmap_cameras(RailPhotographs photographs, const fs::path& workspace) {
  const std::vector<fs::path> models = colmap_models_of(workspace);
  if (models.empty()) throw Error(ErrorCode::kBadInput, workspace.string() + ": holds no model");
  const FoundColmapModel found = largest_colmap_model(models, photographs.notes);
  std::map<std::string, const ColmapModel::Image*> image_of;
  for (const ColmapModel::Image& image : found.model.images)
    image_of[fs::path(image.name).filename().string()] = &image;

  std::vector<RailPhotograph> posed;
  std::string lost;
  for (RailPhotograph& picture : photographs.pictures) {
    const std::string name = picture.file.filename().string();
    const auto image = image_of.find(name);
    if (image == image_of.end()) {
      lost += (lost.empty() ? "" : ", ") + name;
      continue;
    }
    picture.lens = found.model.cameras.at(image->second->camera_id);
    if (picture.lens.width != photographs.width || picture.lens.height != photographs.height)
      throw Error(ErrorCode::kBadInput,
                  picture.file.string() + ": its camera in " + found.folder.string() + " is for " +
                      size_text(picture.lens.width, picture.lens.height) + " pixels, it has " +
                      size_text(photographs.width, photographs.height));
    picture.rotation = image->second->rotation.toRotationMatrix();
    picture.translation = image->second->translation;
    posed.push_back(std::move(picture));
  }
  constexpr std::size_t kLeast = 3;
  if (posed.size() < kLeast)
    throw Error(ErrorCode::kBadInput, found.folder.string() + ": holds the cameras of " +
                                          std::to_string(posed.size()) +
                                          " of the photographs; a rail needs 3 or more");
  if (!lost.empty())
    photographs.notes.push_back("without a camera in " + found.folder.string() +
                                " and left out: " + lost);
  photographs.pictures = std::move(posed);
  photographs.lens_note.clear();
  photographs.posed = photographs.focal_is_known = photographs.distortion_is_known = true;
  return photographs;
}

}  // namespace gigaray
