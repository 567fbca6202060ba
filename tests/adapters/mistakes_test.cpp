// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>

#include "adapters/adapters_test.h"
#include "gigaray/adapters/child_process.h"
#include "gigaray/adapters/cloud_file.h"
#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/drawing.h"
#include "gigaray/adapters/feature_ranges.h"
#include "gigaray/adapters/feature_tracks.h"
#include "gigaray/adapters/hci_old.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/lens.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/mesh_file.h"
#include "gigaray/adapters/options_file.h"
#include "gigaray/adapters/photographs.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/pose_check.h"
#include "gigaray/adapters/pose_convention.h"
#include "gigaray/adapters/rail_rectification.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/adapters/shrunk.h"
#include "gigaray/adapters/sparse_file.h"
#include "support/black_views.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

class MistakesOfAdapters : public AdaptersTest {
 protected:
  static LightField two_views() { return testing_support::black_views(2); }
};

TEST_F(MistakesOfAdapters, AMapThatCannotBeWritten) {
  const FloatMap empty, coloured(3, 3, 3), map(3, 3);
  for (const FloatMap& wrong : {empty, coloured}) {
    expect_mistake("pfm", [&] { write_pfm(folder / "a.pfm", wrong); });
    expect_mistake("npy", [&] { write_npy(folder / "a.npy", wrong); });
    expect_mistake("exr", [&] { write_exr(folder / "a.exr", wrong); });
    expect_mistake("png16", [&] { write_png16(folder / "a.png", wrong, {0, 1}); });
    expect_mistake("picture", [&] { write_depth_picture(folder / "a.png", wrong, {0, 1}); });
    expect_mistake("colmap", [&] { write_colmap_depth_map(folder / "a.bin", wrong); });
    expect_mistake("normals", [&] { write_colmap_normal_map(folder / "a.bin", wrong, Camera()); });
  }
  for (const DisparityRange range : {DisparityRange{1, 1}, {1, 0}, {NAN, 1}, {0, INFINITY}}) {
    expect_mistake("range", [&] { write_png16(folder / "a.png", map, range); });
    expect_mistake("range", [&] { write_depth_picture(folder / "a.png", map, range); });
  }
  expect_mistake("size", [&] { write_colmap_normal_map(folder / "a.bin", map, Camera()); });
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(MistakesOfAdapters, APictureThatCannotBeWritten) {
  const Image<std::uint16_t> picture(3, 3, 3);
  expect_mistake("empty", [&] { write_png(folder / "a.png", {}, 8); });
  expect_mistake("channels", [] { png_bytes(Image<std::uint16_t>(3, 3, 2), 8); });
  for (const int bits : {0, 7, 12, 17}) expect_mistake("bits", [&] { png_bytes(picture, bits); });
  expect_mistake("empty", [] { jpeg_bytes({}, 90); });
  expect_mistake("channels", [] { jpeg_bytes(Image<std::uint8_t>(3, 3, 1), 90); });
  for (const int quality : {0, 101})
    expect_mistake("quality", [&] { jpeg_bytes(Image<std::uint8_t>(3, 3, 3), quality); });
  EpiDrawing epi;
  expect_mistake("empty", [&] { draw_epi(epi); });
  epi.pixels = Image<std::uint16_t>(5, 3, 3);
  expect_mistake("rows", [&] { draw_epi(epi); });
  expect_mistake("cells", [] { draw_samples({}); });
  const std::vector<float> scores{0, 1};
  expect_mistake("scores", [] { draw_scores({}, {0, 1}, 0, {}); });
  expect_mistake("range", [&] { draw_scores(scores, {1, 0}, 0, {}); });
  expect_mistake("size", [] { shrunk(two_views(), 0); });
}

TEST_F(MistakesOfAdapters, AFileThatIsNotThere) {
  const auto nowhere = folder / "nowhere";
  expect_mistake("light field", [&] { open_light_field(nowhere); });
  expect_mistake("light field", [] { open_light_field(""); });
  expect_mistake("result", [&] { DepthResult{nowhere}; });
  expect_mistake("camera", [&] { read_camera(nowhere); });
  expect_mistake("sparse", [&] { SparseFile{nowhere}; });
  expect_mistake("colmap", [&] { read_colmap_model(nowhere); });
  expect_mistake("colmap", [&] { read_colmap_depth_map(nowhere); });
  expect_mistake("truth", [&] { read_hci_old_truth(nowhere); });
  expect_mistake("map", [&] { read_float_map(nowhere); });
  expect_mistake("picture", [&] { read_picture(nowhere); });
  expect_mistake("options", [&] { read_options_file(nowhere); });
  expect_mistake("text", [&] { read_text(nowhere); });
  expect_mistake("rail", [&] { open_rail_in_order(nowhere, {}); });
  expect_mistake("program", [] { ChildProcess({}, {}); });
  expect_mistake("program", [] { ChildProcess({"no such program"}, {}); });
}

TEST_F(MistakesOfAdapters, AViewThatIsNotThere) {
  const LightField field = two_views();
  expect_mistake("files", [&] { write_light_field_json(folder / "a.json", field, {"one"}); });
  const auto flat = [](int) { return FloatMap(7, 5); };
  const RunControl control;
  const auto path = folder / "a.grl";
  expect_mistake("empty", [&] { write_sparse_file(path, {}, flat, {}, control); });
  expect_mistake("error", [&] { write_sparse_file(path, field, flat, {-1, 0, {}}, control); });
  expect_mistake("disparity", [&] { write_sparse_file(path, field, {}, {}, control); });
  write_sparse_file(path, field, flat, {}, control);
  const SparseFile file(path);
  for (const int view : {-1, 2}) {
    expect_mistake("view", [&] { file.picture(view, {0, 5}); });
    expect_mistake("view", [&] { file.disparity(view, {0, 5}); });
  }
  for (const RowRange rows : {RowRange{-1, 3}, {3, 3}, {0, 6}}) {
    expect_mistake("rows", [&] { file.picture(0, rows); });
    expect_mistake("rows", [&] { file.disparity(0, rows); });
  }
  DepthFolder output(folder / "out", {}, {});
  expect_mistake("not described", [&] { output.write_view(0, FloatMap(7, 5), {}, {0, 1}, true); });
  output.describe(field);
  expect_mistake("view", [&] { output.write_view(2, FloatMap(7, 5), {}, {0, 1}, true); });
  expect_mistake("empty", [&] { output.write_view(0, {}, {}, {0, 1}, true); });
  expect_mistake("rail", [] { source_of(RectifiedRail(), 0); });
  expect_mistake("rail", [] { rectified_light_field(RectifiedRail(), std::nullopt); });
}

TEST_F(MistakesOfAdapters, ASurfaceOrACloudThatIsNone) {
  SurfaceMesh mesh;
  expect_mistake("empty", [&] { write_mesh(folder / "a.ply", mesh); });
  mesh.positions.emplace_back(0, 0, 0);
  mesh.faces.push_back({0, 0, 0});
  expect_mistake("colours", [&] { write_mesh(folder / "a.ply", mesh); });
  mesh.normals.emplace_back(0, 0, 1);
  mesh.colours.push_back({});
  mesh.faces.push_back({0, 1, 2});
  expect_mistake("corners", [&] { write_mesh(folder / "a.ply", mesh); });
  mesh.faces = {{0, 0, 0}};
  expect_mistake("format", [&] { write_mesh(folder / "a.doc", mesh); });
  TexturedMeshOutput output(folder / "a.obj", {});
  expect_mistake("texture", [&] { output.write(mesh, {}); });
  PointCloud cloud, other;
  for (PointCloud* each : {&cloud, &other}) {
    each->positions.emplace_back(0, 0, 0);
    each->normals.emplace_back(0, 0, 1);
    each->colours.push_back({});
    each->confidences.push_back(1);
    each->supports.push_back(1);
  }
  other.origin.x() = 1;
  CloudFile file(AtomicFile(folder / "a.ply"));
  file.add(cloud);
  expect_mistake("origin", [&] { file.add(other); });
  cloud.colours.clear();
  expect_mistake("colours", [&] { file.add(cloud); });
}

TEST_F(MistakesOfAdapters, ALensOrAPoseThatIsNone) {
  const Lens unknown{"PERISCOPE", 8, 8, {1}}, short_one{"PINHOLE", 8, 8, {1}};
  for (const Lens& lens : {Lens(), unknown, short_one}) {
    expect_mistake("check", [&] { check(lens, "a"); });
    expect_mistake("distort", [&] { distort(lens, {0, 0}); });
    expect_mistake("undistort", [&] { undistort(lens, {0, 0}); });
    expect_mistake("map", [&] { LensMap{lens}; });
  }
  expect_mistake("size", [] { LensMap(centred_pinhole(0, 0, 1)); });
  const PoseConvention none{"XYZ", false};
  expect_mistake("read", [&] { read_pose(StatedPose::Identity(), none); });
  expect_mistake("state", [&] { state_pose(CameraPose(), none); });
  expect_mistake("describe", [&] { describe(none); });
  const RunControl control;
  expect_mistake("agreement", [&] { measure_pose_agreement(LightField(), control); });
  expect_mistake("agreement", [&] { measure_pose_agreement(two_views(), control); });
  LightField posed = two_views();
  posed.kind = LightFieldKind::kUnstructured;
  posed.cameras.resize(1);
  expect_mistake("range", [&] { take_range_of_features(posed, control); });
  expect_mistake("rows", [&] { displacement_across_rows(LightField(), control); });
  expect_mistake("series", [&] { find_feature_tracks({2, 8, {}}, {}, "a", control); });
  expect_mistake("series", [&] { measure_vertical_residual({2, 8, {}}, "a", control); });
}

}  // namespace
}  // namespace gigaray
