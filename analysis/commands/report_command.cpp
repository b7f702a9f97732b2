// SPDX-License-Identifier: BSD-3-Clause
// limen analyse report: pages of the sweeps and of the studies in a store.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/commands/sweep_reports.h"
#include "analysis/study_page/study_page.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

struct ReportCall {
  ReportOptions sweeps;
  StudyInput study;
  bool json = false;
};

void print(const StudyPageResult& result, bool json) {
  if (json)
    printLine({{"event", "report"},
               {"page", result.page},
               {"title", result.title},
               {"protocol", result.hash},
               {"observers", result.observers},
               {"sessions", result.sessions},
               {"answers", result.answers},
               {"figures", result.figures},
               {"simulated", result.simulated}});
  else
    std::printf("%s\n", result.page.c_str());
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

void addReportCommand(CLI::App& app) {
  const auto call = std::make_shared<ReportCall>();
  CLI::App* command = app.add_subcommand(
      "report",
      "HTML page, figures and CSV tables of a sweep (speed against error) or a study (as for a paper)");
  addSweepReportOptions(*command, call->sweeps);
  addStudyChoice(*command, call->study);
  command->add_flag("--json", call->json, "print one JSON line for each page");
  command->callback([call, command] {
    call->study.choice.store = call->sweeps.storePath;
    report(*command, *call);
  });
}

}  // namespace limen::analysis
