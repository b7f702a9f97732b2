// SPDX-License-Identifier: BSD-3-Clause
// Variance shadow map (SS-03): the first two moments of depth, averaged over a window, bound the share of its
// texels that lie beyond the receiver. Exact if a window holds two depths of which the receiver's is the
// farther; an upper bound otherwise, so that light bleeds through where a second occluder lies below a first.
// Source: Schwarz 2009, section 3.2.1 (after Donnelly and Lauritzen 2006; the formula is not given there).
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

struct VarianceSettings {
  PrefilteredSettings common;
  std::variant<SearchedWindow, FixedWindow> window;
  double minVariance = 1e-6, bleedClamp = 0.0;
  static const SettingsTable<VarianceSettings>& table() {
    using S = VarianceSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        windowBinding(&S::window),
        {&S::minVariance,
         "min_variance",
         {1e-12, 0.01},
         "",
         "Smallest variance of depth, with depths from 0 to 1 over the map's range",
         "Schwarz 2009, section 3.2.1 (value not given there)"},
        {&S::bleedClamp,
         "bleed_clamp",
         {0, 0.99},
         "",
         "Visibility mapped to 0, the rest being rescaled to 0..1: less light bleeding, darker penumbrae",
         "Schwarz 2009, section 3.2.1 (reconstructed)"}};
    return kTable;
  }
};

class Variance : public PrefilteredTechnique {
 public:
  using Settings = VarianceSettings;
  explicit Variance(const VarianceSettings& settings)
      : PrefilteredTechnique("variance", settings.common, settings.window,
                             settings.common.prefilterSettings()),
        settings_(settings) {}

 protected:
  void configure(const gl::Program& program) const override {
    PrefilteredTechnique::configure(program);
    program.set("minVariance", static_cast<float>(settings_.minVariance));
    program.set("bleedClamp", static_cast<float>(settings_.bleedClamp));
  }

 private:
  VarianceSettings settings_;
};

const RegisteredTechnique<Variance> kVarianceRegistered{PrefilteredTechnique::info(
    "soft_shadows/variance", "Variance shadow map: Chebyshev's bound from averaged moments of depth")};

}  // namespace
}  // namespace limen::techniques
