// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/object_tracer.h"

#include <epoxy/gl.h>

#include <utility>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/triangle_grid.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

struct ObjectTriangles {
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
};

/// Numbered as in the scene, without those of no object, or without those of any.
ObjectTriangles objectTriangles(const frame::Frame& frame, const vf::RigidObjects& objects,
                                bool ofObjects = true) {
  const scene::Mesh& mesh = frame.scene().mesh;
  ObjectTriangles out{{}, mesh.triangles};
  for (const glm::dvec3 p : mesh.positions) out.vertices.emplace_back(p - frame.gpuScene().anchor());
  // Without area: left out of the tree, but counted.
  for (size_t i = 0; i < out.triangles.size(); ++i)
    if ((objects.objectOf[i] == vf::kFieldNoObject) == ofObjects) out.triangles[i] = glm::uvec3(0);
  return out;
}


}  // namespace

const SettingsTable<TreeTracer>& TreeTracer::table() {
  static const SettingsTable<TreeTracer> kTable = {};
  return kTable;
}

const SettingsTable<GridTracer>& GridTracer::table() {
  static const SettingsTable<GridTracer> kTable = {
      {&GridTracer::density, "density", {0.01, 64.0}, "", "Cells per triangle", "Cleary and Wyvill 1988"}};
  return kTable;
}

ray_tracing::RayScene raysOfObjects(frame::Frame& frame, const ReceiverRays& rays) {
  const ObjectTriangles all = objectTriangles(frame, objectsOf(frame, rays.objects));
  return {frame.context(), all.vertices, all.triangles};
}

ray_tracing::RayScene raysWithoutObjects(frame::Frame& frame, const ReceiverRays& rays) {
  const ObjectTriangles others = objectTriangles(frame, objectsOf(frame, rays.objects), false);
  return {frame.context(), others.vertices, others.triangles};
}

void ObjectTracer::prepare(frame::Frame& frame, const ReceiverRays& rays, const TracerSetting& tracer) {
  const vf::RigidObjects objects = objectsOf(frame, rays.objects);
  const ObjectTriangles all = objectTriangles(frame, objects);
  const auto* grid = std::get_if<GridTracer>(&tracer);
  if (!frame.scene().motions.empty()) {
    if (grid)
      throw Error("the cells of a grid are filled once, and parts of this scene move", "tracer",
                  "use tracer: tree");
    auto rebuilt = std::make_unique<ray_tracing::RebuiltTree>(frame.context(),
                                                              static_cast<uint32_t>(all.triangles.size()));
    rebuilt_ = rebuilt.get();
    rays_ = std::move(rebuilt);
    indices_.emplace(all.triangles);
  } else if (grid)
    rays_ = std::make_unique<ray_tracing::TriangleGrid>(frame.context(), all.vertices, all.triangles,
                                                        grid->density);
  else
    rays_ = std::make_unique<ray_tracing::RayScene>(frame.context(), all.vertices, all.triangles);
  objectOf_.emplace(objects.objectOf);
}

void ObjectTracer::update(frame::Frame& frame) {
  if (rebuilt_) rebuilt_->build(frame.passes(), frame.positions(), *indices_);
}

gl::ShaderDefines ObjectTracer::defines(const TracerSetting& tracer) {
  gl::ShaderDefines defines;
  if (std::holds_alternative<GridTracer>(tracer)) defines["RAY_GRID"] = "1";
  return defines;
}

void ObjectTracer::bind(const gl::Program& program) const {
  rays_->bind(program);
  objectOf_->bindStorage(vf::kFieldObjectOfBuffer);
}

void ObjectTracer::dispatchRows(const gl::Program& program, frame::Frame& frame, int rows) {
  const int atOnce = frame.context().device().software ? 1 : rows;
  for (int row = 0; row < rows; row += atOnce) {
    program.set("firstRow", row);
    program.set("lastRow", row + atOnce - 1);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

}  // namespace limen::techniques
