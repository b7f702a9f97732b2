// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/observer_kind.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "experiments/base/assignments.h"
#include "experiments/base/error.h"
#include "experiments/base/registry.h"
#include "perception/popping/settings.h"

namespace limen::study {
namespace {

struct IdealSettings {
  static const SettingsTable<IdealSettings>& table() {
    static const SettingsTable<IdealSettings> kTable = {};
    return kTable;
  }
};

const RegisteredObserver<IdealSettings> kIdeal{
    {"ideal", 1, "the simulation block's probabilities without lapses"}, [](const IdealSettings&) {
      ObserverBehaviour out;
      out.lapses = false;
      return out;
    }};

struct ProtocolRate {
  static constexpr const char *kKind = "protocol", *kSummary = "as in the simulation block";
};
struct OwnRate {
  static constexpr const char *kKind = "own", *kSummary = "the observer's own";
  double value = 0.05;
  static const SettingsTable<OwnRate>& table() {
    static const SettingsTable<OwnRate> kTable = {{&OwnRate::value, "value", {0.0, 0.9}, "", "the rate"}};
    return kTable;
  }
};
using Rate = std::variant<ProtocolRate, OwnRate>;

std::optional<double> valueOf(const Rate& rate) {
  const auto* own = std::get_if<OwnRate>(&rate);
  return own ? std::optional(own->value) : std::nullopt;
}

struct LapsingSettings {
  Rate lapse, guess;
  static const SettingsTable<LapsingSettings>& table() {
    static const SettingsTable<LapsingSettings> kTable = {
        {&LapsingSettings::lapse, "lapse", "share of changes missed however strong"},
        {&LapsingSettings::guess, "guess", "rate of \"yes\" without a change"}};
    return kTable;
  }
  void check() const {
    if (valueOf(lapse).value_or(0.0) + valueOf(guess).value_or(0.0) >= 1.0)
      throw Error("guess and lapse rates sum to 1 or more", "guess", "give smaller ones");
  }
};

const RegisteredObserver<LapsingSettings> kLapsing{
    {"lapsing", 1, "the simulation block's probabilities, with its guess and lapse rates or others"},
    [](const LapsingSettings& settings) {
      ObserverBehaviour out;
      out.lapse = valueOf(settings.lapse);
      out.guess = valueOf(settings.guess);
      return out;
    }};

struct BiasedSettings {
  double criterionShift = 0.5, firstBias = 0.5;
  static const SettingsTable<BiasedSettings>& table() {
    static const SettingsTable<BiasedSettings> kTable = {
        {&BiasedSettings::criterionShift,
         "criterion_shift",
         {-10.0, 10.0},
         "SD of the noise",
         "yes/no and rating: positive says \"yes\" less often",
         "Macmillan and Creelman 2005, chapter 2"},
        {&BiasedSettings::firstBias,
         "first_bias",
         {-10.0, 10.0},
         "SD of the noise",
         "alternatives, intervals and pairs: preference for the first or left one",
         "Macmillan and Creelman 2005, chapter 7"}};
    return kTable;
  }
};

const RegisteredObserver<BiasedSettings> kBiased{
    {"biased", 1, "a biased criterion, or a preference for the first of several alternatives"},
    [](const BiasedSettings& settings) {
      ObserverBehaviour out;
      out.criterionShift = settings.criterionShift;
      out.firstBias = settings.firstBias;
      return out;
    }};

struct DriftingSettings {
  double strengthPerHundred = -0.5, lapsePerHundred = 0.02;
  static const SettingsTable<DriftingSettings>& table() {
    static const SettingsTable<DriftingSettings> kTable = {
        {&DriftingSettings::strengthPerHundred,
         "strength_per_100",
         {-100.0, 100.0},
         "",
         "added to the sigmoid's argument over 100 trials; negative: fatigue, positive: learning"},
        {&DriftingSettings::lapsePerHundred,
         "lapse_per_100",
         {-1.0, 1.0},
         "",
         "added to the lapse rate over 100 trials"}};
    return kTable;
  }
};

const RegisteredObserver<DriftingSettings> kDrifting{
    {"drifting", 1, "gets worse or better from trial to trial"}, [](const DriftingSettings& settings) {
      ObserverBehaviour out;
      out.strengthPerHundred = settings.strengthPerHundred;
      out.lapsePerHundred = settings.lapsePerHundred;
      return out;
    }};

struct ModelSettings {
  perception::DetectionModel detection;
  perception::PoppingSettings popping;
  double strengthSd = 0.0, valuePerRating = -1.0;
  static const SettingsTable<ModelSettings>& table() {
    static const SettingsTable<ModelSettings> kTable = {
        {&ModelSettings::detection, "detection", "probability that a region of rating R is reported"},
        {&ModelSettings::popping, "popping", "the predictor; its own detection is not used"},
        {&ModelSettings::strengthSd,
         "strength_sd",
         {0.0, 100.0},
         "",
         "SD over observers of the detection function's argument (R - midpoint) / scale"},
        {&ModelSettings::valuePerRating,
         "value_per_rating",
         {-100.0, 100.0},
         "",
         "pairwise: scale value of one step of rating; negative: less popping is better"}};
    return kTable;
  }
};

const RegisteredObserver<ModelSettings> kModel{
    {"model", 2, "the popping predictor on the frames of every stimulus"}, [](const ModelSettings& settings) {
      ObserverBehaviour out;
      out.fromModel = true;
      out.detection = settings.detection;
      out.popping = perception::PoppingSettings::table().write(settings.popping);
      out.strengthSd = settings.strengthSd;
      out.valuePerRating = settings.valuePerRating;
      return out;
    }};

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
  return chooseObserver(kind, readAssignments(settings, kind.parameters, "--set"), "--set");
}

ObserverChoice chooseObserver(const ObserverKind& kind, const std::map<std::string, ParameterValue>& given,
                              const std::string& where) {
  const ParameterValues values(kind.parameters, given, where);
  return {kind.name, kind.version, values, kind.make(values)};
}

nlohmann::json toJson(const ObserverChoice& choice) {
  return {{"kind", choice.name}, {"version", choice.version}, {"parameters", choice.values.toJson()}};
}

}  // namespace limen::study
