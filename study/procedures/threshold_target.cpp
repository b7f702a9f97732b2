// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/threshold_target.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace limen::study {

std::optional<ThresholdTarget> thresholdTarget(const ProcedureSettings& settings, const Estimate& estimate) {
  const nlohmann::json json = toJson(settings);
  if (settings.type == "quest") return ThresholdTarget{false, json.at("threshold_probability").get<double>()};
  if (settings.type == "staircase") {
    for (const ParameterEstimate& parameter : estimate.parameters)
      if (parameter.name == "target_probability") return ThresholdTarget{false, parameter.mean};
    return std::nullopt;
  }
  if (!json.contains("model")) return std::nullopt;
  const std::string model = json["model"].get<std::string>();
  if (model.rfind("weibull", 0) == 0) return ThresholdTarget{true, -std::expm1(-1.0)};
  if (model == "logistic" || model == "normal" || model == "sigmoid") return ThresholdTarget{true, 0.5};
  return std::nullopt;
}

const ParameterEstimate* thresholdOf(const Estimate& estimate) {
  for (const ParameterEstimate& parameter : estimate.parameters)
    if (parameter.name == "threshold" || parameter.name == "mean") return &parameter;
  return nullptr;
}

}  // namespace limen::study
