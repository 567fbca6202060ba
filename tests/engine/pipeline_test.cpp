// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What comes out of reconstruct(): the right depth, for every view, and one clear line otherwise.
#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "gigaray/core/synthetic.h"
#include "support/analytic_field.h"
#include "support/depth_result.h"
#include "support/errors.h"
#include "support/memory_limits.h"

namespace gigaray::testing_support {
namespace {

DepthOptions job(const std::string& preset, DisparityRange range, int hypotheses) {
  DepthOptions options = preset_options(preset);
  options.disparity = range;
  options.hypotheses = hypotheses;
  return options;
}

DepthResult run(const LightField& light_field, const DepthOptions& options,
                const std::string& backend = "opencl") {
  const RunControl control;
  Reconstruction result = reconstruct(light_field, options, {backend, ""}, control);
  return all_of(result);
}

const char* const kPresets[] = {"paper", "auto"};

TEST(Pipeline, PaperFindsAPlaneWithinOneHypothesis) {
  const double truth = 0.617;
  for (const auto& views : {irregular_row(), irregular_grid()}) {
    const AnalyticField field = analytic_field(93, 61, views, {{truth}});
    const DepthOptions options = job("paper", {-1, 2}, 121);
    const DepthResult result = run(field.light_field, options);
    EXPECT_EQ(pixels_without_estimate(result), 0);
    EXPECT_GT(share_within(result, field.disparity, 3.0 / 120), 0.97);
  }
}

TEST(Pipeline, AutoFindsAPlaneWithinAFractionOfAHypothesis) {
  const double truth = 0.617;
  for (const auto& views : {irregular_row(), irregular_grid()}) {
    const AnalyticField field = analytic_field(93, 61, views, {{truth}});
    const DepthOptions options = job("auto", {-1, 2}, 61);  // steps of 0.05
    const DepthResult result = run(field.light_field, options);
    EXPECT_EQ(pixels_without_estimate(result), 0);
    EXPECT_GT(share_within(result, field.disparity, 0.3 * 0.05), 0.95);
  }
}

TEST(Pipeline, PositiveDisparityIsNearerAndNegativeIsFarther) {
  for (const double truth : {-0.8, 0.8})
    for (const char* preset : kPresets) {
      const AnalyticField field = analytic_field(61, 45, row_of_views(7), {{truth}});
      EXPECT_GT(
          share_within(run(field.light_field, job(preset, {-1.5, 1.5}, 61)), field.disparity, 0.1),
          0.95)
          << preset << " " << truth;
    }
}

TEST(Pipeline, SlantedPlanesAreFound) {
  const RunControl control;
  for (const auto& [views_s, views_t] : {std::pair(9, 1), std::pair(5, 5)}) {
    SyntheticOptions scene;
    scene.scene = "planes";
    scene.width = 121;
    scene.height = 81;
    scene.views_s = views_s;
    scene.views_t = views_t;
    const SyntheticLightField field = render_synthetic(scene, control);
    DepthOptions options = job("auto", {-1.2, 1.2}, 61);
    options.views = {centre_view(field.light_field)};
    const DepthResult slanted = run(field.light_field, options);
    EXPECT_GT(share_within(slanted, field.disparity, 0.07), 0.9) << views_s << "x" << views_t;
    options.support.slanted = options.support.half_planes = options.score.ray_mean = false;
    options.support.choose_sides = options.support.fill_hidden = false;
    EXPECT_GT(share_within(slanted, field.disparity, 0.02),
              share_within(run(field.light_field, options), field.disparity, 0.02));
  }
}

TEST(Pipeline, AnOccludersEdgeStaysSharp) {
  Layer front{1.5, 2};
  front.left = 40;
  front.right = 80;
  front.top = 20;
  front.bottom = 50;
  for (const auto& views : {row_of_views(9), grid_of_views(5, 5)})
    for (const char* preset : kPresets) {
      const AnalyticField field = analytic_field(121, 71, views, {{0, 5}, front});
      const DepthResult result = run(field.light_field, job(preset, {-1, 2.5}, 71));
      EXPECT_GT(share_within(result, field.disparity, 0.1), 0.92) << preset;
      // In the centre view: two pixels within the edge near, three pixels outside of it far.
      const int centre = centre_view(field.light_field);
      const FloatMap& disparity = result.views.at(centre).disparity;
      int near = 0, far = 0, rows = 0;
      for (int v = 24; v < 47; ++v, ++rows) {
        near += std::abs(disparity(42, v) - 1.5) < 0.2 && std::abs(disparity(78, v) - 1.5) < 0.2;
        far += std::abs(disparity(37, v)) < 0.2 && std::abs(disparity(83, v)) < 0.2;
      }
      EXPECT_GT(near, 0.9 * rows) << preset << ", " << views.size() << " views";
      EXPECT_GT(far, 0.8 * rows) << preset << ", " << views.size() << " views";
    }
}

TEST(Pipeline, EveryPixelOfEveryViewGetsAnEstimate) {
  struct Size {
    int width, height, bit_depth;
    std::vector<View> views;
  };
  const Size sizes[] = {{21, 11, 8, row_of_views(2)},
                        {93, 31, 16, row_of_views(3)},
                        {33, 7, 8, row_of_views(5)},
                        {16, 16, 16, grid_of_views(2, 2)},
                        {45, 57, 8, irregular_grid()}};
  for (const Size& size : sizes)
    for (const char* preset : kPresets) {
      Layer patch{1, 3};
      patch.left = patch.top = 4;
      patch.right = patch.bottom = 9;
      const AnalyticField field = analytic_field(size.width, size.height, size.views,
                                                 {{-0.4, 1, 0.02}, patch}, size.bit_depth, 0.01);
      const RunControl control;
      Reconstruction result = reconstruct(field.light_field, job(preset, {-1, 2}, 31), {}, control);
      EXPECT_EQ(result.views().size(), size.views.size());
      EXPECT_EQ(pixels_without_estimate(all_of(result)), 0)
          << preset << " " << size.width << "x" << size.height;
      for (const auto& [view, depth] : all_of(result).views) {
        EXPECT_EQ(depth.disparity.width(), size.width);
        EXPECT_EQ(depth.disparity.height(), size.height);
        for (const float d : depth.disparity) EXPECT_TRUE(d >= -1 && d <= 2) << d;
      }
    }
}

TEST(Pipeline, AFlatPictureGetsDepthToo) {
  const AnalyticField field = analytic_field(33, 31, row_of_views(3), {{0, 1, 0}});
  for (const char* preset : kPresets)
    EXPECT_EQ(pixels_without_estimate(run(field.light_field, job(preset, {-1, 1}, 21))), 0)
        << preset;
  // All hypotheses score 1 then, and of equal scores the smallest hypothesis wins.
  for (const char* backend : {"opencl", "reference"})
    for (const auto& [view, depth] :
         run(field.light_field, job("paper", {-1, 1}, 21), backend).views)
      for (const float d : depth.disparity) EXPECT_EQ(d, -1) << backend;
}

TEST(Pipeline, ReferenceAndOpenClAgree) {
  // Where two hypotheses score alike, rounding decides; the choice travels to other views.
  constexpr double kAgree = 0.98;
  Layer front{1.1, 2};
  front.left = 15;
  front.right = 30;
  for (const auto& views : {irregular_row(), grid_of_views(3, 3)})
    for (const char* preset : kPresets) {
      const AnalyticField field = analytic_field(49, 27, views, {{-0.3, 1}, front}, 8, 0.004);
      const DepthOptions options = job(preset, {-1, 2}, 31);
      const DepthResult reference = run(field.light_field, options, "reference");
      const DepthResult opencl = run(field.light_field, options, "opencl");
      std::vector<FloatMap> expected;
      for (const auto& [view, depth] : reference.views) expected.push_back(depth.disparity);
      const double share = share_within(opencl, expected, 0.1);
      std::printf("%s, %zu views: %.3f %% of the pixels within one hypothesis of the reference\n",
                  preset, views.size(), 100 * share);
      EXPECT_GT(share, kAgree) << preset;
    }
}

TEST(Pipeline, OnlyViewsAskedForHaveDepth) {
  const AnalyticField field = analytic_field(41, 33, row_of_views(5), {{0.5}});
  DepthOptions options = job("auto", {-1, 2}, 31);
  options.views = {4, 1, 4};
  const RunControl control;
  Reconstruction some = reconstruct(field.light_field, options, {}, control);
  EXPECT_EQ(some.views(), (std::vector<int>{1, 4}));
  EXPECT_EQ(pixels_without_estimate(all_of(some)), 0);
  expect_error(ErrorCode::kInvalidArgument, {"view 2"}, [&] { some.view(2); });
  some.for_each_tuple(
      [](const RayTuple& tuple) { EXPECT_TRUE(tuple.view == 1 || tuple.view == 4); });

  options.views = {centre_view(field.light_field)};
  const DepthResult centre = run(field.light_field, options);
  ASSERT_EQ(centre.views.size(), 1u);
  EXPECT_GT(share_within(centre, field.disparity, 0.05), 0.95);
}

TEST(Pipeline, TuplesAreTheAcceptedEstimatesInAFixedOrder) {
  const AnalyticField field = analytic_field(45, 33, row_of_views(5), {{0.5}});
  const RunControl control;
  Reconstruction result = reconstruct(field.light_field, job("paper", {-1, 2}, 61), {}, control);
  const auto order = views_from_centre(field.light_field);
  const auto place = [&](int view) {
    return std::find(order.begin(), order.end(), view) - order.begin();
  };
  std::size_t count = 0;
  RayTuple last;
  last.level = last.u = -1;
  last.view = order.front();
  result.for_each_tuple([&](const RayTuple& tuple) {
    ++count;
    EXPECT_LT(std::tuple(last.level, place(last.view), last.v, last.u),
              std::tuple(tuple.level, place(tuple.view), tuple.v, tuple.u));
    EXPECT_TRUE(tuple.level >= 0 && tuple.level < result.num_levels());
    EXPECT_TRUE(tuple.hypothesis >= -1.0001 && tuple.hypothesis <= 2.0001);
    for (const float x : {tuple.radiance.r, tuple.radiance.g, tuple.radiance.b})
      EXPECT_TRUE(x >= 0 && x <= 1) << x;
    last = tuple;
  });
  EXPECT_EQ(count, result.num_tuples());
  // A ray that was found in the centre view is not searched again elsewhere.
  EXPECT_LT(count, std::size_t(2 * 45 * 33));
}

TEST(Pipeline, OptionsInTheResultAreFilledIn) {
  const AnalyticField field = analytic_field(93, 61, row_of_views(7), {{0.5}}, 8, 0.02);
  DepthOptions options = auto_options();
  const RunControl control;
  Reconstruction result = reconstruct(field.light_field, options, {}, control);
  ASSERT_TRUE(result.options().disparity);
  EXPECT_LT(result.options().disparity->min, 0.5);
  EXPECT_GT(result.options().disparity->max, 0.5);
  EXPECT_EQ(result.options().hypotheses, result.hypotheses().count);
  EXPECT_LE(result.hypotheses().step(), options.hypothesis_step * 1.0001);
  EXPECT_GT(result.options().score.bandwidth, options.score.bandwidth);
  EXPECT_NE(result.device().find("opencl"), std::string::npos);
}

TEST(Pipeline, CancelStopsTheRunAndLeavesNoFile) {
  const AnalyticField field = analytic_field(61, 211, row_of_views(5), {{0.5}});
  const ScopedFolder work;
  DepthOptions options = job("auto", {-1, 2}, 61);
  options.work_folder = work.path;
  options.memory_bytes = least_limit_by_trial(field.light_field, options);
  ASSERT_GT(forecast(field.light_field, options).disk_bytes, 0);
  for (const double stop_at : {0.0, 0.3, 0.76}) {
    RunControl control;
    bool reached = false;
    control.on_progress = [&](const std::string& stage, double done, double total) {
      if (stage.starts_with("level") && done >= stop_at * total) {
        reached = true;
        control.cancel();
      }
    };
    expect_error(ErrorCode::kCancelled, {"stopped"},
                 [&] { reconstruct(field.light_field, options, {}, control); });
    EXPECT_TRUE(reached);
    EXPECT_TRUE(std::filesystem::is_empty(work.path));
  }
}

TEST(Pipeline, CancelBeforeTheStartAndWhileDecoding) {
  const AnalyticField field = analytic_field(41, 33, row_of_views(5), {{0.5}});
  const DepthOptions options = job("paper", {-1, 2}, 31);
  RunControl before;
  before.cancel();
  expect_error(ErrorCode::kCancelled, {"stopped"},
               [&] { reconstruct(field.light_field, options, {}, before); });
  RunControl decoding;
  decoding.on_progress = [&](const std::string& stage, double, double) {
    if (stage == "decode") decoding.cancel();
  };
  expect_error(ErrorCode::kCancelled, {"stopped"},
               [&] { reconstruct(field.light_field, options, {}, decoding); });
}

TEST(Pipeline, ProgressGrowsToTheEnd) {
  const AnalyticField field = analytic_field(45, 33, row_of_views(5), {{0.5}});
  RunControl control;
  double last = 0;
  std::string stage_of_last;
  control.on_progress = [&](const std::string& stage, double done, double total) {
    if (stage == "decode" || stage == "noise") return;
    EXPECT_GE(done / total, last) << stage;
    last = done / total;
    stage_of_last = stage;
  };
  reconstruct(field.light_field, job("auto", {-1, 2}, 31), {}, control);
  EXPECT_EQ(last, 1);
}

TEST(Pipeline, AWorkFolderThatCantBeWrittenIsNamed) {
  const AnalyticField field = analytic_field(93, 61, row_of_views(5), {{0.5}});
  const ScopedFolder work;
  DepthOptions options = job("paper", {-1, 2}, 31);
  options.work_folder = work.path / "file";
  std::ofstream(options.work_folder) << "not a folder";
  options.memory_bytes = least_limit_by_trial(field.light_field, options);
  const RunControl control;
  expect_error(ErrorCode::kIo, {options.work_folder},
               [&] { reconstruct(field.light_field, options, {}, control); });
}

TEST(Pipeline, TooLittleMemorySaysHowMuchItTakes) {
  const AnalyticField field = analytic_field(93, 61, row_of_views(5), {{0.5}});
  DepthOptions options = job("paper", {-1, 2}, 31);
  options.memory_bytes = 32 << 20;
  const RunControl control;
  for (const char* backend : {"opencl", "reference"})
    expect_error(ErrorCode::kOutOfMemory, {"32 MiB", "5 views", "at least"}, [&] {
      reconstruct(field.light_field, options, {backend, ""}, control);
    });
  // What the message advises must do.
  std::string message;
  try {
    forecast(field.light_field, options);
  } catch (const Error& error) {
    message = error.what();
  }
  options.memory_bytes = std::stod(message.substr(message.find("at least") + 8)) * (1 << 20);
  EXPECT_NO_THROW(forecast(field.light_field, options));
}

TEST(Pipeline, WrongArgumentsAreNamed) {
  const AnalyticField field = analytic_field(41, 33, row_of_views(5), {{0.5}});
  const RunControl control;
  const auto expect_refused = [&](const DepthOptions& options, std::vector<std::string> parts) {
    expect_error(ErrorCode::kInvalidArgument, parts,
                 [&] { reconstruct(field.light_field, options, {}, control); });
  };
  const DepthOptions good = job("paper", {-1, 2}, 31);
  DepthOptions options = good;
  options.views = {0, 5};
  expect_refused(options, {"view 5", "0", "4"});
  options.views = {-1};
  expect_refused(options, {"view -1"});
  options = good;
  options.disparity = DisparityRange{-1, 41};
  expect_refused(options, {"-1 41", "41 px"});
  options = good;
  options.hypotheses = 0;
  options.hypothesis_step = 1e-4;
  expect_refused(options, {"hypotheses", "4096"});
  expect_error(ErrorCode::kInvalidArgument, {"cuda", "opencl", "reference"}, [&] {
    reconstruct(field.light_field, good, {"cuda", ""}, control);
  });
  expect_error(ErrorCode::kDevice, {"no such device"}, [&] {
    reconstruct(field.light_field, good, {"opencl", "no such device"}, control);
  });
}

/// Pictures that fail in one view.
class DamagedPixels : public PixelSource {
 public:
  explicit DamagedPixels(Image<std::uint16_t> odd_one) : odd_one_(std::move(odd_one)) {}
  Image<std::uint16_t> read(int view) const override {
    if (view != 3) return Image<std::uint16_t>(41, 33, 3, 100);
    if (odd_one_.empty()) throw Error(ErrorCode::kBadInput, "view3.png: truncated");
    return odd_one_;
  }
  int bit_depth() const override { return 8; }

