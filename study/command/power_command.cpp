// SPDX-License-Identifier: BSD-3-Clause
// limen study power: how many observers and repetitions a desired precision takes, by simulation.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/catalogue.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/text.h"
#include "renderer/catalogue.h"
#include "study/command/commands.h"
#include "study/observers/popping_model.h"
#include "study/observers/power.h"
#include "study/observers/summary.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct PowerOptions {
  std::string protocol, kind = "lapsing", display, predictions;
  std::vector<std::string> settings;
  PowerRequest request;
  double thresholdWidth = 0.0;
  bool asJson = false, asCsv = false, allConditions = false;
};

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json toJson(const PowerCell& cell) {
  return {{"part", cell.part},
          {"condition", cell.condition},
          {"measure", cell.threshold ? "threshold" : "rate"},
          {"unit", cell.unit},
          {"mean", finite(cell.mean)},
          {"sd_between_observers", finite(cell.sdBetween)},
          {"mean_width", finite(cell.meanWidth)},
          {"mean_width_error", finite(cell.meanWidthError)},
          {"reached", cell.reached},
          {"reached_error", cell.reachedError},
          {"degenerate", cell.degenerate}};
}

json designJson(const PowerDesign& design) {
  return {{"observers", design.observers}, {"repetitions", design.repetitions}};
}

void printJson(const PowerOptions& options, const Protocol& protocol, const PowerResult& result) {
  const PowerRequest& request = options.request;
  json out = {{"protocol", protocol.name},
              {"protocol_sha256", protocol.hash},
              {"observer", toJson(chooseObserver(options.kind, options.settings))},
              {"confidence", request.confidence},
              {"width", request.width},
              {"probability", request.probability},
              {"simulations", request.simulations},
              {"seed", request.seed},
              {"designs", json::array()}};
  out["threshold_width"] = request.thresholdWidth ? json(*request.thresholdWidth) : json(nullptr);
  for (const PowerDesign& design : result.designs) {
    json entry = designJson(design);
    entry["conditions"] = json::array();
    for (const PowerCell& cell : design.cells) entry["conditions"].push_back(toJson(cell));
    entry["reaches"] = design.judged ? json(design.reaches) : json(nullptr);
    entry["clear_of_simulation_error"] = design.judged ? json(design.clear) : json(nullptr);
    if (design.judged) entry["worst"] = design.worst;
    out["designs"].push_back(entry);
  }
  const auto choice = [&](const std::optional<size_t>& index) {
    return index ? designJson(result.designs[*index]) : json(nullptr);
  };
  out["fewest_observers"] = choice(result.fewestObservers);
  out["fewest_trials"] = choice(result.fewestTrials);
  fmt::print("{}\n", out.dump(2));
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void printCsv(const PowerResult& result) {
  fmt::print(
      "observers,repetitions,part,condition,measure,unit,mean,sd_between_observers,mean_width,mean_width_"
      "error,reached,"
      "reached_error,degenerate\n");
  const auto number = [](double value) {
    return std::isfinite(value) ? shortestNumber(value) : std::string("NA");
  };
  for (const PowerDesign& design : result.designs)
    for (const PowerCell& cell : design.cells)
      fmt::print("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", design.observers, design.repetitions,
                 quoted(cell.part), quoted(conditionText("", cell.condition)),
                 cell.threshold ? "threshold" : "rate", quoted(cell.unit), number(cell.mean),
                 number(cell.sdBetween), number(cell.meanWidth), number(cell.meanWidthError),
                 number(cell.reached), number(cell.reachedError), number(cell.degenerate));
}

std::string reachedText(const PowerCell& cell) {
  return fmt::format("{:5.1f} +- {:.1f} %", 100.0 * cell.reached, 100.0 * cell.reachedError);
}

void printDesign(const PowerDesign& design, bool all) {
  fmt::print("{:>9}  {:>11}", design.observers, design.repetitions);
  if (!design.judged) {
    fmt::print("    no target width\n");
  } else {
    const PowerCell& worst = design.cells[design.worst];
    fmt::print("  {:>6.3f} +- {:.3f}  {:>16}  {:<4} {}{}\n", worst.meanWidth, worst.meanWidthError,
               reachedText(worst), design.reaches ? "yes" : "no", conditionText(worst.part, worst.condition),
               design.clear ? "" : "  [within 2 simulation errors of the target probability]");
  }
  for (const PowerCell& cell : design.cells) {
    const bool judged = design.judged && (!cell.threshold || cell.reached > 0.0);
    if (!all && !(cell.threshold && !judged)) continue;
    fmt::print("             {:<52} {} mean {:.4g} {}, SD between observers {:.3g}, width {:.4g} +- {:.2g}",
               conditionText(cell.part, cell.condition), cell.threshold ? "threshold" : "rate", cell.mean,
               cell.unit, cell.sdBetween, cell.meanWidth, cell.meanWidthError);
    if (judged) fmt::print(", reached {}", reachedText(cell));
    fmt::print("\n");
  }
}

void printDesigns(const PowerOptions& options, const PowerResult& result) {
  const PowerRequest& request = options.request;
  fmt::print(
      "{:g} % t intervals over observers, {} simulated experiments, seed {}; +- is one standard error of the "
      "simulation\n",
      100.0 * request.confidence, request.simulations, request.seed);
  fmt::print("target: a width of {:g} or less", request.width);
  if (request.thresholdWidth) fmt::print(" (thresholds: {:g})", *request.thresholdWidth);
  fmt::print(" in each condition with a probability of {:g} %\n\n", 100.0 * request.probability);
  fmt::print("observers  repetitions  mean width        reached           enough?  worst condition\n");
  double degenerate = 0.0;
  for (const PowerDesign& design : result.designs) {
    printDesign(design, options.allConditions);
    for (const PowerCell& cell : design.cells) degenerate = std::max(degenerate, cell.degenerate);
  }
  const auto say = [&](const char* what, const std::optional<size_t>& index) {
    if (!index) return;
    const PowerDesign& design = result.designs[*index];
    fmt::print("{}: {} observers, {} repetitions (reached {})\n", what, design.observers, design.repetitions,
               reachedText(design.cells[design.worst]));
  };
  fmt::print("\n");
  if (result.fewestObservers) {
    say("fewest observers", result.fewestObservers);
    say("fewest trials in all", result.fewestTrials);
  } else {
    fmt::print("none of these designs is enough\n");
  }
  if (degenerate > 0.01)
    fmt::print(
        "note: in some condition and design all observers agreed in {:.0f} % of the experiments; there the "
        "exact binomial\n"
        "interval for as many answers as observers replaces the t interval, whose width would be zero\n",
        100.0 * degenerate);
}

void runPower(const PowerOptions& given, Run& run) {
  PowerOptions options = given;
  if (options.thresholdWidth > 0.0) options.request.thresholdWidth = options.thresholdWidth;
  if (options.asJson && options.asCsv) throw Error("--json and --csv exclude each other", "power");
  const ObserverChoice observer = chooseObserver(options.kind, options.settings);
  const Protocol protocol = readProtocol(options.protocol, catalogueFromRegistries());
  std::unique_ptr<StimulusModel> model;
  if (observer.behaviour.fromModel || Simulation(protocol).needsModel())
    model = makePoppingModel(
        protocol, perception::readDisplay(options.display.empty() ? protocol.display : options.display),
        observer.behaviour.popping, options.predictions);
  installInterruptHandlers();
  const bool terminal = isatty(STDERR_FILENO) != 0;
  int shown = -1;
  const PowerResult result =
      simulatePower(protocol, observer.behaviour, options.request, model.get(), [&](double share) {
        const int percent = static_cast<int>(100.0 * share);
        if (terminal && percent != shown) fmt::print(stderr, "\r{} % ", shown = percent);
        return interruptSignal() != 0;
      });
  if (terminal) std::fputs("\r\033[K", stderr);
  if (result.designs.empty()) {
    run.exitCode = kExitFailedRuns;
    return;
  }
  if (options.asJson)
    printJson(options, protocol, result);
  else if (options.asCsv)
    printCsv(result);
  else
    printDesigns(options, result);
}

}  // namespace

