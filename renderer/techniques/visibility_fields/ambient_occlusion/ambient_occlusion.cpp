// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion from visibility fields: the distance that a ray runs to an object is that to its bounding
// sphere and what the field says from there, so that cost does not depend on triangles. Source: Gaitatzes
// 2012, sections 4.4 to 4.7; several objects by the nearest hit of each ray (the bench's own), by products,
// or by passes that subtract (section 4.7.1, Fig. 41).
#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/techniques/visibility_fields/field_technique.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

namespace limen::techniques {
namespace {

enum class CombineObjects { Nearest, Product, Subtract, Passes };
constexpr EnumNames<CombineObjects, 4> enumNames(CombineObjects) {
  return {{{{CombineObjects::Nearest, "nearest"},
            {CombineObjects::Product, "product"},
            {CombineObjects::Subtract, "subtract"},
            {CombineObjects::Passes, "passes"}}}};
}
static_assert(static_cast<int>(CombineObjects::Nearest) == kCombineNearest &&
              static_cast<int>(CombineObjects::Product) == kCombineProduct &&
              static_cast<int>(CombineObjects::Subtract) == kCombineSubtract &&
              static_cast<int>(CombineObjects::Passes) == kCombinePasses);

struct FieldOcclusionSettings {
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/ambient_occlusion/ambient_occlusion.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/occlusion";
  static constexpr gl::Format kFormat = gl::Format::RGBA32F;

  OcclusionRays rays;
  FieldReading field;
  CombineObjects combine = CombineObjects::Nearest;
  static const SettingsTable<FieldOcclusionSettings>& table() {
    using S = FieldOcclusionSettings;
    static const SettingsTable<S> kTable = {included(&S::rays),
                                            included(&S::field),
                                            {&S::combine, "combine",
                                             "Several objects: the nearest hit of each ray, the product of "
                                             "what each leaves visible, or their occlusions "
                                             "subtracted one after another, in one pass or in a full pass "
                                             "for each object",
                                             "Gaitatzes 2012, section 4.7.1 (passes)"}};
    return kTable;
  }
  void check() const {
    if (field.use.spheres > 1 && combine != CombineObjects::Nearest)
      throw Error(std::string("'combine: ") + limen::toText(combine) +
                      "' would count each of an object's 'spheres' by itself",
                  "spheres", "leave out 'spheres', or use combine: nearest");
  }
  int passes(uint32_t objects) const {
    return combine == CombineObjects::Passes ? std::max(static_cast<int>(objects), 1) : 1;
  }
  void define(gl::ShaderDefines& defines) const {
    defines["COMBINE"] = std::to_string(static_cast<int>(combine));
  }
};

const RegisteredTechnique<FieldTechnique<FieldOcclusionSettings>> kFieldOcclusion{
    {.name = "visibility_fields/ambient_occlusion",
     .version = 2,
     .summary = "Ambient occlusion by rays whose distances are looked up in fields around objects",
     .source = "Gaitatzes 2012, sections 4.4 to 4.7 (VF-01 to VF-18)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .counters = FieldReader::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
