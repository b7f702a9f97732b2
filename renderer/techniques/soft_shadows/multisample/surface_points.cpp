// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/multisample/surface_points.h"

#include <epoxy/gl.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kSurfaceShaders = "renderer/techniques/soft_shadows/multisample/";

glm::ivec2 roundedUp(glm::ivec2 sizePx) { return (sizePx + kGroupSide - 1) / kGroupSide * kGroupSide; }

/// Pixels' own points, and below them rows of tiles for `furtherPerPixel` times as many.
glm::ivec2 pointsSize(glm::ivec2 ownPx, double furtherPerPixel) {
  const double further = furtherPerPixel * ownPx.x * ownPx.y;
  const int rows = static_cast<int>(std::ceil(further / (double(ownPx.x) * kGroupSide))) * kGroupSide;
  return {ownPx.x, ownPx.y + rows};
}

const char* imageFormat(gl::Format format) { return format == gl::Format::R32F ? "r32f" : "rgba32f"; }

}  // namespace

SurfacePoints::SurfacePoints(frame::Frame& frame, const SurfaceSamples& settings, const PixelSamples* samples,
                             gl::Format format)
    : settings_(settings),
      samples_(samples),
      ownPx_(roundedUp(frame.sizePx())),
      pointsPx_(pointsSize(ownPx_, samples ? settings.capacity : 0.0)),
      ownPoints_(frame.context().programs().compute(kSurfaceShaders + std::string("own_points.comp.glsl"))),
      ids_(gl::Format::R32UI, pointsPx_),
      places_(gl::Format::RG32F, pointsPx_),
      visibility_(format, frame.sizePx()),
      counts_(int64_t{sizeof(SurfaceCounts)}, nullptr) {
  gl::ShaderDefines defines = samples ? samples->defines() : gl::ShaderDefines{};
  defines["VISIBILITY_FORMAT"] = imageFormat(format);
  if (!samples) defines["SINGLE"] = "1";
  resolve_ = &frame.context().programs().compute(kSurfaceShaders + std::string("resolve_surfaces.comp.glsl"),
                                                 defines);
  if (!samples) return;
  defines["LANES"] = std::to_string(samples->places().size() + 1);
  surfaces_ =
      &frame.context().programs().compute(kSurfaceShaders + std::string("surfaces.comp.glsl"), defines);
}

void SurfacePoints::choose(frame::Frame& frame) const {
  const auto tell = [&](const gl::Program& program) {
    program.set("sizePx", frame.sizePx());
    program.set("pointsPx", pointsPx_);
    program.set("ownRows", ownPx_.y);
  };
  frame.get<frame::TriangleIds>().texture().bindTexture(kSurfaceCentreIdsUnit);
  ids_.bindImage(kSurfacePointIdsImage, gl::Access::Write);
  places_.bindImage(kSurfacePlacesImage, gl::Access::Write);
  counts_.bindStorage(kSurfaceCountsBuffer);
  tell(ownPoints_);
  ownPoints_.dispatch(pointsPx_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
  if (!surfaces_) return;
  tell(*surfaces_);
  const glm::dmat4& toCamera = frame.anchorToCamera();
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  surfaces_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  surfaces_->set("anchorToCamera", glm::mat4(toCamera));
  surfaces_->set("cameraToLight", glm::mat4(toLight * glm::inverse(toCamera)));
  for (size_t i = 0; i < samples_->places().size(); ++i)
    surfaces_->set(("samplePlaces[" + std::to_string(i) + "]").c_str(), samples_->places()[i]);
  surfaces_->set("tolerance", static_cast<float>(settings_.tolerance));
  surfaces_->set("cosine", static_cast<float>(std::cos(glm::radians(settings_.angleDeg))));
  surfaces_->set("capacity",
                 static_cast<uint32_t>(pointsPx_.x) * static_cast<uint32_t>(pointsPx_.y - ownPx_.y));
  frame.geometry().bindStorage();
  samples_->ids().bindStorage(kSampleIdsBuffer);
  counts_.bindStorage(kSurfaceCountsBuffer);
  frame::dispatchOverSampleList(*surfaces_, samples_->list());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SurfacePoints::resolve(frame::Frame& frame, const gl::Texture& ofPoints) const {
  resolve_->set("sizePx", frame.sizePx());
  resolve_->set("pointsPx", pointsPx_);
  resolve_->set("ownRows", ownPx_.y);
  ofPoints.bindTexture(kSurfaceVisibilityUnit);
  if (samples_) {
    samples_->marks().bindTexture(kSampleMarksUnit);
    samples_->ids().bindStorage(kSampleIdsBuffer);
  }
  visibility_.bindImage(kSurfaceVisibilityImage, gl::Access::Write);
  resolve_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

SurfacePoints::Counts SurfacePoints::counts() const {
  const SurfaceCounts read = counts_.read<SurfaceCounts>()[0];
  return {read.points, read.dropped, read.complexPixels};
}

}  // namespace limen::techniques
