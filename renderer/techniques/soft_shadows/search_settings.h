// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/techniques/soft_shadows/bias_form.h"
#include "renderer/techniques/soft_shadows/occluder_kinds.h"
#include "renderer/techniques/soft_shadows/quality/budget_settings.h"
#include "renderer/techniques/soft_shadows/quality/level_settings.h"
#include "renderer/techniques/soft_shadows/structure_settings.h"

namespace limen::techniques {

/// Common settings of all techniques that search the shadow map for the texels that can matter to a receiver;
/// included in theirs. Source: Schwarz 2009, sections 4.1 to 4.4.
struct SearchSettings {
  MapSettings map = {};
  BiasSettings bias = PlaneBias{};
  BudgetSettings budget = {};
  int refinements = 2;  ///< number of times that the search area is narrowed
  StructureSettings structure = HierarchicalMap{};
  static const SettingsTable<SearchSettings>& table();
};

/// Throws Error if a requested level is not in the map, or if levels are chosen in more than one way.
void checkLevels(const SearchSettings& search, const OccluderChoice& occluders, const LevelSettings& levels);
/// The cells that search areas are divided into; none: levels. Throws if they conflict with other settings.
std::optional<SearchCells> cellsOf(const SearchSettings& search, const OccluderChoice& occluders,
                                   const LevelSettings& levels);
/// Throws Error if occluders are not made of texels whose stored bias would apply.
void checkBias(const SearchSettings& search, const OccluderChoice& occluders);

}  // namespace limen::techniques
