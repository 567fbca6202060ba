// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "gigaray/core/metrics.h"

namespace gigaray {
namespace {

constexpr double kBad = 0.07;

/// What a region metric is computed from.
struct Region {
  const FloatMap& estimate;
  const FloatMap& truth;
  const RigGeometry& rig;
  int border;
  Mask mask;
};

/// Up to three masks, the rest null; their union is meant.
using MaskNames = std::array<const char*, 3>;

/// A metric of the HCI benchmark for scenes that have its masks.
struct RegionMetric {
  const char* name;
  MaskNames masks;
  double (*compute)(const Region&);
  const char* meaning;
};

double bad_in_region(const Region& r) {
  return bad_pix(r.estimate, r.truth, kBad, r.border, r.mask);
}
double bumpiness_in_region(const Region& r) {
  return bumpiness(r.estimate, r.truth, r.border, r.mask);
}
double angle_in_region(const Region& r) {
  return median_angular_error(r.estimate, r.truth, r.rig, r.border, r.mask);
}

std::span<const RegionMetric> region_metrics() {
  using R = const Region&;
  static constexpr RegionMetric metrics[] = {
      {"Discontinuities", {"discontinuities"}, bad_in_region, "% above 0.07 at discontinuities"},
      {"FineFattening",
       {"fine_surrounding"},
       [](R r) { return fine_fattening(r.estimate, r.truth, r.border, r.mask); },
       "% too near by 0.15 around fine structures"},
      {"FineThinning",
       {"fine"},
       [](R r) { return fine_thinning(r.estimate, r.truth, r.border, r.mask); },
       "% too far by 0.15 on fine structures"},
      {"BumpinessPlanes",
       {"planes"},
       bumpiness_in_region,
       "roughness of the error on planes x 100"},
      {"BumpinessSurfaces",
       {"smooth_surfaces"},
       bumpiness_in_region,
       "the same on smooth surfaces"},
      {"MAEPlanes", {"planes"}, angle_in_region, "median angle between normals on planes, degrees"},
      {"MAESurfaces", {"smooth_surfaces"}, angle_in_region, "the same on smooth surfaces"},
      {"BackgammonFattening",
       {"foreground_fattening"},
       [](R r) { return backgammon_fattening(r.estimate, r.truth, r.border, r.mask); },
       "% beside the wedges closer to the foreground"},
      {"BackgammonThinning",
       {"foreground_thinning"},
       [](R r) { return backgammon_thinning(r.estimate, r.truth, r.border, r.mask); },
       "% on the wedges closer to the background"},
      {"PyramidsSlanted",
       {"sphere_in", "sphere_out", "pyramids"},
       bumpiness_in_region,
       "roughness of the error on slanted parts x 100"},
      {"PyramidsParallel", {"plane"}, bumpiness_in_region, "the same on the parallel plane"},
      {"StripesLowTexture", {"low_texture"}, bad_in_region, "% above 0.07 where texture is low"},
      {"DarkStripes", {"high_contrast"}, bad_in_region, "% above 0.07 at dark stripes"},
      {"BrightStripes", {"low_contrast"}, bad_in_region, "% above 0.07 at bright stripes"},
  };
  return metrics;
}

bool has_all(const SceneParts& scene, const MaskNames& names) {
  return std::all_of(names.begin(), names.end(),
                     [&](const char* name) { return !name || scene.masks.contains(name); });
}

Mask union_of(const SceneParts& scene, const MaskNames& names) {
  const LabelMap& first = scene.masks.at(names.front());
  Mask mask(first.width(), first.height());
  for (const char* name : names) {
    if (!name) continue;
    const LabelMap& labels = scene.masks.at(name);
    for (std::size_t i = 0; i < mask.size(); ++i) mask.data()[i] |= labels.data()[i] != 0;
  }
  return mask;
}

class Sheet {
 public:
  Sheet(const FloatMap& estimate, const FloatMap& truth, const SceneParts& scene,
        const ScoreChoice& choice)
      : estimate_(estimate), truth_(truth), scene_(scene), choice_(choice) {}

