// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion of vertices from visibility fields on the CPU. Source: Gaitatzes 2012, section 4.6.1,
// Fig. 35 and Table 1.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/scene/part_motion.h"
#include "renderer/techniques/visibility_fields/vertex_occlusion/vertex_technique.h"
#include "renderer/visibility_fields/cpu_field.h"

namespace limen::techniques {
namespace {

constexpr double kMostBytes = 4.0 * (1 << 30);

struct VertexFieldSettings {
  VertexRays rays;
  visibility_fields::FieldForm form;
  HitFetch fetch = HitFetch::Aimed;
  static const SettingsTable<VertexFieldSettings>& table() {
    using S = VertexFieldSettings;
    static const SettingsTable<S> kTable = {included(&S::rays), included(&S::form),
                                            hitFetchBinding(&S::fetch)};
    return kTable;
  }
};

class VertexFieldOcclusion : public VertexTechnique {
 public:
  using Settings = VertexFieldSettings;
  explicit VertexFieldOcclusion(const Settings& settings)
      : VertexTechnique(settings.rays, "visibility_fields/vertex_occlusion"),
        form_(settings.form),
        fetch_(settings.fetch) {}

 protected:
  int64_t prepareObjects(const std::vector<visibility_fields::RigidObject>& objects) override {
    const double bytes = 4.0 * double(objects.size()) * form_.positions * form_.directions * form_.directions;
    if (bytes > kMostBytes)
      throw Error("fields of " + std::to_string(objects.size()) + " objects take " +
                      std::to_string(static_cast<int64_t>(bytes)) + " bytes of main memory",
                  "directions", "store fewer positions or directions");
    fields_.clear(), parts_.clear();
    for (const visibility_fields::RigidObject& object : objects) {
      fields_.emplace_back(object, form_);
      parts_.push_back(object.part);
    }
    toRest_.assign(objects.size(), glm::dmat4(1.0));
    int64_t held = 0;
    for (const visibility_fields::CpuField& field : fields_) held += 4 * field.rayCount();
    return held;
  }
  void distances(glm::dvec3 origin, std::span<const glm::dvec3> directions, double,
                 std::span<double> out) const override {
    std::fill(out.begin(), out.end(), -1.0);
    for (size_t object = 0; object < fields_.size(); ++object) {
      const glm::dvec3 from(toRest_[object] * glm::dvec4(origin, 1.0));
      const glm::dmat3 turned(toRest_[object]);
      for (size_t i = 0; i < directions.size(); ++i) {
        const double distance =
            fields_[object].distance(from, turned * directions[i], 0.0, fetch_ == HitFetch::Aimed);
        if (distance >= 0.0 && (out[i] < 0.0 || distance < out[i])) out[i] = distance;
      }
    }
  }
  void place(const scene::Scene& scene, double timeS) override {
    for (const scene::PartMotion& motion : scene.motions) {
      const glm::dmat4 back = glm::inverse(motion.at(timeS));
      for (size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i] == motion.part) toRest_[i] = back;
    }
  }
  void addCounters(std::vector<Counter>& counters) const override {
    double rays = 0.0;
    for (const visibility_fields::CpuField& field : fields_) rays += double(field.rayCount());
    counters.push_back({"field_rays", rays});
    counters.push_back({"field_objects", double(fields_.size())});
  }

 private:
  visibility_fields::FieldForm form_;
  HitFetch fetch_;
  std::vector<visibility_fields::CpuField> fields_;
  std::vector<uint32_t> parts_;     ///< of the objects
  std::vector<glm::dmat4> toRest_;  ///< from where each is to where its field was made
};

std::vector<Quantity> vertexFieldQuantities() {
  std::vector<Quantity> out = VertexTechnique::quantities();
  for (const Quantity& quantity : FieldReader::quantities())
    if (quantity.name == "field_rays" || quantity.name == "field_objects") out.push_back(quantity);
  return out;
}

const RegisteredTechnique<VertexFieldOcclusion> kVertexFieldOcclusion{
    {.name = "visibility_fields/vertex_occlusion",
     .version = 3,
     .summary = "Ambient occlusion of vertices that only receive, from visibility fields on the CPU",
     .source = "Gaitatzes 2012, section 4.6.1 (VF-15, VF-07)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .followsMotion = true,
     .onCpu = true,
     .counters = vertexFieldQuantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
