// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scatter/light_layers.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace limen::techniques {
namespace {

/// As in shadow maps: nothing is considered more than 75 degrees off the light's direction, or nearer than a
/// thousandth of the farthest.
constexpr double kWidestTangent = 3.7320508075688772, kNearestShare = 1e-3;

std::vector<scene::TriangleRange> rangesOf(const scene::Scene& scene, bool receiverOnly) {
  std::vector<scene::TriangleRange> out;
  for (const scene::Part& part : scene.parts)
    if (part.receiverOnly == receiverOnly) out.push_back({part.firstTriangle, part.triangleCount});
  return out;
}

}  // namespace

LightLayers::LightLayers(frame::Frame& frame, int resolution, int receiverResolution, bool withSecond)
    : program_(frame.context().programs().get(
          {"renderer/frame/shadow.vert.glsl", "renderer/frame/shadow.frag.glsl"})),
      casterFrustum_(frame::LightCasters(frame.scene()).fit(glm::dvec2(0.0), resolution)),
      casterRanges_(frame.scene().parts.size()),
      receiverRanges_(frame.scene().parts.size()) {
  fitReceivers(frame.scene());
  casterRanges_.set(rangesOf(frame.scene(), false));
  receiverRanges_.set(rangesOf(frame.scene(), true));
  nearest_.emplace(gl::Format::Depth32F, glm::ivec2(resolution));
  nearestTarget_.emplace(std::vector<const gl::Texture*>{}, &*nearest_);
  if (withSecond) {
    farthest_.emplace(gl::Format::Depth32F, glm::ivec2(resolution));
    farthestTarget_.emplace(std::vector<const gl::Texture*>{}, &*farthest_);
  }
  receivers_.emplace(gl::Format::Depth32F, glm::ivec2(receiverResolution));
  receiverTarget_.emplace(std::vector<const gl::Texture*>{}, &*receivers_);
}

void LightLayers::fitReceivers(const scene::Scene& scene) {
  const scene::AreaLight& light = scene.lights.at(0);
  const glm::dmat4 toLight = light.toLightSpace();
  std::vector<glm::dvec3> corners;
  for (const scene::Part& part : scene.parts) {
    if (!part.receiverOnly) continue;
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
      for (int k = 0; k < 3; ++k) {
        corners.emplace_back(toLight * glm::dvec4(scene.mesh.positions[scene.mesh.triangles[i][k]], 1.0));
        farthestReceiver_ = std::max(farthestReceiver_, corners.back().z);
      }
  }
  const double limit = kNearestShare * (farthestReceiver_ > 0.0 ? farthestReceiver_ : 1.0);
  double nearest = std::max(farthestReceiver_, limit);
  glm::dvec2 low(kWidestTangent), high(-kWidestTangent);
  for (const glm::dvec3& q : corners) {
    nearest = std::min(nearest, std::max(q.z, limit));
    if (q.z < limit) {  // reaches past the light's plane: all directions
      low = glm::dvec2(-kWidestTangent), high = glm::dvec2(kWidestTangent);
      continue;
    }
    low = glm::min(low, glm::dvec2(q) / q.z), high = glm::max(high, glm::dvec2(q) / q.z);
  }
  // A caster at z shadows receivers up to w/2 (1/z - 1/p_z) beside it, in tangents.
  const glm::dvec2 reach =
      0.5 * light.size * std::max(1.0 / casterFrustum_.near - 1.0 / std::max(farthestReceiver_, limit), 0.0);
  low = glm::clamp(glm::max(low, casterFrustum_.low - reach), -kWidestTangent, kWidestTangent);
  high = glm::clamp(glm::min(high, casterFrustum_.high + reach), -kWidestTangent, kWidestTangent);
  receiverFrustum_.low = low;
  receiverFrustum_.high = glm::max(high, low + 1e-6);
  receiverFrustum_.near = 0.999 * nearest;
}

void LightLayers::pass(frame::Frame& frame, const gl::Framebuffer& target, const frame::LightFrustum& frustum,
                       const frame::TriangleRanges& ranges, bool nearest, Faces faces) const {
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  target.bind();
  const GLfloat nothing = nearest ? 0.0F : 1.0F;
  glClearBufferfv(GL_DEPTH, 0, &nothing);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(nearest ? GL_GREATER : GL_LESS);
  if (faces == Faces::All) {
    glDisable(GL_CULL_FACE);
  } else {
    // Light space looks along +z, which mirrors, and rows grow with y, which mirrors again: triangles that
    // are counter-clockwise seen from outside are so in the picture if they face the light.
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(faces == Faces::Towards ? GL_BACK : GL_FRONT);
  }
  program_.use();
  program_.set("anchorToClip", glm::mat4(frustum.clipFromLight() * toLight));
  frame.gpuScene().draw(&ranges);
  glDisable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glDisable(GL_DEPTH_TEST);
}

void LightLayers::draw(frame::Frame& frame, Faces nearest, Faces farthest) const {
  pass(frame, *nearestTarget_, casterFrustum_, casterRanges_, true, nearest);
  if (farthestTarget_) pass(frame, *farthestTarget_, casterFrustum_, casterRanges_, false, farthest);
  pass(frame, *receiverTarget_, receiverFrustum_, receiverRanges_, true, Faces::All);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

int64_t LightLayers::bytes() const {
  return nearest_->bytes() + (farthest_ ? farthest_->bytes() : 0) + receivers_->bytes();
}

}  // namespace limen::techniques
