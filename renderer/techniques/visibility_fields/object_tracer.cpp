// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/object_tracer.h"

#include <epoxy/gl.h>

#include <vector>

#include "experiments/base/error.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

/// Numbered as in the scene, without those of no object, or without those of any.
std::vector<glm::uvec3> trianglesOf(const frame::Frame& frame, const vf::RigidObjects& objects,
                                    bool ofObjects = true) {
  std::vector<glm::uvec3> out = frame.scene().mesh.triangles;
  // Without area: left out of the tree, but counted.
  for (size_t i = 0; i < out.size(); ++i)
    if ((objects.objectOf[i] == vf::kFieldNoObject) == ofObjects) out[i] = glm::uvec3(0);
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

TracedTriangles treeOfObjects(frame::Frame& frame, const ReceiverRays& rays) {
  return {frame, trianglesOf(frame, objectsOf(frame, rays.objects))};
}

TracedTriangles treeWithoutObjects(frame::Frame& frame, const ReceiverRays& rays) {
  return {frame, trianglesOf(frame, objectsOf(frame, rays.objects), false)};
}

void ObjectTracer::prepare(frame::Frame& frame, const ReceiverRays& rays, const TracerSetting& tracer) {
  const vf::RigidObjects objects = objectsOf(frame, rays.objects);
  const auto* grid = std::get_if<GridTracer>(&tracer);
  if (grid && !frame.scene().motions.empty())
    throw Error("the cells of a grid are filled once, and parts of this scene move", "tracer",
                "use tracer: tree");
  if (grid)
    grid_.emplace(frame.context(), anchoredVertices(frame), trianglesOf(frame, objects), grid->density);
  else
    tree_.emplace(frame, trianglesOf(frame, objects));
  objectOf_.emplace(objects.objectOf);
}

void ObjectTracer::update(frame::Frame& frame) {
  if (tree_) tree_->update(frame);
}

gl::ShaderDefines ObjectTracer::defines(const TracerSetting& tracer) {
  gl::ShaderDefines defines;
  if (std::holds_alternative<GridTracer>(tracer)) defines["RAY_GRID"] = "1";
  return defines;
}

void ObjectTracer::bind(const gl::Program& program) const {
  (tree_ ? tree_->tree() : *grid_).bind(program);
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
