// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/environment_map/surroundings.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/techniques/reflections/moving_mirrors.h"
#include "renderer/techniques/reflections/reflection_bindings.h"

namespace limen::techniques {
namespace {

/// The mirror with the largest surface: its part, and the middle of its box relative to the anchor.
struct MapReflector {
  uint32_t part = ViewRaster::kNoGroup;
  glm::dvec3 middle{0.0};
};

MapReflector largestMapReflector(const scene::Scene& scene, glm::dvec3 anchor,
                                 const frame::ShownMirrors& shown) {
  MapReflector best;
  double most = -1.0;
  for (size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (!shown.has(p) || !scene.materials[part.material].reflects()) continue;
    double area = 0.0;
    scene::Bounds bounds;
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
      const glm::uvec3 of = scene.mesh.triangles[t];
      const glm::dvec3 a = scene.mesh.positions[of.x], b = scene.mesh.positions[of.y],
                       c = scene.mesh.positions[of.z];
      const double twice = glm::length(glm::cross(b - a, c - a));
      if (!std::isfinite(twice)) continue;
      area += 0.5 * twice;
      for (const glm::dvec3& corner : {a, b, c}) bounds.extend(corner - anchor);
    }
    if (area > most && !bounds.empty()) {
      most = area;
      best = {static_cast<uint32_t>(p), bounds.centre()};
    }
  }
  return best;
}

}  // namespace

Surroundings::Surroundings(frame::Frame& frame, int resolution, bool mipLevels,
                           const frame::ShadedSetting& shading, int layers)
    : shading_(shading) {
  const scene::Scene& scene = frame.scene();
  refuseMovingMirrors(frame, "a map of a mirror's surroundings has one place");
  const MapReflector reflector = largestMapReflector(scene, frame.gpuScene().anchor(), frame.shownMirrors());
  part_ = reflector.part, middle_ = reflector.middle;
  std::vector<uint32_t> partOf(scene.mesh.triangles.size());
  for (size_t p = 0; p < scene.parts.size(); ++p)
    std::fill_n(partOf.begin() + scene.parts[p].firstTriangle, scene.parts[p].triangleCount, uint32_t(p));
  first_.emplace(frame, resolution, partOf, ViewRaster::Shown::Nearest, mipLevels);
  if (layers == 2)
    second_.emplace(frame, resolution, partOf, ViewRaster::Shown::FrontsBehindDepth, mipLevels);
  gl::ShaderDefines defines = frame::shadingDefines(shading_, frame);
  defines.erase("SHADOW");
  program_ = &frame.context().programs().compute(
      "renderer/techniques/reflections/environment_map/environment_face.comp.glsl", defines);
}

int64_t Surroundings::bytes() const {
  int64_t bytes = 0;
  for (const std::optional<Layer>* layer : {&first_, &second_})
    if (*layer) bytes += (*layer)->raster.bytes() + (*layer)->map.bytes();
  return bytes;
}

void Surroundings::draw(frame::Frame& frame) {
  for (int face = 0; face < 6; ++face) drawFace(frame, face);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  first_->map.makeLevels();
  if (second_) second_->map.makeLevels();
}

void Surroundings::drawFace(frame::Frame& frame, int face) {
  const CubeFace of = cubeFace(face);
  glm::dmat4 clip(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    clip[axis][0] = of.right[axis];
    clip[axis][1] = -of.down[axis];
    clip[axis][3] = of.forward[axis];
  }
  clip[3] = -(clip * glm::dvec4(middle_, 0.0));
  clip[3][2] = frame::nearPlane(frame);
  const glm::vec4 everything(0.0F, 0.0F, 0.0F, 1.0F);
  first_->raster.clear();
  first_->raster.draw(frame, glm::mat4(clip), everything, part_);
  shadeFace(frame, *first_, face);
  if (!second_) return;
  second_->raster.clear();
  second_->raster.draw(frame, glm::mat4(clip), everything, part_, &first_->raster.depth());
  shadeFace(frame, *second_, face);
}

void Surroundings::shadeFace(frame::Frame& frame, const Layer& layer, int face) {
  frame::configureShading(*program_, frame, shading_);
  program_->set("sizePx", glm::ivec2(layer.map.resolution()));
  program_->set("face", face);
  program_->set("centre", glm::vec3(middle_));
  program_->set("flatShading", shading_.smoothNormals ? 0 : 1);
  layer.raster.ids().bindTexture(kEnvironmentIdsUnit);
  layer.map.faces().bindImage(kReflectionImage, gl::Access::Write);
  program_->dispatch(glm::ivec2(layer.map.resolution()));
}

}  // namespace limen::techniques
