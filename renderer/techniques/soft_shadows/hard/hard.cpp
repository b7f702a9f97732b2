// SPDX-License-Identifier: BSD-3-Clause
// Hard shadow map (SS-01): one depth comparison with the map rendered from the light's centre. The smallest
// technique: the one to copy. Source: Schwarz 2009, section 3.3, with linear depth as in all techniques here.
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

class HardShadow : public VisibilityTechnique {
 public:
  explicit HardShadow(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/hard/hard.comp.glsl",
                            "soft_shadows/hard") {}

 protected:
  void configure(const gl::Program&) const override {}
};

const Registered<TechniqueInfo> kHardRegistered{
    {.name = "soft_shadows/hard",
     .version = 1,
     .summary = "Hard shadow map: one comparison with the depth seen from the light's centre",
     .source = "Schwarz 2009, section 3.3 (SS-01)",
     .product = ProductKind::Visibility,
     .parameters = VisibilityTechnique::commonParameters(1.0),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<HardShadow>(values); },
     .errorBound = {},
     .counters = VisibilityTechnique::counterNames()}};

}  // namespace
}  // namespace limen::techniques
