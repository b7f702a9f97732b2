// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/scene_rendering.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/shaded.h"

namespace limen::experiments {

perception::LitSurfaces ShownSurfaces::of(frame::Frame& frame) {
  frame::ShadedSetting albedo, direct;
  albedo.ambient = 1.0, albedo.diffuse = 0.0, albedo.background = -1.0;
  direct.ambient = 0.0, direct.diffuse = 1.0, direct.background = 0.0;
  return {&frame.get<frame::Shaded>(albedo).texture(), &frame.get<frame::Shaded>(direct).texture()};
}

ShownSurfaces::ShownSurfaces(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx)
    : frame_(context, onGpu, sizePx) {
  frame_.begin();
  textures_ = of(frame_);
  frame_.end();
}

perception::Depicts depicts(techniques::ProductKind kind) {
  using perception::Depicts;
  using techniques::ProductKind;
  switch (kind) {
    case ProductKind::Visibility:
    case ProductKind::LightColour:
      return Depicts::ShareOfLight;
    case ProductKind::Colour:
      return Depicts::Light;
    case ProductKind::Threshold:
    case ProductKind::VisibilityChange:
    case ProductKind::JndMap:
      return Depicts::Nothing;
    case ProductKind::Stream:
      return Depicts::Items;
  }
  return Depicts::Nothing;
}

nlohmann::json sceneFacts(const scene::Scene& scene) {
  const scene::Bounds bounds = scene.bounds();
  return {{"content_hash", scene.contentHash()},
          {"triangles", scene.mesh.triangles.size()},
          {"bounds",
           {{bounds.low.x, bounds.low.y, bounds.low.z}, {bounds.high.x, bounds.high.y, bounds.high.z}}}};
}

ViewImages viewImages(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx) {
  using frame::Channel;
  using frame::ChannelSetting;
  using frame::GBufferChannel;
  frame::Frame frame(context, onGpu, sizePx);
  frame.begin();
  const Image receivers = frame.get<frame::Receivers>().texture().read();
  const Image normals = frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture().read();
  const Image positions = frame.get<GBufferChannel>(ChannelSetting{Channel::Position}).texture().read();
  const Image albedo = frame.get<GBufferChannel>(ChannelSetting{Channel::Albedo}).texture().read();
  ViewImages out{Image(sizePx.x, sizePx.y, 1), {}, Image(sizePx.x, sizePx.y, 3)};
  if (onGpu.scene.traits().count("mirrors")) {
    const Image origins = frame.get<frame::MirrorRays>().origins().read();
    out.mirrors = Image(sizePx.x, sizePx.y, 1);
    for (size_t i = 0; i < out.mirrors.pixels(); ++i) out.mirrors.data[i] = origins.data[4 * i + 3];
  }
  frame.end();
  const auto& lights = onGpu.scene.lights;
  const glm::dvec3 light = lights.empty() ? glm::dvec3(0.0) : lights[0].centre - onGpu.gpu.anchor();
  for (size_t i = 0; i < out.mask.pixels(); ++i) {
    const bool receiver = receivers.data[4 * i + 3] >= 0.0F;
    out.mask.data[i] = receiver ? 1.0F : 0.0F;
    if (!receiver) continue;
    const glm::dvec3 toLight =
        light - glm::dvec3(positions.data[4 * i], positions.data[4 * i + 1], positions.data[4 * i + 2]);
    const double cosine =
        glm::dot(glm::dvec3(normals.data[4 * i], normals.data[4 * i + 1], normals.data[4 * i + 2]),
                 toLight / glm::length(toLight));
    for (size_t c = 0; c < 3; ++c)
      out.shading.data[3 * i + c] = albedo.data[4 * i + c] * static_cast<float>(std::max(cosine, 0.0));
  }
  return out;
}

void requireTraits(const techniques::TechniqueInfo& info, const scene::Scene& scene) {
  const std::set<std::string> traits = scene.traits();
  for (const std::string& need : info.needs)
    if (!traits.count(need))
      throw Error("technique '" + info.name + "' needs a scene with '" + need + "', which '" + scene.name +
                      "' with these parameters does not have",
                  {}, "choose another light or another technique");
  if (traits.count("moving_parts") && !info.followsMotion)
    throw Error("technique '" + info.name + "' knows scenes at rest alone, and parts of '" + scene.name +
                    "' with these parameters move",
                {}, "leave out the motion, or choose another technique");
}

RenderedOnce renderWithRemarks(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                               const Configuration& technique) {
  const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(technique.name);
  requireTraits(info, onGpu.scene);
  const auto made = info.make(technique.values);
  frame::Frame frame(context, onGpu, sizePx);
  made->prepare(frame);
  frame.begin();
  made->render(frame);
  frame.end();
  RenderedOnce out{made->product().read(), made->remarks()};
  context.checkDebugMessages();
  return out;
}

Image renderOnce(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                 const Configuration& technique) {
  return renderWithRemarks(context, onGpu, sizePx, technique).product;
}

}  // namespace limen::experiments
