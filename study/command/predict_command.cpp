// SPDX-License-Identifier: BSD-3-Clause
// limen study predict: what predictors say of the stimuli that a store's sessions showed.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/build_facts.h"
#include "base/clock.h"
#include "base/interrupt.h"
#include "base/text.h"
#include "base/value_reader.h"
#include "experiments/store/predictions.h"
#include "perception/popping/settings.h"
#include "perception/vision/display_yaml.h"
#include "renderer/gl/context.h"
#include "study/command/commands.h"
#include "study/protocol/protocol.h"
#include "study/stimulus/frame_difference.h"
#include "study/stimulus/prediction.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct PredictOptions {
  std::string store, protocol, display;
  std::vector<std::string> settings;
  bool asJson = false, quiet = false;
};

/// Where stimuli were shown: they look the same only in the same window of the same display.
struct Place {
  std::string displayHash;
  int widthPx = 0, heightPx = 0;
  bool operator<(const Place& other) const {
    return std::tie(displayHash, widthPx, heightPx) <
           std::tie(other.displayHash, other.widthPx, other.heightPx);
  }
};

/// Displays and, by place and hash, the stimuli with a change.
struct Shown {
  std::map<std::string, store::StudyDisplay> displays;
  std::map<Place, std::map<std::string, json>> stimuli;
};

// The protocol was checked when its session began; only its window is asked for here.
glm::ivec2 windowOf(const store::StudyProtocol& protocol) {
  WindowSetting window;
  const YamlNode root = parseYaml(protocol.text, protocol.path);
  if (const YamlNode* node = root.find("window")) {
    if (const YamlNode* width = node->find("width_px")) window.widthPx = std::stoi(width->text);
    if (const YamlNode* height = node->find("height_px")) window.heightPx = std::stoi(height->text);
  }
  return {window.widthPx, window.heightPx};
}

bool hasChange(const json& stimulus) {
  const Stimulus read = stimulusFromJson(stimulus);
  return read.changes && (read.levels || read.after);
}

Shown readShown(const PredictOptions& options) {
  Shown out;
  const store::SessionReader reader(options.store);
  std::optional<store::StudyDisplay> other;
  if (!options.display.empty()) {
    const perception::DisplayProfile display = perception::readDisplay(options.display);
    other = {display.hash(), display.name, toYaml(display), json::object()};
  }
  std::vector<std::string> protocols;
  bool found = false;
  std::map<std::string, bool> changes;  // stimulus -> whether it has one
  for (const store::StudySession& session : reader.sessions()) {
    const store::StudyProtocol protocol = reader.protocol(session.protocol);
    if (std::find(protocols.begin(), protocols.end(), protocol.name) == protocols.end())
      protocols.push_back(protocol.name);
    if (!options.protocol.empty() && options.protocol != protocol.name && options.protocol != protocol.hash)
      continue;
    found = true;
    const store::StudyDisplay display = other ? *other : reader.display(session.display);
    out.displays[display.hash] = display;
    const glm::ivec2 window = windowOf(protocol);
    auto& stimuli = out.stimuli[{display.hash, window.x, window.y}];
    for (const store::StudyTrial& trial : reader.trials(session.id)) {
      if (trial.practice) continue;
      for (size_t i = 0; i < trial.stimuli.size(); ++i) {
        const std::string& hash = trial.stimulusHashes.at(i);
        const auto [entry, fresh] = changes.try_emplace(hash, false);
        if (fresh) entry->second = hasChange(trial.stimuli[i]);
        if (entry->second) stimuli.emplace(hash, trial.stimuli[i]);
      }
    }
  }
  if (protocols.empty())
    throw Error("holds no sessions", options.store, "run or simulate a study into it first");
  if (!found)
    throw Error("no session of a protocol '" + options.protocol + "'", options.store,
                suggest(options.protocol, protocols));
  return out;
}

ParameterValues poppingValues(const std::vector<std::string>& settings) {
  const std::vector<Parameter>& declared = perception::poppingParameters();
  std::vector<std::string> names;
  for (const Parameter& parameter : declared) names.push_back(parameter.name);
  std::map<std::string, ParameterValue> given;
  for (const std::string& setting : settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error("'" + setting + "' is no setting", "--set", "write --set NAME=VALUE");
    const std::string name = setting.substr(0, equals);
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end())
      throw Error("the predictor has no parameter '" + name + "'", "--set", suggest(name, names));
    if (given.count(name)) throw Error("'" + name + "' is set twice", "--set");
    Problems problems("--set " + setting);
    FileFinder files("");
    const YamlNode node = parseYaml(setting.substr(equals + 1), problems.file());
    const auto value =
        ValueReader(problems, files).value(node, declared[static_cast<size_t>(place - names.begin())]);
    problems.throwIfAny();
    if (value) given[name] = *value;
  }
  return ParameterValues(declared, given, "--set");
}

