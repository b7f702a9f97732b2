// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/weights_gpu.h"

#include <epoxy/gl.h>

#include <cassert>

#include "perception/popping/gpu/popping_bindings.h"

namespace limen::perception {
namespace {

constexpr glm::ivec2 kGroup{kPoppingGroupX, kPoppingGroupY};
const char* const kDisocclusion = "perception/popping/gpu/disocclusion.comp.glsl";
const char* const kFlicker = "perception/popping/gpu/flicker.comp.glsl";

}  // namespace

PoppingWeightsGpu::PoppingWeightsGpu(gl::Context& context, const PoppingSettings& settings)
    : context_(context),
      disocclusion_(settings.disocclusionSettings()),
      flicker_(settings.flickerSettings()) {
  context.programs().compute(kDisocclusion);
  context.programs().compute(kFlicker);
}

void PoppingWeightsGpu::disocclusion(const std::vector<DisocclusionTextures>& views,
                                     const gl::Texture& weight) {
  assert(views.size() == 1 || views.size() == 2);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  const gl::Program& program = context_.programs().compute(kDisocclusion);
  for (uint32_t i = 0; i < 2; ++i) {
    const DisocclusionTextures& view = views[i < views.size() ? i : 0];
    static_assert(kDisocclusionDisplacement1Unit - kDisocclusionDisplacement0Unit ==
                      kDisocclusionDepthOfPixel1Unit - kDisocclusionDepthOfPixel0Unit &&
                  kDisocclusionPreviousDepth1Unit - kDisocclusionPreviousDepth0Unit ==
                      kDisocclusionDepthOfPixel1Unit - kDisocclusionDepthOfPixel0Unit);
    const uint32_t first = i * (kDisocclusionDepthOfPixel1Unit - kDisocclusionDepthOfPixel0Unit);
    view.previousDepthOfPixel->bindTexture(kDisocclusionDepthOfPixel0Unit + first);
    view.displacement->bindTexture(kDisocclusionDisplacement0Unit + first);
    view.previousDepth->bindTexture(kDisocclusionPreviousDepth0Unit + first);
  }
  weight.bindImage(kDisocclusionWeightsImage, gl::Access::Write);
  program.set("viewCount", static_cast<int>(views.size()));
  program.set("pcfRadius", disocclusion_.pcfRadiusPx);
  program.set("depthTolerance", static_cast<float>(disocclusion_.depthTolerance));
  program.set("outsideVisibility", static_cast<float>(disocclusion_.outsideVisibility));
  program.dispatch(weight.sizePx(), kGroup);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void PoppingWeightsGpu::flicker(const FlickerTextures& input, const gl::Texture& weight) {
  const bool compareDepth = input.previousDepthOfPixel && input.previousDepth;
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  const gl::Program& program = context_.programs().compute(kFlicker);
  input.actual->bindTexture(kFlickerActualUnit);
  input.predicted->bindTexture(kFlickerPredictedUnit);
  input.previousShading->bindTexture(kFlickerPreviousShadingUnit);
  input.previousFrame->bindTexture(kFlickerPreviousFrameUnit);
  input.displacement->bindTexture(kFlickerDisplacementUnit);
  (compareDepth ? input.previousDepthOfPixel : input.displacement)->bindTexture(kFlickerDepthOfPixelUnit);
  (compareDepth ? input.previousDepth : input.displacement)->bindTexture(kFlickerPreviousDepthUnit);
  weight.bindImage(kFlickerWeightsImage, gl::Access::Write);
  program.set("compareDepth", compareDepth ? 1 : 0);
  program.set("kappa", static_cast<float>(flicker_.kappa));
  program.set("largestDisplacement", static_cast<float>(flicker_.maxDisplacementPx));
  program.set("flickerWeight", static_cast<float>(flicker_.weight));
  program.set("depthTolerance", static_cast<float>(flicker_.depthTolerance));
  program.dispatch(weight.sizePx(), kGroup);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::perception
