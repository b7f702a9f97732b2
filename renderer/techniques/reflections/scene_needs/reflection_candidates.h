// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/frame/mirror_path.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/scene_needs/reflector_rule.h"
#include "renderer/techniques/scene_needs/needs.h"

namespace limen::techniques {

/// What all candidates and the reference have in common, as far as they take it.
struct ReflectionCommon {
  frame::MirrorPathSettings path;
  frame::ShadedSetting shading;
  static const SettingsTable<ReflectionCommon>& table();
};

/// All ways to show mirrors, from cheap to expensive: those that are not there, or that a scene does not
/// allow, are left out with the reason when they are tried. `glossRad`: the largest of the mirrors.
std::vector<Candidate> builtInReflections(double glossRad, const ReflectionCommon& common);
/// As a file lists them; `common` applies where an entry does not set it.
std::vector<Candidate> readReflections(const std::string& path, const ReflectionCommon& common);

/// The technique and settings that serve a need, of mirrors that lie in `planes` planes where these count.
Candidate candidateForNeed(ReflectorNeed need, int planes, double glossRad, const scene::Scene& scene,
                           const ReflectionCommon& common);
/// The same for all mirrors at once.
Candidate candidateFor(const RuleVerdict& verdict, double glossRad, const scene::Scene& scene,
                       const ReflectionCommon& common);
/// A map that is filtered for mirrors of this gloss.
Candidate filteredMap(double glossRad, const ReflectionCommon& common);

/// Colour where pixels see mirrors, against the exact reference or, if any mirror is glossy, the sampled one.
NeedsSubject reflectionSubject(bool glossy, const ReflectionCommon& common);

/// Exponent of a cosine with the same mean cosine as a cone of even weight, 1 to 1000 (the map's range): with
/// the cosine's n, (n + 1) / (n + 2) = (1 + cos gloss) / 2.
double lobeExponent(double glossRad);

}  // namespace limen::techniques
