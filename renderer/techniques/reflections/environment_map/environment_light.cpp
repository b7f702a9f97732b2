// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/environment_map/environment_light.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/reflections/reflection_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kMapPass = "reflections/environment_map", *kLookPass = "reflections/environment_lookup",
                     *kPrefilterPass = "reflections/prefilter";

}  // namespace

EnvironmentLight::Reflector EnvironmentLight::largestReflector(const scene::Scene& scene, glm::dvec3 anchor) {
  Reflector best;
  double most = -1.0;
  for (size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (!scene.materials[part.material].reflects()) continue;
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

void EnvironmentLight::prepare(frame::Frame& frame) {
  const scene::Scene& scene = frame.scene();
  reflector_ = largestReflector(scene, frame.gpuScene().anchor());
  std::vector<uint32_t> partOf(scene.mesh.triangles.size());
  for (size_t p = 0; p < scene.parts.size(); ++p)
    std::fill_n(partOf.begin() + scene.parts[p].firstTriangle, scene.parts[p].triangleCount, uint32_t(p));
  const auto* lobe = std::get_if<PrefilteredLobe>(&settings_.prefilter);
  const auto* depth = std::get_if<DepthMap>(&settings_.lookup);
  const bool mipLevels = settings_.filter == MapFilter::Mip || lobe;
  first_.emplace(frame, settings_.resolution, partOf, ViewRaster::Shown::Nearest, mipLevels);
  if (depth && depth->layers == 2)
    second_.emplace(frame, settings_.resolution, partOf, ViewRaster::Shown::FrontsBehindDepth, mipLevels);
  if (lobe) filtered_.emplace(lobe->resolution, false);
  gl::ShaderDefines defines = frame::shadingDefines(shading_, frame);
  defines.erase("SHADOW");
  auto& programs = frame.context().programs();
  const std::string folder = "renderer/techniques/reflections/environment_map/";
  face_ = &programs.compute(folder + "environment_face.comp.glsl", defines);
  prefilter_ = &programs.compute(folder + "prefilter.comp.glsl", {});
  gl::ShaderDefines look;
  defineEnum(look, "FILTER", settings_.filter);
  if (std::holds_alternative<FiniteMap>(settings_.lookup)) look["FINITE"] = "1";
  look["LAYERS"] = std::to_string(depth ? depth->layers : 0);
  if (under_) look["UNDER"] = "1";
  look_ = &programs.compute(folder + "environment_look.comp.glsl", look);
  look["COUNT"] = "1";
  countLook_ = &programs.compute(folder + "environment_look.comp.glsl", look);
  fates_.emplace(gl::Format::R32UI, frame.sizePx());
  int64_t bytes = filtered_ ? filtered_->bytes() : 0;
  for (const std::optional<Layer>* layer : {&first_, &second_})
    if (*layer) bytes += (*layer)->raster.bytes() + (*layer)->map.bytes();
  frame.passes().setBytesHeld(kMapPass, bytes);
}

void EnvironmentLight::draw(frame::Frame& frame) {
  {
    const auto scope = frame.passes().open(kMapPass);
    for (int face = 0; face < 6; ++face) drawFace(frame, face);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    first_->map.makeLevels();
    if (second_) second_->map.makeLevels();
  }
  if (const auto* lobe = std::get_if<PrefilteredLobe>(&settings_.prefilter)) {
    const auto scope = frame.passes().open(kPrefilterPass);
    prefilter(*lobe);
  }
}

void EnvironmentLight::look(frame::Frame& frame, const frame::MirrorRays& rays, const gl::Texture& target) {
  const auto scope = frame.passes().open(kLookPass);
  look(frame, rays, *look_, target);
}

std::vector<Counter> EnvironmentLight::count(frame::Frame& frame, const gl::Texture& target) {
  look(frame, frame.get<frame::MirrorRays>(), *countLook_, target);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  double rays = 0.0, cracks = 0.0, missed = 0.0;
  for (const uint32_t fate : fates_->readUint()) {
    rays += fate != kEnvironmentNoRay;
    cracks += fate == kEnvironmentCrack || fate == kEnvironmentMetBehindCrack;
    missed += fate == kEnvironmentMissed || fate == kEnvironmentCrack;
  }
  return {{"mirror_px", rays},
          {"crack_px", cracks},
          {"missed_px", missed},
          {"triangles_drawn", (second_ ? 12.0 : 6.0) * frame.gpuScene().triangleCount()}};
}

std::vector<Quantity> EnvironmentLight::counters() {
  return {{"mirror_px", "Pixels that see a mirror", "px", Direction::Neither},
          {"crack_px", "Pixels whose ray slips behind a border in the map", "px", Direction::LowerIsBetter},
          {"missed_px", "Pixels whose ray meets nothing in the map", "px", Direction::LowerIsBetter},
          {"triangles_drawn", "Triangles drawn in further views", "", Direction::LowerIsBetter}};
}

void EnvironmentLight::drawFace(frame::Frame& frame, int face) {
  const CubeFace of = cubeFace(face);
  glm::dmat4 clip(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    clip[axis][0] = of.right[axis];
    clip[axis][1] = -of.down[axis];
    clip[axis][3] = of.forward[axis];
  }
  clip[3] = -(clip * glm::dvec4(reflector_.middle, 0.0));
  clip[3][2] = frame::nearPlane(frame);
  const glm::vec4 everything(0.0F, 0.0F, 0.0F, 1.0F);
  first_->raster.clear();
  first_->raster.draw(frame, glm::mat4(clip), everything, reflector_.part);
  shadeFace(frame, *first_, face);
  if (!second_) return;
  second_->raster.clear();
  second_->raster.draw(frame, glm::mat4(clip), everything, reflector_.part, &first_->raster.depth());
  shadeFace(frame, *second_, face);
}

void EnvironmentLight::shadeFace(frame::Frame& frame, const Layer& layer, int face) {
  frame::configureShading(*face_, frame, shading_);
  face_->set("sizePx", glm::ivec2(settings_.resolution));
  face_->set("face", face);
  face_->set("centre", glm::vec3(reflector_.middle));
  face_->set("flatShading", shading_.smoothNormals ? 0 : 1);
  layer.raster.ids().bindTexture(kEnvironmentIdsUnit);
  layer.map.faces().bindImage(kReflectionImage, gl::Access::Write);
  face_->dispatch(glm::ivec2(settings_.resolution));
}

void EnvironmentLight::prefilter(const PrefilteredLobe& lobe) {
  int level = 0;
  while (settings_.resolution >> level > lobe.source) ++level;
  first_->map.faces().bindTexture(kEnvironmentFacesUnit);
  filtered_->faces().bindImage(kReflectionImage, gl::Access::Write);
  prefilter_->set("sourceLevel", level);
  prefilter_->set("sourceResolution", settings_.resolution >> level);
  prefilter_->set("resolution", lobe.resolution);
  prefilter_->set("exponent", static_cast<float>(lobe.exponent));
  for (int face = 0; face < 6; ++face) {
    prefilter_->set("face", face);
    prefilter_->dispatch(glm::ivec2(lobe.resolution));
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void EnvironmentLight::look(frame::Frame& frame, const frame::MirrorRays& rays, const gl::Program& program,
                            const gl::Texture& target) {
  const CubeMap& map = filtered_ ? *filtered_ : first_->map;
  program.set("sizePx", frame.sizePx());
  program.set("resolution", settings_.resolution);
  program.set("mapResolution", map.resolution());
  program.set("centre", glm::vec3(reflector_.middle));
  const double diagonal = frame.gpuScene().diagonal();
  if (const auto* finite = std::get_if<FiniteMap>(&settings_.lookup))
    program.set("radius", static_cast<float>(finite->radius * diagonal));
  if (const auto* depth = std::get_if<DepthMap>(&settings_.lookup)) {
    program.set("steps", depth->steps);
    program.set("refinements", depth->refinements);
    program.set("crackShare", static_cast<float>(depth->crackShare));
    program.set("reach", static_cast<float>(0.1 * diagonal));
  }
  rays.origins().bindTexture(kReflectionOriginsUnit);
  rays.directions().bindTexture(kReflectionDirectionsUnit);
  map.bindCube(kEnvironmentCubeUnit);
  map.faces().bindTexture(kEnvironmentMapFacesUnit);
  first_->map.faces().bindTexture(kEnvironmentFacesUnit);
  if (second_) {
    second_->map.bindCube(kEnvironmentSecondCubeUnit);
    second_->map.faces().bindTexture(kEnvironmentSecondFacesUnit);
  }
  target.bindImage(kReflectionImage, under_ ? gl::Access::ReadWrite : gl::Access::Write);
  fates_->bindImage(kEnvironmentFateImage, gl::Access::Write);
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
