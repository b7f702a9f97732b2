// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/techniques/reflections/scene_needs/reflector_facts.h"

/// Roger's advice on which technique to take (2008, sections 1.3.1, 2.4 and 6), with numbers for what is
/// "distant", "smooth" and "nearly convex", none of which he gives.
namespace limen::techniques {

/// What a reflector needs, as the advice has it.
enum class ReflectorNeed {
  Cones,         ///< glossy
  PlanarMirror,  ///< a plane, or a few
  Map,           ///< distant surroundings
  Tracer,        ///< nothing moves
  Vertices,      ///< smooth and nearly convex, in a scene that moves
  RayHierarchy   ///< anything else
};
constexpr size_t kReflectorNeeds = 6;

struct ReflectorRule {
  double glossyRad = 1e-3;
  int mostPlanes = 4;
  double farRadii = 20.0;
  double mostConcave = 0.05, creaseDeg = 10.0, mostCreased = 0.01;
  static const SettingsTable<ReflectorRule>& table();
};

/// A need with the figures that led to it.
struct NeedVerdict {
  ReflectorNeed need = ReflectorNeed::RayHierarchy;
  std::string reason;
};

/// `moving`: whether the scene moves, other than by its camera.
NeedVerdict needOf(const ReflectorFacts& facts, bool moving, const ReflectorRule& rule);

struct RuleVerdict {
  std::vector<NeedVerdict> reflectors;  ///< in the order of the facts
  NeedVerdict all;                      ///< of the one technique that serves all of them
  int planes = 0;                       ///< of those that need planar mirrors
};

/// What all reflectors need; if they need different things, what serves any: cones if one is glossy,
/// otherwise the ray tracer in a still scene and the ray hierarchy in one that moves. `facts` may be empty.
RuleVerdict decideByRule(std::span<const ReflectorFacts> facts, bool moving, const ReflectorRule& rule);

}  // namespace limen::techniques
