// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/frame_path.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/interrupt.h"
#include "experiments/scene_rendering.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/motion.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {
namespace {

/// What outlives a frame: it is compared with the next one.
struct KeptFrame {
  gl::Texture test, reference, mask, depth;
  KeptFrame(gl::Format product, glm::ivec2 sizePx)
      : test(product, sizePx),
        reference(product, sizePx),
        mask(gl::Format::R32F, sizePx),
        depth(gl::Format::R32F, sizePx) {}
};

void copy(const gl::Texture& from, const gl::Texture& to) {
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.sizePx().x,
                     to.sizePx().y, 1);
}

/// The first light moved in its plane by a share of its extents.
scene::Scene withLightMoved(const scene::Scene& scene, double share, double directionDeg) {
  scene::Scene moved = scene;
  scene::AreaLight& light = moved.lights.at(0);
  const double angle = glm::radians(directionDeg);
  light.centre +=
      share * (std::cos(angle) * light.size.x * light.axisX + std::sin(angle) * light.size.y * light.axisY);
  return moved;
}

Image maskOf(const Image& receivers) {
  Image mask(receivers.width, receivers.height, 1);
  for (size_t pixel = 0; pixel < mask.pixels(); ++pixel)
    mask.data[pixel] = receivers.data[4 * pixel + 3] >= 0.0F ? 1.0F : 0.0F;
  return mask;
}

}  // namespace

FramePath::FramePath(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                     const PlannedRun& run, ReferenceCache& references, std::string identity)
    : context_(context),
      onGpu_(onGpu),
      sizePx_(sizePx),
      run_(run),
      references_(references),
      identity_(std::move(identity)) {}

std::shared_ptr<const Image> FramePath::reference(const scene::Scene& scene, double timeS, double lightShare,
                                                  double directionDeg) {
  const nlohmann::json place = {
      {"run", identity_}, {"time_s", timeS}, {"light_share", lightShare}, {"direction_deg", directionDeg}};
  return references_
      .get(sha256(place.dump()), sizePx_.x, sizePx_.y,
           [&] {
             const auto technique = techniques::TechniqueRegistry::instance()
                                        .get(run_.reference.name)
                                        .make(run_.reference.values);
             frame::Frame frame(context_, scene, onGpu_.gpu, sizePx_, timeS);
             technique->prepare(frame);
             frame.begin();
             technique->render(frame);
             frame.end();
             return Reference{std::make_shared<const Image>(technique->product().read()),
                              technique->remarks()};
           })
      .image;
}

void FramePath::note(const techniques::Technique* technique) {
  if (!technique) return;
  for (std::string& remark : technique->remarks())
    if (std::find(prepared_.begin(), prepared_.end(), remark) == prepared_.end())
      remarks_.push_back(std::move(remark));
}

void FramePath::render(const perception::PathRequest& request, const perception::PathVisitor& visit) {
  const auto* light = std::get_if<perception::LightPath>(&request.path);
  const auto* camera = std::get_if<perception::CameraPath>(&request.path);
  if (camera && !onGpu_.scene.traits().count("moving_camera") && onGpu_.scene.motions.empty())
    throw Error("neither the camera nor parts of scene '" + onGpu_.scene.name + "' move",
                "metric jnd_change, path",
                "choose a scene with a path of the camera or parts that move, or move the light");
  if (light && onGpu_.scene.lights.empty())
    throw Error("scene '" + onGpu_.scene.name + "' has no light to move", "metric jnd_change, path",
                "choose another scene, or move the camera");
  const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(run_.technique.name);
  const double directionDeg = light ? light->directionDeg : 0.0;
  std::array<std::optional<KeptFrame>, 2> kept;
  std::array<perception::PathFrame, 2> seen;
  std::optional<scene::Scene> moved;
  std::unique_ptr<frame::Frame> frame;
  std::unique_ptr<techniques::Technique> technique;
  for (int step = 0; step <= request.steps; ++step) {
    throwIfInterrupted();
    const double timeS = camera ? step * camera->stepS : 0.0, share = light ? step * light->step : 0.0;
    if (!frame || light) {
      const bool keep = technique && info.followsLight;
      if (!keep) note(technique.get()), technique.reset();
      frame.reset();
      if (light) moved.emplace(withLightMoved(onGpu_.scene, share, directionDeg));
      frame =
          std::make_unique<frame::Frame>(context_, moved ? *moved : onGpu_.scene, onGpu_.gpu, sizePx_, timeS);
      if (!keep) {
        technique = info.make(run_.technique.values);
        technique->prepare(*frame);
        prepared_ = technique->remarks();
      }
    }
    frame->setTime(timeS);
    frame->begin();
    technique->render(*frame);
    const gl::Texture& product = technique->product();
    std::optional<KeptFrame>& now = kept[static_cast<size_t>(step % 2)];
    if (!now) now.emplace(product.format(), sizePx_);
    copy(product, now->test);
    now->reference.write(*reference(frame->scene(), timeS, share, directionDeg));
    now->mask.write(maskOf(frame->get<frame::Receivers>().texture().read()));
    perception::PathFrame& place = seen[static_cast<size_t>(step % 2)];
    place = {&now->test, &now->reference, &now->mask, ShownSurfaces::of(*frame), nullptr, nullptr, nullptr};
    if (camera) {
      copy(frame->get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture(),
           now->depth);
      const auto& motion = frame->get<frame::Motion>(frame::MotionSetting{camera->stepS});
      place.displacement = &motion.displacement();
      place.depthBefore = &motion.previousDepth();
      place.depth = &now->depth;
    }
    if (step > 0) visit(step, seen[static_cast<size_t>((step + 1) % 2)], place);
    frame->end();
  }
  note(technique.get());
}

}  // namespace limen::experiments
