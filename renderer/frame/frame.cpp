// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limen::frame {

Frame::Frame(gl::Context& context, const scene::Scene& scene, const GpuScene& gpuScene, glm::ivec2 sizePx,
             double timeS, Raster raster)
    : context_(context),
      scene_(scene),
      gpuScene_(gpuScene),
      sizePx_(sizePx),
      raster_(raster),
      ownPasses_(std::make_unique<gl::PassList>()),
      passes_(ownPasses_.get()) {
  setTime(timeS);
}

Frame::Frame(Frame& parent, const std::string& name, glm::ivec2 sizePx)
    : Frame(parent, name, parent.scene_, sizePx) {}

Frame::Frame(Frame& parent, const std::string& name, const scene::Scene& scene)
    : Frame(parent, name, scene, parent.sizePx_) {}

Frame::Frame(Frame& parent, const std::string& name, const scene::Scene& scene, glm::ivec2 sizePx)
    : context_(parent.context_),
      scene_(scene),
      gpuScene_(parent.gpuScene_),
      sizePx_(sizePx),
      raster_(parent.raster_),
      passes_(parent.passes_),
      prefix_(parent.prefix_ + name + "/") {
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
  if (ownPasses_) ownPasses_->beginFrame();
}

void Frame::end() {
  if (ownPasses_) ownPasses_->endFrame();
}

}  // namespace limen::frame
