// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/gpu_scene.h"

#include <epoxy/gl.h>

#include <glm/gtc/packing.hpp>

namespace limen::frame {
namespace {

std::vector<glm::vec3> relativePositions(const scene::Scene& scene, glm::dvec3 anchor) {
  std::vector<glm::vec3> out;
  out.reserve(scene.mesh.positions.size());
  for (const glm::dvec3& position : scene.mesh.positions) out.emplace_back(position - anchor);
  return out;
}

/// One RGBA8-packed albedo a triangle: constant over it, so no vertex has to carry it.
std::vector<uint32_t> albedos(const scene::Scene& scene) {
  std::vector<uint32_t> out(scene.mesh.triangles.size());
  for (const scene::Part& part : scene.parts) {
    const uint32_t packed = glm::packUnorm4x8(glm::vec4(scene.materials[part.material].albedo, 1.0F));
    for (uint32_t i = 0; i < part.triangleCount; ++i) out[part.firstTriangle + i] = packed;
  }
  return out;
}

glm::dvec3 anchorOf(const scene::Scene& scene) {
  const scene::Bounds bounds = scene.bounds();
  return bounds.empty() ? glm::dvec3(0.0) : bounds.centre();
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene)
    : scene_(scene),
      anchor_(anchorOf(scene)),
      triangleCount_(static_cast<uint32_t>(scene.mesh.triangles.size())),
      positions_(relativePositions(scene, anchor_)),
      indices_(scene.mesh.triangles),
      triangleAlbedo_(albedos(scene)) {
  glCreateVertexArrays(1, &vertexArray_);
  glVertexArrayVertexBuffer(vertexArray_, 0, positions_.id(), 0, sizeof(glm::vec3));
  glVertexArrayAttribFormat(vertexArray_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(vertexArray_, 0, 0);
  glEnableVertexArrayAttrib(vertexArray_, 0);
  glVertexArrayElementBuffer(vertexArray_, indices_.id());
}

GpuScene::~GpuScene() { glDeleteVertexArrays(1, &vertexArray_); }

int64_t GpuScene::bytes() const {
  return positions_.bytes() + indices_.bytes() + triangleAlbedo_.bytes() + (surface_ ? surface_->bytes() : 0);
}

const SurfaceBuffers& GpuScene::surface() const {
  if (!surface_) surface_.emplace(scene_, anchor_);
  return *surface_;
}

void GpuScene::draw() const {
  glBindVertexArray(vertexArray_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangleCount_ * 3), GL_UNSIGNED_INT, nullptr);
}

void GpuScene::bindStorage(uint32_t firstBinding) const {
  positions_.bindStorage(firstBinding);
  indices_.bindStorage(firstBinding + 1);
  triangleAlbedo_.bindStorage(firstBinding + 2);
}

}  // namespace limen::frame
