// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/sparse_file.h"

#include <bit>
#include <cstdlib>

#include "adapters/adapters_test.h"
#include "gigaray/adapters/depth_result.h"
#include "support/analytic_field.h"

namespace gigaray {
namespace {

using testing_support::analytic_field;
using testing_support::AnalyticField;
using testing_support::grid_of_views;
using testing_support::irregular_grid;
using testing_support::row_of_views;

class SparseFileTest : public AdaptersTest {
 protected:
  static constexpr int kWide = 61, kHigh = 43;

  static AnalyticField field_of(std::vector<View> views, int bit_depth = 8) {
    return analytic_field(kWide, kHigh, std::move(views), {{-0.5, 1}, {1.3, 2, 1, 20, 40, 12, 33}},
                          bit_depth, 0.01);
  }
  std::filesystem::path file() const { return folder / "field.grl"; }

  SparseFileReport encode(const AnalyticField& field, const SparseFileOptions& options = {}) const {
    return write_sparse_file(file(), field.light_field,
                             [&](int view) { return field.disparity[view]; }, options, {});
  }
  void expect_same_pictures(const AnalyticField& field, const LightField& decoded) const {
    ASSERT_EQ(decoded.num_views(), field.light_field.num_views());
    for (int view = 0; view < decoded.num_views(); ++view)
      EXPECT_TRUE(read_view(decoded, view) == read_view(field.light_field, view)) << view;
  }
  void expect_damaged(const std::string& word) const {
    expect_error(ErrorCode::kBadInput, word, [&] {
      const SparseFile sparse(file());
      sparse.tuples();
      for (int view = 0; view < sparse.light_field().num_views(); ++view)
        sparse.picture(view, {0, kHigh});
    });
  }
};

TEST_F(SparseFileTest, RestoresEveryPixelOfEveryView) {
  for (const int bit_depth : {8, 16})
    for (const auto& views : {row_of_views(5), grid_of_views(3, 3), irregular_grid()}) {
      const AnalyticField field = field_of(views, bit_depth);
      const SparseFileReport report =
          encode(field, {.max_error = 0, .band_rows = 10, .sparse = {}});
      EXPECT_EQ(report.unexplained, 0u);
      EXPECT_EQ(report.rays, std::uint64_t(views.size()) * kWide * kHigh);
      EXPECT_EQ(report.rgb_bytes, report.rays * 3 * bit_depth / 8);
      EXPECT_EQ(report.file_bytes, std::filesystem::file_size(file()));
      EXPECT_GT(report.file_bytes, report.tuple_bytes + report.difference_bytes);
      expect_same_pictures(field, open_light_field(file()));
    }
}

TEST_F(SparseFileTest, KeepsWhatIsKnownOfTheRig) {
  AnalyticField field = field_of(irregular_grid());
  field.light_field.rig = {1000.0, 0.02, std::nullopt, "m"};
  field.light_field.declared_range = DisparityRange{-1, 2};
  encode(field);
  const LightField decoded = open_light_field(file());
  EXPECT_EQ(decoded.kind, LightFieldKind::k4D);
  EXPECT_EQ(decoded.rig.focal_px, 1000.0);
  EXPECT_EQ(decoded.rig.baseline, 0.02);
  EXPECT_FALSE(decoded.rig.focus_distance.has_value());
  EXPECT_EQ(decoded.rig.unit, "m");
  EXPECT_EQ(decoded.declared_range, (DisparityRange{-1, 2}));
  for (int i = 0; i < decoded.num_views(); ++i) {
    EXPECT_EQ(decoded.views[i].name, field.light_field.views[i].name);
    EXPECT_EQ(decoded.views[i].s, field.light_field.views[i].s);
    EXPECT_EQ(decoded.views[i].t, field.light_field.views[i].t);
  }
  EXPECT_EQ(decoded.pixels->bit_depth(), 8);
}

TEST_F(SparseFileTest, RaysWithoutDepthAreRestoredToo) {
  AnalyticField field = field_of(row_of_views(4));
  for (FloatMap& map : field.disparity)
    for (int v = 0; v < kHigh; ++v)
      for (int u = 0; u < kWide; ++u)
        if (v < 7 || u > 50) map(u, v) = kNoEstimate;
  const SparseFileReport report = encode(field);
  EXPECT_GT(report.unexplained, 0u);
  expect_same_pictures(field, open_light_field(file()));
  const FloatMap disparity = SparseFile(file()).disparity(0, {0, kHigh});
  EXPECT_TRUE(std::isnan(disparity(3, 3)));

  for (FloatMap& map : field.disparity) std::fill(map.begin(), map.end(), kNoEstimate);
  EXPECT_EQ(encode(field).tuples, 0u);
  expect_same_pictures(field, open_light_field(file()));
}

TEST_F(SparseFileTest, APartIsTheSameAsThatPartOfTheWhole) {
  const AnalyticField field = field_of(irregular_grid());
  encode(field, {.max_error = 0, .band_rows = 9, .sparse = {}});
  const SparseFile whole(file());
  const Image<std::uint16_t> all = whole.picture(2, {0, kHigh});
  const FloatMap disparity = whole.disparity(2, {0, kHigh});
  for (const RowRange rows : {RowRange{0, 1}, RowRange{8, 19}, RowRange{40, kHigh}}) {
    const SparseFile fresh(file());
    const Image<std::uint16_t> part = fresh.picture(2, rows);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), all.row(rows.begin)));
    const FloatMap part_disparity = fresh.disparity(2, rows);
    EXPECT_TRUE(
        std::equal(part_disparity.begin(), part_disparity.end(), disparity.row(rows.begin)));
  }
}

