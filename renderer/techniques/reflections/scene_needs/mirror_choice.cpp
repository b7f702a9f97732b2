// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/scene_needs/mirror_choice.h"

#include <algorithm>
#include <cassert>

#include "renderer/techniques/reflections/moving_mirrors.h"

namespace limen::techniques {
namespace {

constexpr int64_t kPlanesAtMost = 16;  // of reflections/planar_mirror

bool isPlanar(const Candidate& candidate) { return candidate.technique == "reflections/planar_mirror"; }
bool isMap(const Candidate& candidate) { return candidate.technique == "reflections/environment_map"; }
bool isVertices(const Candidate& candidate) { return candidate.technique == "reflections/vertex_reflection"; }

int64_t planesOf(const Candidate& candidate) {
  return std::get<int64_t>(completeValues(candidate).all().at("planes"));
}

/// Why it cannot show the mirror; "": it can.
std::string obstacleFor(const Candidate& candidate, const scene::Scene& scene, size_t part) {
  if ((isPlanar(candidate) || isMap(candidate) || isVertices(candidate)) && movesPart(scene, part))
    return "the mirror moves itself";
  return obstacleTo(candidate, scene);
}

/// What two mirrors of one group have in common; only planes may differ.
std::string groupKey(const Candidate& candidate) {
  if (!isPlanar(candidate)) return describe(candidate);
  Candidate any = candidate;
  any.given.erase("planes");
  return describe(any);
}

}  // namespace

std::vector<MirrorNeed> eachByRule(const scene::Scene& scene, std::span<const ReflectorFacts> facts,
                                   const RuleVerdict& verdict, bool moving, const ReflectionCommon& common) {
  assert(facts.size() == verdict.reflectors.size());
  const ReflectorNeed rays = moving ? ReflectorNeed::RayHierarchy : ReflectorNeed::Tracer;
  std::vector<MirrorNeed> out;
  for (size_t i = 0; i < facts.size(); ++i) {
    const ReflectorFacts& mirror = facts[i];
    const NeedVerdict& need = verdict.reflectors[i];
    std::vector<Candidate> order = {
        candidateForNeed(need.need, mirror.planes, mirror.glossRad, scene, common)};
    if (need.need == ReflectorNeed::Cones) order.push_back(filteredMap(mirror.glossRad, common));
    order.push_back(candidateForNeed(rays, 0, 0.0, scene, common));
    std::string reason = need.reason;
    for (const Candidate& candidate : order) {
      const std::string obstacle = obstacleFor(candidate, scene, mirror.part);
      out.resize(i);
      out.push_back({candidate, reason});
      if (obstacle.empty()) break;
      reason += "; not by " + candidate.technique + ": " + obstacle;
    }
  }
  return out;
}

std::vector<MirrorGroup> groupsOf(std::span<const ReflectorFacts> facts, std::span<const MirrorNeed> needs) {
  assert(facts.size() == needs.size());
  std::vector<MirrorGroup> out;
  for (size_t i = 0; i < facts.size(); ++i) {
    const Candidate& own = needs[i].candidate;
    const auto fits = [&](const MirrorGroup& group) {
      if (isMap(own) || groupKey(group.candidate) != groupKey(own)) return false;
      return !isPlanar(own) || planesOf(group.candidate) + planesOf(own) <= kPlanesAtMost;
    };
    auto found = std::find_if(out.begin(), out.end(), fits);
    if (found == out.end())
      found = out.insert(out.end(), {.candidate = own, .parts = {}, .names = {}});
    else if (isPlanar(own))
      found->candidate.given["planes"] = planesOf(found->candidate) + planesOf(own);
    found->parts.push_back(facts[i].part);
    found->names.push_back(facts[i].name);
  }
  return out;
}

}  // namespace limen::techniques
