// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/candidate.h"

#include <algorithm>

#include "experiments/base/error.h"

namespace limen::techniques {

ParameterValues completeValues(const Candidate& candidate) {
  return {TechniqueRegistry::instance().get(candidate.technique).parameters, candidate.given,
          candidate.technique};
}

std::unique_ptr<Technique> makeTechnique(const Candidate& candidate) {
  if (candidate.make) return candidate.make();
  return TechniqueRegistry::instance().get(candidate.technique).make(completeValues(candidate));
}

bool takes(const TechniqueInfo& info, const std::string& path) {
  const std::vector<DeclaredAt> declared = flatten(info.parameters);
  return std::any_of(declared.begin(), declared.end(), [&](const DeclaredAt& at) { return at.path == path; });
}

std::string describe(const Candidate& candidate) {
  if (candidate.make) return candidate.technique + ": " + candidate.details;
  const TechniqueInfo* info = TechniqueRegistry::instance().find(candidate.technique);
  const std::vector<DeclaredAt> declared = info ? flatten(info->parameters) : std::vector<DeclaredAt>{};
  const auto isUsualChoice = [&](const std::string& path, const ParameterValue& value) {
    return std::any_of(declared.begin(), declared.end(), [&](const DeclaredAt& at) {
      return at.path == path && at.parameter->type == ParameterType::Choice &&
             at.parameter->defaultValue == value;
    });
  };
  std::string text = candidate.technique;
  for (const auto& [path, value] : candidate.given)
    if (!isUsualChoice(path, value)) text += ", " + path + "=" + limen::toText(value);
  return text;
}

std::string obstacleTo(const Candidate& candidate, const scene::Scene& scene) {
  if (candidate.make) return "";
  try {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(candidate.technique);
    const auto traits = scene.traits();
    for (const std::string& trait : info.needs)
      if (traits.count(trait) == 0) return "the scene has no " + trait;
    if (traits.count("moving_parts") && !info.followsMotion) return "it does not follow parts that move";
    const ParameterValues values = completeValues(candidate);
    if (info.check) info.check(values);
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

}  // namespace limen::techniques
