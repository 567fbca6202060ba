// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The whole method on a synthetic light field in memory: from encoded pixels to depth maps.
#include <cmath>
#include <memory>
#include <optional>

#include "gigaray/core/metrics.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/engine/reconstruct.h"
#include "support/program.h"

namespace gigaray::benchmarks {
namespace {

/// The default is the size of the flower garden of the paper (section 6), with the paper's number
/// of hypotheses.
struct Job {
  SyntheticOptions scene;
  DepthOptions options = paper_options();
};

/// A light field that all benchmarks of the process share.
class Garden {
 public:
  explicit Garden(const Job& job) : job_(job) {}

  const SyntheticLightField& field() {
    if (!field_) field_ = render_synthetic(job_.scene, RunControl{});
    return *field_;
  }
  /// All maps of the requested views, as a user gets them.
  Reconstruction run(const std::vector<int>& views, FloatMap& first) {
    DepthOptions options = job_.options;
    options.views = views;
    Reconstruction result =
        reconstruct(field().light_field, options, BackendChoice{}, RunControl{});
    for (const int view : result.views()) {
      ViewDepth depth = result.view(view);
      if (view == result.views().front()) first = std::move(depth.disparity);
    }
    return result;
  }

 private:
  Job job_;
  std::optional<SyntheticLightField> field_;
};

void declare(const std::string& name, const std::shared_ptr<Garden>& garden, bool all_views) {
  const auto run = [garden, all_views](benchmark::State& state) {
    const SyntheticLightField& field = garden->field();
    const int centre = centre_view(field.light_field);
    const std::vector<int> views = all_views ? std::vector<int>{} : std::vector<int>{centre};

    // Warms the kernel cache and checks the answer.
    FloatMap disparity;
    Reconstruction result = garden->run(views, disparity);
    const int first = result.views().front();
    const DisparityScores scores = score_disparity(disparity, field.disparity[first]);
    if (!(scores.bad_pix_007 < 50))
      throw Error(ErrorCode::kDevice,
                  "the depth is wrong: BadPix0.07 is " + std::to_string(scores.bad_pix_007));

    std::map<std::string, double> seconds;
    for (auto _ : state) seconds = garden->run(views, disparity).seconds();
    for (const auto& [stage, value] : seconds) state.counters[stage] = value;
    state.counters["BadPix0.07"] = scores.bad_pix_007;
    state.counters["filled"] = scores.filled;
    state.counters["levels"] = result.num_levels();
  };
  repeated(benchmark::RegisterBenchmark(name.c_str(), run))
      ->Unit(benchmark::kSecond)
      ->Iterations(1);
}

int number(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  int value = 0;
  try {
    value = std::stoi(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || value <= 0)
    throw Error(ErrorCode::kInvalidArgument, option + " " + text + ": not a number above 0");
  return value;
}

Job parse(const std::vector<std::string>& arguments) {
  Job job;
  job.scene.scene = "garden";
  job.scene.views_s = 50;
  job.scene.disparity = {-0.5, 0.5};
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    const std::string& option = arguments[i];
    if (i + 1 == arguments.size())
      throw Error(ErrorCode::kInvalidArgument,
                  option + ": unknown option, or its value is missing");
    const std::string& value = arguments[i + 1];
    if (option == "--views")
      job.scene.views_s = number(option, value);
    else if (option == "--rows-of-views")
      job.scene.views_t = number(option, value);
    else if (option == "--width")
      job.scene.width = number(option, value);
    else if (option == "--height")
      job.scene.height = number(option, value);
    else if (option == "--hypotheses")
      job.options.hypotheses = number(option, value);
    else if (option == "--preset") {
      const int hypotheses = job.options.hypotheses;
      job.options = preset_options(value);
      if (value == "paper") job.options.hypotheses = hypotheses;
    } else
      throw Error(ErrorCode::kInvalidArgument,
                  option +
                      ": unknown option; there are --views --rows-of-views --width --height "
                      "--hypotheses --preset, and those of Google Benchmark");
  }
  job.scene.check();
  job.options.check();
  return job;
}

}  // namespace
}  // namespace gigaray::benchmarks

int main(int argc, char** argv) {
  using namespace gigaray::benchmarks;
  return run_program(argc, argv, [](const std::vector<std::string>& arguments) {
    const Job job = parse(arguments);
    const auto garden = std::make_shared<Garden>(job);
    const gigaray::SyntheticOptions& scene = job.scene;
    const std::string name = scene.scene + "/" + job.options.preset + "/" +
                             std::to_string(scene.views_s * scene.views_t) + "x" +
                             std::to_string(scene.width) + "x" + std::to_string(scene.height) +
                             "/" + std::to_string(job.options.hypotheses);
    declare(name + "/centre", garden, false);
    declare(name + "/all_views", garden, true);
  });
}
