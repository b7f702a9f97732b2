// SPDX-License-Identifier: BSD-3-Clause
// limen-export: what a sweep measured, for other programs.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <map>

#include "analysis/output/text_output.h"
#include "analysis/sweep/exchange.h"
#include "analysis/sweep/report.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/program.h"
#include "experiments/base/replace_file.h"

int main(int argc, char** argv) {
  using namespace limen;
  using namespace limen::analysis;
  const std::map<std::string, std::function<std::string(const Sweep&)>> formats = {
      {"csv", runsCsv}, {"vega", vegaLite}, {"latex", latexTable}};
  CLI::App app(
      "What a sweep measured, for other programs: csv, a row for each run; vega, the chart of the report as "
      "an editable Vega-Lite specification; latex, what the chart shows as a table with units. Programs that "
      "read SQLite find the rows of csv in the store's view 'runs'.",
      "limen-export");
  app.set_version_flag("--version", versionText("limen-export"));
  std::string store, format = "csv", file, experiment;
  bool force = false;
  app.add_option("STORE", store, "result store with a sweep")->required();
  app.add_option("--format", format, "csv (default), vega or latex")
      ->check(CLI::IsMember({"csv", "vega", "latex"}));
  app.add_option("-o,--output", file, "file to write (default: standard output)");
  app.add_option("--experiment", experiment,
                 "title or hash (8 digits or more) of one experiment, where the store has several");
  app.add_flag("--force", force, "export although runs are missing or failed");
  app.callback([&] {
    const store::Store results(store, store::Access::ReadOnly);
    const std::vector<store::Experiment> chosen = chooseExperiments(results, experiment);
    if (chosen.size() > 1) {
      std::string titles;
      for (const store::Experiment& one : chosen)
        titles += (titles.empty() ? "" : ", ") + one.title + " (" + one.hash.substr(0, kShortHash) + ")";
      throw Error("holds several experiments: " + titles, store, "choose one with --experiment");
    }
    const Sweep sweep = loadSweep(results, chosen.front());
    if (!force) requireComplete(sweep, store);
    const std::string text = formats.at(format)(sweep);
    if (file.empty())
      std::fwrite(text.data(), 1, text.size(), stdout);
    else
      replaceFile(file, text);
  });
  const int exitCode = kExitSuccess;
  return runProgram(app, argc, argv, exitCode);
}
