// SPDX-License-Identifier: BSD-3-Clause
// Exponential shadow map (SS-03): exp(c (z - p)) stands for the comparison z >= p, as long as no z lies
// beyond p; averaged over a window it needs the average of exp(c z) alone. Occluders closer than about 1 / c
// of the depth range are lost, and one deep texel in a window lights all of it. Source: Schwarz 2009,
// section 3.2.1 (after Annen et al. 2008 and Salvi 2008; the formula is not given there).
//
// A summed-area table of 32-bit floats holds sums of numbers that differ by up to exp(c): a window over near
// depths is the small difference of large sums, and with large c nothing of it is left. Averages in a pyramid
// have no such loss, and are the default.
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

frame::PrefilterSettings exponentialSettings(const ParameterValues& values) {
  frame::PrefilterSettings settings = PrefilteredTechnique::settingsOf(values);
  settings.basis = frame::DepthBasis::Exponential;
  settings.exponent = values.real("exponent");
  return settings;
}

class Exponential : public PrefilteredTechnique {
 public:
  explicit Exponential(const ParameterValues& values)
      : PrefilteredTechnique(values, "exponential", exponentialSettings(values)) {}
};

std::vector<Parameter> exponentialParameters() {
  std::vector<Parameter> all =
      PrefilteredTechnique::prefilterParameters({"searched", "fixed"}, {"mips", "sums"});
  all.push_back(realParameter(
      "exponent", 80.0, 1.0, 88.0, "",
      "Steepness c, for depths from 0 to 1 over the map's range; beyond 88 exp(c) leaves 32-bit "
      "floats",
      "Schwarz 2009, section 3.2.1 (value not given there)"));
  return all;
}

const Registered<TechniqueInfo> kExponentialRegistered{PrefilteredTechnique::declare(
    "soft_shadows/exponential", 1,
    "Exponential shadow map: averaged exponentials of depth stand for the comparison",
    exponentialParameters(),
    [](const ParameterValues& values) { return std::make_unique<Exponential>(values); })};

}  // namespace
}  // namespace limen::techniques
