// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// One experiment of the paper: a table as JSON and on stdout, and pictures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "experiments/experiments.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/parallel.h"
#include "gigaray/version.h"

namespace gigaray::experiments {
namespace {

void print(const nlohmann::ordered_json& rows) {
  fmt::print(
      "| {} | views | BadPix 0.07 | 0.03 | MSE × 100 | near jumps | SAD, % of the range | "
      "filled, % | s | MiB |\n|---|---|---|---|---|---|---|---|---|---|\n",
      rows[0]["scene"].get<std::string>());
  for (const auto& row : rows)
    fmt::print(
        "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.0f} |\n",
        row["label"].get<std::string>(), row["views"].get<int>(), row["BadPix0.07"].get<double>(),
        row["BadPix0.03"].get<double>(), row["MSEx100"].get<double>(),
        row["NearJumps"].get<double>(), 100 * row["SAD"].get<double>(), row["filled"].get<double>(),
        row["seconds"].get<double>(), row["memory_mib"].get<double>());
}

int main(int argc, char** argv) {
  CLI::App app("Experiments of Kim et al. 2013, section 5");
  std::string name;
  std::filesystem::path output;
  Setup setup;
  int repeats = 3;
  std::string list;
  std::vector<std::string> names;
  for (const Experiment& experiment : all_experiments()) {
    list += fmt::format("\n  {:<12} {}", experiment.name, experiment.question);
    names.emplace_back(experiment.name);
  }
  app.add_option("EXPERIMENT", name, "One of:" + list)->required()->check(CLI::IsMember(names));
  app.add_option("-o,--output", output, "Folder for results.json and the pictures")->required();
  app.add_option("--input", setup.input,
                 "A scene with truth instead of the synthetic one (figure_4, figure_5, kernels, "
                 "iterations, row_or_grid)");
  app.add_option("--size", setup.size, "Synthetic pictures are so many times 352 x 240")
      ->check(CLI::Range(0.1, 40.0))
      ->capture_default_str();
  app.add_option("--repeats", repeats, "Timed runs; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const auto& all = all_experiments();
  const auto chosen =
      std::ranges::find_if(all, [&](const Experiment& e) { return name == e.name; });
  if (setup.input && !chosen->takes_input)
    throw Error(ErrorCode::kInvalidArgument, name + ": makes its own pictures; leave --input out");

  AtomicFolder folder(output, "gigaray experiment");
  Report report(folder.path(), repeats);
  chosen->run(setup, report);
  const nlohmann::ordered_json root{{"format", "gigaray experiment"},
                                    {"experiment", name},
                                    {"question", chosen->question},
                                    {"program", "gigaray " GIGARAY_VERSION},
                                    {"device", report.device()},
                                    {"threads", num_threads()},
                                    {"repeats", repeats},
                                    {"rows", report.rows()}};
  write_file_atomically(folder.path() / "results.json", root.dump(2) + "\n");
  folder.commit();
  print(report.rows());
  return 0;
}

}  // namespace
}  // namespace gigaray::experiments

int main(int argc, char** argv) {
  try {
    return gigaray::experiments::main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "gigaray_experiments: {}\n", error.what());
    return 1;
  }
}
