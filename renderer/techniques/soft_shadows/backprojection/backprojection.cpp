// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occluder backprojection and area accumulation (SS-10, SS-11, SS-26, SS-30): areas
// of all micro-occluders on the light are summed, so overlapping ones count twice. Source: Schwarz 2009,
// sections 4.1 (after Guennebaud 2006), 4.4.1 and 4.4.3.
#include "renderer/techniques/soft_shadows/backprojection/backprojection_parts.h"

namespace limen::techniques {
namespace {

/// Areas are summed in a register of the shader.
class AreaGathering : public Gathering {
 public:
  explicit AreaGathering(const BackprojectionSettings::Occluders& occluders) : occluders_(occluders) {}

  gl::ShaderDefines prepare(frame::Frame&, const MapSource&) override {
    return std::visit(
        [](const auto& chosen) -> gl::ShaderDefines {
          if constexpr (requires { chosen.area; })
            if (chosen.area == QuadArea::Signed) return {{"SIGNED_AREAS", "1"}};
          return {};
        },
        occluders_);
  }

  void configure(const gl::Program& program, size_t) const override {
    if (const auto* contours = std::get_if<Contours>(&occluders_))
      program.set("contourInset", static_cast<float>(contours->inset));
  }

 private:
  BackprojectionSettings::Occluders occluders_;
};

class Backprojection : public SearchTechnique {
 public:
  using Settings = BackprojectionSettings;
  explicit Backprojection(const BackprojectionSettings& settings)
      : SearchTechnique(backprojectionParts(settings)) {}
};

const RegisteredTechnique<Backprojection> kBackprojectionRegistered{
    {.name = "soft_shadows/backprojection",
     .version = 4,
     .summary = "Micro-occluders backprojected onto the light, their areas summed",
     .source = "Schwarz 2009, sections 4.1 and 4.4 (SS-10, SS-11, SS-26, SS-30, SS-31)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = SearchTechnique::quantities()}};

}  // namespace

SearchParts backprojectionParts(const BackprojectionSettings& settings) {
  return {.shader = "renderer/techniques/soft_shadows/backprojection/backprojection.comp.glsl",
          .pass = "soft_shadows/backprojection",
          .search = settings.search,
          .levels = settings.levels,
          .passes = settings.passes,
          .occluders = occluderChoice(settings.occluders),
          .maps = CentreMap{},
          .gathering = std::make_unique<AreaGathering>(settings.occluders),
          .last = nullptr};
}

}  // namespace limen::techniques
