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

void EnvironmentLight::prepare(frame::Frame& frame) {
  const auto* lobe = std::get_if<PrefilteredLobe>(&settings_.prefilter);
  const auto* depth = std::get_if<DepthMap>(&settings_.lookup);
  const bool mipLevels = settings_.filter == MapFilter::Mip || lobe;
  surroundings_.emplace(frame, settings_.resolution, mipLevels, shading_, depth ? depth->layers : 1);
  if (lobe) filtered_.emplace(lobe->resolution, false);
  auto& programs = frame.context().programs();
  const std::string folder = "renderer/techniques/reflections/environment_map/";
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
  const int64_t bytes = surroundings_->bytes() + (filtered_ ? filtered_->bytes() : 0);
  frame.passes().setBytesHeld(kMapPass, bytes);
}

void EnvironmentLight::draw(frame::Frame& frame) {
  {
    const auto scope = frame.passes().open(kMapPass);
    surroundings_->draw(frame);
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
  return {
      {"mirror_px", rays},
      {"crack_px", cracks},
      {"missed_px", missed},
      {"triangles_drawn", (surroundings_->secondLayer() ? 12.0 : 6.0) * frame.gpuScene().triangleCount()}};
}

std::vector<Quantity> EnvironmentLight::counters() {
  return {{"mirror_px", "Pixels that see a mirror", "px", Direction::Neither},
          {"crack_px", "Pixels whose ray slips behind a border in the map", "px", Direction::LowerIsBetter},
          {"missed_px", "Pixels whose ray meets nothing in the map", "px", Direction::LowerIsBetter},
          {"triangles_drawn", "Triangles drawn in further views", "", Direction::LowerIsBetter}};
}

void EnvironmentLight::prefilter(const PrefilteredLobe& lobe) {
  int level = 0;
  while (settings_.resolution >> level > lobe.source) ++level;
  surroundings_->map().faces().bindTexture(kEnvironmentFacesUnit);
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
  const CubeMap& map = filtered_ ? *filtered_ : surroundings_->map();
  program.set("sizePx", frame.sizePx());
  program.set("resolution", settings_.resolution);
  program.set("mapResolution", map.resolution());
  program.set("centre", glm::vec3(surroundings_->middle()));
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
  surroundings_->map().faces().bindTexture(kEnvironmentFacesUnit);
  if (const CubeMap* second = surroundings_->secondLayer()) {
    second->bindCube(kEnvironmentSecondCubeUnit);
    second->faces().bindTexture(kEnvironmentSecondFacesUnit);
  }
  target.bindImage(kReflectionImage, under_ ? gl::Access::ReadWrite : gl::Access::Write);
  fates_->bindImage(kEnvironmentFateImage, gl::Access::Write);
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
