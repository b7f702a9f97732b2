// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shadow_map.h"

#include <epoxy/gl.h>

#include <array>
#include <bit>
#include <cassert>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

int levelCount(int resolution) {
  assert(std::has_single_bit(static_cast<unsigned>(resolution)));
  return std::bit_width(static_cast<unsigned>(resolution));
}

}  // namespace

std::string ShadowMapSettings::name() const {
  std::string out;
  if (eye != glm::dvec2(0.5)) out += "/eye_" + shortestNumber(eye.x) + "_" + shortestNumber(eye.y);
  if (part >= 0) out += "/part_" + std::to_string(part);
  if (extent != 1.0) out += "/extent_" + shortestNumber(extent);
  if (layer > 0) {
    out += "/layer_" + std::to_string(layer);
    if (peelBias != ShadowMapSettings{}.peelBias) out += "/behind_" + shortestNumber(peelBias);
  }
  return out;
}

std::optional<ShadowMapSettings> ShadowMapSettings::first() const {
  if (together == 1 || layer == 0) return std::nullopt;
  ShadowMapSettings map = *this;
  map.layer = 0;
  map.extent = 1.0;
  return map;
}

ShadowMapSettings ShadowMapSettings::alone() const {
  ShadowMapSettings map = *this;
  map.together = 1;
  return map;
}

ShadowRaster::ShadowRaster(gl::Context& context, int resolution, Raster raster, Extra extra) {
  const bool withIds = extra == Extra::Ids, peels = extra == Extra::Peels;
  if (chosenRaster(raster, context) == Raster::Compute) {
    compute_ = std::make_unique<ComputeRaster>(context, glm::ivec2(resolution),
                                               ComputeRasterSettings{.ids = withIds, .peels = peels});
    return;
  }
  gl::Texture depth(gl::Format::Depth32F, glm::ivec2(resolution));
  std::optional<gl::Texture> ids;
  if (withIds) ids.emplace(gl::Format::R32UI, glm::ivec2(resolution));
  const std::vector<std::string> shaders =
      withIds
          ? std::vector<std::string>{"renderer/frame/triangle_ids.vert.glsl",
                                     "renderer/frame/triangle_ids.frag.glsl"}
          : std::vector<std::string>{"renderer/frame/shadow.vert.glsl", "renderer/frame/shadow.frag.glsl"};
  std::vector<const gl::Texture*> colours;
  if (ids) colours.push_back(&*ids);
  gl::Framebuffer framebuffer(colours, &depth);
  const gl::ShaderDefines defines = peels ? gl::ShaderDefines{{"PEEL", "1"}} : gl::ShaderDefines{};
  hardware_.reset(new HardwareTarget{context.programs().get(shaders, defines), std::move(depth),
                                     std::move(ids), std::move(framebuffer)});
}

int64_t ShadowRaster::bytes() const {
  if (compute_) return compute_->bytes();
  return hardware_->depth.bytes() + (hardware_->ids ? hardware_->ids->bytes() : 0);
}

