// SPDX-License-Identifier: BSD-3-Clause
// The rays of visibility_fields/vertex_occlusion, traced by Embree: a ray caster with a bounding hierarchy on
// the CPU. Source: Gaitatzes 2012, section 4.6 (BL-01).
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/part_motion.h"
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
    rest_.clear(), vertices_.clear(), triangles_.clear(), ranges_.clear();
    if (!objects.empty()) middle_ = objects[0].sphere.centre;
    for (const visibility_fields::RigidObject& object : objects) {
      const size_t first = rest_.size();
      for (const glm::vec3 v : object.vertices) {
        rest_.push_back(object.sphere.centre + object.sphere.radius * glm::dvec3(v));
        vertices_.emplace_back(rest_.back() - middle_);
      }
      for (const glm::uvec3 t : object.triangles) triangles_.push_back(t + static_cast<uint32_t>(first));
      ranges_.push_back({object.part, first, rest_.size()});
    }
    rays_.emplace(vertices_, triangles_);
    return static_cast<int64_t>(vertices_.size() * sizeof(glm::vec3) +
                                triangles_.size() * sizeof(glm::uvec3));
  }
  /// Builds the tree anew of moved vertices, whatever poses fields are placed in.
  void place(const scene::Scene& scene, double timeS) override {
    for (const scene::PartMotion& motion : scene.motions) {
      const glm::dmat4 now = motion.at(timeS);
      for (const Range& range : ranges_)
        for (size_t i = range.first; i < range.last && range.part == motion.part; ++i)
          vertices_[i] = glm::vec3(glm::dvec3(now * glm::dvec4(rest_[i], 1.0)) - middle_);
    }
    rays_.emplace(vertices_, triangles_);
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
  struct Range {  ///< of an object's vertices
    uint32_t part;
    size_t first, last;
  };
  glm::dvec3 middle_{0.0};
  std::vector<glm::dvec3> rest_;
  std::vector<glm::vec3> vertices_;
  std::vector<glm::uvec3> triangles_;
  std::vector<Range> ranges_;
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
     .followsMotion = true,
     .onCpu = true,
     .counters = VertexTechnique::quantities(),
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
