// SPDX-License-Identifier: BSD-3-Clause
// limen study example: simulated studies, analysed end to end and compared with published results.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/interrupt.h"
#include "study/command/commands.h"
#include "study/example/run_example.h"

namespace limen::study {
namespace {

struct ExampleOptions {
  std::string name, folder;
  bool list = false, asJson = false, quiet = false;
};

void listExamples(bool asJson) {
  nlohmann::json out = nlohmann::json::array();
  std::string text = "Shipped examples:\n";
  for (const auto& [name, title] : shippedExamples()) {
    out.push_back({{"name", name}, {"title", title}});
    text += fmt::format("  {:<20}  {}\n", name, title);
  }
  text += "limen study example NAME -o FOLDER runs one; use FILE for your own.\n";
  std::fputs(asJson ? (out.dump(2) + "\n").c_str() : text.c_str(), stdout);
}

// On a terminal a line that is overwritten, otherwise one line every ten seconds.
class StepProgress {
 public:
  explicit StepProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~StepProgress() { clear(); }
  StepProgress(const StepProgress&) = delete;
  StepProgress& operator=(const StepProgress&) = delete;

  void step(const std::string& text) {
    clear();
    if (!quiet_) fmt::print(stderr, "{}\n", text);
    last_ = std::chrono::steady_clock::now();
  }
  bool far(const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    if (!quiet_ && now - last_ > std::chrono::milliseconds(terminal_ ? 100 : 10000)) {
      last_ = now;
      written_ = terminal_;
      fmt::print(stderr, "{}  {}{}", terminal_ ? "\r\033[K" : "", text, terminal_ ? "" : "\n");
      std::fflush(stderr);
    }
    return interruptSignal() != 0;
  }

 private:
  void clear() {
    if (written_) std::fputs("\r\033[K", stderr);
    written_ = false;
  }

  bool quiet_, terminal_, written_ = false;
  std::chrono::steady_clock::time_point last_;
};

void runExampleCommand(const ExampleOptions& options, Run& run) {
  if (options.list) return listExamples(options.asJson);
  if (options.name.empty()) throw Error("no example given", "example", "give a name or a file, or --list");
  const Example example = readExample(options.name);
  ExampleRequest request;
  request.folder = options.folder.empty() ? "results/" + example.name : options.folder;
  auto progress = std::make_shared<StepProgress>(options.quiet);
  request.say = [progress](const std::string& text) { progress->step(text); };
  request.progress = [progress](const std::string& text) { return progress->far(text); };
  installInterruptHandlers();
  const ExampleEnd end = runExample(example, request);
  if (end.stopped) {
    fmt::print(stderr, "stopped; the same command resumes\n");
    run.exitCode = kExitFailedRuns;
    return;
  }
  if (options.asJson)
    fmt::print("{}\n", nlohmann::json({{"folder", request.folder},
                                       {"summary", request.folder + "/summary.json"},
                                       {"comparison", request.folder + "/comparison.csv"},
                                       {"notes", end.notes}})
                           .dump());
  else
    fmt::print("{}\nall of it: {}\n", end.summary, request.folder);
}

}  // namespace

void addExampleCommand(CLI::App& app, Run& run) {
  CLI::App* command =
      app.add_subcommand("example",
                         "Simulates studies, predicts and analyses them, and compares the answers with "
                         "published results; resumes\nwhat an earlier call left unfinished");
  auto options = std::make_shared<ExampleOptions>();
  command->add_option("example", options->name, "Name of a shipped example, or a file")
      ->type_name("NAME|FILE");
  command->add_option("-o,--output", options->folder,
                      "Folder for stores, tables, pages and summary (default: results/NAME)");
  command->add_flag("--list", options->list, "List names and titles of the shipped examples");
  command->add_flag("--json", options->asJson, "As JSON");
  command->add_flag("--quiet", options->quiet, "No progress");
  command->callback([options, &run] { runExampleCommand(*options, run); });
}

}  // namespace limen::study
