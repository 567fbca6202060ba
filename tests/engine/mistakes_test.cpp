// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <new>

#include "gigaray/core/arguments.h"
#include "gigaray/engine/camera_order.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/engine/exposures.h"
#include "gigaray/engine/option_table.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/engine/scene_estimates.h"
#include "gigaray/engine/tune.h"
#include "gigaray/engine/view_layout.h"
#include "support/black_views.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;
using testing_support::expect_mistake;

const BackendChoice kReference{"reference", ""};

LightField three_views() {
  LightField field = testing_support::black_views(3, 16, 12);
  field.declared_range = DisparityRange{-1, 1};
  return field;
}

/// Every call that takes a light field and options.
void expect_all_to_refuse(const char* what, const LightField& field, const DepthOptions& options,
                          const BackendChoice& backend = kReference) {
  const RunControl control;
  expect_mistake(what, [&] { reconstruct(field, options, backend, control); });
  expect_mistake(what, [&] { probe(field, options, backend, 0, 1, 1, control); });
  if (backend.backend != "reference") return;
  expect_mistake(what, [&] { Estimator::reference().reconstruct(field, options, control); });
  expect_mistake(what, [&] { Estimator::reference().probe(field, options, 0, 1, 1, control); });
  expect_mistake(what, [&] { forecast(field, options, backend); });
  expect_mistake(what, [&] { least_memory_bytes(field, options); });
}

TEST(MistakesOfTheEngine, ALightFieldThatIsNone) {
  const DepthOptions options;
  expect_all_to_refuse("empty", {}, options);
  LightField field = three_views();
  field.pixels = nullptr;
  expect_all_to_refuse("no pixels", field, options);
  field = three_views();
  field.width = 17;
  expect_mistake("size", [&] { reconstruct(field, options, kReference, RunControl()); });
  field = three_views();
  field.views.resize(1);
  expect_all_to_refuse("one view", field, options);
  field = three_views();
  field.views[2].t = NAN;
  expect_all_to_refuse("NaN", field, options);
  field = three_views();
  field.kind = LightFieldKind::kUnstructured;
  expect_all_to_refuse("no cameras", field, options);
  field = three_views();
  field.declared_range = DisparityRange{1, -1};
  expect_all_to_refuse("range", field, options);
}

TEST(MistakesOfTheEngine, OptionsThatCannotBeMeant) {
  const auto refuse = [](const char* what, auto change) {
    DepthOptions options;
    change(options);
    expect_all_to_refuse(what, three_views(), options);
  };
  refuse("views", [](auto& o) { o.views = {3}; });
  refuse("views", [](auto& o) { o.views = {-1}; });
  refuse("memory", [](auto& o) { o.memory_bytes = NAN; });
  refuse("memory", [](auto& o) { o.memory_beside = -1; });
  refuse("disparity", [](auto& o) { o.disparity = DisparityRange{NAN, 1}; });
  refuse("disparity", [](auto& o) { o.disparity = DisparityRange{-1e6, 1e6}; });
  refuse("radius", [](auto& o) { o.winner.median_radius = -1; });
  expect_all_to_refuse("backend", three_views(), DepthOptions(), {"abacus", ""});
  expect_mistake("preset", [] { preset_options(""); });
  DepthOptions options;
  expect_mistake("option", [&] { set_option(options, "", OptionValue()); });
  expect_mistake("devices", [] { Estimator(std::vector<Device>()); });
  expect_mistake("device", [] { Device(nullptr); });
  expect_mistake("backend", [] { Estimator::of({"", ""}); });
}

