// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/commands.h"
#include "analysis/report.h"
#include "analysis/study_commands.h"
#include "analysis/switch_distances.h"
#include "analysis/text_output.h"
#include "base/build_facts.h"
#include "base/error.h"
#include "base/program.h"

namespace {

using limen::analysis::ReportOptions;
using limen::analysis::ReportResult;

void print(const ReportResult& result, bool json) {
  if (json) {
    const nlohmann::json line = {
        {"event", "report"},         {"page", result.page},
        {"title", result.title},     {"experiment", result.hash},
        {"runs", result.runs},       {"failed", result.failed},
        {"missing", result.missing}, {"broken_expectations", result.brokenExpectations}};
    std::printf("%s\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::printf("%s\n", result.page.c_str());
  }
}

using limen::analysis::SwitchOptions;
using limen::analysis::SwitchReport;

void runSwitchDistances(const SwitchOptions& options, bool json) {
  const std::vector<SwitchReport> reports = limen::analysis::findSwitchDistances(options);
  for (const SwitchReport& report : reports) {
    if (!options.folder.empty()) {
      std::filesystem::path folder = options.folder;
      if (reports.size() > 1) folder /= limen::analysis::slug(report.title);
      std::filesystem::create_directories(folder);
      limen::analysis::writeFileBytes((folder / "switch_distances.json").string(), toJson(report) + "\n");
      limen::analysis::writeFileBytes((folder / "switch_distances.csv").string(), toCsv(report));
      limen::analysis::drawSwitchChart(report, folder.string());
    }
    std::printf("%s\n", (json ? toJson(report) : toText(report)).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Says what sweeps and studies found. Needs no GPU.", "limen-analyse");
  app.set_version_flag("--version", limen::versionText("limen-analyse"));
  app.require_subcommand(1);

  ReportOptions options;
  bool json = false;
  CLI::App* report = app.add_subcommand("report", "HTML page and CSV tables of a sweep: speed against error");
  report->add_option("STORE", options.storePath, "result store that limen-sweep wrote")->required();
  report->add_option("-o,--output", options.folder, "folder for report.html, CSV tables, charts and pictures")
      ->required();
  report->add_option(
      "--experiment", options.experiment,
      "title or hash (8 digits or more) of one experiment; otherwise all of the store, each in a folder "
      "of its own if there are several");
  report->add_flag("--force", options.force, "report although runs are missing or failed; the page says so");
  report->add_flag("--json", json, "print one JSON line for each page");
  report->callback([&] {
    for (const ReportResult& result : limen::analysis::writeReports(options)) print(result, json);
  });

  SwitchOptions switches;
  CLI::App* distances = app.add_subcommand(
      "switch-distances", "distance at which each level-of-detail switch of a sweep may happen");
  distances->add_option("STORE", switches.storePath, "result store that limen-sweep wrote")->required();
  distances->add_option("-p,--probability", switches.probability, "detection that is allowed")
      ->capture_default_str();
  distances->add_option("--confidence", switches.confidence, "of the interval over views")
      ->capture_default_str();
  distances->add_option("--experiment", switches.experiment, "title or hash of one experiment");
  distances->add_option("--distance", switches.distance, "parameter that is the distance")
      ->capture_default_str();
  distances->add_option("--views", switches.views, "parameters that make views of the same switch")
      ->delimiter(',')
      ->capture_default_str();
  distances->add_option("--measurement", switches.measurement, "what falls with distance")
      ->capture_default_str();
  distances->add_option("--seed", switches.seed, "of the bootstrap")->capture_default_str();
  distances->add_option("-o,--output", switches.folder, "folder for JSON, CSV and chart");
  distances->add_flag("--force", switches.force, "go on although runs are missing or failed");
  distances->add_flag("--json", json, "print one JSON line for each experiment");
  distances->callback([&] { runSwitchDistances(switches, json); });

  limen::analysis::addFitCommand(app);
  limen::analysis::addStudyCommands(app);
  return limen::runProgram(app, argc, argv, limen::kExitSuccess);
}
