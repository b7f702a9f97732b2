// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/candidate.h"

#include "experiments/base/error.h"

namespace limen::techniques {

ParameterValues completeValues(const Candidate& candidate) {
  return {TechniqueRegistry::instance().get(candidate.technique).parameters, candidate.given,
          candidate.technique};
}

std::unique_ptr<Technique> makeTechnique(const Candidate& candidate) {
  return TechniqueRegistry::instance().get(candidate.technique).make(completeValues(candidate));
}

std::string describe(const Candidate& candidate) {
  std::string text = candidate.technique;
  for (const auto& [path, value] : candidate.given) text += ", " + path + "=" + limen::toText(value);
  return text;
}

std::string obstacleTo(const Candidate& candidate, const scene::Scene& scene) {
  try {
    const TechniqueInfo& info = TechniqueRegistry::instance().get(candidate.technique);
    const auto traits = scene.traits();
    for (const std::string& trait : info.needs)
      if (traits.count(trait) == 0) return "the scene has no " + trait;
    const ParameterValues values = completeValues(candidate);
    if (info.check) info.check(values);
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

}  // namespace limen::techniques
