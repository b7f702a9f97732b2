// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/mirror_rays.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <vector>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/surface_point.h"

namespace limen::frame {

double rayOriginTolerance(const GpuScene& scene) { return 0x1p-20 * scene.reach(); }

void configureRayOrigins(const gl::Program& program, const GpuScene& scene) {
  program.set("originTolerance", static_cast<float>(rayOriginTolerance(scene)));
}

namespace {

gl::ShaderDefines rayDefines(const Frame& frame, RefractionSetting setting) {
  gl::ShaderDefines defines = surfaceDefines(frame, true);
  if (setting.refraction) defines["REFRACT"] = "1";
  if (!frame.shownMirrors().all()) defines["SHOWN"] = "1";
  return defines;
}

std::optional<gl::Buffer> shownTriangles(const Frame& frame) {
  if (frame.shownMirrors().all()) return std::nullopt;
  const scene::Scene& scene = frame.scene();
  std::vector<uint32_t> bits(scene.mesh.triangles.size() / 32 + 1, 0);
  for (size_t p = 0; p < scene.parts.size(); ++p) {
    if (!frame.shownMirrors().has(p)) continue;
    const scene::Part& part = scene.parts[p];
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t)
      bits[t / 32] |= 1U << (t % 32);
  }
  return gl::Buffer(bits);
}

}  // namespace

const MirrorRays& firstRays(Frame& frame, bool refraction) {
  return refraction ? frame.get<MirrorRays>(RefractionSetting{true}) : frame.get<MirrorRays>();
}

MirrorRays::MirrorRays(Frame& frame, RefractionSetting setting)
    : program_(frame.context().programs().compute("renderer/frame/mirror_rays.comp.glsl",
                                                  rayDefines(frame, setting))),
      origins_(gl::Format::RGBA32F, frame.sizePx()),
      directions_(gl::Format::RGBA32F, frame.sizePx()),
      shown_(shownTriangles(frame)) {
  frame.passes().setBytesHeld("frame/mirror_rays",
                              origins_.bytes() + directions_.bytes() + (shown_ ? shown_->bytes() : 0));
}

void MirrorRays::make(Frame& frame) {
  const gl::Texture& ids = frame.get<TriangleIds>().texture();
  const auto scope = frame.passes().open("frame/mirror_rays");
  configureSurfacePoints(program_, frame, frame.camera());
  ids.bindTexture(kMirrorRaysIdsUnit);
  if (shown_) shown_->bindStorage(kMirrorRaysShownBuffer);
  origins_.bindImage(kMirrorRaysOriginsImage, gl::Access::Write);
  directions_.bindImage(kMirrorRaysDirectionsImage, gl::Access::Write);
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::frame
