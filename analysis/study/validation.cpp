// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/validation.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

/// Rates are means of quotients: equal ones must stay equal, or ties would be lost to rounding.
double rounded(double value) { return std::round(value * 1e12) / 1e12; }

std::vector<Scenario> scenariosOf(const StudyAnswers& study, size_t part, const ChosenPredictions& chosen,
                                  const std::map<std::string, std::string>& displays) {
  struct Sums {
    Scenario scenario;
    double severity = 0.0;
    int64_t severities = 0;
  };
  std::map<std::pair<std::vector<size_t>, PredictionKey>, Sums> all;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != part || !answer.change) continue;
    const PredictionKey key{answer.stimulusHash, displays.at(answer.displayHash)};
    Sums& sums = all[{levelsOf(study.plan.parts[part], answer.condition), key}];
    Scenario& scenario = sums.scenario;
    scenario.condition = conditionText(study.plan.parts[part], answer.condition);
    scenario.presentation = answer.presentation;
    scenario.stimulusHash = key.first;
    scenario.displayHash = key.second;
    const int64_t yes = answer.outcome == 1 ? 1 : 0;
    scenario.yes += yes;
    ++scenario.trials;
    scenario.observers[answer.observer].yes += yes;
    ++scenario.observers[answer.observer].trials;
    if (yes && answer.severity) sums.severity += *answer.severity, ++sums.severities;
  }
  std::vector<Scenario> out;
  for (auto& [key, sums] : all) {
    sums.scenario.rate = rounded(meanRate(sums.scenario.observers));
    if (sums.severities > 0)
      sums.scenario.meanSeverity = rounded(sums.severity / static_cast<double>(sums.severities));
    sums.scenario.predictors = chosen.values.at(key.second);
    out.push_back(std::move(sums.scenario));
  }
  return out;
}

/// Names of the sets of scenarios: static and dynamic apart and together, if there are both.
std::vector<std::string> setsOf(const std::vector<Scenario>& scenarios) {
  std::set<std::string> kinds;
  for (const Scenario& scenario : scenarios) kinds.insert(scenario.presentation);
  if (kinds.size() < 2) return {"all"};
  return {"static", "dynamic", "both"};
}

bool isIn(const Scenario& scenario, const std::string& set) {
  return set == "all" || set == "both" || set == scenario.presentation;
}

/// Predictors of the scenarios beside what `of` says of their answers; scenarios without one of both are left
/// out.
template <class Of>
void compareWith(std::vector<Agreement>& out, const PartValidation& part, const std::string& protocol,
                 const std::vector<std::string>& predictors, bool severity, Of of) {
  for (const std::string& set : setsOf(part.scenarios))
    for (const std::string& predictor : predictors) {
      std::vector<double> predictions, answers;
      for (const Scenario& scenario : part.scenarios) {
        const auto value = scenario.predictors.find(predictor);
        const std::optional<double> answer = of(scenario);
        if (!isIn(scenario, set) || value == scenario.predictors.end() || !answer) continue;
        predictions.push_back(value->second);
        answers.push_back(*answer);
      }
      if (predictions.size() < 2) continue;
      out.push_back({set, predictor, predictions.size(), kendall(predictions, answers),
                     pearson(predictions, answers),
                     severity ? ClampedPearson{} : clampedPearson(predictions, answers),
                     publishedAgreement(protocol, part.part, set, predictor, severity)});
    }
}

/// Predictors that are compared with each other: one for each kind, and all that others bring.
bool isCompared(const std::string& predictor) {
  for (const PredictorName& own : studyPredictors())
    if (own.name == predictor)
      return predictor == "rating" || predictor == "flip" || predictor == "one_minus_ssim" ||
             predictor == "color_video_vdp" || predictor == "color_video_vdp_clip";
  return true;
}

void compareTrials(PartValidation& out) {
  std::vector<int> outcomes;
  std::map<std::string, std::vector<double>> scores;
  for (const Scenario& scenario : out.scenarios)
    for (int64_t i = 0; i < scenario.trials; ++i) {
      outcomes.push_back(i < scenario.yes ? 1 : 0);
      for (const auto& [name, value] : scenario.predictors) scores[name].push_back(value);
    }
  const auto full = [&](const std::string& name) { return scores[name].size() == outcomes.size(); };
  if (full("detection_probability")) out.calibration = calibrate(scores["detection_probability"], outcomes);
  const auto yes = std::count(outcomes.begin(), outcomes.end(), 1);
  if (yes == 0 || yes == static_cast<std::ptrdiff_t>(outcomes.size())) {
    out.notes.push_back("all trials with a change were answered alike: no area under a curve");
    return;
  }
  for (const std::string& predictor : out.predictors) {
    if (!full(predictor)) continue;
    TrialArea area{predictor, rocArea(scores[predictor], outcomes), {}};
    if (predictor != "rating" && full("rating"))
      area.againstRating = compareRocAreas(scores[predictor], scores["rating"], outcomes);
    out.areas.push_back(std::move(area));
  }
  std::vector<std::string> compared;
  for (const std::string& predictor : out.predictors)
    if (full(predictor) && isCompared(predictor)) compared.push_back(predictor);
  for (size_t i = 0; i < compared.size(); ++i)
    for (size_t k = i + 1; k < compared.size(); ++k)
      out.comparisons.push_back(
          {compared[i], compared[k], compareRocAreas(scores[compared[i]], scores[compared[k]], outcomes)});
}

