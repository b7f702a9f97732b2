// SPDX-License-Identifier: BSD-3-Clause
// limen study predict: predictions for the stimuli that a store's sessions showed.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/assignments.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/text.h"
#include "perception/popping/settings.h"
#include "study/command/commands.h"
#include "study/stimulus/store_predictions.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct PredictOptions {
  std::string store, protocol, display;
  std::vector<std::string> settings;
  bool asJson = false, quiet = false, clips = false;
};

ParameterValues poppingValues(const std::vector<std::string>& settings) {
  const std::vector<Parameter> declared = perception::PoppingSettings::table().parameters();
  return {declared, readAssignments(settings, declared, "--set"), "--set"};
}

/// Reports progress on standard error: overwriting a line on a terminal, otherwise at every tenth stimulus.
void sayProgress(int done, int all, bool quiet) {
  if (quiet) return;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal && done % 10 != 0 && done != all) return;
  fmt::print(stderr, "{}{} of {} stimuli{}", terminal ? "\r" : "", done, all,
             terminal && done != all ? " " : "\n");
  std::fflush(stderr);
}

void predict(const PredictOptions& options, Run& run) {
  StorePredictionRequest request;
  request.store = options.store;
  request.protocol = options.protocol;
  request.display = options.display;
  request.popping = poppingValues(options.settings);
  request.clips = options.clips;
  request.progress = [&](int done, int all) { sayProgress(done, all, options.quiet); };
  installInterruptHandlers();
  const StorePredictionEnd end = predictStore(request);
  if (options.asJson)
    fmt::print(
        "{}\n",
        json({{"store", options.store}, {"made", end.made}, {"known", end.known}, {"stopped", end.stopped}})
            .dump());
  else
    fmt::print("{}: {} predictions made, {} there before\n", options.store, end.made, end.known);
  if (end.stopped) {
    fmt::print(stderr, "stopped; the same command resumes\n");
    run.exitCode = kExitFailedRuns;
  }
}

}  // namespace

void addPredictCommand(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand(
      "predict",
      "Predicts the visibility of the changes shown in the sessions of a store, by popping predictor and "
      "image\nmetrics on exactly those frames, and stores it for `limen analyse validate`. Resumes with "
      "what is missing.");
  auto options = std::make_shared<PredictOptions>();
  command->add_option("store", options->store, "Result store with sessions")->required();
  command->add_option("--protocol", options->protocol, "Only sessions of this protocol (name or SHA-256)");
  command->add_option("--display", options->display,
                      "Preset or profile to use instead of the one that a session was shown on");
  command->add_option("--set", options->settings, "Parameter of the predictor (limen perceive pop --list)")
      ->type_name("NAME=VALUE");
  command->add_flag("--clips", options->clips,
                    "Also ColorVideoVDP of the clips around the changes, with the clip without the change as "
                    "reference");
  command->add_flag("--json", options->asJson, "One JSON object");
  command->add_flag("--quiet", options->quiet, "No progress");
  command->callback([options, &run] { predict(*options, run); });
}

}  // namespace limen::study
