// SPDX-License-Identifier: BSD-3-Clause
// Hard shadow map (SS-01): one depth comparison with the map rendered from the light's centre. The smallest
// technique: the one to copy. Source: Schwarz 2009, section 3.3, with linear depth as in all techniques here.
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

struct HardSettings {
  MapSettings map;
  TexelBiasSettings bias = PlaneBias{};
  static const SettingsTable<HardSettings>& table() {
    static const SettingsTable<HardSettings> kTable = {
        included(&HardSettings::map),
        Binding(&HardSettings::bias, "bias", "Bias that keeps a surface from shadowing itself")
            .shorthand("constant")};
    return kTable;
  }
};

class HardShadow : public VisibilityTechnique {
 public:
  using Settings = HardSettings;
  explicit HardShadow(const HardSettings& settings)
      : VisibilityTechnique(settings.map, anyBias(settings.bias),
                            "renderer/techniques/soft_shadows/hard/hard.comp.glsl", "soft_shadows/hard") {}

 protected:
  void configure(const gl::Program&) const override {}
};

const RegisteredTechnique<HardShadow> kHardRegistered{
    {.name = "soft_shadows/hard",
     .version = 2,
     .summary = "Hard shadow map: one comparison with the depth seen from the light's centre",
     .source = "Schwarz 2009, section 3.3 (SS-01)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = VisibilityTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