void fitLinks(PartValidation& out, const ObserverCounts& catches, const ValidationSetting& setting,
              size_t observers) {
  LinkData data;
  data.catches = catches;
  for (const Scenario& scenario : out.scenarios) {
    const auto rating = scenario.predictors.find("rating");
    const auto probability = scenario.predictors.find("detection_probability");
    if (rating == scenario.predictors.end() || probability == scenario.predictors.end()) break;
    data.ratings.push_back(rating->second);
    data.predicted.push_back(probability->second);
    data.answers.push_back(scenario.observers);
  }
  // Without all ratings there is nothing but the catch trials to tell.
  const bool all = data.ratings.size() == out.scenarios.size();
  if (!all) data.ratings.clear();
  out.link = linkReport(
      data, {{setting.guess, setting.lapse}, setting.fitGuess, all ? setting.samples : 0, setting.seed},
      observers);
  if (!all) return;
  if (out.link.catchTrials == 0 && !setting.fitGuess && !setting.guess)
    out.notes.push_back("no catch trials: the link is fitted with a guess rate of 0");
  if (!out.link.refit) out.notes.push_back("the link cannot be fitted: ratings or answers do not vary");
}

}  // namespace

StudyValidation validateStudy(const StudyAnswers& study,
                              const std::vector<store::StudyPrediction>& predictions,
                              const std::map<std::string, std::string>& displayNames,
                              const ValidationSetting& setting) {
  checkScoreBins(setting.bins);
  std::map<std::string, std::string> displays;  // used -> predicted for
  std::set<PredictionKey> wanted;
  StudyValidation out;
  for (const StudyAnswer& answer : study.answers) {
    if (!displays.count(answer.displayHash))
      displays[answer.displayHash] = wantedDisplay(answer.displayHash, displayNames, setting);
    if (answer.change && study.plan.parts[answer.part].asksYesNo())
      wanted.insert({answer.stimulusHash, displays[answer.displayHash]});
  }
  for (size_t part = 0; part < study.plan.parts.size(); ++part)
    if (!study.plan.parts[part].asksYesNo())
      out.notes.push_back("part '" + study.plan.parts[part].name +
                          "' does not ask for yes or no: not compared");
  if (wanted.empty())
    throw Error("no trial with a change asks for yes or no", study.plan.name,
                "name another protocol with --protocol");
  ChosenPredictions chosen;
  if (predictions.empty() && setting.scores) {
    for (const PredictionKey& key : wanted) chosen.values[key];
    out.notes.push_back(
        "the store has no predictions (limen study predict makes them): only the scores are tested");
  } else {
    chosen = choosePredictions(predictions, study.plan, wanted, setting);
    std::erase_if(chosen.values, [&](const auto& one) { return wanted.count(one.first) == 0; });
  }
  std::vector<std::string> predictors;
  for (const PredictorName& predictor : studyPredictors()) predictors.push_back(predictor.name);
  if (setting.scores) {
    const size_t others = addClipScores(*setting.scores, study.plan, chosen.values);
    if (others > 0)
      out.notes.push_back(
          std::to_string(others) +
          " rows of the scores are of clips without a change, or of none in this study: left out");
    out.scoresFile = setting.scores->file;
    out.scoresHash = setting.scores->hash;
    predictors.insert(predictors.end(), setting.scores->names.begin(), setting.scores->names.end());
  }
  out.settingsHash = chosen.settingsHash;
  out.programVersion = chosen.programVersion;
  if (!chosen.settingsHash.empty() && chosen.version < 2)
    out.notes.push_back(
        "predictions of version 1: rated by the highest of all regions, also where a cue asks about one "
        "place "
        "(limen study predict makes those at the cue)");
  std::set<std::string> names;
  for (const auto& [used, predicted] : displays) {
    const auto name = displayNames.find(predicted);
    names.insert(name == displayNames.end() ? predicted.substr(0, 12) : name->second);
  }
  out.displays.assign(names.begin(), names.end());
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    if (!study.plan.parts[part].asksYesNo()) continue;
    PartValidation one;
    one.part = study.plan.parts[part].name;
    one.scenarios = scenariosOf(study, part, chosen, displays);
    if (one.scenarios.empty()) continue;
    ObserverCounts catches;
    for (const StudyAnswer& answer : study.answers)
      if (answer.part == part && !answer.change) {
        ++catches[answer.observer].trials;
        catches[answer.observer].yes += answer.outcome == 1 ? 1 : 0;
      }
    one.predictors = predictors;
    compareWith(one.agreements, one, study.plan.name, predictors, false,
                [](const Scenario& scenario) { return std::optional<double>(scenario.rate); });
    compareWith(one.severity, one, study.plan.name, {"rating_score", "rating_level"}, true,
                [](const Scenario& scenario) { return scenario.meanSeverity; });
    if (!setting.onlyAgreements) {
      compareTrials(one);
      fitLinks(one, catches, setting, study.observers.size());
    }
    out.parts.push_back(std::move(one));
  }
  return out;
}

}  // namespace limen::analysis
