// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/gpu_scene.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/ray_tracing/ray_scene.h"

namespace limen::frame {
namespace {

std::vector<glm::vec3> relativePositions(const scene::Scene& scene, glm::dvec3 anchor) {
  std::vector<glm::vec3> out;
  out.reserve(scene.mesh.positions.size() + scene.coarser.positions.size());
  for (const scene::Mesh* mesh : {&scene.mesh, &scene.coarser})
    for (const glm::dvec3& position : mesh->positions) out.emplace_back(position - anchor);
  return out;
}

std::vector<glm::uvec3> joinedIndices(const scene::Scene& scene) {
  std::vector<glm::uvec3> out = scene.mesh.triangles;
  const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
  for (const glm::uvec3& triangle : scene.coarser.triangles) out.push_back(triangle + first);
  return out;
}

glm::dvec3 anchorOf(const scene::Bounds& bounds) {
  return bounds.empty() ? glm::dvec3(0.0) : bounds.centre();
}

/// The anchor is the centre.
double reachOf(const scene::Bounds& bounds) {
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.high - bounds.low;
  return 0.5 * std::max({size.x, size.y, size.z});
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene)
    : scene_(scene),
      anchor_(anchorOf(scene.bounds())),
      diagonal_(scene.bounds().diagonal()),
      reach_(reachOf(scene.bounds())),
      triangleCount_(static_cast<uint32_t>(scene.mesh.triangles.size())),
      vertexCount_(static_cast<uint32_t>(scene.mesh.positions.size() + scene.coarser.positions.size())),
      positions_(relativePositions(scene, anchor_)),
      indices_(joinedIndices(scene)),
      firstTriangle_(std::vector<glm::uvec2>{glm::uvec2(0)}) {
  glCreateVertexArrays(1, &vertexArray_);
  glVertexArrayAttribFormat(vertexArray_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(vertexArray_, 0, 0);
  glEnableVertexArrayAttrib(vertexArray_, 0);
  // One value per draw: an instanced attribute starts at the draw's base instance.
  glVertexArrayAttribIFormat(vertexArray_, 1, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(vertexArray_, 1, 1);
  glVertexArrayBindingDivisor(vertexArray_, 1, 1);
  glEnableVertexArrayAttrib(vertexArray_, 1);
  glVertexArrayElementBuffer(vertexArray_, indices_.id());
}

GpuScene::~GpuScene() { glDeleteVertexArrays(1, &vertexArray_); }

int64_t GpuScene::bytes() const {
  return positions_.bytes() + indices_.bytes() + (surface_ ? surface_->bytes() : 0) +
         (rays_ ? rays_->bytes() : 0);
}

const SurfaceBuffers& GpuScene::surface() const {
  if (!surface_) surface_.emplace(scene_, anchor_);
  return *surface_;
}

const ray_tracing::RayScene& GpuScene::rays(gl::Context& context) const {
  if (!scene_.motions.empty())
    throw Error("a tree is kept of triangles at rest, and parts of scene '" + scene_.name + "' move", {},
                "have the tree rebuilt or refitted in each frame, or choose a scene at rest");
  if (!rays_) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene_.mesh.positions.size());
    for (const glm::dvec3& position : scene_.mesh.positions) positions.emplace_back(position - anchor_);
    rays_ = std::make_unique<ray_tracing::RayScene>(context, positions, scene_.mesh.triangles);
  }
  return *rays_;
}

void GpuScene::draw(const TriangleRanges* ranges, const gl::Buffer* positions) const {
  glVertexArrayVertexBuffer(vertexArray_, 0, (positions ? *positions : positions_).id(), 0,
                            sizeof(glm::vec3));
  glVertexArrayVertexBuffer(vertexArray_, 1, (ranges ? ranges->ranges() : firstTriangle_).id(), 0,
                            sizeof(glm::uvec2));
  glBindVertexArray(vertexArray_);
  if (!ranges) {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangleCount_ * 3), GL_UNSIGNED_INT, nullptr);
    return;
  }
  if (ranges->rangeCount() == 0) return;
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, ranges->commands().id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, ranges->rangeCount(), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void GpuScene::bindStorage(const gl::Buffer* positions) const {
  (positions ? *positions : positions_).bindStorage(kScenePositionsBuffer);
  indices_.bindStorage(kSceneIndicesBuffer);
}

}  // namespace limen::frame
