// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows from visibility fields: a point of the light is hidden if the distance that a field gives for
// the ray to it is less than its own. Source: Gaitatzes 2012, section 4.7.2 (spherical lights, 20 rays each).
#include "renderer/techniques/visibility_fields/field_technique.h"
#include "renderer/techniques/visibility_fields/light_rays.h"
#include "renderer/techniques/visibility_fields/near_receivers/near_setting.h"

namespace limen::techniques {
namespace {

struct FieldShadowSettings {
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/soft_shadows/soft_shadows.comp.glsl";
  static constexpr const char* kNearShader =
      "renderer/techniques/visibility_fields/near_receivers/near_shadow.comp.glsl";
  static constexpr const char* kDoubtfulShader =
      "renderer/techniques/visibility_fields/doubtful_rays/doubtful_shadow.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/soft_shadows";
  static constexpr gl::Format kFormat = gl::Format::R32F;

  LightRays rays;
  FieldReading field;
  NearSetting nearSetting = NearByField{};
  static const SettingsTable<FieldShadowSettings>& table() {
    using S = FieldShadowSettings;
    static const SettingsTable<S> kTable = {included(&S::rays), included(&S::field),
                                            nearBinding(&S::nearSetting)};
    return kTable;
  }
  void check() const { checkNear(nearSetting, field, "near"); }
  NearSetting near() const { return nearSetting; }
  int passes(uint32_t) const { return 1; }
  void define(gl::ShaderDefines&) const {}
};

const RegisteredTechnique<FieldTechnique<FieldShadowSettings>> kFieldShadows{
    {.name = "visibility_fields/soft_shadows",
     .version = 5,
     .summary = "Soft shadows by rays to a light whose distances are looked up in fields around objects",
     .source = "Gaitatzes 2012, section 4.7.2 (VF-19)",
     .product = ProductKind::Visibility,
     .needs = {"casters", "rectangular_light"},
     .followsMotion = true,
     .counters = FieldTechnique<FieldShadowSettings>::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
