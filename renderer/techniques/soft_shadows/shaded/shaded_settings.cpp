// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shaded/shaded_settings.h"

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/backprojection/backprojection_parts.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_parts.h"

namespace limen::techniques {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& where, const std::string& hint) {
  throw Error("the shading pass evaluates the loop itself, and " + what, where, hint + ", or loop: own_pass");
}

}  // namespace

const SettingsTable<ShadedShadowSettings>& ShadedShadowSettings::table() {
  using S = ShadedShadowSettings;
  static const SettingsTable<S> kTable = {
      innerBinding(&S::inner, InnerKind::OrRayTraced),
      {&S::loop, "loop",
       "Place of the loop over micro-occluders: in passes of its own, or in the pass that shades, in a "
       "compute "
       "shader or in a fragment shader, over the picture at once or on the scene's triangles",
       "Schwarz 2009, sections 4.1, 4.6 and 5.2.2"}};
  return kTable;
}

SearchParts innerParts(const ChosenEntry& inner) {
  const ParameterValues values = completeValues<TechniqueInfo>(inner);
  if (inner.name == "soft_shadows/bitmask") return bitmaskParts(BitmaskSettings::table().read(values));
  if (inner.name == "soft_shadows/backprojection")
    return backprojectionParts(BackprojectionSettings::table().read(values));
  refuse("'" + inner.name + "' has none", "inner", "give inner: bitmask, or inner: backprojection");
}

void ShadedShadowSettings::check() const {
  if (loop == VisibilityLoop::OwnPass) return;
  const SearchParts parts = innerParts(inner);
  if (!std::holds_alternative<SinglePass>(parts.passes))
    refuse("'passes: split' takes it apart", "inner.passes", "give passes: single");
  if (!std::holds_alternative<CentreMap>(parts.maps))
    refuse("'maps' are several, each with a loop of its own", "inner.maps", "give maps: centre");
  if (parts.last) refuse("a filter needs visibility of neighbours", "inner.filter", "give filter: none");
  if (!std::holds_alternative<UniformBudget>(parts.search.budget))
    refuse("'budget' is a map that other passes make", "inner.budget", "give a number");
}

}  // namespace limen::techniques