  std::vector<Score> fill() {
    if (choice_.hci) {
      add_general("", {});
      add_regions();
    }
    if (choice_.middlebury) add_middlebury("", {});
    for (const std::string& name : scene_.asked) {
      const Mask mask = union_of(scene_, {name.c_str()});
      if (choice_.hci) add_general(name + ".", mask);
      if (choice_.middlebury) add_middlebury(name + ".", mask);
    }
    return std::move(scores_);
  }

 private:
  void add(const std::string& name, double value, const std::string& meaning) {
    scores_.push_back({name, value, meaning});
  }

  /// prefix: "MASK." or nothing, which is the whole map.
  void add_general(const std::string& prefix, const Mask& mask) {
    const DisparityScores s = score_disparity(estimate_, truth_, choice_.hci_border(), mask);
    add(prefix + "BadPix0.07", s.bad_pix_007, "% of pixels with an error above 0.07");
    add(prefix + "BadPix0.03", s.bad_pix_003, "% above 0.03");
    add(prefix + "BadPix0.01", s.bad_pix_001, "% above 0.01");
    add(prefix + "MSEx100", s.mse_x100, "mean squared error x 100");
    add(prefix + "Q25", s.q25_x100, "25th percentile of the error x 100");
    add_coverage(prefix, s.filled, s.scored);
  }

  void add_middlebury(const std::string& prefix, const Mask& mask) {
    const MiddleburyScores s =
        score_middlebury(estimate_, truth_, choice_.middlebury_border(), mask);
    add(prefix + "bad0.5", s.bad_05, "% of pixels with an error above 0.5 px");
    add(prefix + "bad1.0", s.bad_10, "% above 1 px");
    add(prefix + "bad2.0", s.bad_20, "% above 2 px");
    add(prefix + "bad4.0", s.bad_40, "% above 4 px");
    add(prefix + "avgerr", s.average_error, "mean error, px");
    add(prefix + "rms", s.rms, "root of the mean squared error, px");
    add(prefix + "A50", s.a50, "median of the error, px");
    add(prefix + "A90", s.a90, "90th percentile of the error, px");
    add(prefix + "A95", s.a95, "95th percentile, px");
    add(prefix + "A99", s.a99, "99th percentile, px");
    // The borders of the two benchmarks differ, so the pixels do.
    if (choice_.hci)
      add(prefix + "coverage", s.filled, fmt::format("% of {} pixels scored in px", s.scored));
    else
      add_coverage(prefix, s.filled, s.scored);
  }

  void add_coverage(const std::string& prefix, double filled, long scored) {
    add(prefix + "filled", filled, fmt::format("% of {} pixels scored", scored));
    add(prefix + "scored", double(scored), "pixels");
  }

  void add_regions() {
    Region region{estimate_, truth_, scene_.rig, choice_.hci_border(), {}};
    for (const RegionMetric& metric : region_metrics()) {
      if (!has_all(scene_, metric.masks)) continue;
      region.mask = union_of(scene_, metric.masks);
      add(metric.name, metric.compute(region), metric.meaning);
    }
    if (has_all(scene_, {"boxes", "dots_by_size"})) {
      if (has_all(scene_, {"background"}))
        add("DotsBackgroundMSEx100",
            mean_squared_error_x100(estimate_, truth_, choice_.hci_border(),
                                    union_of(scene_, {"background"})),
            "mean squared error behind the dots x 100");
      add("MissedDots",
          missed_dots(estimate_, truth_, scene_.masks.at("boxes"), scene_.masks.at("dots_by_size")),
          "% of dots of which half is off by 0.4");
    }
    region.mask = mask_near_jumps(truth_);
    add("NearJumps", bad_in_region(region), "% above 0.07 within 4 px of a jump of the truth");
  }

  const FloatMap& estimate_;
  const FloatMap& truth_;
  const SceneParts& scene_;
  const ScoreChoice& choice_;
  std::vector<Score> scores_;
};

}  // namespace

std::vector<Score> scores_of(const FloatMap& estimate, const FloatMap& truth,
                             const SceneParts& scene, const ScoreChoice& choice) {
  return Sheet(estimate, truth, scene, choice).fill();
}

}  // namespace gigaray
