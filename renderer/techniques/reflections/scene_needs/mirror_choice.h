// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/techniques/reflections/scene_needs/grouped_mirrors.h"
#include "renderer/techniques/reflections/scene_needs/reflection_candidates.h"

namespace limen::techniques {

/// A mirror's own technique and the reason for it.
struct MirrorNeed {
  Candidate candidate;
  std::string reason;
};

/// What each mirror needs by the rule, in the order of the facts. Where a technique cannot show a mirror, as
/// it moves itself or lies in more planes than can be drawn, another is taken, and the reason says so: for
/// glossy mirrors a filtered map, otherwise the ray tracer in a still scene and the ray hierarchy in one that
/// moves.
std::vector<MirrorNeed> eachByRule(const scene::Scene& scene, std::span<const ReflectorFacts> facts,
                                   const RuleVerdict& verdict, bool moving, const ReflectionCommon& common);

/// Mirrors of one technique with the same settings become a group, as far as it shows several at once: a map
/// has one place, and no more than 16 planes are drawn. In the order of the first of each.
std::vector<MirrorGroup> groupsOf(std::span<const ReflectorFacts> facts, std::span<const MirrorNeed> needs);

}  // namespace limen::techniques
