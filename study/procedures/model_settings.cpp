// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/model_settings.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/psychometrics/grid_posterior.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;
using psychometrics::GridAxis;

void checkValues(const ModelParameter& declared, const GridAxis& axis, const std::string& where) {
  for (double value : axis.values) {
    const bool inside = declared.open ? value > declared.minimum && value < declared.maximum
                                      : value >= declared.minimum && value <= declared.maximum;
    if (inside) continue;
    const std::string between = shortestNumber(declared.minimum) + " to " + shortestNumber(declared.maximum);
    throw Error(shortestNumber(value) + " is not a value of '" + declared.name + "'", where,
                "give values from " + between + (declared.open ? ", excluding the ends" : ""));
  }
}

// Reads one parameter: an axis as for psychometrics::readAxis, with `prior` if it is an object.
void readParameter(const ModelParameter& declared, SettingsReader& reader, ModelSettings& out) {
  json source;
  if (reader.has(declared.name)) {
    source = reader.required(declared.name, "");
  } else if (declared.otherwise) {
    source = *declared.otherwise;
  } else {
    reader.required(declared.name, "a number, a list or a range: " + declared.description);
  }
  const std::string where = reader.at(declared.name);
  json prior = "uniform";
  if (source.is_object() && source.contains("prior")) {
    prior = source["prior"];
    source.erase("prior");
  }
  GridAxis axis = psychometrics::readAxis(source, declared.name, where);
  checkValues(declared, axis, where);
  if (axis.unit.empty() && declared.ofStimulus && out.stimulus.size() == 1) axis.unit = out.stimulus[0].unit;
  out.priors.push_back(psychometrics::readPrior(prior, axis, where + ".prior"));
  out.priorSources.push_back(std::move(prior));
  out.parameters.push_back(std::move(axis));
}

void readStimulus(SettingsReader& reader, ModelSettings& out) {
  const std::vector<std::string> names = out.model->stimulusNames();
  out.stimulus =
      readStimulusAxes(reader.required("stimulus", "the values that may be shown"), reader.at("stimulus"));
  const size_t expected = names.empty() ? 1 : names.size();
  if (out.stimulus.size() != expected) {
    throw Error("the stimulus has " + std::to_string(out.stimulus.size()) + " dimensions",
                reader.at("stimulus"),
                "the model has " +
                    (names.empty() ? std::string("one") : std::to_string(expected) + ": " + join(names)));
  }
  if (names.empty()) out.modelOrder = {0};
  for (const std::string& name : names) {
    const auto found = std::find_if(out.stimulus.begin(), out.stimulus.end(),
                                    [&](const GridAxis& axis) { return axis.name == name; });
    if (found == out.stimulus.end()) {
      throw Error("there is no dimension '" + name + "'", reader.at("stimulus"),
                  "the model's dimensions are " + join(names));
    }
    out.modelOrder.push_back(static_cast<size_t>(found - out.stimulus.begin()));
  }
}

// If both can be chosen freely, their sum has to leave room for a rise.
void checkAsymptotes(const ModelSettings& settings, const std::string& where) {
  double highest = 0.0;
  for (const GridAxis& axis : settings.parameters) {
    if (axis.name == "guess" || axis.name == "lapse") highest += axis.values.back();
  }
  if (highest >= 1.0) {
    throw Error("guess and lapse sum to " + shortestNumber(highest), where, "keep their sum below 1");
  }
}

void readNuisance(SettingsReader& reader, ModelSettings& out) {
  out.nuisance.assign(out.parameters.size(), false);
  if (!reader.has("nuisance")) return;
  const json& list = reader.required("nuisance", "");
  std::vector<std::string> names;
  for (const GridAxis& axis : out.parameters) names.push_back(axis.name);
  if (!list.is_array())
    throw Error("found " + list.dump(), reader.at("nuisance"), "list names of parameters");
  for (const json& entry : list) {
    const std::string name = entry.is_string() ? entry.get<std::string>() : entry.dump();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw Error("no parameter '" + name + "'", reader.at("nuisance"), suggest(name, names));
    }
    out.nuisance[static_cast<size_t>(found - names.begin())] = true;
  }
  bool any = false;
  for (size_t d = 0; d < names.size(); ++d) any = any || (!out.nuisance[d] && out.parameters[d].size() > 1);
  if (!any) {
    throw Error("every parameter with more than one value is a nuisance", reader.at("nuisance"),
                "leave one to be estimated");
  }
}

}  // namespace

void ModelSettings::logProbabilities(const std::vector<double>& x, const double* values, double* out) const {
  double ordered[8];
  for (size_t d = 0; d < modelOrder.size(); ++d) ordered[d] = x[modelOrder[d]];
  model->logProbabilities(ordered, values, out);
}

bool ModelSettings::knows(const std::vector<double>& x) const {
  double ordered[8];
  for (size_t d = 0; d < modelOrder.size(); ++d) ordered[d] = x[modelOrder[d]];
  return model->knows(ordered);
}

ModelSettings readModelSettings(SettingsReader& reader, const std::string& defaultModel) {
  ModelSettings out;
  out.model = readModel(reader, defaultModel);
  readStimulus(reader, out);
  SettingsReader parameters(reader.required("parameters", "the values of the model's parameters"),
                            reader.at("parameters"));
  for (const ModelParameter& declared : out.model->parameters()) readParameter(declared, parameters, out);
  parameters.finish();
  checkAsymptotes(out, reader.at("parameters"));
  readNuisance(reader, out);
  const psychometrics::ProductGrid shown(out.stimulus);
  for (size_t i = 0; i < shown.size(); ++i) {
    if (!out.knows(shown.valuesOf(i))) {
      throw Error("the model does not cover stimulus " + shortestNumber(shown.valueOf(i, 0)),
                  reader.at("stimulus"), "give values that it covers");
    }
  }
  return out;
}

void writeModelSettings(const ModelSettings& settings, json& out) {
  settings.model->writeKeys(out);
  out["stimulus"] = toJson(settings.stimulus);
  json parameters = json::object(), nuisance = json::array();
  for (size_t d = 0; d < settings.parameters.size(); ++d) {
    json entry = psychometrics::toJson(settings.parameters[d]);
    entry["prior"] = settings.priorSources[d];
    parameters[settings.parameters[d].name] = entry;
    if (settings.nuisance[d]) nuisance.push_back(settings.parameters[d].name);
  }
  out["parameters"] = parameters;
  if (!nuisance.empty()) out["nuisance"] = nuisance;
}

std::vector<StimulusDimension> dimensionsOf(const std::vector<GridAxis>& axes) {
  std::vector<StimulusDimension> out;
  for (const GridAxis& axis : axes)
    out.push_back({axis.name, axis.unit, axis.values.front(), axis.values.back()});
  return out;
}

}  // namespace limen::study
