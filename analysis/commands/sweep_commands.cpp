// SPDX-License-Identifier: BSD-3-Clause
// limen analyse switch-distances: what sweeps found.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/commands/commands.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/switch_distances.h"
#include "experiments/base/error.h"
#include "experiments/base/staged_folder.h"

namespace limen::analysis {
namespace {

void runSwitchDistances(const SwitchOptions& options, bool json) {
  const std::vector<SwitchReport> reports = findSwitchDistances(options);
  std::optional<StagedFolder> staged;
  if (!options.folder.empty()) staged.emplace(options.folder);
  for (const SwitchReport& report : reports) {
    if (staged) {
      std::filesystem::path folder = staged->path();
      if (reports.size() > 1) folder /= slug(report.title);
      std::filesystem::create_directories(folder);
      writeFileBytes((folder / "switch_distances.json").string(), toJson(report) + "\n");
      writeFileBytes((folder / "switch_distances.csv").string(), toCsv(report));
      drawSwitchChart(report, folder.string());
    }
    std::printf("%s\n", (json ? toJson(report) : toText(report)).c_str());
  }
  if (staged) staged->putInPlace();
}

}  // namespace

void addSweepCommands(CLI::App& app) {
  struct Call {
    SwitchOptions options;
    bool json = false;
  };
  const auto call = std::make_shared<Call>();
  CLI::App* distances = app.add_subcommand(
      "switch-distances", "distance at which each level-of-detail switch of a sweep may happen");
  distances->add_option("STORE", call->options.storePath, "result store that limen-sweep wrote")->required();
  distances->add_option("-p,--probability", call->options.probability, "detection that is allowed")
      ->capture_default_str();
  distances->add_option("--confidence", call->options.confidence, "of the interval over views")
      ->capture_default_str();
  distances->add_option("--experiment", call->options.experiment, "title or hash of one experiment");
  distances->add_option("--distance", call->options.distance, "parameter that is the distance")
      ->capture_default_str();
  distances->add_option("--views", call->options.views, "parameters that make views of the same switch")
      ->delimiter(',')
      ->capture_default_str();
  distances->add_option("--measurement", call->options.measurement, "what falls with distance")
      ->capture_default_str();
  distances->add_option("--seed", call->options.seed, "of the bootstrap")->capture_default_str();
  distances->add_option("-o,--output", call->options.folder, "folder for JSON, CSV and chart");
  distances->add_flag("--force", call->options.force, "go on although runs are missing or failed");
  distances->add_flag("--json", call->json, "print one JSON line for each experiment");
  distances->callback([call] { runSwitchDistances(call->options, call->json); });
}

}  // namespace limen::analysis
