// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/choices.h"

#include <algorithm>
#include <array>

#include "experiments/base/error.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

using techniques::TechniqueInfo;
using techniques::TechniqueRegistry;

const TechniqueInfo& techniqueNamed(const std::string& name) {
  return TechniqueRegistry::instance().get(name, "technique");
}

}  // namespace

experiments::Choice completeScene(const Chosen& chosen) {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(chosen.name, "scene");
  return {chosen.name, info.version, {info.allParameters(), chosen.given, "scene '" + chosen.name + "'"}};
}

experiments::Choice completeTechnique(const Chosen& chosen) {
  const TechniqueInfo& info = techniqueNamed(chosen.name);
  experiments::Choice out{chosen.name, info.version,
                          ParameterValues(info.parameters, chosen.given, "technique '" + chosen.name + "'")};
  if (info.check) info.check(out.values);
  return out;
}

void give(Chosen& chosen, const Parameter& parameter, const ParameterValue& value) {
  ParameterValue valid = validate(parameter, value, chosen.name);
  if (!parameter.required && valid == parameter.defaultValue)
    chosen.given.erase(parameter.name);
  else
    chosen.given[parameter.name] = std::move(valid);
}

const ParameterValue& shown(const Chosen& chosen, const Parameter& parameter) {
  const auto given = chosen.given.find(parameter.name);
  return given == chosen.given.end() ? parameter.defaultValue : given->second;
}

std::vector<Parameter> sceneParameters(const std::string& name) {
  return scene::SceneRegistry::instance().get(name, "scene").allParameters();
}

std::vector<Parameter> techniqueParameters(const std::string& name) {
  return techniqueNamed(name).parameters;
}

std::vector<std::string> comparable(const std::string& technique) {
  const techniques::ProductKind kind = techniqueNamed(technique).product;
  std::vector<std::string> references, others;
  for (const auto& [name, info] : TechniqueRegistry::instance().all())
    if (info.product == kind) (info.reference ? references : others).push_back(name);
  references.insert(references.end(), others.begin(), others.end());
  return references;
}

std::optional<Chosen> usualReference(const std::string& technique) {
  const techniques::ProductKind kind = techniqueNamed(technique).product;
  // Rays against the true triangles lean on nothing that a technique leans on; what can begin roughly shows
  // something soon.
  const auto worth = [](const TechniqueInfo& info) {
    return (info.effort.empty() ? 0 : 2) + (info.onCpu ? 1 : 0);
  };
  const TechniqueInfo* best = nullptr;
  for (const auto& [name, info] : TechniqueRegistry::instance().all())
    if (info.reference && info.product == kind && name != technique && (!best || worth(info) > worth(*best)))
      best = &info;
  return best ? std::optional(Chosen{best->name, {}}) : std::nullopt;
}

std::vector<Chosen> fromCoarseToFine(const Chosen& reference) {
  const TechniqueInfo& info = techniqueNamed(reference.name);
  const auto effort = std::find_if(info.parameters.begin(), info.parameters.end(), [&](const Parameter& p) {
    return p.name == info.effort && p.type == ParameterType::Integer;
  });
  std::vector<Chosen> steps;
  if (effort != info.parameters.end()) {
    const int64_t most = std::get<int64_t>(shown(reference, *effort));
    // By squares, since some count samples along each axis.
    for (const int64_t divisor : {256, 64, 16, 4}) {
      if (most % divisor != 0) continue;
      Chosen step = reference;
      try {
        give(step, *effort, most / divisor);
        completeTechnique(step);
      } catch (const Error&) {
        continue;  // too few for this technique
      }
      steps.push_back(std::move(step));
    }
  }
  steps.push_back(reference);
  return steps;
}

}  // namespace limen::viewer