void ShadowRaster::draw(Frame& frame, const Geometry& geometry, const LightFrustum& frustum,
                        const DepthPeel& peel) const {
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  const glm::mat4 clip(frustum.clipFromLight() * toLight);
  if (compute_) {
    compute_->draw(geometry, clip, frustum.near, peel);
    return;
  }
  hardware_->framebuffer.bind();
  constexpr GLfloat kFar = 0.0F;
  glClearBufferfv(GL_DEPTH, 0, &kFar);
  constexpr std::array<GLuint, 4> kClearedId = {0xffffffffU, 0, 0, 0};
  if (hardware_->ids) glClearBufferuiv(GL_COLOR, 0, kClearedId.data());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  hardware_->program.use();
  hardware_->program.set("anchorToClip", clip);
  if (peel.previous) {
    peel.previous->bindTexture(kPeelPreviousDepthUnit);
    hardware_->program.set("peelBias", static_cast<float>(peel.bias));
  }
  geometry.draw();
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

ShadowDepth::ShadowDepth(Frame& frame, ShadowMapSettings settings)
    : settings_(settings),
      raster_(frame.context(), settings.resolution, settings.raster,
              settings.layer > 0 ? ShadowRaster::Extra::Peels : ShadowRaster::Extra::None),
      pass_("frame/shadow_raster" + settings.name()) {
  const scene::Scene& scene = frame.scene();
  if (!scene.motions.empty())
    throw Error("shadow maps are fitted to parts at rest, and parts of scene '" + scene.name + "' move", {},
                "leave shadows out, or choose a scene at rest");
  frustum_ = LightCasters(scene, settings.part)
                 .fit((settings.eye - 0.5) * scene.lights.at(0).size, settings.resolution);
  if (settings.extent != 1.0) {
    const glm::dvec2 middle = glm::clamp(glm::dvec2(0.0), frustum_.low, frustum_.high);
    frustum_.low = glm::mix(middle, frustum_.low, settings.extent);
    frustum_.high = glm::mix(middle, frustum_.high, settings.extent);
  }
  if (settings.part >= 0) {
    const scene::Part& part = scene.parts.at(static_cast<size_t>(settings.part));
    part_ = std::make_unique<TriangleRanges>(1);
    part_->set({{part.firstTriangle, part.triangleCount}});
  }
  frame.passes().setBytesHeld(pass_, raster_.bytes());
}

void ShadowDepth::make(Frame& frame) {
  DepthPeel peel;
  if (settings_.layer > 0) {
    // The layers of a smaller frustum are peeled from each other too, so that a texel has the same ray in all
    // of them.
    ShadowMapSettings nearer = settings_;
    --nearer.layer;
    peel = {&frame.get<ShadowDepth>(nearer).depth(), settings_.peelBias};
  }
  Geometry geometry = frame.geometry();
  // A part's triangles are those of its finest level.
  if (part_) geometry.ranges = part_.get();
  const auto scope = frame.passes().open(pass_);
  raster_.draw(frame, geometry, frustum_, peel);
}

ShadowMap::ShadowMap(Frame& frame, ShadowMapSettings settings)
    : settings_(settings),
      program_(frame.context().programs().compute("renderer/frame/linear_depth.comp.glsl")),
      linear_(gl::Format::R32F, glm::ivec2(settings.resolution)),
      pass_("frame/shadow_map" + settings.name()) {
  frame.passes().setBytesHeld(pass_, linear_.bytes());
}

void ShadowMap::make(Frame& frame) {
  const auto& raster = frame.get<ShadowDepth>(settings_);
  frustum_ = raster.frustum();
  const auto scope = frame.passes().open(pass_);
  program_.set("near", static_cast<float>(frustum_.near));
  program_.set("resolution", settings_.resolution);
  raster.depth().bindTexture(kLinearDepthSourceUnit);
  linear_.bindImage(kLinearDepthImage, gl::Access::Write);
  program_.dispatch(glm::ivec2(settings_.resolution));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

MapTexture::MapTexture(gl::Format format, glm::ivec2 sizePx, int levels, int layers,
                       const ShadowMapSettings& map, const MapTexture* first)
    : all_(map.together > 1 && !first ? std::optional<gl::Texture>(std::in_place, format, sizePx, levels,
                                                                   std::max(layers, 1) * map.together)
                                      : std::nullopt),
      own_(map.together == 1
               ? gl::Texture(format, sizePx, levels, layers)
               : (first ? first->shared() : *all_).view(std::max(layers, 1) * map.layer, layers)) {}

MinMaxPyramid::MinMaxPyramid(Frame& frame, ShadowMapSettings settings)
    : settings_(settings),
      first_(frame.context().programs().compute("renderer/frame/min_max_pyramid.comp.glsl",
                                                {{"FROM_DEPTH", "1"}})),
      next_(frame.context().programs().compute("renderer/frame/min_max_pyramid.comp.glsl")),
      minima_(gl::Format::R32F, glm::ivec2(settings.resolution), levelCount(settings.resolution), 0, settings,
              settings.first() ? &frame.get<MinMaxPyramid>(*settings.first()).minima_ : nullptr),
      maxima_(gl::Format::R32F, glm::ivec2(std::max(settings.resolution / 2, 1)),
              std::max(levelCount(settings.resolution) - 1, 1), 0, settings,
              settings.first() ? &frame.get<MinMaxPyramid>(*settings.first()).maxima_ : nullptr),
      pass_("frame/min_max_pyramid" + settings.name()) {
  frame.passes().setBytesHeld(pass_, minimum().bytes() + maximum().bytes());
}

void MinMaxPyramid::make(Frame& frame) {
  const auto& raster = frame.get<ShadowDepth>(settings_.alone());
  frustum_ = raster.frustum();
  const auto scope = frame.passes().open(pass_);
  const int count = levels();
  constexpr std::array kMinima = {kPyramidMinimum1Image, kPyramidMinimum2Image, kPyramidMinimum3Image,
                                  kPyramidMinimum4Image};
  constexpr std::array kMaxima = {kPyramidMaximum1Image, kPyramidMaximum2Image, kPyramidMaximum3Image,
                                  kPyramidMaximum4Image};
  int made = 0;
  for (int base = 0; base < std::max(count - 1, 1); base += made) {
    const gl::Program& program = base == 0 ? first_ : next_;
    const int most = base == 0 ? kPyramidFirstLevels : kPyramidNextLevels;
    made = std::min(most, std::max(count - 1 - base, 1));
    program.set("near", static_cast<float>(frustum_.near));
    program.set("sourceSize", settings_.resolution >> base);
    program.set("levelsMade", std::min(made, count - 1 - base));
    for (int i = 0; i < most; ++i) {
      // Image units past the last level are bound to the last level and never written.
      minimum().bindImage(kMinima[static_cast<size_t>(i)], gl::Access::Write,
                          std::min(base + 1 + i, count - 1));
      maximum().bindImage(kMaxima[static_cast<size_t>(i)], gl::Access::Write,
                          std::min(base + i, maximum().levels() - 1));
    }
    if (base == 0) {
      raster.depth().bindTexture(kPyramidDepthMapUnit);
      minimum().bindImage(kPyramidBaseImage, gl::Access::Write, 0);
    } else {
      minimum().bindTexture(kPyramidMinimumMapUnit);
      maximum().bindTexture(kPyramidMaximumMapUnit);
      program.set("sourceLevel", base);
    }
    program.dispatch(glm::ivec2(std::max((settings_.resolution >> base) / 2, 1)));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

}  // namespace limen::frame
