// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/predicted.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

std::string wantedDisplay(const std::string& used, const std::map<std::string, std::string>& names,
                          const PredictionChoice& choice) {
  if (choice.display.empty()) return used;
  std::vector<std::string> fitting, known;
  for (const auto& [hash, name] : names) {
    known.push_back(name);
    if (name == choice.display || (choice.display.size() >= 8 && hash.rfind(choice.display, 0) == 0))
      fitting.push_back(hash);
  }
  if (fitting.empty())
    throw Error("no display '" + choice.display + "' in the store", "--display",
                suggest(choice.display, known));
  if (fitting.size() > 1)
    throw Error("several displays are named '" + choice.display + "'", "--display",
                "give the first digits of a SHA-256: " + join(fitting));
  return fitting.front();
}

ChosenPredictions choosePredictions(const std::vector<store::StudyPrediction>& predictions,
                                    const StudyPlan& plan, const std::set<PredictionKey>& wanted,
                                    const PredictionChoice& choice) {
  ChosenPredictions out;
  std::set<std::string> settings;
  for (auto one = predictions.rbegin(); one != predictions.rend() && out.settingsHash.empty(); ++one) {
    const std::string hash = store::settingsHash(one->settings);
    settings.insert(hash.substr(0, 12));
    if (!wanted.count({one->stimulusHash, one->displayHash})) continue;
    if (!choice.settings.empty() && hash.rfind(choice.settings, 0) != 0) continue;
    out.settingsHash = hash;
    out.programVersion = one->programVersion;
  }
  if (!choice.settings.empty() && out.settingsHash.empty())
    throw Error("no prediction with settings '" + choice.settings + "'", "--settings",
                "known: " + join({settings.begin(), settings.end()}));
  for (const store::StudyPrediction& one : predictions)
    if (one.programVersion == out.programVersion && one.widthPx == plan.widthPx &&
        one.heightPx == plan.heightPx && store::settingsHash(one.settings) == out.settingsHash)
      out.values[{one.stimulusHash, one.displayHash}] = predictorValues(one.figures, choice.bins);
  const auto missing = std::count_if(wanted.begin(), wanted.end(),
                                     [&](const PredictionKey& key) { return out.values.count(key) == 0; });
  if (missing > 0)
    throw Error(fmt::format("{} of {} stimuli have no prediction", missing, wanted.size()), plan.name,
                "make them with limen study predict, for the display that is asked for");
  return out;
}

}  // namespace limen::analysis
