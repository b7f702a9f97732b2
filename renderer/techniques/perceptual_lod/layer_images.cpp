// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/layer_images.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kFolder = "renderer/techniques/perceptual_lod/";
constexpr const char* kComposite = "perceptual_lod/composite";

std::string contextPass(int layer) { return "perceptual_lod/context_" + std::to_string(layer); }

double attenuationOf(const PerceptualLodSettings& settings) {
  const auto* darkened = std::get_if<DarkenedShadows>(&settings.castShadows);
  return darkened ? darkened->factor : 1.0;
}

}  // namespace

LayerImages::LayerImages(frame::Frame& parent, const PerceptualLodSettings& settings)
    : parent_(parent),
      shading_(settings.shading),
      attenuation_(attenuationOf(settings)),
      compositeProgram_(parent.context().programs().compute(std::string(kFolder) + "composite.comp.glsl")),
      contextProgram_(parent.context().programs().compute(std::string(kFolder) + "context.comp.glsl")),
      maskProgram_(parent.context().programs().compute(std::string(kFolder) + "shadow_mask.comp.glsl")),
      frontColour_(gl::Format::RGBA32F, parent.sizePx()),
      frontKey_(gl::Format::RGBA32UI, parent.sizePx()),
      secondColour_(gl::Format::RGBA32F, parent.sizePx()),
      secondKey_(gl::Format::RGBA32UI, parent.sizePx()),
      shown_(nothingOf(parent.scene())) {
  parent.passes().setBytesHeld(
      kComposite, frontColour_.bytes() + frontKey_.bytes() + secondColour_.bytes() + secondKey_.bytes());
  const bool shadows = shading_.shadow && !parent.scene().lights.empty();
  if (shadows) casters_ = std::make_unique<LevelView>(parent, "casters");
  for (int i = 0; i <= layerCount(settings.layers); ++i) {
    layers_.push_back(std::make_unique<Layer>(parent, i == 0 ? "background" : "layer_" + std::to_string(i)));
    Layer& layer = *layers_.back();
    layer.view.frame().setCasters(casters());
    if (i == 0) continue;
    layer.context.emplace(gl::Format::RGBA32F, parent.sizePx());
    layer.context->clear(glm::vec4(0.0F));
    int64_t bytes = layer.context->bytes();
    if (shadows && std::holds_alternative<DarkenedShadows>(settings.castShadows)) {
      layer.mask.emplace(gl::Format::R32F, parent.sizePx());
      layer.mask->clear(glm::vec4(0.0F));
      layer.others = std::make_unique<LevelView>(parent, "casters_but_" + std::to_string(i));
      bytes += layer.mask->bytes();
    }
    parent.passes().setBytesHeld(contextPass(i), bytes);
  }
}

scene::LodSelection LayerImages::selectionOf(int layer) const {
  scene::LodSelection out = shown_;
  out.background = layer == 0;
  for (size_t i = 0; i < layerOf_.size(); ++i)
    if (layerOf_[i] != layer) out.levels[i] = scene::LodSelection::kOmitted;
  return out;
}

void LayerImages::drawLayer(int layer) {
  frame::Frame& frame = layers_[static_cast<size_t>(layer)]->view.show(timeS_, selectionOf(layer));
  frame.get<frame::Shaded>(shading_);
  layers_[static_cast<size_t>(layer)]->drawn = true;
}

void LayerImages::render(double timeS, const scene::LodSelection& shown, const std::vector<int>& layerOf) {
  timeS_ = timeS;
  shown_ = shown;
  layerOf_ = layerOf;
  if (casters_) casters_->show(timeS, shown);
  std::vector<int> drawn;
  for (int i = 0; i < layers(); ++i) {
    layers_[static_cast<size_t>(i)]->drawn = false;
    // The background is drawn even if it is empty: its constant is behind everything.
    if (i > 0 && std::find(layerOf.begin(), layerOf.end(), i) == layerOf.end()) continue;
    drawLayer(i);
    drawn.push_back(i);
  }
  layersDrawn_ = static_cast<int>(drawn.size());
  compositeLayers(drawn);
}

