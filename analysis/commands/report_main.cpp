// SPDX-License-Identifier: BSD-3-Clause
// limen-report: report pages of sweeps. It links none of the fits and tests, so that a first sweep need not
// wait for them to compile; pages of studies come from `limen analyse report`.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "analysis/commands/sweep_reports.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/program.h"

namespace {

/// The launcher goes on with `limen analyse report` then.
constexpr int kExitHoldsStudy = 3;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "HTML page, figures and CSV tables of the sweeps in a store. If it holds a study, limen analyse report "
      "writes its page; see limen analyse report --help.",
      "limen-report");
  app.set_version_flag("--version", limen::versionText("limen-report"));
  app.allow_extras();
  limen::analysis::ReportOptions options;
  bool json = false, sweepsOnly = false;
  int exitCode = limen::kExitSuccess;
  limen::analysis::addSweepReportOptions(app, options);
  app.add_flag("--json", json, "print one JSON line for each page");
  app.add_flag("--sweeps", sweepsOnly, "leave out studies that the store holds beside sweeps");
  app.callback([&] {
    // Options that are unknown here are those on sessions, or mistakes that limen-analyse explains.
    const bool study = app.remaining_size() > 0 || (!sweepsOnly && options.experiment.empty() &&
                                                    limen::analysis::holdsSessions(options.storePath));
    if (study) {
      // The launcher does so by itself.
      if (limen::calledName("limen-report") == "limen-report")
        std::fprintf(stderr, "limen-report: for studies and their options use limen analyse report\n");
      exitCode = kExitHoldsStudy;
      return;
    }
    if (options.folder.empty()) options.folder = limen::analysis::defaultReportFolder(options.storePath);
    for (const limen::analysis::ReportResult& result : limen::analysis::writeReports(options))
      limen::analysis::printReport(result, json);
  });
  return limen::runProgram(app, argc, argv, exitCode);
}
