// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/observer_kind.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/problems.h"
#include "experiments/base/registry.h"
#include "experiments/base/text.h"
#include "experiments/base/value_reader.h"
#include "experiments/base/yaml_tree.h"

namespace limen::study {
namespace {

ObserverBehaviour makeLapsing(const ParameterValues& values) {
  ObserverBehaviour out;
  if (values.real("lapse") >= 0.0) out.lapse = values.real("lapse");
  if (values.real("guess") >= 0.0) out.guess = values.real("guess");
  return out;
}

std::vector<Parameter> lapsingParameters() {
  return {realParameter("lapse", -1.0, -1.0, 0.9, "",
                        "share of changes missed however strong; negative: as the simulation block says"),
          realParameter("guess", -1.0, -1.0, 0.9, "",
                        "rate of \"yes\" without a change; negative: as the simulation block says")};
}

std::vector<Parameter> modelParameters() {
  std::vector<Parameter> out = perception::detectionParameters();
  out.push_back(
      realParameter("strength_sd", 0.0, 0.0, 100.0, "",
                    "SD over observers of the detection function's argument (R - midpoint) / scale"));
  out.push_back(
      realParameter("value_per_rating", -1.0, -100.0, 100.0, "",
                    "pairwise: scale value of one step of rating; negative: less popping is better"));
  return out;
}

ObserverBehaviour makeModel(const ParameterValues& values) {
  ObserverBehaviour out;
  out.fromModel = true;
  out.detection.guessRate = values.real("guess_rate");
  out.detection.lapseRate = values.real("lapse_rate");
  out.detection.midpointR = values.real("rating_midpoint");
  out.detection.scaleR = values.real("rating_scale_r");
  out.strengthSd = values.real("strength_sd");
  out.valuePerRating = values.real("value_per_rating");
  return out;
}

const Registered<ObserverKind> kIdeal{
    {"ideal", 1, "the simulation block's probabilities without lapses", {}, [](const ParameterValues&) {
       ObserverBehaviour out;
       out.lapses = false;
       return out;
     }}};

const Registered<ObserverKind> kLapsing{
    {"lapsing", 1, "the simulation block's probabilities with its guesses and lapses, or others",
     lapsingParameters(), makeLapsing}};

const Registered<ObserverKind> kBiased{
    {"biased",
     1,
     "a criterion that is off, or a liking for the first of several alternatives",
     {realParameter("criterion_shift", 0.5, -10.0, 10.0, "SD of the noise",
                    "yes/no and rating: positive says \"yes\" less often",
                    "Macmillan and Creelman 2005, chapter 2"),
      realParameter("first_bias", 0.5, -10.0, 10.0, "SD of the noise",
                    "alternatives, intervals and pairs: preference for the first or left one",
                    "Macmillan and Creelman 2005, chapter 7")},
     [](const ParameterValues& values) {
       ObserverBehaviour out;
       out.criterionShift = values.real("criterion_shift");
       out.firstBias = values.real("first_bias");
       return out;
     }}};

const Registered<ObserverKind> kDrifting{
    {"drifting",
     1,
     "gets worse, or better, from trial to trial",
     {realParameter("strength_per_100", -0.5, -100.0, 100.0, "",
                    "added to the sigmoid's argument over 100 trials; negative: fatigue, positive: learning"),
      realParameter("lapse_per_100", 0.02, -1.0, 1.0, "", "added to the lapse rate over 100 trials")},
     [](const ParameterValues& values) {
       ObserverBehaviour out;
       out.strengthPerHundred = values.real("strength_per_100");
       out.lapsePerHundred = values.real("lapse_per_100");
       return out;
     }}};

const Registered<ObserverKind> kModel{
    {"model", 1, "the popping predictor on the frames of every stimulus", modelParameters(), makeModel}};

}  // namespace

std::vector<const ObserverKind*> observerKinds() {
  std::vector<const ObserverKind*> out;
  for (const auto& [name, kind] : Registry<ObserverKind>::instance().all()) out.push_back(&kind);
  return out;
}

const ObserverKind& observerKind(const std::string& name, const std::string& where) {
  return Registry<ObserverKind>::instance().get(name, where);
}

ObserverChoice chooseObserver(const std::string& name, const std::vector<std::string>& settings) {
  const ObserverKind& kind = observerKind(name, "--kind");
  std::vector<std::string> known;
  for (const Parameter& parameter : kind.parameters) known.push_back(parameter.name);
  std::map<std::string, ParameterValue> given;
  for (const std::string& setting : settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error("'" + setting + "' is no setting", "--set", "write --set NAME=VALUE");
    const std::string key = setting.substr(0, equals);
    const auto parameter = std::find(known.begin(), known.end(), key);
    if (parameter == known.end())
      throw Error("observer '" + name + "' has no parameter '" + key + "'", "--set",
                  known.empty() ? "it has none" : suggest(key, known));
    if (given.count(key)) throw Error("'" + key + "' is set twice", "--set");
    Problems problems("--set " + setting);
    FileFinder files("");
    const YamlNode node = parseYaml(setting.substr(equals + 1), problems.file());
    const auto value = ValueReader(problems, files)
                           .value(node, kind.parameters[static_cast<size_t>(parameter - known.begin())]);
    problems.throwIfAny();
    if (value) given[key] = *value;
  }
  ObserverChoice out{kind.name, kind.version, ParameterValues(kind.parameters, given, "--set"), {}};
  out.behaviour = kind.make(out.values);
  if (out.behaviour.guess.value_or(0.0) + out.behaviour.lapse.value_or(0.0) >= 1.0)
    throw Error("guess and lapse rates sum to 1 or more", "--set");
  return out;
}

nlohmann::json toJson(const ObserverChoice& choice) {
  return {{"kind", choice.name}, {"version", choice.version}, {"parameters", choice.values.toJson()}};
}

}  // namespace limen::study
