// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/ambient_occlusion, traced against the triangles of the same objects instead:
// what fields are compared with, exact for those rays, and the tracer that they must beat. Source: Gaitatzes
// 2012, section 4.7 (MT-01, BL-02).
#include "renderer/techniques/visibility_fields/field_technique.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

namespace limen::techniques {
namespace {

struct ObjectOcclusionSettings {
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/traced_occlusion/traced_occlusion.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/traced_occlusion";
  static constexpr gl::Format kFormat = gl::Format::RGBA32F;

  OcclusionRays rays;
  TracerSetting tracer;
  static const SettingsTable<ObjectOcclusionSettings>& table() {
    using S = ObjectOcclusionSettings;
    static const SettingsTable<S> kTable = {included(&S::rays), tracerBinding(&S::tracer)};
    return kTable;
  }
};

const RegisteredTechnique<TracedTechnique<ObjectOcclusionSettings>> kObjectOcclusion{
    {.name = "visibility_fields/traced_occlusion",
     .version = 1,
     .summary = "Ambient occlusion by the same rays as from visibility fields, traced on the GPU",
     .source = "Gaitatzes 2012, section 4.7 (MT-01, BL-02)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .reference = true,
     .followsMotion = true,
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
