// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "perception/psychometrics/grid.h"
#include "study/procedures/model.h"
#include "study/procedures/procedure.h"

namespace limen::study {

/// Model, grids and prior of a Bayesian procedure, checked: every parameter value is valid for the model.
struct ModelSettings {
  std::shared_ptr<const Model> model;
  std::vector<psychometrics::GridAxis> stimulus;    ///< in the declared order
  std::vector<size_t> modelOrder;                   ///< [model's dimension] = index in `stimulus`
  std::vector<psychometrics::GridAxis> parameters;  ///< in the model's order
  std::vector<std::vector<double>> priors;
  std::vector<nlohmann::json> priorSources;  ///< as given, so that they read back bit for bit
  std::vector<bool> nuisance;                ///< marginalised before stimuli are compared

  /// ln P of all outcomes for a stimulus in the declared order.
  void logProbabilities(const std::vector<double>& stimulus, const double* parameters, double* out) const;
  bool knows(const std::vector<double>& stimulus) const;
};

/// Reads `model` and its keys, `stimulus`, `parameters` and `nuisance`.
ModelSettings readModelSettings(SettingsReader& reader, const std::string& defaultModel);
void writeModelSettings(const ModelSettings& settings, nlohmann::json& out);

/// Dimensions of a next() that takes its values from these axes.
std::vector<StimulusDimension> dimensionsOf(const std::vector<psychometrics::GridAxis>& axes);

}  // namespace limen::study
