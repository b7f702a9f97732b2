// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/soft_shadows, traced against the triangles of the same objects instead: exact
// for those rays. Source: Gaitatzes 2012, section 4.7.2 (MT-01, BL-02).
#include "renderer/techniques/visibility_fields/field_technique.h"
#include "renderer/techniques/visibility_fields/light_rays.h"

namespace limen::techniques {
namespace {

struct ObjectShadowSettings {
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/traced_shadows/traced_shadows.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/traced_shadows";
  static constexpr gl::Format kFormat = gl::Format::R32F;

  LightRays rays;
  TracerSetting tracer;
  static const SettingsTable<ObjectShadowSettings>& table() {
    using S = ObjectShadowSettings;
    static const SettingsTable<S> kTable = {included(&S::rays), tracerBinding(&S::tracer)};
    return kTable;
  }
};

const RegisteredTechnique<TracedTechnique<ObjectShadowSettings>> kObjectShadows{
    {.name = "visibility_fields/traced_shadows",
     .version = 1,
     .summary = "Soft shadows by the same rays as from visibility fields, traced on the GPU",
     .source = "Gaitatzes 2012, section 4.7.2 (MT-01, BL-02)",
     .product = ProductKind::Visibility,
     .needs = {"casters", "rectangular_light"},
     .reference = true,
     .followsMotion = true,
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
