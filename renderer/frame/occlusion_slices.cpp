// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/occlusion_slices.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr const char* kRasterPass = "frame/occlusion_slices_raster";
constexpr const char* kFilterPass = "frame/occlusion_slices";

/// Light-space z of the farthest point of the casters; 0 if none is in front of the light.
double farthestCaster(const scene::Scene& scene) {
  const glm::dmat4 toLight = scene.lights.at(0).toLightSpace();
  double farthest = 0.0;
  for (const scene::Part& part : scene.parts) {
    if (part.receiverOnly) continue;
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
      for (int corner = 0; corner < 3; ++corner)
        farthest = std::max(
            farthest, (toLight * glm::dvec4(scene.mesh.positions[scene.mesh.triangles[i][corner]], 1.0)).z);
  }
  return farthest;
}

}  // namespace

std::string OcclusionSliceSettings::key() const {
  return std::to_string(resolution) + "/" + std::to_string(slices) + "/" +
         std::to_string(static_cast<int>(prefilter));
}

OcclusionSlices::OcclusionSlices(Frame& frame, OcclusionSliceSettings settings)
    : settings_(settings),
      raster_(frame.context().programs().get(
          {"renderer/frame/shadow.vert.glsl", "renderer/frame/occlusion_slices.frag.glsl"})),
      unpack_(frame.context().programs().compute(
          "renderer/frame/occlusion_slices.comp.glsl",
          settings.prefilter == Prefilter::Sums ? gl::ShaderDefines{{"SUMS", "1"}} : gl::ShaderDefines{})),
      bits_(gl::Format::R32UI, glm::ivec2(settings.resolution)),
      target_(gl::Format::R8, glm::ivec2(settings.resolution)),
      framebuffer_({&target_}, nullptr),
      averages_(frame.context(),
                {settings.prefilter, settings.resolution, settings.slices, 1, SumForm::Fixed,
                 gl::Format::R16F, "r16f"},
                "the array of occlusion textures", "choose a smaller map, or fewer slices") {
  frustum_ = LightCasters(frame.scene()).fit(glm::dvec2(0.0), settings.resolution);
  begin_ = frustum_.near;
  // The farthest caster belongs to the last slice despite rounding.
  const double end = std::max(farthestCaster(frame.scene()), begin_) * (1.0 + 1e-5);
  depth_ = (end - begin_) / settings.slices;
  frame.passes().setBytesHeld(kRasterPass, bits_.bytes() + target_.bytes());
  frame.passes().setBytesHeld(kFilterPass, averages_.bytes());
}

void OcclusionSlices::make(Frame& frame) {
  {
    const auto scope = frame.passes().open(kRasterPass);
    const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
    bits_.clearUint(glm::uvec4(0));
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    bits_.bindImage(kSlicesBitsImage, gl::Access::ReadWrite);
    raster_.set("anchorToClip", glm::mat4(frustum_.clipFromLight() * toLight));
    raster_.set("near", static_cast<float>(frustum_.near));
    raster_.set("begin", static_cast<float>(begin_));
    raster_.set("slicesPerDepth", static_cast<float>(1.0 / depth_));
    raster_.set("slices", settings_.slices);
    framebuffer_.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    raster_.use();
    frame.geometry().draw();
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  const auto scope = frame.passes().open(kFilterPass);
  bits_.bindTexture(kSlicesBitsUnit);
  averages_.texture().bindImage(kSlicesCoveredImage, gl::Access::Write);
  unpack_.set("resolution", settings_.resolution);
  unpack_.set("slices", settings_.slices);
  unpack_.dispatch(glm::ivec2(settings_.resolution));
  averages_.build();
}

}  // namespace limen::frame
