// SPDX-License-Identifier: BSD-3-Clause
// Exponential shadow map (SS-03): exp(c (z - p)) replaces the comparison z >= p, as long as no z lies beyond
// p; averaged over a window it needs only the average of exp(c z). Occluders closer than about 1 / c of the
// depth range are lost, and one deep texel in a window lights all of it. Source: Schwarz 2009, section 3.2.1
// (after Annen et al. 2008 and Salvi 2008; the formula is not given there).
//
// A summed-area table of 32-bit floats holds sums of numbers that differ by up to exp(c): a window over near
// depths is the small difference of large sums, and with large c all its precision is lost. Averages in a
// pyramid do not have this problem and are the default.
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

struct ExponentialSettings {
  PrefilteredSettings common{.prefilter = MipsPrefilter{}};
  std::variant<SearchedWindow, FixedWindow> window;
  double exponent = 80.0;
  static const SettingsTable<ExponentialSettings>& table() {
    using S = ExponentialSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        windowBinding(&S::window),
        {&S::exponent,
         "exponent",
         {1, 88},
         "",
         "Steepness c, for depths from 0 to 1 over the map's range; beyond 88 exp(c) overflows 32-bit floats",
         "Schwarz 2009, section 3.2.1 (value not given there)"}};
    return kTable;
  }

  frame::PrefilterSettings prefilterSettings() const {
    frame::PrefilterSettings settings = common.prefilterSettings();
    settings.basis = frame::DepthBasis::Exponential;
    settings.exponent = exponent;
    return settings;
  }
};

class Exponential : public PrefilteredTechnique {
 public:
  using Settings = ExponentialSettings;
  explicit Exponential(const ExponentialSettings& settings)
      : PrefilteredTechnique("exponential", settings.common, settings.window, settings.prefilterSettings()) {}
};

const RegisteredTechnique<Exponential> kExponentialRegistered{PrefilteredTechnique::info(
    "soft_shadows/exponential",
    "Exponential shadow map: averaged exponentials of depth replace the comparison")};

}  // namespace
}  // namespace limen::techniques