TEST(MistakesOfTheEngine, AViewOrAPixelThatIsNotThere) {
  const LightField field = three_views();
  DepthOptions options = paper_options();
  options.hypotheses = 5;
  options.views = {1};
  const RunControl control;
  const Reconstruction result = reconstruct(field, options, kReference, control);
  for (const int view : {-1, 0, 3, std::numeric_limits<int>::max()}) {
    expect_mistake("view", [&] { result.view(view); });
    expect_mistake("view", [&] { result.decision(view, 1, 1); });
  }
  for (const auto& [u, v] : {std::pair(-1, 0), {0, -1}, {16, 0}, {0, 12}}) {
    expect_mistake("pixel", [&, u = u, v = v] { result.decision(1, u, v); });
    expect_mistake("pixel",
                   [&, u = u, v = v] { probe(field, options, kReference, 1, u, v, control); });
  }
  expect_mistake("view", [&] { probe(field, options, kReference, 3, 1, 1, control); });
  ViewDepth depth = result.view(1);
  depth.confidence = FloatMap(3, 3);
  expect_mistake("sizes", [&] { drop_unsure(0.5f, depth); });
}

TEST(MistakesOfTheEngine, EstimatesOfWhatIsNoLightField) {
  const RunControl control;
  LightField none, flat = three_views();
  LightField assumed;
  assumed.sign_is_assumed = true;
  expect_mistake("direction", [&] { check_direction(assumed, control); });
  expect_mistake("positions", [&] { doubt_positions(none, control); });
  expect_mistake("range", [&] { estimate_disparity_range(none, control); });
  expect_mistake("agreement", [&] { measure_agreement(none, control); });
  expect_mistake("noise", [&] { estimate_noise(none, {0, 1, 5}, control); });
  expect_mistake("noise", [&] { estimate_noise(flat, {1, 0, 5}, control); });
  expect_mistake("noise", [&] { estimate_noise(flat, {0, NAN, 5}, control); });
  expect_mistake("noise", [&] { estimate_noise(flat, {0, 1, 1}, control); });
  expect_mistake("depths", [&] { estimate_inverse_depths(none, control, true); });
  expect_mistake("depths", [&] { estimate_inverse_depths(flat, control, true); });
  expect_mistake("exposures", [&] { estimate_exposures(none, control); });
  expect_mistake("exposures", [&] { estimate_exposures(flat, control); });
  expect_mistake("exposures", [&] { evened(flat, {}); });
  expect_mistake("exposures", [&] { evened(none, {}); });
  expect_mistake("layout", [&] { try_layouts(none, {}, 0, control); });
  expect_mistake("layout", [&] { try_layouts(flat, {0, 1}, 3, control); });
  expect_mistake("layout", [&] { try_layouts(flat, {0, 1, 2}, 0, control); });
  expect_mistake("layout", [&] { try_layout(flat, {0, 1, 2}, {0, 0}, control); });
  expect_mistake("layout", [&] { try_layout(flat, {0, -1, 2}, {1, 3}, control); });
  expect_mistake("device", [&] { tune_device("no such device", control); });
}

/// Pictures that find no memory.
class Greedy : public PixelSource {
 public:
  Image<std::uint16_t> read(int) const override { throw std::bad_alloc(); }
  int bit_depth() const override { return 8; }
};

TEST(MistakesOfTheEngine, MemoryThatIsNotThereIsAnErrorOfItsOwn) {
  LightField field = three_views();
  field.pixels = std::make_shared<Greedy>();
  const DepthOptions options = paper_options();
  const RunControl control;
  const auto expect = [](auto call) {
    expect_error(ErrorCode::kOutOfMemory, {"out of memory"}, call);
  };
  expect([&] { reconstruct(field, options, kReference, control); });
  expect([&] { Estimator::reference().reconstruct(field, options, control); });
  expect([&] { probe(field, options, kReference, 0, 1, 1, control); });
  field.declared_range.reset();
  expect([&] { forecast(field, options, kReference); });
  expect([&] { least_memory_bytes(field, options); });
  expect([] { with_memory_errors("a list", [] { std::vector<int>().reserve(~std::size_t(0)); }); });
}

}  // namespace
}  // namespace gigaray
