// SPDX-License-Identifier: BSD-3-Clause
// Reference: the control mesh subdivided step by step in double precision on the CPU, its vertices pushed to
// their limits; it knows nothing of tables (renderer/surfaces/loop_subdivision.h, catmull_clark.h).
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

struct RecursiveSettings {
  int level = 5;
  double poseS = 0.0;
  frame::ShadedSetting shading;
  static const SettingsTable<RecursiveSettings>& table() {
    using S = RecursiveSettings;
    static const SettingsTable<S> kTable = {
        {&S::level, "level", {0, 7}, "steps", "Steps of subdivision"},
        {&S::poseS, "pose_s", {0.0, 3600.0}, "s", "Time of the joints' pose"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

uint32_t packedPlace(const glm::dvec3& value) {
  const auto bits = [](double x) {
    return static_cast<uint32_t>(std::lround(65535.0 * glm::clamp(x, 0.0, 1.0)));
  };
  return bits(value.x) | bits(value.y) << 16U;
}

/// Every corner of every face with the limit point and normal that it has there.
template <class Limit>
void addFaces(const surfaces::PolygonMesh& mesh, const Limit& limit, uint32_t material, glm::dvec3 anchor,
              const surfaces::PolygonMesh* values, const std::vector<glm::dvec3>& valueLimits,
              std::vector<TessellatedVertex>& out) {
  for (size_t f = 0; f < mesh.faces.size(); ++f)
    for (size_t i = 2; i < mesh.faces[f].size(); ++i)
      for (const size_t c : {size_t{0}, i - 1, i})
        out.push_back({glm::vec3(limit.points[mesh.faces[f][c]] - anchor), material,
                       glm::vec3(limit.normals[f][c]),
                       values ? packedPlace(valueLimits[values->faces[f][c]]) : kRungField});
}

/// Attributes as a mesh of their own, refined as positions are.
template <class Refine>
std::optional<surfaces::PolygonMesh> refinedValues(const surfaces::SubdivisionSurface& surface,
                                                   Refine refine) {
  if (!surface.attributes) return std::nullopt;
  return refine(surfaces::attributeMesh(surface.cage, *surface.attributes));
}

class RecursiveSubdivision : public Technique {
 public:
  using Settings = RecursiveSettings;
  explicit RecursiveSubdivision(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    if (scene.subdivisions.size() != 1)
      throw Error("the scene has " + std::to_string(scene.subdivisions.size()) + " subdivision surfaces", "",
                  "use a scene with one");
    const surfaces::SubdivisionSurface& surface = scene.subdivisions[0];
    if (surface.scheme == surfaces::SubdivisionScheme::Butterfly)
      throw Error("the reference has no Butterfly scheme", "scheme", "use loop or catmull_clark");
    surfaces::PolygonMesh cage = surface.cage;
    cage.points = skinned(surface, settings_.poseS);
    const uint32_t material = scene.parts[surface.part].material;
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    std::vector<TessellatedVertex> vertices;
    if (surface.scheme == surfaces::SubdivisionScheme::Loop) {
      const surfaces::PolygonMesh fine = surfaces::loop(std::move(cage), settings_.level);
      const std::optional<surfaces::PolygonMesh> values =
          refinedValues(surface, [&](const auto& mesh) { return surfaces::loop(mesh, settings_.level); });
      addFaces(fine, surfaces::loopLimit(fine), material, anchor, values ? &*values : nullptr,
               values ? surfaces::loopLimit(*values).points : std::vector<glm::dvec3>(), vertices);
    } else {
      const surfaces::PolygonMesh fine =
          surfaces::catmullClark(std::move(cage), std::max(1, settings_.level));
      const std::optional<surfaces::PolygonMesh> values = refinedValues(surface, [&](const auto& mesh) {
        return surfaces::catmullClark(mesh, std::max(1, settings_.level));
      });
      addFaces(fine, surfaces::catmullClarkLimit(fine), material, anchor, values ? &*values : nullptr,
               values ? surfaces::catmullClarkLimit(*values).points : std::vector<glm::dvec3>(), vertices);
    }
    count_ = static_cast<int>(vertices.size());
    vertices_.emplace(vertices);
    array_.emplace(*vertices_);
    picture_.emplace(frame, settings_.shading, "subdivision");
    program_ = &frame.context().programs().get(
        {"renderer/techniques/tessellation/compute/surface.vert.glsl",
         "renderer/techniques/tessellation/surface.frag.glsl"},
        surface.attributes ? gl::ShaderDefines{{"TEXTURED", "1"}} : gl::ShaderDefines{});
    frame.passes().setBytesHeld("subdivision/vertices", vertices_->bytes());
  }

  void render(frame::Frame& frame) override {
    picture_->render(frame, [&] {
      program_->use();
      program_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      glDrawArrays(GL_TRIANGLES, 0, count_);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

 private:
  Settings settings_;
  std::optional<SurfacePicture> picture_;
  std::optional<gl::Buffer> vertices_;
  std::optional<SurfaceVertexArray> array_;
  const gl::Program* program_ = nullptr;
  int count_ = 0;
};

const RegisteredTechnique<RecursiveSubdivision> kRecursiveSubdivisionRegistered{
    {.name = "subdivision/recursive",
     .version = 1,
     .summary =
         "Subdivision surfaces by recursion in double precision on the CPU, with the limit surface's normals",
     .source = "bench",
     .product = ProductKind::Colour,
     .needs = {"subdivision_surfaces"},
     .reference = true}};

}  // namespace
}  // namespace limen::techniques