 private:
  Image<std::uint16_t> odd_one_;
};

TEST(Pipeline, BadLightFieldsAreRefused) {
  const AnalyticField field = analytic_field(41, 33, row_of_views(5), {{0.5}});
  const RunControl control;
  const DepthOptions options = job("paper", {-1, 2}, 31);
  const auto expect_refused = [&](const LightField& light_field, std::vector<std::string> parts) {
    expect_error(ErrorCode::kBadInput, parts,
                 [&] { reconstruct(light_field, options, {}, control); });
  };
  LightField bad = field.light_field;
  bad.pixels = nullptr;
  expect_refused(bad, {"no pixels"});
  bad = field.light_field;
  bad.views.resize(1);
  expect_refused(bad, {"two views"});
  bad = field.light_field;
  bad.views[2].s = std::nan("");
  expect_refused(bad, {"view2", "finite"});
  bad = field.light_field;
  bad.views[2].name = "view1";
  expect_refused(bad, {"view1"});
  bad = field.light_field;
  bad.views[2].t = 1;  // kind still says 3D
  expect_refused(bad, {"view2", "line"});
  bad = field.light_field;
  bad.kind = LightFieldKind::kUnstructured;
  expect_refused(bad, {"unstructured"});
  bad = field.light_field;
  bad.pixels = std::make_shared<DamagedPixels>(Image<std::uint16_t>());
  expect_refused(bad, {"view3.png"});
  bad.pixels = std::make_shared<DamagedPixels>(Image<std::uint16_t>(40, 33, 3));
  expect_refused(bad, {"view3", "40x33", "41x33"});
}

TEST(Pipeline, PropagationGivesAHiddenViewTheDepthOfTheCentre) {
  // Only the centre view sees enough: the outer views have nothing to search, all come from rays.
  const AnalyticField field = analytic_field(61, 45, row_of_views(5), {{0.5}});
  const RunControl control;
  Reconstruction result = reconstruct(field.light_field, job("auto", {-1, 2}, 61), {}, control);
  std::map<int, int> found_in;
  result.for_each_tuple([&](const RayTuple& tuple) {
    if (tuple.level == 0) ++found_in[tuple.view];
  });
  const int centre = centre_view(field.light_field), pixels = 61 * 45;
  EXPECT_GT(found_in[centre], 0.9 * pixels);
  for (const auto& [view, count] : found_in)
    EXPECT_LT(count, view == centre ? pixels + 1 : pixels / 5) << view;
  EXPECT_GT(share_within(all_of(result), field.disparity, 0.05), 0.97);
}

}  // namespace
}  // namespace gigaray::testing_support
