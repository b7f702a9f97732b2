// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "perception/psychometrics/grid.h"

namespace limen::study {

class SettingsReader;

/// Declaration of a psychometric model's parameter.
struct ModelParameter {
  std::string name, description;
  std::optional<double> otherwise;  ///< value if the settings give none; if missing, they must
  double minimum, maximum;
  bool open = false;        ///< the limits themselves are not allowed
  bool ofStimulus = false;  ///< has the stimulus's unit
};

/// Probabilities of the outcomes of a trial, given stimulus and parameters.
class Model {
 public:
  virtual ~Model() = default;
  virtual int outcomes() const = 0;
  virtual const std::vector<ModelParameter>& parameters() const = 0;
  /// Names of the stimulus dimensions in the order that logProbabilities() takes them; empty: one, of any
  /// name.
  virtual std::vector<std::string> stimulusNames() const { return {}; }
  /// ln P of outcomes 0, 1, ... into `out`.
  virtual void logProbabilities(const double* stimulus, const double* parameters, double* out) const = 0;
  /// False for a stimulus outside the model's domain.
  virtual bool knows(const double* /*stimulus*/) const { return true; }
  /// The model's own keys, `model` among them.
  virtual void writeKeys(nlohmann::json& out) const = 0;
};

/// Reads `model` (default `otherwise`) and the model's own keys. Throws Error.
std::shared_ptr<const Model> readModel(SettingsReader& reader, const std::string& otherwise);

/// One paragraph per model: formula, parameters with defaults and limits, source.
std::string describeModels();

}  // namespace limen::study
