// SPDX-License-Identifier: BSD-3-Clause
// limen analyse switch-distances: what sweeps found.
// limen analyse report: pages of the sweeps and of the studies in a store.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/commands/sweep_reports.h"
#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/study_page.h"
#include "analysis/sweep/switch_distances.h"
#include "experiments/base/error.h"
#include "experiments/base/staged_folder.h"

namespace limen::analysis {

namespace {

void runSwitchDistances(const SwitchOptions& options, bool json, const std::string& csv) {
  const std::vector<SwitchReport> reports = findSwitchDistances(options);
  std::optional<StagedFolder> staged;
  if (!options.folder.empty()) staged.emplace(options.folder);
  std::vector<Section> sections;
  for (const SwitchReport& report : reports) {
    const Result result = resultOf(report);
    if (staged) {
      std::filesystem::path folder = staged->path();
      if (reports.size() > 1) folder /= slug(report.title);
      std::filesystem::create_directories(folder);
      writeFileBytes((folder / "switch_distances.json").string(), jsonLine(result));
      writeFileBytes((folder / "switch_distances.csv").string(), toCsv(result.head.table("curves")));
      drawSwitchChart(report, (folder / "switch_distances.svg").string());
    }
    sections.push_back(result.head);
    sections.back().fact(key(text("experiment_title")), report.title);
    std::fputs((json ? jsonLine(result) : toText(result)).c_str(), stdout);
  }
  if (!csv.empty()) writeFileBytes(csv, toCsv(sections));
  if (staged) staged->putInPlace();
}

struct ReportCall {
  ReportOptions sweeps;
  StudyInput study;
  bool json = false;
};

void print(const StudyPageResult& result, bool json) {
  Section facts;
  facts.fact(text("title"), result.title);
  facts.fact(text("protocol"), result.hash);
  facts.fact(integer("observers"), result.observers);
  facts.fact(integer("sessions"), result.sessions);
  facts.fact(integer("answers"), result.answers);
  facts.fact(integer("figures"), result.figures);
  facts.fact(flag("simulated"), result.simulated);
  printPage(result.page, std::move(facts), json);
}

/// What was asked for by an option, else what the store holds.
void report(const CLI::App& command, ReportCall call) {
  const std::string& path = call.sweeps.storePath;
  const bool experiments = holdsExperiments(path);
  const bool sessions = holdsSessions(path);
  const bool study = choosesSessions(command), sweep = command.count("--experiment") > 0;
  if (!experiments && !sessions && !study && !sweep)
    throw Error("the store holds no experiment and no session", path, "run a sweep or a study into it first");
  const bool writesSweeps = sweep || (experiments && !study);
  const bool writesStudies = study || (sessions && !sweep);
  call.sweeps.ownFolders = writesSweeps && writesStudies;
  // The studies first: these put nothing in place before all is made.
  if (writesStudies) {
    const StudyPageOptions options{choiceOf(call.study), call.sweeps.folder, call.sweeps.ownFolders};
    for (const StudyPageResult& result : writeStudyPages(options)) print(result, call.json);
  }
  if (writesSweeps)
    for (const ReportResult& result : writeReports(call.sweeps)) printReport(result, call.json);
}

}  // namespace

void addSweepCommands(CLI::App& app) {
  struct Call {
    SwitchOptions options;
    bool json = false;
    std::string csv;
  };
  const auto call = std::make_shared<Call>();
  CLI::App* distances = app.add_subcommand(
      "switch-distances", "distance at which each level-of-detail switch of a sweep may happen");
  distances->add_option("STORE", call->options.storePath, "result store that limen sweep wrote")->required();
  addDefaulted(*distances, "-p,--probability", call->options.probability, "detection that is allowed");
  addDefaulted(*distances, "--confidence", call->options.confidence, "of the interval over views");
  distances->add_option("--experiment", call->options.experiment, "title or hash of one experiment");
  addDefaulted(*distances, "--distance", call->options.distance, "parameter that is the distance");
  distances->add_option("--views", call->options.views, "parameters that make views of the same switch")
      ->delimiter(',')
      ->capture_default_str();
  addDefaulted(*distances, "--measurement", call->options.measurement, "what falls with distance");
  addDefaulted(*distances, "--seed", call->options.seed, "of the bootstrap");
  distances->add_option("-o,--output", call->options.folder, "folder for JSON, CSV and chart");
  distances->add_flag("--force", call->options.force, "go on although runs are missing or failed");
  distances->add_flag("--json", call->json, "print one JSON line for each experiment");
  distances->add_option("--csv", call->csv, "Writes all tables of the result to this file")
      ->type_name("FILE");
  distances->callback([call] { runSwitchDistances(call->options, call->json, call->csv); });
}

void addReportCommand(CLI::App& app) {
  const auto call = std::make_shared<ReportCall>();
  CLI::App* command = app.add_subcommand(
      "report",
      "HTML page, figures and CSV tables of a sweep (speed against error) or a study (as for a paper)");
  addSweepReportOptions(*command, call->sweeps);
  addStudyChoice(*command, call->study);
  command->add_flag("--json", call->json, "print one JSON line for each page");
  command->callback([call, command] {
    if (call->sweeps.folder.empty()) call->sweeps.folder = defaultReportFolder(call->sweeps.storePath);
    call->study.choice.store = call->sweeps.storePath;
    report(*command, *call);
  });
}

}  // namespace limen::analysis
