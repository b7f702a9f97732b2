// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/parameter_list.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"
#include "perception/popping/detection.h"

namespace limen::study {

/// How an observer deviates from the conditions in the protocol's `simulation:` block.
struct ObserverBehaviour {
  bool fromModel = false;              ///< all conditions from the popping predictor
  bool lapses = true;                  ///< false: the lapse rate is 0 regardless of the block
  std::optional<double> guess, lapse;  ///< instead of the block's
  double criterionShift = 0.0;         ///< in SD of the noise
  double firstBias = 0.0;              ///< towards the first or left alternative, in SD of the noise
  double strengthPerHundred = 0.0;     ///< added to the sigmoid's argument over 100 trials
  double lapsePerHundred = 0.0;        ///< added to the lapse rate over 100 trials
  double strengthSd = 0.0;             ///< over observers, in addition to the block's
  perception::DetectionModel detection;
  /// Of perception::PoppingSettings, for the predictor; what is left out takes its default.
  std::map<std::string, ParameterValue> popping;
  double valuePerRating = -1.0;  ///< Pairwise: scale value of a step of rating
};

struct ObserverKind {
  static constexpr const char* kKind = "observer";
  std::string name;
  int version = 1;  ///< raised when the same settings give different answers
  std::string summary;
  ParameterList parameters = {};
  std::function<ObserverBehaviour(const ParameterValues&)> make = {};
};

/// Registers a kind with settings S at program start. `kind` provides the rest; its parameters and make are
/// filled in.
template <class S>
struct RegisteredObserver {
  RegisteredObserver(ObserverKind kind, ObserverBehaviour (*make)(const S&)) {
    kind.parameters = ParameterList([] { return S::table().parameters(); });
    kind.make = [make](const ParameterValues& values) { return make(S::table().read(values)); };
    Registry<ObserverKind>::instance().add(std::move(kind));
  }
};

/// "biased", "drifting", "ideal", "lapsing", "model", in this order.
std::vector<const ObserverKind*> observerKinds();
/// Throws Error with the nearest known name.
const ObserverKind& observerKind(const std::string& name, const std::string& where = {});

/// A kind with all its values.
struct ObserverChoice {
  std::string name;
  int version = 1;
  ParameterValues values;
  ObserverBehaviour behaviour;
};
/// `settings`: texts "NAME=VALUE" (see readAssignments()). Throws Error: unknown kind or name, an invalid
/// value.
ObserverChoice chooseObserver(const std::string& kind, const std::vector<std::string>& settings = {});
/// `given`: values by path. Throws Error.
ObserverChoice chooseObserver(const ObserverKind& kind, const std::map<std::string, ParameterValue>& given,
                              const std::string& where = {});
/// {kind, version, parameters}
nlohmann::json toJson(const ObserverChoice& choice);

}  // namespace limen::study
