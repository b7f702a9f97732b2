// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion from visibility fields: the distance that a ray runs to an object is that to its bounding
// sphere and what the field says from there, so that cost does not depend on triangles. Source: Gaitatzes
// 2012, sections 4.4 to 4.7; several objects by the nearest hit of each ray (the bench's own), by products,
// or by passes that subtract (section 4.7.1, Fig. 41).
#include <algorithm>
#include <string>
#include <variant>

#include "experiments/base/error.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/field_technique.h"
#include "renderer/techniques/visibility_fields/near_receivers/near_setting.h"
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

namespace limen::techniques {
namespace {

// What becomes of several objects, by COMBINE.
struct NearestOfObjects {
  static constexpr const char *kKind = "nearest", *kSummary = "the nearest hit of each ray";
  static constexpr int kCode = kCombineNearest;
  NearSetting near = NearByField{};
  static const SettingsTable<NearestOfObjects>& table() {
    static const SettingsTable<NearestOfObjects> kTable = {nearBinding(&NearestOfObjects::near)};
    return kTable;
  }
};
struct ProductOfObjects {
  static constexpr const char *kKind = "product", *kSummary = "the product of what each leaves visible";
  static constexpr int kCode = kCombineProduct;
  static const SettingsTable<ProductOfObjects>& table() {
    static const SettingsTable<ProductOfObjects> kTable = {};
    return kTable;
  }
};
struct SubtractedObjects {
  static constexpr const char *kKind = "subtract",
                              *kSummary = "their occlusions subtracted one after another, in one pass";
  static constexpr int kCode = kCombineSubtract;
  static const SettingsTable<SubtractedObjects>& table() {
    static const SettingsTable<SubtractedObjects> kTable = {};
    return kTable;
  }
};
struct PassForEachObject {
  static constexpr const char *kKind = "passes", *kSummary = "subtracted in a full pass for each object";
  static constexpr int kCode = kCombinePasses;
  static const SettingsTable<PassForEachObject>& table() {
    static const SettingsTable<PassForEachObject> kTable = {};
    return kTable;
  }
};
using CombineSetting = std::variant<NearestOfObjects, ProductOfObjects, SubtractedObjects, PassForEachObject>;

struct FieldOcclusionSettings {
  static constexpr const char* kShader =
      "renderer/techniques/visibility_fields/ambient_occlusion/ambient_occlusion.comp.glsl";
  static constexpr const char* kNearShader =
      "renderer/techniques/visibility_fields/near_receivers/near_occlusion.comp.glsl";
  static constexpr const char* kDoubtfulShader =
      "renderer/techniques/visibility_fields/doubtful_rays/doubtful_occlusion.comp.glsl";
  static constexpr const char* kPass = "visibility_fields/occlusion";
  static constexpr gl::Format kFormat = gl::Format::RGBA32F;

  OcclusionRays rays;
  FieldReading field;
  CombineSetting combine;
  static const SettingsTable<FieldOcclusionSettings>& table() {
    using S = FieldOcclusionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::rays),
        included(&S::field),
        {&S::combine, "combine", "Several objects", "Gaitatzes 2012, section 4.7.1 (passes)"}};
    return kTable;
  }
  void check() const {
    checkNear(near(), field, "combine.near");
    if (field.use.spheres > 1 && !std::holds_alternative<NearestOfObjects>(combine))
      throw Error("'combine' other than nearest would count each of an object's 'spheres' by itself",
                  "spheres", "leave out 'spheres', or use combine: nearest");
  }
  NearSetting near() const {
    const auto* nearest = std::get_if<NearestOfObjects>(&combine);
    return nearest ? nearest->near : NearByField{};
  }
  int passes(uint32_t objects) const {
    return std::holds_alternative<PassForEachObject>(combine) ? std::max(static_cast<int>(objects), 1) : 1;
  }
  void define(gl::ShaderDefines& defines) const {
    std::visit([&](const auto& one) { defines["COMBINE"] = std::to_string(one.kCode); }, combine);
  }
};

const RegisteredTechnique<FieldTechnique<FieldOcclusionSettings>> kFieldOcclusion{
    {.name = "visibility_fields/ambient_occlusion",
     .version = 5,
     .summary = "Ambient occlusion by rays whose distances are looked up in fields around objects",
     .source = "Gaitatzes 2012, sections 4.4 to 4.7 (VF-01 to VF-18)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .followsMotion = true,
     .counters = FieldTechnique<FieldOcclusionSettings>::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
