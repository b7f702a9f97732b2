// SPDX-License-Identifier: BSD-3-Clause
// limen study simulate: whole sessions of simulated observers, into the same kind of store as for people.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/catalogue.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/text.h"
#include "renderer/catalogue.h"
#include "study/command/commands.h"
#include "study/observers/popping_model.h"
#include "study/observers/simulate.h"
#include "study/observers/summary.h"

namespace limen::study {
namespace {

struct SimulateOptions {
  std::string protocol, kind = "lapsing", store, prefix = "S", display, predictions;
  std::vector<std::string> settings;
  uint64_t seed = 1;
  int observers = 200, jobs = 1;
  double invalidRate = 0.0;
  bool list = false, asJson = false, quiet = false;
};

void listKinds(bool asJson) {
  nlohmann::json out = nlohmann::json::array();
  std::string text;
  for (const ObserverKind* kind : observerKinds()) {
    nlohmann::json parameters = nlohmann::json::array();
    text += fmt::format("{}: {}\n", kind->name, kind->summary);
    for (const Parameter& parameter : kind->parameters) parameters.push_back(toJson(parameter));
    for (const DeclaredAt& at : flatten(kind->parameters)) {
      const Parameter& parameter = *at.parameter;
      text += fmt::format("    {:<18} {}\n    {:<18} {}; default {}{}\n", at.path, parameter.description, "",
                          describeRange(parameter), limen::toText(parameter.defaultValue),
                          parameter.source.empty() ? "" : " [" + parameter.source + "]");
    }
    out.push_back({{"name", kind->name},
                   {"version", kind->version},
                   {"summary", kind->summary},
                   {"parameters", parameters}});
  }
  text +=
      "\nWhat an observer sees in a condition comes from the protocol's `simulation:` block; without one, "
      "and for "
      "`model`,\n"
      "from the popping predictor.\n";
  std::fputs(asJson ? (out.dump(2) + "\n").c_str() : text.c_str(), stdout);
}

// A line on standard error that is overwritten at most ten times a second; without a terminal only the last
// one.
class SimulationProgress {
 public:
  SimulationProgress(int observers, bool quiet)
      : observers_(observers), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  bool operator()(int64_t steps, int done) {
    const auto now = std::chrono::steady_clock::now();
    if (!quiet_ && terminal_ && now - last_ > std::chrono::milliseconds(100)) {
      last_ = now;
      written_ = true;
      fmt::print(stderr, "\r{} of {} observers, {} screens and trials ", done, observers_, steps);
      std::fflush(stderr);
    }
    return interruptSignal() != 0;
  }
  void finish() const {
    if (written_) std::fputs("\r\033[K", stderr);
  }

 private:
  int observers_;
  bool quiet_, terminal_, written_ = false;
  std::chrono::steady_clock::time_point last_;
};

void runSimulate(const SimulateOptions& options, Run& run) {
  if (options.list) return listKinds(options.asJson);
  if (options.protocol.empty())
    throw Error("no protocol given", "simulate", "give a name or a file, or --list");
  const ObserverChoice observer = chooseObserver(options.kind, options.settings);
  const Protocol protocol = readProtocol(options.protocol, catalogueFromRegistries());

  SimulationRequest request;
  request.store = options.store.empty() ? "results/" + protocol.name + "_simulated.sqlite" : options.store;
  request.observers = options.observers;
  request.seed = options.seed;
  request.observer = observer;
  request.prefix = options.prefix;
  request.jobs = options.jobs;
  request.invalidRate = options.invalidRate;
  request.display = perception::readDisplay(options.display.empty() ? protocol.display : options.display);

  std::unique_ptr<StimulusModel> model;
  if (observer.behaviour.fromModel || Simulation(protocol).needsModel())
    model = makePoppingModel(
        protocol, request.display, observer.behaviour.popping,
        options.predictions.empty() ? request.store + ".predictions.json" : options.predictions);
  installInterruptHandlers();
  auto progress = std::make_shared<SimulationProgress>(options.observers, options.quiet);
  request.progress = [progress](int64_t steps, int done) { return (*progress)(steps, done); };
  const SimulationEnd end = simulateSessions(protocol, request, model.get());
  progress->finish();
  const SimulationSummary summary = summarise(protocol, request.store, observer.behaviour, options.prefix);

  if (options.asJson) {
    nlohmann::json out = {
        {"store", request.store}, {"protocol", protocol.name}, {"observer", toJson(observer)},
        {"seed", request.seed},   {"new", end.newSessions},    {"resumed", end.resumed},
        {"skipped", end.skipped}, {"stopped", end.stopped},    {"summary", toJson(summary)}};
    fmt::print("{}\n", out.dump(2));
  } else {
    fmt::print("{}: {} new, {} resumed, {} there before\n", request.store, end.newSessions, end.resumed,
               end.skipped);
    std::fputs(toText(summary).c_str(), stdout);
  }
  if (end.stopped) {
    fmt::print(stderr, "stopped; the same command resumes\n");
    run.exitCode = kExitFailedRuns;
  }
}

}  // namespace

void addSimulateCommand(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand(
      "simulate", "Runs sessions of simulated observers; resumes what an earlier call left unfinished");
  auto options = std::make_shared<SimulateOptions>();
  command->add_option("protocol", options->protocol, "Name of a shipped protocol, or a file")
      ->type_name("NAME|FILE");
  command->add_option("--observers", options->observers, "Number of observers")->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of observers, orders and answers")
      ->capture_default_str();
  command->add_option("--kind", options->kind, "Kind of observer; --list names them")->capture_default_str();
  command->add_option("--set", options->settings, "Parameter of the kind")->type_name("NAME=VALUE");
  command->add_option("--store", options->store, "Result store (default: results/NAME_simulated.sqlite)");
  command->add_option("--participant-prefix", options->prefix, "Codes are this prefix and a number from 001")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Threads")->capture_default_str();
  command
      ->add_option("--invalid-rate", options->invalidRate,
                   "Share of presentations that count as disturbed and are repeated")
      ->capture_default_str();
  command->add_option("--display", options->display, "Preset or profile (default: the protocol's)");
  command->add_option("--predictions", options->predictions,
                      "Cache file for the popping predictor's results (default: STORE.predictions.json)");
  command->add_flag("--list", options->list, "List kinds of observer and their parameters");
  command->add_flag("--json", options->asJson, "As JSON");
  command->add_flag("--quiet", options->quiet, "No progress line");
  command->callback([options, &run] { runSimulate(*options, run); });
}

}  // namespace limen::study
