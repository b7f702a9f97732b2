// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/antialiasing/sample_view.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/window_order.h"

namespace limen::techniques {
namespace {

bool hasShadow(const frame::Frame& frame, const SampleShading& settings) {
  return settings.shading.shadow && !frame.scene().lights.empty();
}

frame::ShadowMapSettings shadowMapOf(const SampleShading& settings) {
  return {settings.shading.shadowResolution, frame::Raster::Auto};
}

}  // namespace

const SettingsTable<SampleShading>& SampleShading::table() {
  using S = SampleShading;
  static const SettingsTable<S> kTable = {
      frame::shadingBinding(&S::shading),
      {&S::lightSamples,
       "light_samples",
       {1, 1024},
       "",
       "Points of the light that each sample is shaded with, unshadowed: the cost of the shader",
       "Holländer 2013, section 4.3.6 (a shader that stalls)"}};
  return kTable;
}

const SettingsTable<NeighbourGradients>& NeighbourGradients::table() {
  using S = NeighbourGradients;
  static const SettingsTable<S> kTable = {
      {&S::borders, "borders",
       "Look checks up at points where the next sample sees another material or lies beyond an edge of depth",
       "Holländer 2013, section 4.3.4"},
      {&S::borderDepthRatio,
       "border_depth_ratio",
       {1.0, 1000.0},
       "",
       "Ratio of two samples' depths from which on there is an edge between them",
       "bench (value not given in Holländer 2013, section 4.3.4)"}};
  return kTable;
}

gl::ShaderDefines sampleShadingDefines(const SampleShading& settings, const frame::Frame& frame) {
  gl::ShaderDefines defines = frame::shadingDefines(settings.shading, frame);
  defines["LIGHT_SAMPLES"] = std::to_string(settings.lightSamples);
  return defines;
}

void makeShadowOf(frame::Frame& frame, const SampleShading& settings) {
  if (hasShadow(frame, settings)) frame.casters().get<frame::ShadowMap>(shadowMapOf(settings));
}

void configureSampleShading(const gl::Program& program, frame::Frame& frame, const SampleShading& settings) {
  frame::configureShading(program, frame, settings.shading);
  if (frame.scene().lights.empty()) return;
  const scene::AreaLight& light = frame.scene().lights[0];
  program.set("lightExtentX", glm::vec3(light.axisX * light.size.x));
  program.set("lightExtentY", glm::vec3(light.axisY * light.size.y));
  if (!hasShadow(frame, settings)) return;
  const glm::dmat4 toLight = light.toLightSpace(frame.gpuScene().anchor());
  program.set("cameraToLight", glm::mat4(toLight * glm::inverse(frame.anchorToCamera())));
  frame::configureHardShadow(program, frame.casters().get<frame::ShadowMap>(shadowMapOf(settings)),
                             settings.shading.shadowResolution);
}

SampleView::SampleView(frame::Frame& parent, int window, const SampleShading& settings,
                       const SampleGradients& gradients)
    : parent_(parent), window_(window), settings_(settings), gradients_(gradients) {
  const glm::ivec2 sizePx = parent.sizePx() * window;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(sizePx.x, sizePx.y) > largest)
    throw Error(
        "windows of " + std::to_string(window) + " x " + std::to_string(window) +
            " samples need an image of " + std::to_string(sizePx.x) + " x " + std::to_string(sizePx.y),
        {}, "this driver has at most " + std::to_string(largest) + ": lower 'window' or the image size");
  frame_ = std::make_unique<frame::Frame>(parent, "samples", sizePx);
}

void SampleView::make() {
  frame_->setTime(parent_.timeS());
  frame_->begin();
  frame_->setCasters(&parent_);
  frame_->get<frame::TriangleIds>();
  makeShadowOf(*frame_, settings_);
  frame_->end();
}

gl::ShaderDefines SampleView::defines() const {
  gl::ShaderDefines defines = sampleShadingDefines(settings_, *frame_);
  defines["WINDOW"] = std::to_string(window_);
  defines["ORDER"] = windowOrderGlsl(window_);
  defineEnum(defines, "GRADIENTS", static_cast<Gradients>(gradients_.index()));
  if (const auto* neighbours = std::get_if<NeighbourGradients>(&gradients_)) {
    if (neighbours->borders) defines["BORDERS"] = "1";
    defines["BORDER_DEPTH_RATIO"] = std::to_string(neighbours->borderDepthRatio);
  }
  return defines;
}

void SampleView::configure(const gl::Program& program) {
  configureSampleShading(program, *frame_, settings_);
  program.set("pictureSizePx", pictureSizePx());
  frame_->get<frame::TriangleIds>().texture().bindTexture(kSampleIdsUnit);
}

}  // namespace limen::techniques
