// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occluder backprojection and area accumulation (SS-10, SS-11, SS-26, SS-30): areas
// of all micro-occluders on the light are summed, so overlapping ones count twice. Source: Schwarz 2009,
// sections 4.1 (after Guennebaud 2006), 4.4.1 and 4.4.3.
#include "renderer/techniques/soft_shadows/backprojection/backprojection_settings.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines areaDefines(const BackprojectionSettings::Occluders& occluders) {
  return std::visit(
      [](const auto& chosen) -> gl::ShaderDefines {
        if constexpr (requires { chosen.area; })
          if (chosen.area == QuadArea::Signed) return {{"SIGNED_AREAS", "1"}};
        return {};
      },
      occluders);
}

class Backprojection : public OccluderSearch {
 public:
  using Settings = BackprojectionSettings;
  explicit Backprojection(const BackprojectionSettings& settings)
      : OccluderSearch(settings.search, settings.levels, settings.passes, occluderChoice(settings.occluders),
                       "renderer/techniques/soft_shadows/backprojection/backprojection.comp.glsl",
                       "soft_shadows/backprojection", areaDefines(settings.occluders)) {
    if (const auto* contours = std::get_if<Contours>(&settings.occluders))
      contourInset_ = static_cast<float>(contours->inset);
  }

 protected:
  void configure(const gl::Program& program) const override {
    OccluderSearch::configure(program);
    program.set("contourInset", contourInset_);
  }

 private:
  float contourInset_ = 0.0F;
};

const RegisteredTechnique<Backprojection> kBackprojectionRegistered{
    {.name = "soft_shadows/backprojection",
     .version = 1,
     .summary = "Micro-occluders backprojected onto the light, their areas summed",
     .source = "Schwarz 2009, sections 4.1 and 4.4 (SS-10, SS-11, SS-26, SS-30, SS-31)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = OccluderSearch::quantities()}};

}  // namespace
}  // namespace limen::techniques