void addPowerCommand(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand(
      "power", "How many observers and repetitions a desired precision takes, by simulation");
  auto options = std::make_shared<PowerOptions>();
  PowerRequest& request = options->request;
  command->add_option("protocol", options->protocol, "Name of a shipped protocol, or a file")
      ->type_name("NAME|FILE")
      ->required();
  command
      ->add_option("--width", request.width, "Target width of the intervals of rates, upper minus lower end")
      ->capture_default_str();
  command->add_option("--threshold-width", options->thresholdWidth, "The same for thresholds, in their unit");
  command->add_option("--observers", request.observers, "Numbers of observers to try")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--repetitions", request.repetitions,
                   "Numbers of repetitions of each condition, or of runs of each procedure, to try")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--confidence", request.confidence, "Confidence level of the intervals")
      ->capture_default_str();
  command
      ->add_option("--probability", request.probability, "Probability with which the width has to be reached")
      ->capture_default_str();
  command->add_option("--simulations", request.simulations, "Simulated experiments")->capture_default_str();
  command->add_option("--seed", request.seed, "Seed of everything")->capture_default_str();
  command->add_option("--kind", options->kind, "Kind of observer; see simulate --list")
      ->capture_default_str();
  command->add_option("--set", options->settings, "Parameter of the kind")->type_name("NAME=VALUE");
  command->add_option("--display", options->display, "Preset or profile (default: the protocol's)");
  command->add_option("--predictions", options->predictions,
                      "Cache file for the popping predictor's results");
  command->add_flag("--conditions", options->allConditions, "Print every condition of every design");
  command->add_flag("--json", options->asJson, "Print everything as JSON");
  command->add_flag("--csv", options->asCsv, "Print every condition of every design as CSV");
  command->callback([options, &run] { runPower(*options, run); });
}

}  // namespace limen::study
