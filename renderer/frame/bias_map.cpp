// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/bias_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

#include "experiments/base/text.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {

ShadowTriangles::ShadowTriangles(Frame& frame, ShadowMapSettings settings)
    : raster_(frame.context(), settings.resolution, settings.raster, ShadowRaster::Extra::Ids),
      frustum_(LightCasters(frame.scene()).fit(glm::dvec2(0.0), settings.resolution)),
      pass_("frame/shadow_triangles") {
  frame.passes().setBytesHeld(pass_, raster_.bytes());
}

void ShadowTriangles::make(Frame& frame) {
  const auto scope = frame.passes().open(pass_);
  raster_.draw(frame, frame.geometry(), frustum_);
}

BiasLevels::BiasLevels(gl::Context& context, int resolution)
    : resolution_(resolution),
      program_(context.programs().compute("renderer/frame/bias_pyramid.comp.glsl")),
      biases_(gl::Format::RG32F, glm::ivec2(resolution), std::bit_width(static_cast<unsigned>(resolution))) {}

void BiasLevels::aggregate(const gl::Texture& minimum, float tolerance) const {
  minimum.bindTexture(kBiasPyramidMinimumMapUnit);
  biases_.bindTexture(kBiasPyramidBiasesUnit);
  program_.set("tolerance", tolerance);
  for (int level = 1; level < biases_.levels(); ++level) {
    program_.set("sourceLevel", level - 1);
    program_.set("size", resolution_ >> level);
    biases_.bindImage(kBiasPyramidImage, gl::Access::Write, level);
    program_.dispatch(glm::ivec2(resolution_ >> level));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

std::string BiasSettings::key() const {
  return map.key() + "/" + shortestNumber(double{maxSlope}) + "/" + shortestNumber(double{tolerance});
}

BiasMap::BiasMap(Frame& frame, BiasSettings settings)
    : settings_(settings),
      slopes_(frame.context().programs().compute("renderer/frame/slope_bias.comp.glsl")),
      levels_(frame.context(), settings.map.resolution),
      pass_("frame/bias_map") {
  frame.passes().setBytesHeld(pass_, levels_.bytes());
}

void BiasMap::make(Frame& frame) {
  const auto& pyramid = frame.get<MinMaxPyramid>(settings_.map);
  const auto& triangles = frame.get<ShadowTriangles>(settings_.map);
  const LightFrustum& frustum = triangles.frustum();
  const auto scope = frame.passes().open(pass_);
  slopes_.set("anchorToLight", glm::mat4(frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor())));
  slopes_.set("tangentLow", glm::vec2(frustum.low));
  slopes_.set("tangentSize", glm::vec2(frustum.high - frustum.low));
  slopes_.set("resolution", settings_.map.resolution);
  slopes_.set("maxSlope", settings_.maxSlope);
  triangles.ids().bindTexture(kSlopeBiasIdsUnit);
  pyramid.minimum().bindTexture(kSlopeBiasMinimumMapUnit);
  levels_.biases().bindImage(kSlopeBiasImage, gl::Access::Write, 0);
  frame.geometry().bindStorage();
  slopes_.dispatch(glm::ivec2(settings_.map.resolution));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  levels_.aggregate(pyramid.minimum(), settings_.tolerance);
}

}  // namespace limen::frame
