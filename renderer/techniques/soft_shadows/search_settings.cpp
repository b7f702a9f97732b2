// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/search_settings.h"

#include <bit>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::techniques {

const SettingsTable<SearchSettings>& SearchSettings::table() {
  using S = SearchSettings;
  static const SettingsTable<S> kTable = {
      included(&S::map),
      Binding(&S::bias, "bias",
              "Bias that keeps a surface from shadowing itself: how far a depth must be below the receiver's",
              "Schwarz 2009, section 4.5.4")
          .shorthand("constant")
          .formerly({"bias_form"}),
      Binding(&S::budget, "budget", "Micro-occluders allowed per pixel",
              "Schwarz 2009, sections 4.1, 4.5 and 5.2.1")
          .shorthand("limit")
          .formerly({"budget_map"}),
      {&S::refinements,
       "refinements",
       {0, 3},
       "",
       "Number of times that the search area is narrowed by its depth range",
       "Schwarz 2009, section 4.1"},
      {&S::structure, "structure", "Structure that provides the depth range of a search area",
       "Schwarz 2009, sections 4.1 and 4.3; N-buffer: Décoret 2005"}};
  return kTable;
}

void checkLevels(const SearchSettings& search, const OccluderChoice& occluders, const LevelSettings& levels) {
  cellsOf(search, occluders, levels);
  const int resolution = search.map.resolution;
  const int coarsest = std::bit_width(static_cast<unsigned>(resolution)) - 1;
  const auto* fixed = std::get_if<FixedLevel>(&levels);
  const auto tooCoarse = [&](double level, const char* where) {
    if (level > coarsest)
      throw Error("level " + shortestNumber(level) + " of a map of " + std::to_string(resolution) +
                      " texels per side was requested, of which level " + std::to_string(coarsest) +
                      " is a single texel",
                  where, "give a lower level, or a higher resolution");
  };
  if (fixed) tooCoarse(fixed->level, "levels.level");
  if (occluders.morphLevel) {
    tooCoarse(*occluders.morphLevel, "occluders.level");
    if (!std::holds_alternative<FinestWithin>(levels))
      throw Error("morphing microquads lie between two levels of their own, which conflict with 'levels'",
                  "levels", "leave it out, or choose other occluders");
  }
  if (!fixed && !occluders.morphLevel) return;
  const auto* uniform = std::get_if<UniformBudget>(&search.budget);
  if (!uniform || uniform->limit != UniformBudget{}.limit)
    throw Error("a budget leads to a level per pixel, but here all pixels have the same level", "budget",
                fixed ? "leave it out, or choose other levels" : "leave it out, or choose other occluders");
}

std::optional<SearchCells> cellsOf(const SearchSettings& search, const OccluderChoice& occluders,
                                   const LevelSettings& levels) {
  const auto* given = std::get_if<SearchCells>(&occluders.division);
  if (!given && !std::holds_alternative<AutoDivision>(occluders.division)) return std::nullopt;
  const auto conflict = [&](const char* what, const char* where, const char* hint) {
    if (given) throw Error(std::string("cells of search areas conflict with ") + what, where, hint);
    return std::nullopt;
  };
  if (occluders.depths != CoarseDepths::Sampled)
    return conflict(
        "depths that only levels hold", "occluders.depths",
        "leave it out, or give division: levels; division: {kind: cells, spread: 0} takes the depths at "
        "the middles of cells");
  if (!std::holds_alternative<FinestWithin>(levels))
    return conflict("a choice of levels", "levels", "leave it out, or give occluders.division: levels");
  if (!std::holds_alternative<PlaneBias>(search.bias))
    return conflict("a bias that holds for a level's texels", "bias",
                    "give bias: receiver_plane, or occluders.division: levels");
  return given ? *given : SearchCells{};
}

void checkBias(const SearchSettings& search, const OccluderChoice& occluders) {
  if (std::holds_alternative<StoredBias>(search.bias) && occluders.kind == OccluderKind::MorphingMicroquads)
    throw Error(std::string("a stored bias belongs to a texel of a level, and ") +
                    limen::toText(occluders.kind) + " lie between two levels",
                "bias", "choose another form, or other occluders");
  if (std::holds_alternative<StoredBias>(search.bias) && sampledTexel(occluders.depths))
    throw Error("a stored bias belongs to the nearest depth of a texel, and 'depths' is another", "bias",
                std::string("choose another form, or occluders: {kind: ") + limen::toText(occluders.kind) +
                    ", depths: nearest}");
}

}  // namespace limen::techniques
