// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/virtual_lights.h"

#include <epoxy/gl.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kLightsPass = "many_lods/virtual_lights";

}  // namespace

const SettingsTable<VirtualLightSettings>& VirtualLightSettings::table() {
  using S = VirtualLightSettings;
  static const SettingsTable<S> kTable = {
      {&S::count, "lights", {1, 65536}, "", "Virtual point lights", "Holländer 2013, section 3.6.2 (1,024)"},
      {&S::turnDeg,
       "turn",
       {0.0, 90.0},
       "deg",
       "Angle by which the light turns about the scene's middle in a frame",
       "Holländer 2013, table 3.1 (about 10)"},
      {&S::framesBefore,
       "frames_before",
       {0, 64},
       "",
       "Frames of that motion before the first picture, at whose end the light is in its place"},
      {&S::clamp,
       "clamp",
       {0.0, 1.0},
       "",
       "Distance from a virtual light below which its light grows no more, share of the scene's diagonal",
       "Keller 1997 (the bound is usual; Holländer 2013 gives none)"},
      {&S::gain, "gain", {0.0, 1000.0}, "", "Factor on the light, for pictures of a useful brightness"}};
  return kTable;
}

VirtualLights::VirtualLights(frame::Frame& frame, const VirtualLightSettings& settings)
    : settings_(settings),
      range_(1.01 * frame.gpuScene().diagonal()),
      leastDistance2_(std::pow(settings.clamp * frame.gpuScene().diagonal(), 2.0)),
      program_(frame.context().programs().compute("renderer/techniques/many_lods/virtual_lights.comp.glsl")),
      lights_(settings.count * int64_t{sizeof(VirtualLight)}, nullptr),
      views_(settings.count * int64_t{sizeof(many_lods::CutView)}, nullptr) {
  frame.passes().setBytesHeld(kLightsPass, lights_.bytes() + views_.bytes());
}

void VirtualLights::make(frame::Frame& frame, int step, int tilePx, double epsilonPx, double lift) const {
  const auto scope = frame.passes().open(kLightsPass);
  const scene::AreaLight& light = frame.scene().lights[0];
  const glm::dvec3 anchor = frame.gpuScene().anchor();
  const glm::dmat4 turn =
      glm::rotate(glm::dmat4(1.0), glm::radians(settings_.turnDeg * step), glm::dvec3(0.0, 1.0, 0.0));
  const auto turned = [&](glm::dvec3 v, double w) { return glm::vec3(turn * glm::dvec4(v, w)); };
  frame.bindSurfaces();
  frame.gpuScene().rays(frame.context()).bind(program_);
  lights_.bindStorage(kVirtualLightsBuffer);
  views_.bindStorage(kVirtualViewsBuffer);
  program_.set("lightCentre", turned(light.centre - anchor, 1.0));
  program_.set("lightX", turned(light.axisX, 0.0));
  program_.set("lightY", turned(light.axisY, 0.0));
  program_.set("lightZ", turned(light.direction(), 0.0));
  // A diffuse light of radiance L and area A sends out pi L A.
  const double share = settings_.gain * std::acos(-1.0) * light.area() / static_cast<double>(settings_.count);
  program_.set("fluxOfRay", light.parts[0].radiance * static_cast<float>(share));
  program_.set("lightCount", count());
  program_.set("lift", static_cast<float>(lift));
  const double q = std::max(2.0 * tilePx / std::sqrt(8.0) / epsilonPx, 1.0);
  program_.set("sizeFactor", static_cast<float>(q * q));
  program_.set("inverseRange", static_cast<float>(1.0 / range_));
  program_.use();
  glDispatchCompute((count() + kVirtualLightsGroup - 1) / kVirtualLightsGroup, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace limen::techniques
