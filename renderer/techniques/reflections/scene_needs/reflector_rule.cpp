// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/scene_needs/reflector_rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace limen::techniques {
namespace {

/// More than this many planes cannot be drawn by reflections/planar_mirror.
constexpr int kPlanesDrawn = 16;

NeedVerdict anyOf(std::span<const NeedVerdict> verdicts, bool moving, const std::string& reason) {
  const bool glossy = std::any_of(verdicts.begin(), verdicts.end(),
                                  [](const NeedVerdict& one) { return one.need == ReflectorNeed::Cones; });
  if (glossy) return {ReflectorNeed::Cones, reason + ": cones serve glossy mirrors and all others"};
  if (!moving)
    return {ReflectorNeed::Tracer, reason + ": in a still scene the ray tracer serves all of them"};
  return {ReflectorNeed::RayHierarchy,
          reason + ": in a scene that moves the ray hierarchy serves all of them"};
}

}  // namespace

NeedVerdict needOf(const ReflectorFacts& facts, bool moving, const ReflectorRule& rule) {
  if (facts.glossRad > rule.glossyRad)
    return {ReflectorNeed::Cones,
            fmt::format("glossy: {:.3g} rad, more than {:.3g}", facts.glossRad, rule.glossyRad)};
  if (facts.planes > 0 && facts.planes <= rule.mostPlanes)
    return {ReflectorNeed::PlanarMirror,
            facts.planes == 1 ? std::string("a plane") : fmt::format("{} planes", facts.planes)};
  if (facts.surroundings >= rule.farRadii)
    return {
        ReflectorNeed::Map,
        fmt::format("no plane; all that surrounds it is {:.3g} of its radii or more away, at least {:.3g}",
                    facts.surroundings, rule.farRadii)};
  const std::string near =
      fmt::format("no plane; its surroundings begin at {:.3g} of its radii, below {:.3g}", facts.surroundings,
                  rule.farRadii);
  if (!moving) return {ReflectorNeed::Tracer, near + "; nothing moves"};
  const bool convex = facts.concaveShare <= rule.mostConcave, smooth = facts.creasedShare <= rule.mostCreased;
  const std::string shape = fmt::format(
      "; in a scene that moves: {:.3g} % of its edges' turn concave ({} {:.3g} %), {:.3g} % of its edges' "
      "length creased ({} {:.3g} %), {} point sees it as a whole",
      100.0 * facts.concaveShare, convex ? "within" : "more than", 100.0 * rule.mostConcave,
      100.0 * facts.creasedShare, smooth ? "within" : "more than", 100.0 * rule.mostCreased,
      facts.star ? "some" : "no");
  return {convex && smooth && facts.star ? ReflectorNeed::Vertices : ReflectorNeed::RayHierarchy,
          near + shape};
}

RuleVerdict decideByRule(std::span<const ReflectorFacts> facts, bool moving, const ReflectorRule& rule) {
  RuleVerdict out;
  for (const ReflectorFacts& one : facts) {
    out.reflectors.push_back(needOf(one, moving, rule));
    if (out.reflectors.back().need == ReflectorNeed::PlanarMirror) out.planes += one.planes;
  }
  if (out.reflectors.empty()) {
    out.all = anyOf({}, moving, "no mirror has any area");
    return out;
  }
  const ReflectorNeed first = out.reflectors.front().need;
  const bool alike = std::all_of(out.reflectors.begin(), out.reflectors.end(),
                                 [&](const NeedVerdict& one) { return one.need == first; });
  if (!alike)
    out.all = anyOf(out.reflectors, moving, "the mirrors need different techniques");
  else if (first == ReflectorNeed::PlanarMirror && out.planes > kPlanesDrawn)
    out.all = anyOf({}, moving, fmt::format("the mirrors lie in {} planes, too many to draw", out.planes));
  else
    out.all = {first, out.reflectors.size() == 1 ? "the only mirror needs it" : "all mirrors need it"};
  return out;
}

const SettingsTable<ReflectorRule>& ReflectorRule::table() {
  using S = ReflectorRule;
  static const SettingsTable<S> kTable = {
      {&S::glossyRad,
       "glossy",
       {0.0, 1.0},
       "rad",
       "Gloss above which a mirror is glossy; the default is about a pixel's angle",
       "Roger 2008, chapter 6 (value not given there)"},
      {&S::mostPlanes,
       "planes",
       {1, 16},
       "",
       "Planes of one mirror that count as planar at most",
       "Roger 2008, section 1.3.1 (one)"},
      {&S::farRadii,
       "far",
       {1.0, 1e6},
       "radii",
       "Distance from which on surroundings are distant; at 20 radii a map turns them by 2.9 deg at most",
       "Roger 2008, section 2.4 (value not given there)"},
      {&S::mostConcave,
       "concave",
       {0.0, 1.0},
       "",
       "Concave share of the turn of a nearly convex mirror's edges at most",
       "Roger 2008, section 2.4 (value not given there)"},
      {&S::creaseDeg,
       "crease",
       {0.0, 180.0},
       "deg",
       "Angle between the normals of an edge's two sides above which it is a crease",
       "not given in Roger 2008"},
      {&S::mostCreased,
       "creased",
       {0.0, 1.0},
       "",
       "Share of creases in the length of a smooth mirror's edges at most",
       "Roger 2008, section 2.4 (value not given there)"}};
  return kTable;
}

}  // namespace limen::techniques
