// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/techniques/scene_needs/candidate.h"
#include "renderer/techniques/scene_needs/needs.h"
#include "renderer/techniques/soft_shadows/map_settings.h"

namespace limen::techniques {

/// Candidates of all families, from a hard shadow to hundreds of maps: shadow maps filtered, with occluders
/// backprojected by their areas and by bitmasks, in the form of Schwarz 2009 and in those that replaced it,
/// over budgets, occluders, structures, passes and maps. All read maps of `map`; a few that aim at small
/// errors read maps of twice its resolution. The most expensive come last.
std::vector<Candidate> builtInCandidates(const MapSettings& map);

/// As a file lists them; `map` applies where an entry does not set it.
std::vector<Candidate> readCandidates(const std::string& path, const MapSettings& map);

/// Visibility on receivers, against rays to the light.
NeedsSubject shadowSubject();

}  // namespace limen::techniques