json figuresOf(const PredictedPopping& popping, const FrameDifference& difference) {
  json out = toJson(popping);
  out["region_count"] = popping.regions.size();
  out.update(toJson(difference));
  return out;
}

struct Counts {
  int made = 0, known = 0;
  bool stopped = false;
};

/// Says on standard error how far it is: over the same line on a terminal, else at every tenth stimulus.
void sayProgress(int done, int all, bool quiet) {
  if (quiet) return;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal && done % 10 != 0 && done != all) return;
  fmt::print(stderr, "{}{} of {} stimuli{}", terminal ? "\r" : "", done, all,
             terminal && done != all ? " " : "\n");
  std::fflush(stderr);
}

Counts predictAll(const Shown& shown, const ParameterValues& popping, const PredictOptions& options) {
  Counts counts;
  store::PredictionLog log(options.store);
  std::unique_ptr<gl::Context> context;
  int done = 0, all = 0;
  for (const auto& [place, stimuli] : shown.stimuli) all += static_cast<int>(stimuli.size());
  for (const auto& [place, stimuli] : shown.stimuli) {
    const store::StudyDisplay& stored = shown.displays.at(place.displayHash);
    const perception::DisplayProfile display = perception::displayFromYaml(stored.profile, stored.name);
    if (!context) context = gl::createHeadlessContext();
    const glm::ivec2 windowPx(place.widthPx, place.heightPx);
    FrameComparer comparer(*context, windowPx, display);
    Predictor predictor(*context, windowPx, display, popping);
    store::StudyPrediction row;
    row.displayHash = place.displayHash;
    row.widthPx = place.widthPx;
    row.heightPx = place.heightPx;
    row.predictor = "popping";
    row.settings = {{"popping", popping.toJson()}, {"metrics", FrameComparer::settings()}};
    row.programVersion = projectVersion() + " (commit " + buildCommit() + ")";
    for (const auto& [hash, stimulusJson] : stimuli) {
      if (interruptSignal() != 0) {
        counts.stopped = true;
        return counts;
      }
      row.stimulusHash = hash;
      if (log.has(row)) {
        ++counts.known;
      } else {
        const Stimulus stimulus = stimulusFromJson(stimulusJson);
        row.figures = figuresOf(predictor.predict(stimulus), comparer.compare(stimulus));
        row.created = utcNow();
        counts.made += log.add(row, stored) ? 1 : 0;
      }
      sayProgress(++done, all, options.quiet);
    }
  }
  return counts;
}

void predict(const PredictOptions& options, Run& run) {
  const ParameterValues popping = poppingValues(options.settings);
  const Shown shown = readShown(options);
  installInterruptHandlers();
  if (std::all_of(shown.stimuli.begin(), shown.stimuli.end(),
                  [](const auto& place) { return place.second.empty(); }))
    throw Error("no stimulus that was shown has a change", options.store,
                "predictions are of changes of level of detail or technique within a sequence");
  const Counts counts = predictAll(shown, popping, options);
  if (options.asJson)
    fmt::print("{}\n", json({{"store", options.store},
                             {"made", counts.made},
                             {"known", counts.known},
                             {"stopped", counts.stopped}})
                           .dump());
  else
    fmt::print("{}: {} predictions made, {} there before\n", options.store, counts.made, counts.known);
  if (counts.stopped) {
    fmt::print(stderr, "stopped; the same call goes on\n");
    run.exitCode = kExitFailedRuns;
  }
}

}  // namespace

void addPredictCommand(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand(
      "predict",
      "Predicts how visible the changes are that the sessions of a store showed, by popping predictor and "
      "image\nmetrics on the very frames, and keeps it in the store for `limen analyse validate`. Goes on "
      "with "
      "what is missing.");
  auto options = std::make_shared<PredictOptions>();
  command->add_option("store", options->store, "Result store with sessions")->required();
  command->add_option("--protocol", options->protocol, "Only sessions of this protocol (name or SHA-256)");
  command->add_option("--display", options->display,
                      "Preset or profile in place of the one that a session was shown on");
  command->add_option("--set", options->settings, "Parameter of the predictor (limen perceive pop --list)")
      ->type_name("NAME=VALUE");
  command->add_flag("--json", options->asJson, "One JSON object");
  command->add_flag("--quiet", options->quiet, "No progress");
  command->callback([options, &run] { predict(*options, run); });
}

}  // namespace limen::study