void LayerImages::compositeLayers(const std::vector<int>& drawn) {
  static_assert(kCompositeDepthsUnit - kCompositeColoursUnit >= kCompositeLayers &&
                kCompositeIdsUnit - kCompositeDepthsUnit >= kCompositeLayers);
  // Made before the pass opens: passes do not nest.
  const auto scope = parent_.passes().open(kComposite);
  const gl::Program& program = compositeProgram_;
  program.set("sizePx", parent_.sizePx());
  program.set("background", glm::vec3(static_cast<float>(shading_.background)));
  frontColour_.bindImage(kCompositeFrontColourImage, gl::Access::ReadWrite);
  frontKey_.bindImage(kCompositeFrontKeyImage, gl::Access::ReadWrite);
  secondColour_.bindImage(kCompositeSecondColourImage, gl::Access::ReadWrite);
  secondKey_.bindImage(kCompositeSecondKeyImage, gl::Access::ReadWrite);
  constexpr std::array<const char*, kCompositeLayers> kNumbers = {
      "layerNumbers[0]", "layerNumbers[1]", "layerNumbers[2]", "layerNumbers[3]", "layerNumbers[4]"};
  for (size_t done = 0; done < drawn.size(); done += kCompositeLayers) {
    const size_t count = std::min<size_t>(kCompositeLayers, drawn.size() - done);
    for (size_t k = 0; k < kCompositeLayers; ++k) {
      // Units beyond `count` are bound to something and never read.
      const int layer = drawn[done + std::min(k, count - 1)];
      frame::Frame& frame = layers_[static_cast<size_t>(layer)]->view.frame();
      const auto& ids = frame.get<frame::TriangleIds>();
      const auto unit = static_cast<uint32_t>(k);
      frame.get<frame::Shaded>(shading_).texture().bindTexture(kCompositeColoursUnit + unit);
      ids.depth().bindTexture(kCompositeDepthsUnit + unit);
      ids.texture().bindTexture(kCompositeIdsUnit + unit);
      program.set(kNumbers[k], layer);
    }
    program.set("layerCount", static_cast<int>(count));
    program.set("first", done == 0 ? 1 : 0);
    program.dispatch(parent_.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

void LayerImages::makeContext(int number) {
  Layer& layer = *layers_.at(static_cast<size_t>(number));
  const frame::ShadowMap* map = nullptr;
  const frame::Receivers* receivers = nullptr;
  if (layer.mask) {
    scene::LodSelection others = shown_;
    for (size_t i = 0; i < layerOf_.size(); ++i)
      if (layerOf_[i] == number) others.levels[i] = scene::LodSelection::kOmitted;
    map =
        &layer.others->show(timeS_, others)
             .get<frame::ShadowMap>(frame::ShadowMapSettings{shading_.shadowResolution, frame::Raster::Auto});
    receivers = &layer.view.frame().get<frame::Receivers>();
  }
  const auto scope = parent_.passes().open(contextPass(number));
  if (map) {
    const frame::LightFrustum& frustum = map->frustum();
    maskProgram_.set("sizePx", parent_.sizePx());
    maskProgram_.set("tangentLow", glm::vec2(frustum.low));
    maskProgram_.set("tangentSize", glm::vec2(frustum.high - frustum.low));
    maskProgram_.set("resolution", shading_.shadowResolution);
    maskProgram_.set("bias", frame::kShadowBias);
    maskProgram_.set("slopeBias", frame::kShadowSlopeBias);
    maskProgram_.set("maxSlope", frame::kShadowMaxSlope);
    receivers->texture().bindTexture(kShadowMaskReceiversUnit);
    map->texture().bindTexture(kShadowMaskShadowMapUnit);
    layer.mask->bindImage(kShadowMaskImage, gl::Access::Write);
    maskProgram_.dispatch(parent_.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  contextProgram_.set("sizePx", parent_.sizePx());
  contextProgram_.set("layer", number);
  contextProgram_.set("attenuation", layer.mask ? static_cast<float>(attenuation_) : 1.0F);
  frontColour_.bindTexture(kContextFrontColourUnit);
  frontKey_.bindTexture(kContextFrontKeyUnit);
  secondColour_.bindTexture(kContextSecondColourUnit);
  (layer.mask ? *layer.mask : frontColour_).bindTexture(kContextMaskUnit);
  layer.context->bindImage(kContextImage, gl::Access::Write);
  contextProgram_.dispatch(parent_.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void LayerImages::prime(double timeS) {
  timeS_ = timeS;
  shown_ = nothingOf(parent_.scene());
  layerOf_.assign(parent_.scene().lodObjects.size(), 0);
  if (casters_) casters_->show(timeS, shown_);
  for (int i = 0; i < layers(); ++i) drawLayer(i);
  compositeLayers({0});
  for (int i = 1; i < layers(); ++i) makeContext(i);
}

const gl::Texture& LayerImages::image(int layer) {
  return layers_.at(static_cast<size_t>(layer))->view.frame().get<frame::Shaded>(shading_).texture();
}
const gl::Texture* LayerImages::mask(int layer) const {
  const auto& mask = layers_.at(static_cast<size_t>(layer))->mask;
  return mask ? &*mask : nullptr;
}
const gl::Texture& LayerImages::context(int layer) const {
  return *layers_.at(static_cast<size_t>(layer))->context;
}

}  // namespace limen::techniques