TEST_F(SparseFileTest, ABandOfARowIsReadWithoutTheRest) {
  // In 3D no band needs another: damage elsewhere does not matter.
  const AnalyticField field = field_of(row_of_views(5));
  encode(field, {.max_error = 0, .band_rows = 9, .sparse = {}});
  std::string bytes = read("field.grl");
  // The first sections are the tuples of the bands from the top.
  bytes[60] = char(bytes[60] ^ 1);
  write("field.grl", bytes);
  const SparseFile sparse(file());
  expect_error(ErrorCode::kBadInput, "checksum", [&] { sparse.picture(0, {0, 5}); });
  const Image<std::uint16_t> part = sparse.picture(0, {30, 36});
  const Image<std::uint16_t> picture = read_view(field.light_field, 0);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), picture.row(30)));
}

TEST_F(SparseFileTest, LossyKeepsTheBoundAndSaysSo) {
  const AnalyticField field = field_of(row_of_views(5));
  const std::uint64_t lossless = encode(field).file_bytes;
  EXPECT_LT(encode(field, {.max_error = 3, .band_rows = 0, .sparse = {}}).file_bytes, lossless);
  const LightField decoded = open_light_field(file());
  ASSERT_FALSE(decoded.notes.empty());
  EXPECT_NE(decoded.notes.back().find("up to 3"), std::string::npos);
  for (int view = 0; view < decoded.num_views(); ++view) {
    const Image<std::uint16_t> a = read_view(decoded, view), b = read_view(field.light_field, view);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(std::abs(a.data()[i] - b.data()[i]), 3);
  }
}

TEST_F(SparseFileTest, TwiceTheSameGivesTheSameBytes) {
  const AnalyticField field = field_of(grid_of_views(3, 2));
  encode(field);
  const std::string first = read("field.grl");
  encode(field);
  EXPECT_TRUE(read("field.grl") == first);
  EXPECT_EQ(names(), std::set<std::string>{"field.grl"});
}

TEST_F(SparseFileTest, EveryFlippedByteIsFound) {
  encode(field_of(row_of_views(2)));
  const std::string bytes = read("field.grl");
  for (std::size_t i = 0; i < bytes.size(); i += 1 + bytes.size() / 97) {
    std::string damaged = bytes;
    damaged[i] = char(damaged[i] ^ 0x20);
    write("field.grl", damaged);
    // A version that is too new is what damage of the version looks like.
    expect_damaged(i < 8 ? "sparse light field" : i < 16 ? "" : "is damaged");
  }
}

TEST_F(SparseFileTest, TruncatedLongerAndNewerFilesAreRefused) {
  encode(field_of(row_of_views(2)));
  const std::string bytes = read("field.grl");
  for (const std::size_t size :
       {bytes.size() - 1, bytes.size() / 2, std::size_t(57), std::size_t(20)}) {
    write("field.grl", bytes.substr(0, size));
    expect_damaged("is cut short");
  }
  write("field.grl", "");
  expect_damaged("is no sparse light field");
  write("field.grl", bytes + "x");
  expect_damaged("more follows");
  std::string newer = bytes;
  newer[8] = 2;
  write("field.grl", newer);
  expect_damaged("has version 2; this program reads up to version 1");
}

TEST_F(SparseFileTest, AbsurdOptionsAndPlacesAreRefusedBeforeAnythingIsWritten) {
  const AnalyticField field = field_of(row_of_views(2));
  expect_error(ErrorCode::kInvalidArgument, "largest error",
               [&] { encode(field, {.max_error = 200, .band_rows = 0, .sparse = {}}); });
  expect_error(ErrorCode::kInvalidArgument, "largest error",
               [&] { encode(field, {.max_error = -1, .band_rows = 0, .sparse = {}}); });
  EXPECT_EQ(names(), std::set<std::string>{});
  std::filesystem::create_directory(file());
  expect_error(ErrorCode::kInvalidArgument, "is a folder", [&] { encode(field); });
}

TEST_F(SparseFileTest, AFailureLeavesTheOlderFile) {
  const AnalyticField field = field_of(row_of_views(2));
  encode(field);
  const std::string before = read("field.grl");
  expect_error(ErrorCode::kBadInput, "no depth", [&] {
    write_sparse_file(file(), field.light_field,
                      [](int) -> FloatMap { throw Error(ErrorCode::kBadInput, "no depth"); }, {},
                      {});
  });
  EXPECT_TRUE(read("field.grl") == before);
  EXPECT_EQ(names(), std::set<std::string>{"field.grl"});
}

}  // namespace
}  // namespace gigaray
