// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/multi_scale_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

const gl::Program& layersProgram(gl::Context& context, bool byLines, bool first) {
  if (byLines)
    return context.programs().compute("renderer/frame/multi_scale_lines.comp.glsl",
                                      first ? gl::ShaderDefines{{"ROWS", "1"}} : gl::ShaderDefines{});
  return context.programs().compute("renderer/frame/multi_scale_map.comp.glsl",
                                    first ? gl::ShaderDefines{{"FROM_PYRAMID", "1"}} : gl::ShaderDefines{});
}

int log2Of(int powerOfTwo) {
  assert(std::has_single_bit(static_cast<unsigned>(powerOfTwo)));
  return std::countr_zero(static_cast<unsigned>(powerOfTwo));
}

MapTexture allocate(int resolution, int layers, const ShadowMapSettings& map, const MapTexture* first) {
  try {
    return {gl::Format::RG32F, glm::ivec2(resolution), 1, layers, map, first};
  } catch (const Error& error) {
    throw Error("the multi-scale layers do not fit: " + error.message(), {},
                "choose a smaller map, or structure ysm, which needs them only at its base resolution");
  }
}

/// Positions along an axis of the two windows of the layer below that make up one of layer `layer`.
glm::ivec2 sourceOffsets(WindowAnchor anchor, int layer) {
  if (anchor == WindowAnchor::Corner) return {0, 1 << (layer - 1)};
  return layer == 1 ? glm::ivec2(-1, 0) : glm::ivec2(-(1 << (layer - 2)), 1 << (layer - 2));
}

}  // namespace

MultiScaleLayers::MultiScaleLayers(gl::Context& context, int resolution, WindowAnchor anchor,
                                   const ShadowMapSettings& map, const MultiScaleLayers* first)
    : resolution_(resolution),
      layers_(std::max(log2Of(resolution), 1)),
      anchor_(anchor),
      byLines_(resolution <= kMultiScaleLine),
      first_(layersProgram(context, byLines_, true)),
      next_(layersProgram(context, byLines_, false)),
      texture_(allocate(resolution, layers_, map, first ? &first->texture_ : nullptr)) {}

void MultiScaleLayers::build(const gl::Texture& minimum, const gl::Texture& maximum, int level) const {
  texture().bindImage(kMultiScaleImage, gl::Access::Write);
  minimum.bindTexture(kMultiScaleMinimumMapUnit);
  maximum.bindTexture(kMultiScaleMaximumMapUnit);
  first_.set("sourceLevel", level);
  if (byLines_)
    buildByLines();
  else
    buildByTiles();
}

void MultiScaleLayers::buildByLines() const {
  static_assert(1 << kMultiScaleLineLayers == kMultiScaleLine);
  for (const gl::Program* program : {&first_, &next_}) {
    for (int layer = 1; layer <= layers_; ++layer)
      program->set(("offsets[" + std::to_string(layer - 1) + "]").c_str(), sourceOffsets(anchor_, layer));
    program->set("layerCount", layers_);
    program->set("resolution", resolution_);
    if (program == &first_)
      program->dispatch({resolution_, 1}, {1, 1});
    else
      program->dispatch({resolution_, layers_}, {kMultiScaleColumns, 1});
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    texture().bindTexture(kMultiScaleLayersUnit);
  }
}

void MultiScaleLayers::buildByTiles() const {
  for (int layer = 1; layer <= layers_; layer += kMultiScaleLayers) {
    const gl::Program& program = layer == 1 ? first_ : next_;
    if (layer > 1) texture().bindTexture(kMultiScaleLayersUnit);
    // Each layer's offsets are multiples of the first one's.
    const int stride = layer == 1 ? 1 : sourceOffsets(anchor_, layer).y;
    const int made = std::min(kMultiScaleLayers, layers_ + 1 - layer);
    glm::ivec2 reach(0);
    for (int i = 0; i < made; ++i) {
      const glm::ivec2 offsets = sourceOffsets(anchor_, layer + i) / stride;
      program.set(("offsets[" + std::to_string(i) + "]").c_str(), offsets);
      reach += glm::ivec2(-offsets.x, offsets.y);
    }
    program.set("firstLayer", layer);
    program.set("layersMade", made);
    program.set("resolution", resolution_);
    program.set("stride", stride);
    program.set("reach", reach);
    const int tiles = (resolution_ / stride + kMultiScaleTile - 1) / kMultiScaleTile;
    program.dispatch(glm::ivec2(tiles * stride), {1, 1});
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

MultiScaleMap::MultiScaleMap(Frame& frame, MultiScaleSettings settings)
    : settings_(settings),
      baseLevel_(log2Of(settings.map.resolution) - log2Of(settings.base)),
      layers_(frame.context(), settings.base, settings.anchor, settings.map,
              settings.first() ? &frame.get<MultiScaleMap>(*settings.first()).layers_ : nullptr),
      pass_((settings.anchor == WindowAnchor::Corner ? "frame/n_buffer" : "frame/multi_scale_map") +
            settings.map.name()) {
  assert(baseLevel_ >= 0);
  frame.passes().setBytesHeld(pass_, layers_.texture().bytes());
}

void MultiScaleMap::make(Frame& frame) {
  const auto& pyramid = frame.get<MinMaxPyramid>(settings_.map);
  const auto scope = frame.passes().open(pass_);
  layers_.build(pyramid.minimum(), pyramid.maximum(), baseLevel_);
}

}  // namespace limen::frame
