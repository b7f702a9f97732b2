// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/store_predictions.h"

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <tuple>

#include "experiments/base/build_facts.h"
#include "experiments/base/clock.h"
#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/text.h"
#include "experiments/store/predictions.h"
#include "perception/vision/display_yaml.h"
#include "renderer/gl/context.h"
#include "study/stimulus/frame_difference.h"
#include "study/stimulus/prediction.h"
#include "study/stimulus/stored_window.h"

namespace limen::study {
namespace {

using nlohmann::json;

/// Where stimuli were shown: they look the same only in the same window on the same display.
struct Place {
  std::string displayHash;
  int widthPx = 0, heightPx = 0;
  bool operator<(const Place& other) const {
    return std::tie(displayHash, widthPx, heightPx) <
           std::tie(other.displayHash, other.widthPx, other.heightPx);
  }
};

/// Displays and, by presentation context and hash, the stimuli with a change.
struct Shown {
  std::map<std::string, store::StudyDisplay> displays;
  std::map<Place, std::map<std::string, json>> stimuli;
};

bool hasChange(const json& stimulus) {
  const Stimulus read = stimulusFromJson(stimulus);
  return read.changes && (read.levels || read.after);
}

Shown readShown(const StorePredictionRequest& request) {
  Shown out;
  const store::SessionReader reader(request.store);
  std::optional<store::StudyDisplay> other;
  if (!request.display.empty()) {
    const perception::DisplayProfile display = perception::readDisplay(request.display);
    other = {display.hash(), display.name, toYaml(display), json::object()};
  }
  std::vector<std::string> protocols;
  bool found = false;
  std::map<std::string, bool> changes;  // stimulus -> whether it has one
  for (const store::StudySession& session : reader.sessions()) {
    const store::StudyProtocol protocol = reader.protocol(session.protocol);
    if (std::find(protocols.begin(), protocols.end(), protocol.name) == protocols.end())
      protocols.push_back(protocol.name);
    if (!request.protocol.empty() && request.protocol != protocol.name && request.protocol != protocol.hash)
      continue;
    found = true;
    const store::StudyDisplay display = other ? *other : reader.display(session.display);
    out.displays[display.hash] = display;
    const glm::ivec2 window = windowOf(protocol, request.store);
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
    throw Error("holds no sessions", request.store, "run or simulate a study into it first");
  if (!found)
    throw Error("no session of a protocol '" + request.protocol + "'", request.store,
                suggest(request.protocol, protocols));
  return out;
}

json figuresOf(const PredictedPopping& popping, const FrameDifference& difference) {
  json out = toJson(popping);
  out["region_count"] = popping.regions.size();
  out.update(toJson(difference));
  return out;
}

StorePredictionEnd predictAll(const Shown& shown, const StorePredictionRequest& request) {
  StorePredictionEnd end;
  store::PredictionLog log(request.store);
  PredictionCache cache(request.cacheFile);
  std::unique_ptr<gl::Context> context;
  int done = 0, all = 0;
  for (const auto& [place, stimuli] : shown.stimuli) all += static_cast<int>(stimuli.size());
  for (const auto& [place, stimuli] : shown.stimuli) {
    const store::StudyDisplay& stored = shown.displays.at(place.displayHash);
    const perception::DisplayProfile display = perception::displayFromYaml(stored.profile, stored.name);
    if (!context) context = gl::createHeadlessContext();
    const glm::ivec2 windowPx(place.widthPx, place.heightPx);
    FrameComparer comparer(*context, windowPx, display);
    Predictor predictor(*context, windowPx, display, request.popping, &cache);
    store::StudyPrediction row;
    row.displayHash = place.displayHash;
    row.widthPx = place.widthPx;
    row.heightPx = place.heightPx;
    row.predictor = "popping";
    row.settings = {{"popping", request.popping.toJson()},
                    {"popping_version", PredictedPopping::kVersion},
                    {"metrics", FrameComparer::settings(request.clips)}};
    row.programVersion = projectVersion() + " (commit " + buildCommit() + ")";
    for (const auto& [hash, stimulusJson] : stimuli) {
      if (interruptSignal() != 0) {
        end.stopped = true;
        return end;
      }
      row.stimulusHash = hash;
      if (log.has(row)) {
        ++end.known;
      } else {
        const Stimulus stimulus = stimulusFromJson(stimulusJson);
        row.figures = figuresOf(predictor.predict(stimulus), comparer.compare(stimulus, request.clips));
        row.created = utcNow();
        end.made += log.add(row, stored) ? 1 : 0;
      }
      ++done;
      if (request.progress) request.progress(done, all);
    }
  }
  return end;
}

}  // namespace

StorePredictionEnd predictStore(const StorePredictionRequest& request) {
  const Shown shown = readShown(request);
  if (std::all_of(shown.stimuli.begin(), shown.stimuli.end(),
                  [](const auto& place) { return place.second.empty(); }))
    throw Error("no stimulus shown has a change", request.store,
                "predictions are for changes of level of detail or technique within a sequence");
  return predictAll(shown, request);
}

}  // namespace limen::study
