// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// A technique with the settings with which it is tried.
struct Candidate {
  std::string technique;                        ///< as registered
  std::map<std::string, ParameterValue> given;  ///< by path; the rest takes its defaults
};

/// Its settings, complete. Throws Error on a value that the technique does not take.
ParameterValues completeValues(const Candidate& candidate);
std::unique_ptr<Technique> makeTechnique(const Candidate& candidate);
/// The technique, and "path=value" of what is given: all numbers, and choices that are not the default.
std::string describe(const Candidate& candidate);
/// Why it cannot be tried: settings that it does not take, a trait that the scene lacks; "": it can.
std::string obstacleTo(const Candidate& candidate, const scene::Scene& scene);

/// Candidates of all families, from a hard shadow to hundreds of maps: shadow maps filtered, with occluders
/// backprojected by their areas and by bitmasks, in the form of Schwarz 2009 and in those that replaced it,
/// over budgets, occluders, structures, passes and maps. All read maps of `map`; a few that aim at small
/// errors read maps of twice its resolution. The most expensive come last.
std::vector<Candidate> builtInCandidates(const MapSettings& map);

/// Candidates listed in a YAML file, as the techniques of a descriptor are; lists are axes. `map` applies
/// where an entry does not set it. Throws Error naming file and line.
std::vector<Candidate> readCandidates(const std::string& path, const MapSettings& map);

}  // namespace limen::techniques
