// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/light_field.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/engine/reconstruct.h"

// The experiments of section 5 of Kim et al. 2013 and ablations, each a table and pictures.
namespace gigaray::experiments {

/// A light field with the truth of its centre view.
struct Scene {
  std::string name;
  LightField light_field;
  int view = 0;
  FloatMap truth;
  DisparityRange range() const;  ///< of the truth
};

Scene synthetic_scene(const SyntheticOptions& options);

/// A folder with truth.pfm or gt_disp_lowres.pfm. Throws Error(kBadInput) when it has none.
Scene scene_from(const std::filesystem::path& folder);

/// Where an experiment puts what it finds.
class Report {
 public:
  Report(std::filesystem::path folder, int repeats)
      : folder_(std::move(folder)), repeats_(repeats) {}

  /// Runs once to check and warm up, then `repeats` times to be timed: depth of the centre view.
  /// Adds a row with label, BadPix, mean |error| over the range (SAD), filled, seconds (median) and
  /// memory (forecast), and writes LABEL.png. Throws Error(kDevice) when a repeat gives another
  /// map.
  ViewDepth run(const std::string& label, const Scene& scene, DepthOptions options);

  /// Adds a value to the last row.
  void note(const std::string& name, nlohmann::ordered_json value);

  /// An 8-bit RGB picture, and a map in colours.
  void write(const std::string& name, const Image<std::uint16_t>& picture);
  void write(const std::string& name, const FloatMap& map, DisparityRange range);

  const nlohmann::ordered_json& rows() const { return rows_; }
  const std::string& device() const { return device_; }

 private:
  std::filesystem::path folder_;
  int repeats_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
  std::string device_;
};

struct Setup {
  std::optional<std::filesystem::path> input;  ///< instead of the synthetic scene
  double size = 1;                             ///< of synthetic pictures, factor
};

struct Experiment {
  const char *name, *question;
  void (*run)(const Setup& setup, Report& report);
  bool takes_input = true;
};

const std::vector<Experiment>& all_experiments();

}  // namespace gigaray::experiments
