// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr const char* kMovePass = "frame/move_vertices";

std::shared_ptr<const MovedVertices> movedVertices(gl::Context& context, const scene::Scene& scene,
                                                   const GpuScene& gpuScene) {
  if (scene.motions.empty()) return nullptr;
  const SurfaceBuffers& surface = gpuScene.surface();
  return std::make_shared<const MovedVertices>(
      context, scene.motions, gpuScene.anchor(), gpuScene.positions(),
      surface.hasNormals() ? &surface.normals() : nullptr, scene::motionsOfVertices(scene));
}

}  // namespace

Frame::Frame(gl::Context& context, const scene::Scene& scene, const GpuScene& gpuScene, glm::ivec2 sizePx,
             double timeS, Raster raster)
    : context_(context),
      scene_(scene),
      gpuScene_(gpuScene),
      sizePx_(sizePx),
      raster_(raster),
      ownPasses_(std::make_unique<gl::PassList>()),
      passes_(ownPasses_.get()),
      moved_(movedVertices(context, scene, gpuScene)) {
  if (moved_) {
    positions_ = &moved_->positions();
    passes_->setBytesHeld(kMovePass, moved_->bytes());
  }
  setTime(timeS);
}

Frame::Frame(Frame& parent, const std::string& name, glm::ivec2 sizePx)
    : Frame(parent, name, parent.scene_, sizePx) {}

Frame::Frame(Frame& parent, const std::string& name, const scene::Scene& scene)
    : Frame(parent, name, scene, parent.sizePx_) {}

Frame::Frame(Frame& parent, const std::string& name, const ShownMirrors& mirrors)
    : Frame(parent, name, parent.scene_, parent.sizePx_) {
  sharing_ = &parent;
  shownMirrors_ = mirrors;
}

Frame::Frame(Frame& parent, const std::string& name, const scene::Scene& scene, glm::ivec2 sizePx)
    : context_(parent.context_),
      scene_(scene),
      gpuScene_(parent.gpuScene_),
      sizePx_(sizePx),
      raster_(parent.raster_),
      passes_(parent.passes_),
      prefix_(parent.prefix_ + name + "/"),
      moved_(parent.moved_) {
  if (moved_) positions_ = &moved_->positions();
  setTime(parent.timeS_);
}

void Frame::setTime(double timeS) {
  timeS_ = timeS;
  camera_ = scene_.camera.at(timeS);
  // Everything is made relative to the anchor before conversion to float, so distance from the origin costs
  // no precision.
  const glm::dvec3 anchor = gpuScene_.anchor();
  anchorToCamera_ = glm::lookAt(camera_.eye - anchor, camera_.target - anchor, camera_.up);
  tanHalfFov_ = glm::tan(0.5 * glm::radians(camera_.verticalFovDeg));
}

void Frame::setLevels(const scene::LodSelection& selection) {
  if (!ranges_) ranges_ = std::make_unique<TriangleRanges>(scene_.parts.size());
  ranges_->set(scene::rangesOf(scene_, selection));
}

void Frame::begin() {
  ++number_;
  if (!ownPasses_) return;
  ownPasses_->beginFrame();
  if (!moved_) return;
  const auto scope = passes().open(kMovePass);
  moved_->update(timeS_);
}

void Frame::bindSurfaces() const {
  gpuScene_.surface().bindStorage();
  if (moved_ && moved_->normals()) moved_->normals()->bindStorage(kSurfaceNormalsBuffer);
}

void Frame::end() {
  if (ownPasses_) ownPasses_->endFrame();
}

}  // namespace limen::frame
