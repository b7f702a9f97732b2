// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/lit_points.h"

#include <epoxy/gl.h>

#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kLitPass = "many_lods/lit_points";

}  // namespace

LitPoints::LitPoints(frame::Frame& frame, const many_lods::GpuTree& tree)
    : program_(frame.context().programs().compute("renderer/techniques/many_lods/lit_points.comp.glsl")),
      values_(frame.context(), tree.depth()) {
  frame.passes().setBytesHeld(kLitPass, values_.values().bytes());
}

void LitPoints::make(frame::Frame& frame, const many_lods::GpuTree& tree, double gain) const {
  const auto scope = frame.passes().open(kLitPass);
  const scene::AreaLight& light = frame.scene().lights[0];
  const uint32_t leaves = 1U << tree.depth();
  frame.bindSurfaces();
  frame.geometry().bindStorage();
  frame.gpuScene().rays(frame.context()).bind(program_);
  tree.samples().bindStorage(kLitSamplesBuffer);
  values_.values().bindStorage(kLitColoursBuffer);
  program_.set("leaves", leaves);
  program_.set("lightCentre", glm::vec3(light.centre - frame.gpuScene().anchor()));
  program_.set("lightZ", glm::vec3(light.direction()));
  program_.set("intensity", light.parts[0].radiance * static_cast<float>(gain * light.area()));
  program_.use();
  glDispatchCompute((leaves + kLeafColoursGroup - 1) / kLeafColoursGroup, 1, 1);
  values_.average();
}

void LitPoints::bind(const many_lods::GpuTree& tree, const many_lods::ViewAtlas& atlas) const {
  atlas.depths().bindStorage(kGatherDepthsBuffer);
  if (atlas.form() == many_lods::AtlasForm::TwoPasses) atlas.winners().bindStorage(kGatherWinnersBuffer);
  values_.values().bindStorage(kGatherColoursBuffer);
  tree.cones().bindStorage(kGatherConesBuffer);
}

}  // namespace limen::techniques
