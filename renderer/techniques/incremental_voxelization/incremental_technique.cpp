// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/incremental_voxelization/incremental_technique.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/scene/part_motion.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kPicturePass = "incremental_voxelization/picture";
constexpr const char* kVolumePass = "incremental_voxelization/volume";
constexpr const char* kLightMapPass = "incremental_voxelization/light_map";

float largestOf(glm::vec3 v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

void IncrementalTechnique::prepare(frame::Frame& frame) {
  gl::Context& context = frame.context();
  const scene::Scene& scene = frame.scene();
  const bool lit = !scene.lights.empty(), asView = lit && settings_.lightMap.use == LightMapUse::Voxels;
  const int used = asView ? 2 : 1, views = asView || (lit && attributes_.lit) ? 2 : 1;
  const scene::Camera first =
      scene.camera.at(frame.timeS() - settings_.sequence.frames * settings_.sequence.stepS);
  const voxels::VoxelGrid grid = gridFor(scene, first, settings_.box, settings_.resolution);
  volume_.emplace(context, grid, frame.gpuScene().anchor(), attributes_.volume, used, used * samplesPerView(),
                  scrolls(settings_.box));
  if (views == 2) {
    lightMap_.emplace(context, settings_.lightMap.resolution, frame::Raster::Auto);
    frame.passes().setBytesHeld(kLightMapPass, lightMap_->bytes());
  }
  lighting_.strength = settings_.lightMap.strength;
  lighting_.brightest = 0.0;
  for (const scene::Material& material : scene.materials)
    lighting_.brightest =
        std::max(lighting_.brightest, double(largestOf(material.emission)) +
                                          lighting_.strength * double(largestOf(material.albedo)));
  views_.resize(static_cast<size_t>(views));
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  gl::ShaderDefines shown;
  if (attributes_.volume) shown = {{"VOLUME_ALBEDO", "1"}, {"VOLUME_NORMAL", "1"}};
  if (volume_->scrolls()) shown["TOROIDAL"] = "1";
  show_ = &context.programs().compute("renderer/techniques/voxelization/voxel_picture.comp.glsl", shown);
  const int64_t bytes = prepareForm(frame, *volume_, views, used);
  frame.passes().setBytesHeld(kVolumePass, volume_->bytes() + bytes);
  frame.passes().setBytesHeld(kPicturePass, picture_->bytes());
  settings_.sequence.renderAll(frame, [&](frame::Frame& before) { step(before); });
}

IncrementalTechnique::Step IncrementalTechnique::step(frame::Frame& frame) {
  if (std::holds_alternative<CubeAroundCamera>(settings_.box)) {
    voxels::VoxelGrid grid = gridFor(frame.scene(), frame.camera(), settings_.box, settings_.resolution);
    const auto& around = std::get<CubeAroundCamera>(settings_.box);
    if (around.sway && number_ % 2 == 1) grid.origin.x += around.step * grid.voxelSize;
    if (grid.origin != volume_->grid().origin) {
      const auto scope = frame.passes().open("incremental_voxelization/restart");
      const glm::ivec3 by = volume_->moveTo(grid.origin);
      moved(volume_->grid(), by);
      // Nothing stays of a box that moves by its own size.
      const bool stays = glm::all(glm::lessThan(glm::abs(by), volume_->grid().resolution));
      ++(stays ? scrolls_ : restarts_);
    }
  }
  views_[0] = incremental_voxels::cameraView(frame);
  if (lightMap_) {
    const auto scope = frame.passes().open(kLightMapPass);
    lightMap_->draw(frame, {volume_->grid().origin, volume_->grid().high()});
    views_[1] = lightMap_->view();
  }
  volume_->turn();
  const Step step{frame, *volume_, views_, lighting_, number_++};
  update(step);
  return step;
}

void IncrementalTechnique::render(frame::Frame& frame) {
  const Step now = step(frame);
  const auto scope = frame.passes().open(kPicturePass);
  show(now, *picture_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void IncrementalTechnique::show(const Step& step, const gl::Texture& picture) {
  frame::Frame& frame = step.frame;
  volume_->configure(*show_);
  if (attributes_.volume) {
    volume_->albedo().bindTexture(voxels::kVolumeAlbedoUnit);
    volume_->normal().bindTexture(voxels::kVolumeNormalUnit);
  }
  show_->set("cameraToAnchor", glm::mat4(glm::inverse(frame.anchorToCamera())));
  show_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  show_->set("sizePx", frame.sizePx());
  picture.bindImage(kVoxelPictureImage, gl::Access::Write);
  show_->use();
  show_->dispatch(frame.sizePx());
}

}  // namespace limen::techniques
