// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/vertex_occlusion, traced by Embree: a ray caster with a bounding hierarchy on
// the CPU. Source: Gaitatzes 2012, section 4.6 (BL-01).
#include <optional>

#include "renderer/techniques/visibility_fields/vertex_occlusion/vertex_technique.h"
#include "renderer/visibility_fields/object_rays.h"

namespace limen::techniques {
namespace {

struct TracedVertexSettings {
  VertexRays rays;
  static const SettingsTable<TracedVertexSettings>& table() {
    static const SettingsTable<TracedVertexSettings> kTable = {included(&TracedVertexSettings::rays)};
    return kTable;
  }
};

class TracedVertexOcclusion : public VertexTechnique {
 public:
  using Settings = TracedVertexSettings;
  explicit TracedVertexOcclusion(const Settings& settings)
      : VertexTechnique(settings.rays, "visibility_fields/traced_vertex_occlusion") {}

 protected:
  /// All objects in one tree, relative to the first one's centre.
  int64_t prepareObjects(const std::vector<visibility_fields::RigidObject>& objects) override {
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;
    if (!objects.empty()) middle_ = objects[0].sphere.centre;
    for (const visibility_fields::RigidObject& object : objects) {
      const auto first = static_cast<uint32_t>(vertices.size());
      for (const glm::vec3 v : object.vertices)
        vertices.emplace_back(object.sphere.centre - middle_ + object.sphere.radius * glm::dvec3(v));
      for (const glm::uvec3 t : object.triangles) triangles.push_back(t + first);
    }
    rays_.emplace(vertices, triangles);
    return static_cast<int64_t>(vertices.size() * sizeof(glm::vec3) + triangles.size() * sizeof(glm::uvec3));
  }
  void distances(glm::dvec3 origin, std::span<const glm::dvec3> directions, double far,
                 std::span<double> out) const override {
    glm::vec3 ways[visibility_fields::ObjectRays::kPacketRays];
    float found[visibility_fields::ObjectRays::kPacketRays];
    for (size_t i = 0; i < directions.size(); ++i) ways[i] = glm::vec3(directions[i]);
    rays_->trace(glm::vec3(origin - middle_), {ways, directions.size()}, static_cast<float>(far), found);
    std::copy(found, found + directions.size(), out.begin());
  }

 private:
  glm::dvec3 middle_{0.0};
  std::optional<visibility_fields::ObjectRays> rays_;
};

const RegisteredTechnique<TracedVertexOcclusion> kTracedVertexOcclusion{
    {.name = "visibility_fields/traced_vertex_occlusion",
     .version = 1,
     .summary = "Ambient occlusion of vertices by the same rays as from visibility fields, traced on the CPU",
     .source = "Gaitatzes 2012, section 4.6 (BL-01, MT-01)",
     .product = ProductKind::Colour,
     .needs = {"casters"},
     .reference = true,
     .onCpu = true,
     .counters = VertexTechnique::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
